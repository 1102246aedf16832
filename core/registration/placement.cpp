#include "core/registration/placement.h"

#include <algorithm>

#include "core/registration/fit_check.h"
#include "core/registration/found_place.h"

namespace adit {
namespace {

std::string words_of(SearchOutcome outcome) {
  switch (outcome) {
    case SearchOutcome::alike_elsewhere:
      return "it fits in more than one place";
    case SearchOutcome::undetermined:
      return "the walls are too smooth to tell where along the tunnel it stands";
    default:
      return "no other scan shows enough of the same surfaces";
  }
}

/// Scans in groups that stand together; each group has a frame of its own.
class Groups {
 public:
  Groups(const std::vector<PreparedScan>& scans, const std::vector<std::optional<Pose>>& known)
      : scans_(scans), group_(scans.size()), pose_(scans.size(), Pose::Identity()) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      group_[i] = known[i] ? 0 : i + 1;
      pose_[i] = known[i].value_or(Pose::Identity());
    }
  }

  bool together(std::size_t i, std::size_t k) const { return group_[i] == group_[k]; }
  bool all_together() const {
    return std::adjacent_find(group_.begin(), group_.end(), std::not_equal_to<>()) == group_.end();
  }

  /// Brings both groups together if that contradicts nothing: no other two scans of them may see through each other.
  bool join(std::size_t target, std::size_t source, const Pose& target_from_source) {
    // The group of the lower number keeps its frame: known scans and first ones come first.
    if (group_[source] < group_[target]) return join(source, target, target_from_source.inverse());
    const Pose kept_from_moved = pose_[target] * target_from_source * pose_[source].inverse();
    const bool guesses = group_[target] == 0;  // those may be metres off: nothing follows from them
    for (std::size_t i = 0; i < scans_.size() && !guesses; ++i)
      for (std::size_t k = 0; k < scans_.size(); ++k) {
        if (group_[i] != group_[target] || group_[k] != group_[source] || (i == target && k == source)) continue;
        const FitCheck check = check_fit(scans_[i], scans_[k], pose_[i].inverse() * kept_from_moved * pose_[k]);
        if (check.is_enough() && !check.agrees()) return false;
      }
    const std::size_t moved = group_[source];
    for (std::size_t k = 0; k < scans_.size(); ++k) {
      if (group_[k] != moved) continue;
      group_[k] = group_[target];
      pose_[k] = kept_from_moved * pose_[k];
    }
    return true;
  }

  /// The group of a known scan, or the largest (the first of them).
  std::size_t main_group(const std::vector<std::optional<Pose>>& known) const {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i]) return group_[i];
    const auto size = [&](std::size_t group) { return std::count(group_.begin(), group_.end(), group); };
    return *std::max_element(group_.begin(), group_.end(), [&](auto a, auto b) { return size(a) < size(b); });
  }

  std::optional<Pose> pose_in(std::size_t group, std::size_t scan) const {
    return group_[scan] == group ? std::optional<Pose>(pose_[scan]) : std::nullopt;
  }

 private:
  const std::vector<PreparedScan>& scans_;
  std::vector<std::size_t> group_;  ///< 0: that of the known scans; else one more than the scan whose frame it is
  std::vector<Pose> pose_;          ///< group_from_scan
};

/// Scans that follow each other in the job first: so do their stations, mostly.
std::vector<std::pair<std::size_t, std::size_t>> pairs_to_try(std::size_t scans) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t apart = 1; apart < scans; ++apart)
    for (std::size_t i = 0; i + apart < scans; ++i) pairs.emplace_back(i, i + apart);
  return pairs;
}

}  // namespace

std::vector<StartingPlace> place_scans(const std::vector<PreparedScan>& scans,
                                       const std::vector<std::optional<Pose>>& known,
                                       const RegistrationOptions& options, Progress& progress) {
  Groups groups(scans, known);
  std::vector<SearchOutcome> best(scans.size(), SearchOutcome::nothing_alike);
  const auto pairs = pairs_to_try(scans.size());
  for (std::size_t n = 0; n < pairs.size() && !groups.all_together(); ++n) {
    const auto [i, k] = pairs[n];
    Progress searching =
        progress.part(1.0 / static_cast<double>(pairs.size()), "searching " + scans[k].name + " in " + scans[i].name);
    if (groups.together(i, k)) continue;
    PairFound found = found_place(scans[i], scans[k], options, searching);
    if (found.outcome == SearchOutcome::placed && !groups.join(i, k, found.target_from_source))
      found.outcome = SearchOutcome::alike_elsewhere;
    best[i] = std::max(best[i], found.outcome);
    best[k] = std::max(best[k], found.outcome);
  }
  const std::size_t main = groups.main_group(known);
  std::vector<StartingPlace> places(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    places[i].local_from_scan = groups.pose_in(main, i);
    if (!places[i].local_from_scan)
      places[i].why_not =
          best[i] == SearchOutcome::placed ? "it fits to others, but none of them to the rest" : words_of(best[i]);
  }
  return places;
}

}  // namespace adit
