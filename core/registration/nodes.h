#pragma once
// The scans that take part in the adjustment.

#include <vector>

#include "core/registration/pose_graph.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

inline constexpr std::size_t least_targets = 3;  ///< place a scan without anything else

/// A scan with a starting pose.
struct Node {
  std::size_t scan = 0;  ///< index into the caller's scans
  const PreparedScan* prepared = nullptr;
  Pose start = Pose::Identity();                             ///< local_from_scan
  enum class By { guess, control, search } by = By::search;  ///< control: or pictures
  std::vector<GraphControl> control;
  std::vector<GraphSight> sights;

  bool is_tied() const { return !control.empty() || !sights.empty(); }
  /// Whether its targets or pictures alone say where it stands.
  bool is_placed() const { return control.size() >= least_targets || !sights.empty(); }
};

/// Throws Error when there is no scan, and for targets and pictures without a scan, a control point or a camera.
void check_targets(const std::vector<ScanToPlace>& scans, const RegistrationContext& context);
/// The targets of a scan with their control points; the node is 0.
std::vector<GraphControl> control_of(const std::string& scan, const RegistrationContext& context);
/// The pictures of a scan; the node is 0.
std::vector<GraphSight> sights_of(const std::string& scan, const RegistrationContext& context);

/// Those scans of the caller's that have enough points, in their order.
struct PreparedScans {
  std::vector<PreparedScan> scans;
  std::vector<std::size_t> of;  ///< indices into the caller's
};

/// Prepares all scans. A finding names each that has too few points; throws Error when all have.
PreparedScans prepare_scans(const std::vector<ScanToPlace>& scans, const RegistrationOptions& options,
                            Findings& findings, Progress& progress);

/// Those scans that can start: at their guess, by their control, or where the search finds them. A finding names each
/// that cannot.
std::vector<Node> starting_nodes(const std::vector<ScanToPlace>& scans, const PreparedScans& prepared,
                                 const RegistrationContext& context, const RegistrationOptions& options,
                                 Findings& findings, Progress& progress);

/// Direction of the tunnel at a node, local frame: the design's, or what its walls say.
Eigen::Vector3d axis_at(const RegistrationContext& context, const Node& node, const Pose& local_from_scan);

}  // namespace adit
