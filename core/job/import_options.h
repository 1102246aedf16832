#pragma once
// How scans are kept after import.

#include <string>

namespace adit {

struct ImportOptions {
  /// 0.1mm: coordinates rounded to 0.1 mm, about half the disk; float32: to the last bit
  std::string keep = "0.1mm";
};

template <typename Visitor>
void describe(Visitor& v, ImportOptions& o) {
  v.choice("keep", o.keep, {"0.1mm", "float32"},
           "coordinates rounded to 0.1 mm (half the disk), or float32 to the bit");
}

}  // namespace adit
