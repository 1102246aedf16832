#include "core/design/cant.h"

#include <algorithm>
#include <cmath>

#include "core/design/transition_curve.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

std::string station_at(const CantStation& station) {
  return "the cant station at chainage " + short_number(station.chainage_m);
}

}  // namespace

Cant::Cant(std::vector<CantStation> stations, double base_m) : stations_(std::move(stations)), base_m_(base_m) {
  if (!(base_m > 0.0) || !std::isfinite(base_m))
    throw Error("the base of the cant is not a positive length", {}, "give the distance from rail to rail in metres");
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const CantStation& station = stations_[i];
    if (!std::isfinite(station.chainage_m) || !std::isfinite(station.left_m) || !std::isfinite(station.right_m))
      throw Error("a station of the cant holds a number that is not finite");
    if (std::max(std::abs(station.left_m), std::abs(station.right_m)) > 0.5 * base_m) {
      throw Error(
          station_at(station) + " raises an edge by more than half of the base of " + short_number(base_m) + " m", {},
          "check the unit of the cant: millimetres or inches");
    }
    if (i > 0 && station.chainage_m < stations_[i - 1].chainage_m) {
      throw Error(
          station_at(station) + " goes back: the one before it stands at " + short_number(stations_[i - 1].chainage_m),
          {}, "list cant stations in order of chainage");
    }
  }
}

CantAt Cant::at(double chainage_m) const {
  if (stations_.empty()) return {};
  const auto behind = std::upper_bound(stations_.begin(), stations_.end(), chainage_m,
                                       [](double s, const CantStation& station) { return s < station.chainage_m; });
  const CantStation& before = behind == stations_.begin() ? *behind : *(behind - 1);
  double left_m = before.left_m, right_m = before.right_m;
  if (behind != stations_.begin() && behind != stations_.end()) {
    const double u = (chainage_m - before.chainage_m) / (behind->chainage_m - before.chainage_m);
    const double done = share_done(before.transition, u);
    left_m += done * (behind->left_m - before.left_m);
    right_m += done * (behind->right_m - before.right_m);
  }
  const double cant_m = left_m - right_m;
  return {cant_m, 0.5 * (left_m + right_m), std::asin(std::clamp(cant_m / base_m_, -1.0, 1.0))};
}

double Cant::strongest_m(double from_m, double to_m) const {
  double strongest = std::max(std::abs(at(from_m).cant_m), std::abs(at(to_m).cant_m));
  for (const CantStation& station : stations_)
    if (station.chainage_m > from_m && station.chainage_m < to_m)
      strongest = std::max(strongest, std::abs(station.left_m - station.right_m));
  return strongest;
}

}  // namespace adit
