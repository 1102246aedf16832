#include "io/pcd_pcl.h"

#include <pcl/io/lzf.h>

namespace adit::io {

std::string lzf_packed(std::string_view bytes) {
  std::string packed(bytes.size() + bytes.size() / 16 + 64, '\0');
  const unsigned size = pcl::lzfCompress(bytes.data(), static_cast<unsigned>(bytes.size()), packed.data(),
                                         static_cast<unsigned>(packed.size()));
  packed.resize(size);
  return packed;
}

}  // namespace adit::io
