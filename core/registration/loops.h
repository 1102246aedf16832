#pragma once
// Loops of pairs: what the pairs leave open around them is the error that no single pair shows.

#include <vector>

#include "core/registration/pose_graph.h"

namespace adit {

/// Pairs one after the other around a loop.
struct PairLoop {
  struct Part {
    std::size_t pair = 0;
    bool forward = true;  ///< from source to target
  };
  std::vector<Part> parts;
  std::vector<std::size_t> nodes;  ///< in the order they are met
};

/// One loop for each pair beyond those that a tree needs: the shortest over the tree and the pairs before it.
std::vector<PairLoop> loops_of(std::size_t nodes, const std::vector<GraphPair>& pairs);

/// How far from where it began a walk around the loop ends; the identity when the pairs agree.
Pose closure_of(const PairLoop& loop, const std::vector<GraphPair>& pairs);

}  // namespace adit
