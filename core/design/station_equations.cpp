#include "core/design/station_equations.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

double ahead_of(const StationEquation& equation, double chainage_m) {
  const double on = chainage_m - equation.chainage_m;
  return equation.ahead_m + (equation.decreasing ? -on : on);
}

}  // namespace

StationEquations::StationEquations(std::vector<StationEquation> equations) : equations_(std::move(equations)) {
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    const double chainage_m = equations_[i].chainage_m;
    constexpr double farthest_m = 1e8;
    if (!(std::abs(chainage_m) <= farthest_m) || !(std::abs(equations_[i].ahead_m) <= farthest_m))
      throw Error("station equation " + std::to_string(i + 1) +
                  " holds a number that is not finite or beyond 100,000 km");
    if (i > 0 && chainage_m <= equations_[i - 1].chainage_m) {
      throw Error("the station equation at chainage " + short_number(chainage_m) +
                      " goes back: the one before it stands at " + short_number(equations_[i - 1].chainage_m),
                  {}, "list station equations in order of chainage (internal station)");
    }
  }
}

double StationEquations::displayed_m(double chainage_m) const {
  const auto behind = std::upper_bound(equations_.begin(), equations_.end(), chainage_m,
                                       [](double s, const StationEquation& e) { return s < e.chainage_m; });
  return behind == equations_.begin() ? chainage_m : ahead_of(*(behind - 1), chainage_m);
}

double StationEquations::back_m(std::size_t i) const {
  const double chainage_m = equations_.at(i).chainage_m;
  return i == 0 ? chainage_m : ahead_of(equations_[i - 1], chainage_m);
}

}  // namespace adit
