#pragma once
// A command of adit: declares its arguments, then acts. One file each; main holds the table.

#include <CLI/CLI.hpp>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "core/foundation/error.h"
#include "core/foundation/progress.h"

namespace adit::app {

/// What every command understands.
struct CommonOptions {
  bool quiet = false;
  bool json = false;
  int threads = 0;  ///< 0: all cores
};

/// Exit codes.
inline constexpr int exit_good = 0;
inline constexpr int exit_needs_a_person = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_our_fault = 3;
inline constexpr int exit_cancelled = 130;

/// For arguments that name a file or a folder: no name is no place to look.
inline const CLI::Validator some_name([](const std::string& name) { return name.empty() ? "a name is needed" : ""; },
                                      "", "some_name");

/// For numbers with limits; CLI::Range lets nan through.
inline CLI::Validator number_between(double least, double most) {
  char limits[80];
  std::snprintf(limits, sizeof limits, "from %.15g to %.15g", least, most);
  return CLI::Validator(
      [least, most, limits = std::string(limits)](const std::string& word) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(word, value) && value >= least && value <= most) return std::string();
        return "\"" + word + "\" is no number " + limits;
      },
      limits, "number_between");
}

/// Thrown by a command that went on with other files where some were bad.
struct BadFiles {
  std::vector<Error> errors;
};

using Action = std::function<int(const CommonOptions&, Progress&)>;

/// Each declares its arguments on the sub-command and returns what to do after parsing.
Action declare_demo(CLI::App& command);
Action declare_run(CLI::App& command, const std::string& last_step);
Action declare_info(CLI::App& command);
Action declare_convert(CLI::App& command);
Action declare_axis(CLI::App& command);
Action declare_target(CLI::App& command);

}  // namespace adit::app
