#pragma once
// Displayed stations: chainage with the jumps of the station equations.

#include <vector>

namespace adit {

/// From chainage_m on, displayed stations go on from ahead_m: up with the chainage, or down.
struct StationEquation {
  double chainage_m = 0.0;
  double ahead_m = 0.0;
  bool decreasing = false;
};

/// Chainage (internal station) to displayed station. Without equations both are the same.
class StationEquations {
 public:
  StationEquations() = default;
  /// Throws Error, naming the equation, when their chainages do not increase or a number is not finite.
  explicit StationEquations(std::vector<StationEquation> equations);

  const std::vector<StationEquation>& equations() const { return equations_; }
  /// At an equation: the station ahead.
  double displayed_m(double chainage_m) const;
  /// What is displayed just before equation i.
  double back_m(std::size_t i) const;

 private:
  std::vector<StationEquation> equations_;
};

}  // namespace adit
