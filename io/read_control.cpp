#include "io/read_control.h"

#include "io/control_csv.h"
#include "io/file_ending.h"
#include "io/kof.h"

namespace adit::io {

ControlFile read_control(const std::filesystem::path& file) {
  if (lower_ending(file) != ".kof") return {read_control_csv(file), {}};
  const KofFile kof = read_kof(file);
  return {control_of(kof), kof.findings};
}

}  // namespace adit::io
