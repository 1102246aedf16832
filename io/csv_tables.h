#pragma once
// Tables beside the report: sections.csv, volumes.csv, registration.csv. Comma separated, decimal point, units in the
// names of the columns.

#include <string>

#include "core/job/results.h"

namespace adit::io {

std::string sections_csv(const Results& results);      ///< one row a section and line
std::string volumes_csv(const Results& results);       ///< one row a stretch, line and method
std::string registration_csv(const Results& results);  ///< one row a scan

}  // namespace adit::io
