#pragma once
// Tables of what a person judges: clearance.csv, zones.csv, tolerances.csv, face.csv, layer.csv. Comma separated,
// decimal point, units in the names of the columns.

#include <string>

#include "core/job/results.h"

namespace adit::io {

std::string zones_csv(const Results& results);       ///< one row a zone, and one for what lies in none
std::string tolerances_csv(const Results& results);  ///< one row a rock class and sector

/// clearance.csv: one row a point inside a clearance line.
std::string clearance_csv_header();
std::string clearance_csv_row(const ClearanceResult& clearance, const ClearancePoint& point, const std::string& scan,
                              const Eigen::Vector3d& site, double station_m);

std::string face_csv(const CompareResult& result);   ///< one row a cell of the face
std::string layer_csv(const CompareResult& result);  ///< one row a block of about a square metre

}  // namespace adit::io
