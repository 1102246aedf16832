#include "core/design/design_tunnel.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/design/profile_blend.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

void check_profiles(const std::vector<ProfileFrom>& profiles) {
  if (profiles.empty()) throw Error("the design has no profile");
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    if (profiles[i].profile.segments().empty()) throw Error("the design holds a profile without a line");
    if (!std::isfinite(profiles[i].from_m)) throw Error("a profile holds from a chainage that is not finite");
    if (profiles[i].interpolated && i + 1 == profiles.size())
      throw Error("the last profile changes into the next one, and there is none", {}, "let it hold as it is");
    if (i > 0 && profiles[i].from_m <= profiles[i - 1].from_m) {
      throw Error("profile " + profiles[i].profile.name() + " holds from chainage " + short_number(profiles[i].from_m) +
                      ", which is not behind the one before it (" + short_number(profiles[i - 1].from_m) + ")",
                  {}, "list the profiles in order of chainage");
    }
  }
}

/// Cuts a stretch over which a profile moves by `change_m` into steps of 0.1 m, or of a millimetre of change:
/// visit(where a step begins, share of the stretch it stands for). Each step stands for its middle, the first and the
/// last for the ends, so that a section at an end or at a whole step shows the design of its own place.
template <typename Visit>
void for_each_step(double from_m, double to_m, double change_m, const Visit& visit) {
  constexpr double shortest_step_m = 0.1, least_change_m = 0.001, none_m = 1e-9;
  if (change_m < none_m) return visit(from_m, 0.0);
  const double wanted = std::min((to_m - from_m) / shortest_step_m, change_m / least_change_m);
  const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil(wanted)));
  for (std::size_t k = 0; k <= n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    const double begin = k == 0 ? 0.0 : share - 0.5 / static_cast<double>(n);
    visit(from_m + begin * (to_m - from_m), share);
  }
}

/// Every stretch that changes as steps so small that nobody sees them.
std::vector<ProfileFrom> stepped(const std::vector<ProfileFrom>& profiles) {
  std::vector<ProfileFrom> steps;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    if (!profiles[i].interpolated) {
      steps.push_back(profiles[i]);
      continue;
    }
    const ProfileFrom &from = profiles[i], &to = profiles.at(i + 1);
    for_each_step(from.from_m, to.from_m, blend_distance_m(from.profile, to.profile),
                  [&](double begin_m, double share) {
                    steps.push_back({begin_m, blended_profile(from.profile, to.profile, share)});
                  });
  }
  return steps;
}

/// A profile between two chainages, turned: one step where the cant is even.
void add_turned(const Profile& profile, const Cant& cant, double from_m, double to_m, std::vector<ProfileFrom>& steps) {
  const double inside_m = to_m - 1e-9;  // at the end itself another transition may begin
  const CantAt begin = cant.at(from_m), end = cant.at(inside_m);
  const double reach_m = profile.box().max().cwiseAbs().cwiseMax(profile.box().min().cwiseAbs()).norm();
  const double change_m = reach_m * std::abs(end.turn_rad - begin.turn_rad) + std::abs(end.rise_m - begin.rise_m);
  for_each_step(from_m, to_m, change_m, [&](double begin_m, double share) {
    const CantAt at = cant.at(from_m + share * (inside_m - from_m));
    steps.push_back({begin_m, turned_profile(profile, at.turn_rad, at.rise_m)});
  });
}

std::vector<ProfileFrom> turned(const std::vector<ProfileFrom>& profiles, const Alignment& axis) {
  std::vector<ProfileFrom> steps;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const double from_m = std::max(profiles[i].from_m, i == 0 ? axis.from_m() : profiles[i].from_m);
    const double to_m = std::min(i + 1 < profiles.size() ? profiles[i + 1].from_m : axis.to_m(), axis.to_m());
    std::vector<double> bounds{from_m};
    for (const CantStation& station : axis.cant().stations())
      if (station.chainage_m > bounds.back() && station.chainage_m < to_m) bounds.push_back(station.chainage_m);
    bounds.push_back(to_m);
    for (std::size_t b = 0; b + 1 < bounds.size(); ++b)
      if (bounds[b + 1] > bounds[b]) add_turned(profiles[i].profile, axis.cant(), bounds[b], bounds[b + 1], steps);
  }
  return steps;
}

void check_lines(const std::vector<DesignLine>& lines) {
  if (lines.empty()) throw Error("the design has no line");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::isfinite(lines[i].offset_m) || !std::isfinite(lines[i].growth_per_m))
      throw Error("line " + lines[i].name + " has an offset that is not finite");
    for (std::size_t j = 0; j < i; ++j) {
      if (lines[j].name == lines[i].name) throw Error("two lines of the design are named " + lines[i].name);
    }
  }
}

}  // namespace

DesignTunnel::DesignTunnel(Alignment alignment, std::vector<ProfileFrom> profiles, std::vector<DesignLine> lines,
                           bool turned_by_cant)
    : alignment_(std::move(alignment)), profiles_(std::move(profiles)), lines_(std::move(lines)) {
  check_profiles(profiles_);
  check_lines(lines_);
  profiles_ = stepped(profiles_);
  if (turned_by_cant && !alignment_.cant().empty()) profiles_ = turned(profiles_, alignment_);
}

DesignTunnel DesignTunnel::standing(SectionPlane plane) const {
  DesignTunnel tunnel = *this;
  tunnel.plane_ = plane;
  return tunnel;
}

double DesignTunnel::lean_m(double from_m, double to_m) const {
  constexpr double step_m = 1.0, beyond_profile_m = 5.0;
  if (plane_ == SectionPlane::vertical) return 0.0;
  double steepest = 0.0, tallest_m = 0.0;
  const double begin_m = std::max(from_m - 10.0, alignment_.from_m());
  const double end_m = std::min(to_m + 10.0, alignment_.to_m());
  for (double s_m = begin_m; s_m < end_m + step_m; s_m += step_m)
    steepest = std::max(steepest, std::abs(alignment_.vertical().at(std::min(s_m, end_m)).grade));
  for (const ProfileFrom& profile : profiles_) {
    const Eigen::AlignedBox2d& box = profile.profile.box();
    tallest_m = std::max({tallest_m, std::abs(box.min().y()), std::abs(box.max().y())});
  }
  return 2.0 * steepest * (tallest_m + beyond_profile_m);
}

DesignTunnel DesignTunnel::driven(Drive drive) const {
  DesignTunnel tunnel = *this;
  tunnel.drive_ = std::move(drive);
  return tunnel;
}

DesignLine DesignTunnel::line_at(const DesignLine& line, double chainage_m) const {
  DesignLine here = line;
  here.growth_per_m = 0.0;
  if (line.growth_per_m == 0.0) return here;
  for (const Drive::Round& round : drive_.rounds)
    if (chainage_m >= round.from_m && chainage_m < round.to_m)
      here.offset_m += line.growth_per_m * (drive_.up_chainage ? chainage_m - round.from_m : round.to_m - chainage_m);
  return here;
}

const Profile& DesignTunnel::profile_at(double chainage_m) const {
  if (profiles_.empty()) throw Error("the design has no profile");
  const auto behind = std::upper_bound(profiles_.begin() + 1, profiles_.end(), chainage_m,
                                       [](double s, const ProfileFrom& profile) { return s < profile.from_m; });
  return std::prev(behind)->profile;
}

DesignTunnel DesignTunnel::relative_to(const Eigen::Vector3d& origin) const {
  DesignTunnel moved = *this;
  moved.alignment_ = alignment_.relative_to(origin);
  return moved;
}

}  // namespace adit
