#pragma once
// The header and the XML part of an E57 file, looked through before a library parses them.

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.h"

namespace adit::io {

/// The XML part. Error unless the header agrees with the file's size and the XML is plain: UTF-8, no document type
/// (entities can grow without end), no schema of its own (a parser would fetch it from the network), elements nested no
/// deeper than E57 asks for (parsers recurse), and the checksums of header and XML are right.
std::string read_plain_e57_xml(const InputFile& file);

/// Of each scan the byte of the file at which its points begin; 0 where the XML does not say.
std::vector<std::uint64_t> e57_record_places(const std::string& xml);

}  // namespace adit::io
