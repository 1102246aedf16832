#pragma once
// Something a person must see. Findings live in the results beside the number they concern; they are never printed
// here.

#include <string>
#include <vector>

namespace adit {

enum class Severity {
  note,      ///< worth knowing, changes nothing
  warning,   ///< a number is weaker than it looks; exit code stays 0
  decision,  ///< a person must decide or mend something; the job is not accepted, exit code 1
};

/// One doubt: which subject ("scan S3", "section 118.0"), in words, and how to mend it.
struct Finding {
  Severity severity = Severity::warning;
  std::string subject;
  std::string words;
  std::string mend;
  bool operator==(const Finding&) const = default;
};

using Findings = std::vector<Finding>;

}  // namespace adit
