#include "core/registration/loops.h"

#include <algorithm>
#include <optional>

namespace adit {
namespace {

/// How a node was reached from the one before.
struct Reached {
  std::size_t from = 0;
  PairLoop::Part part;
};
using Tree = std::vector<std::optional<Reached>>;

/// Breadth first over those pairs that are walkable, as far as they go: the shortest way to each node.
Tree tree_from(std::size_t root, std::size_t nodes, const std::vector<GraphPair>& pairs,
               const std::vector<bool>& walkable) {
  Tree tree(nodes);
  tree[root] = Reached{root, {}};
  std::vector<std::size_t> front{root};
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t at : front)
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const bool forward = pairs[k].source == at;
        if (!walkable[k] || (!forward && pairs[k].target != at)) continue;
        const std::size_t to = forward ? pairs[k].target : pairs[k].source;
        if (tree[to]) continue;
        tree[to] = Reached{at, {k, forward}};
        next.push_back(to);
      }
    front = std::move(next);
  }
  return tree;
}

/// Pairs of a tree over each group of nodes.
std::vector<bool> spanning(std::size_t nodes, const std::vector<GraphPair>& pairs) {
  std::vector<bool> spans(pairs.size(), false), seen(nodes, false);
  for (std::size_t root = 0; root < nodes; ++root) {
    if (seen[root]) continue;
    const Tree tree = tree_from(root, nodes, pairs, std::vector<bool>(pairs.size(), true));
    for (std::size_t node = 0; node < nodes; ++node) {
      if (!tree[node]) continue;
      seen[node] = true;
      if (node != root) spans[tree[node]->part.pair] = true;
    }
  }
  return spans;
}

/// From the pair's source over the pair to its target, and back the shortest way.
PairLoop loop_over(std::size_t pair, std::size_t nodes, const std::vector<GraphPair>& pairs,
                   const std::vector<bool>& walkable) {
  const std::size_t source = pairs[pair].source;
  const Tree tree = tree_from(source, nodes, pairs, walkable);
  PairLoop loop{{{pair, true}}, {pairs[pair].target}};
  for (std::size_t at = pairs[pair].target; at != source; at = tree[at]->from) {
    loop.parts.push_back({tree[at]->part.pair, !tree[at]->part.forward});
    loop.nodes.push_back(tree[at]->from);
  }
  return loop;
}

}  // namespace

std::vector<PairLoop> loops_of(std::size_t nodes, const std::vector<GraphPair>& pairs) {
  const std::vector<bool> spans = spanning(nodes, pairs);
  std::vector<bool> walkable = spans;
  std::vector<PairLoop> loops;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (spans[k]) continue;
    loops.push_back(loop_over(k, nodes, pairs, walkable));
    walkable[k] = true;
  }
  return loops;
}

Pose closure_of(const PairLoop& loop, const std::vector<GraphPair>& pairs) {
  Pose walked = Pose::Identity();  // end_from_begin
  for (const PairLoop::Part& part : loop.parts) {
    const Pose& step = pairs[part.pair].target_from_source;
    walked = (part.forward ? step : Pose(step.inverse())) * walked;
  }
  return walked;
}

}  // namespace adit
