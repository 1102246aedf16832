#pragma once
// Tables beside the report: sections.csv, volumes.csv, sectors.csv, registration.csv, rings.csv. Comma separated,
// decimal point, units in the names of the columns.

#include <string>

#include "core/job/results.h"

namespace adit::io {

std::string sections_csv(const Results& results);      ///< one row a section and line
std::string volumes_csv(const Results& results);       ///< one row a stretch, line and method
std::string sectors_csv(const Results& results);       ///< one row a stretch, line and sector
std::string registration_csv(const Results& results);  ///< one row a scan
std::string rings_csv(const Results& results);         ///< one row a ring
std::string circles_csv(const Results& results);       ///< one row a section with a best circle

}  // namespace adit::io
