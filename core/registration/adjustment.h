#pragma once
// The adjustment of all scans, without the observations that contradict the others.

#include <vector>

#include "core/foundation/progress.h"
#include "core/registration/pose_graph.h"

namespace adit {

/// A target whose residual is longer than this many sigmas of control is wrong.
inline constexpr double wrong_control_sigmas = 5.0;

/// Observations that may be wrong together, as indices into the graph.
struct Suspect {
  enum class Kind {
    pair,         ///< one pair of scans
    observation,  ///< one target in one scan
    point,        ///< a control point: its targets in all scans
    scan,         ///< all targets of a scan
    sight         ///< where a picture says its camera stood
  };
  Kind kind = Kind::pair;
  std::vector<std::size_t> pairs;
  std::vector<std::size_t> control;
  std::vector<std::size_t> sights;
};

/// One contradiction among the observations.
struct Contradiction {
  std::vector<Suspect> suspects;  ///< one when left out; else all whose absence would end the contradiction
  bool left_out = false;          ///< false: the others cannot tell which suspect is wrong, so all stay in
  double off_m = 0.0;             ///< what was left out, from where the others put it: the farthest of it
  double turned_rad = 0.0;        ///< and how it is turned there, of pairs and pictures
};

struct Adjustment {
  PoseGraphResult solved;
  std::vector<bool> pair_used;     ///< of the graph's pairs
  std::vector<bool> control_used;  ///< of the graph's control
  std::vector<bool> sight_used;    ///< of the graph's sights
  std::vector<Contradiction> contradictions;
};

/// The graph of what is used: pairs, control and sights in their order, less those left out.
PoseGraph used_part(const PoseGraph& graph, const Adjustment& adjustment);

/// Solves the graph. While observations contradict each other (a pair twenty of its own sigmas off, a target five, a
/// sight seven), every suspect is left out in turn (data snooping by trial, after Baarda 1968), and the one whose
/// absence explains most goes for good; unless another explains as much, or too little control would be left.
/// Deterministic.
Adjustment adjusted(const PoseGraph& graph, Progress& progress);

}  // namespace adit
