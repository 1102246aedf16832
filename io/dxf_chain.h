#pragma once
// Loose lines and arcs put end to end.

#include <optional>
#include <vector>

#include "io/dxf_entities.h"

namespace adit::io {

struct DxfChains {
  std::vector<DxfLine> closed;
  std::vector<DxfLine> open;
  std::optional<Eigen::Vector2d> branch;  ///< a place where three or more ends meet: chains stop there
};

/// The same segments walked from the other end.
std::vector<ProfileSegment> reversed(const std::vector<ProfileSegment>& segments);

/// Chains entities (in metres) of the same layer whose ends meet within 1 mm.
DxfChains chained(const std::vector<DxfLine>& lines);

}  // namespace adit::io
