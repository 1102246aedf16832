#include "core/registration/control_findings.h"

#include <gtest/gtest.h>

#include "core/foundation/angle.h"

namespace adit {
namespace {

/// Four scans that control placed 13 m apart, each with a guess that is off its place by a move of its own and, before
/// it, by one that all share.
Findings findings_of(const Pose& shared, double own_m) {
  RegistrationResult result;
  std::vector<Node> nodes(4);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double way = i % 2 == 0 ? own_m : -own_m;
    result.scans.emplace_back();
    result.scans.back().local_from_scan = make_pose({13.0 * static_cast<double>(i), 0.0, 0.0}, {0.7, 0.0, 0.0});
    nodes[i].scan = i;
    nodes[i].by = Node::By::guess;
    nodes[i].start = Eigen::Translation3d(way, -way, 0.0) * (shared * result.scans.back().local_from_scan);
    nodes[i].control.resize(3);
  }
  compare_guesses_with_control(result, nodes, {});
  return result.findings;
}

Pose turned(double degrees) {
  return make_pose({20.0, 0.0, 0.0}, {rad_from_deg(degrees), 0.0, 0.0}) * Eigen::Translation3d(-20.0, 0.0, 0.0);
}

TEST(ControlFindings, GuessesThatAllStandOffControlOneWayAreADecision) {
  const auto moved = [](const Eigen::Vector3d& m) { return Pose(Eigen::Translation3d(m)); };
  EXPECT_TRUE(findings_of(Pose::Identity(), 0.5).empty());
  EXPECT_TRUE(findings_of(moved({0.3, 0.0, 0.0}), 0.4).empty());
  EXPECT_EQ(findings_of(moved({0.0, 0.0, 1.0}), 0.4).size(), 1U);
  EXPECT_EQ(findings_of(moved({100.0, 0.0, 0.0}), 0.4).size(), 1U);
  EXPECT_TRUE(findings_of(moved({1.0, 0.0, 0.0}), 1.8).empty());  // each another way: those guesses are bad
}

TEST(ControlFindings, GuessesThatAreAllTurnedOneWayAreADecision) {
  EXPECT_TRUE(findings_of(turned(1.0), 0.0).empty());
  for (const double degrees : {5.0, -20.0, 90.0, 178.0, 180.0}) {
    const Findings findings = findings_of(turned(degrees), 0.1);
    ASSERT_EQ(findings.size(), 1U) << degrees;
    EXPECT_EQ(findings[0].severity, Severity::decision);
    EXPECT_NE(findings[0].words.find("turned by"), std::string::npos) << findings[0].words;
  }
}

}  // namespace
}  // namespace adit
