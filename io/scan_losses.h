#pragma once
// What a scan file cannot hold of the scans that are written to it.

#include <filesystem>
#include <string>
#include <vector>

#include "io/scan_writer.h"

namespace adit::io {

/// What is left out or changed, for people, a sentence each: attributes that the format lacks, places without a return,
/// points that are not finite, a pose that moves the points, stretched intensities. Empty: all is kept.
std::vector<std::string> losses_of_writing(const std::filesystem::path& file, const std::vector<ScanFacts>& scans);

}  // namespace adit::io
