#pragma once
// What stands in front of every writer: points moved where the format has no place for the scanner's pose, and the
// promise that the second pass brings what the first one saw.

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "io/scan_writer.h"

namespace adit::io {

/// Makes the format's own writer for scans with these facts.
using MakeWriter = std::function<std::unique_ptr<ScanWriter>(const std::vector<ScanFacts>&)>;

/// A writer of `file` that hands to the format's own what it may believe: as many scans and points as the facts say,
/// with the same attributes and inside the same box, already moved. Error when they are others (the source changed in
/// between), and for coordinates that no site has (beyond 10^10 m).
std::unique_ptr<ScanWriter> checked_writer(const std::filesystem::path& file, std::vector<ScanFacts> facts,
                                           PoseGoes pose_goes, const MakeWriter& make_writer);

}  // namespace adit::io
