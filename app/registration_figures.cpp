#include "app/registration_figures.h"
#include "app/placed_tiles.h"

#include <cctype>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>

#include "app/file_name.h"
#include "app/pair_sections.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "render/probability_drawing.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;
constexpr double cell_m = 1.0;  // as in the paper's figure
constexpr double pixel_m = 0.05;
constexpr double all_ranges_m = 1e9;
constexpr std::size_t all_pairs = std::numeric_limits<std::size_t>::max();
constexpr std::size_t name_bytes = 40;

/// Names that these pictures have: ndt-1-..., overlap-1-...
bool is_ours(const std::string& name) {
  for (const char* begin : {"ndt-", "overlap-"})
    if (name.starts_with(begin) && name.ends_with(".png") &&
        std::isdigit(static_cast<unsigned char>(name[std::strlen(begin)])) != 0)
      return true;
  return false;
}

/// An own folder, without what an earlier run left; what else lies there is not ours to touch.
void clear(const fs::path& folder) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(folder, ignored);
  if (fs::exists(status) && !fs::is_directory(status))
    throw Error("this is no folder", folder.string(), "move it, or choose another folder with --out");
  fs::create_directories(folder);
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_ours(entry.path().filename().string()) && !entry.is_directory(ignored)) old.push_back(entry.path());
  for (const fs::path& file : old) fs::remove(file);
}

render::Picture distributions_picture(const JobState& state, std::size_t scan, Progress& progress) {
  const auto& options = state.job.options.profiling;
  const io::PointStore& store = *state.stores[scan];
  const bool limited = scanner_at_origin(store);
  const DistributionMap cells(cell_sums(store, cell_m, limited ? options.least_range_m : 0.0,
                                        limited ? options.most_range_m : all_ranges_m, progress),
                              cell_m, {});
  return render::probability_picture(
      probability_from_above(cells, state.results.registration.scans[scan].local_from_scan, pixel_m),
      state.job.scans[scan].name +
          ": normal distributions in cells of 1 m, from above, north up; black: nothing, white: walls on edge");
}

}  // namespace

std::vector<fs::path> write_registration_figures(const JobState& state, Progress& progress) {
  const fs::path folder = state.out / "figures";
  clear(folder);
  std::vector<fs::path> files;
  const auto write = [&](const std::string& name, const render::Picture& picture) {
    files.push_back(folder / (name + ".png"));
    io::write_file_atomically(files.back(), render::png_bytes(picture));
  };
  const std::size_t scans = state.stores.size();
  for (std::size_t i = 0; i < scans; ++i) {
    if (!state.results.registration.scans[i].placed) continue;
    Progress drawing = progress.part(0.5 / static_cast<double>(scans), "drawing distributions");
    write("ndt-" + std::to_string(i + 1) + "-" + in_file_name(state.job.scans[i].name, name_bytes),
          distributions_picture(state, i, drawing));
  }
  Progress cutting = progress.part(0.5, "drawing overlaps");
  std::size_t number = 0;
  for (const render::PairSection& section : pair_sections(state, all_pairs, cutting))
    write("overlap-" + std::to_string(++number) + "-" + in_file_name(section.pair.source, name_bytes) + "-" +
              in_file_name(section.pair.target, name_bytes),
          render::overlap_picture(section, 130.0, 90.0));
  return files;
}

}  // namespace adit::app
