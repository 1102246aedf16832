#include "io/e57.h"

namespace adit::io {

bool is_e57(std::string_view beginning) {
  return beginning.starts_with("ASTM-E57");
}

}  // namespace adit::io
