#include "core/registration/loops.h"

#include <algorithm>
#include <optional>

namespace adit {
namespace {

/// How each node was reached from the one before.
struct Reached {
  std::size_t from = 0;
  PairLoop::Part part;
  std::size_t depth = 0;
};
using Tree = std::vector<std::optional<Reached>>;

/// Breadth first, so that loops are short.
void grow(Tree& tree, std::vector<bool>& in_tree, std::size_t root, const std::vector<GraphPair>& pairs) {
  std::vector<std::size_t> front{root};
  tree[root] = Reached{root, {}, 0};
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t at : front)
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const bool forward = pairs[k].source == at;
        if (!forward && pairs[k].target != at) continue;
        const std::size_t to = forward ? pairs[k].target : pairs[k].source;
        if (tree[to]) continue;
        tree[to] = Reached{at, {k, forward}, tree[at]->depth + 1};
        in_tree[k] = true;
        next.push_back(to);
      }
    front = std::move(next);
  }
}

/// From the pair's source over the pair to its target and back through the tree.
PairLoop loop_over(std::size_t pair, const std::vector<GraphPair>& pairs, const Tree& tree) {
  std::size_t ahead = pairs[pair].target;
  std::size_t behind = pairs[pair].source;
  std::vector<PairLoop::Part> up{{pair, true}}, down;
  std::vector<std::size_t> up_nodes{ahead}, down_nodes;
  while (ahead != behind) {
    if (tree[ahead]->depth >= tree[behind]->depth) {
      up.push_back({tree[ahead]->part.pair, !tree[ahead]->part.forward});
      ahead = tree[ahead]->from;
      up_nodes.push_back(ahead);
    } else {
      down.push_back(tree[behind]->part);
      down_nodes.push_back(behind);
      behind = tree[behind]->from;
    }
  }
  std::reverse(down.begin(), down.end());
  std::reverse(down_nodes.begin(), down_nodes.end());
  PairLoop loop{up, up_nodes};
  loop.parts.insert(loop.parts.end(), down.begin(), down.end());
  loop.nodes.insert(loop.nodes.end(), down_nodes.begin(), down_nodes.end());
  return loop;
}

}  // namespace

std::vector<PairLoop> loops_of(std::size_t nodes, const std::vector<GraphPair>& pairs) {
  Tree tree(nodes);
  std::vector<bool> in_tree(pairs.size(), false);
  for (std::size_t node = 0; node < nodes; ++node)
    if (!tree[node]) grow(tree, in_tree, node, pairs);
  std::vector<PairLoop> loops;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (!in_tree[k]) loops.push_back(loop_over(k, pairs, tree));
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
