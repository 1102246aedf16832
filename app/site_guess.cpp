#include "app/site_guess.h"

#include "app/placed_tiles.h"

namespace adit::app {
namespace {

std::optional<Pose> site_from_file(const JobScan& scan, const io::PointStore& store) {
  if (scan.position) return make_pose(*scan.position, scan.angles);
  if (store.file_pose()) return store.file_pose();
  if (!scanner_at_origin(store)) return Pose::Identity();
  return std::nullopt;
}

}  // namespace

std::optional<Pose> local_from_scan_guess(const JobState& state, std::size_t scan) {
  const io::PointStore& store = *state.stores[scan];
  auto guess = site_from_file(state.job.scans[scan], store);
  if (guess) guess->translation() += guess->linear() * store.offset() - state.results.import.origin.position;
  return guess;
}

}  // namespace adit::app
