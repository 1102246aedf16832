#pragma once
// What a LAS header says for people: who wrote it, when, in which coordinate system.

#include <vector>

#include "io/bytes.h"
#include "io/las_header.h"
#include "io/scan_formats.h"

namespace adit::io {

/// Of a file whose header was read and checked (LAZ has the same one). Variable-length records that are damaged are
/// passed over.
std::vector<HeaderFact> las_description(const InputFile& file, const LasHeader& header);

/// Unit of the coordinates ("foot", "US survey foot", "degree", ...) where the GeoTIFF keys or the well-known text say
/// that it is not the metre; else empty.
std::string las_unit(const InputFile& file, const LasHeader& header);

}  // namespace adit::io
