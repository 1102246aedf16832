#pragma once
// The header and the XML part of an E57 file, looked through before a library parses them.

#include <string>

#include "io/bytes.h"

namespace adit::io {

/// Error unless the header agrees with the file's size and the XML is plain: UTF-8, no document type (entities can grow
/// without end), no schema of its own (a parser would fetch it from the network), elements nested no deeper than E57
/// asks for (parsers recurse).
void expect_plain_e57_xml(const InputFile& file);

}  // namespace adit::io
