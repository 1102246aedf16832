// The normal distributions transform against numeric truth and simulated pairs.

#include "core/registration/ndt.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Eigenvalues>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/registration/newton.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

/// Points of a bumpy plane and a bumpy wall.
std::vector<Eigen::Vector3f> bumpy_corner(std::uint64_t seed, std::size_t count) {
  const Random random(seed);
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double u = random.uniform(4 * i, -6.0, 6.0);
    const double v = random.uniform(4 * i + 1, 0.0, 5.0);
    const double bump = 0.15 * std::sin(1.7 * u) * std::cos(1.1 * v) + 0.004 * random.normal(4 * i + 2);
    points.push_back(i % 2 == 0 ? Eigen::Vector3d(u, v, bump).cast<float>()
                                : Eigen::Vector3d(u, bump, v).cast<float>());
  }
  return points;
}

DistributionMap map_of(const std::vector<Eigen::Vector3f>& points, double cell_m) {
  return {cell_sums(points, cell_m), cell_m, {}};
}

std::vector<NormalDistribution> as_points(const std::vector<Eigen::Vector3f>& points) {
  std::vector<NormalDistribution> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result[i].mean = points[i].cast<double>();
  return result;
}

TEST(CellSums, MeanAndCovarianceAreThoseOfThePoints) {
  const auto points = bumpy_corner(1, 20000);
  const DistributionMap map = map_of(points, 1.0);
  for (const NormalDistribution& d : map.distributions()) {
    std::vector<Eigen::Vector3d> mine;
    const Eigen::Vector3d cell = d.mean.array().floor();
    for (const auto& p : points)
      if (p.cast<double>().array().floor().matrix() == cell) mine.push_back(p.cast<double>());
    ASSERT_EQ(static_cast<double>(mine.size()), d.points);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& x : mine) mean += x / d.points;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& x : mine) covariance += (x - mean) * (x - mean).transpose() / (d.points - 1.0);
    EXPECT_LT((d.mean - mean).norm(), 1e-12);
    // A cell at the rim may hold so flat a piece that it was made thicker; never thinner.
    const Eigen::Matrix3d more = d.covariance - covariance;
    EXPECT_GT(more.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
    EXPECT_LT(more.norm(), 0.03 * 0.03 * covariance.norm() + 0.005 * 0.005);
  }
}

TEST(CellSums, DoubleCellsAreTheSumsOfTheirParts) {
  const auto points = bumpy_corner(2, 50000);
  const auto doubled = with_double_cells(with_double_cells(cell_sums(points, 0.5)));
  const auto direct = cell_sums(points, 2.0);
  ASSERT_EQ(doubled.size(), direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i) {
    EXPECT_EQ(doubled[i].key, direct[i].key);
    EXPECT_EQ(doubled[i].points, direct[i].points);
    EXPECT_LT((doubled[i].first - direct[i].first).norm(), 1e-8);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(doubled[i].second[k], direct[i].second[k], 1e-7);
  }
}

TEST(CellIndex, FindsTheCellsAroundAPlaceAndNoOthers) {
  const Random random(9, 1);
  std::vector<std::array<int, 3>> cells;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto place = [&](std::uint64_t axis) { return static_cast<int>(random.uniform(3 * i + axis, -9.0, 9.0)); };
    cells.push_back({place(0), place(1), place(2)});
  }
  const double cell_m = 0.3;
  const auto key_of = [&](const std::array<int, 3>& c) {
    return cell_key(in_cells(cell_m * Eigen::Vector3d(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5), cell_m));
  };
  std::sort(cells.begin(), cells.end(), [&](const auto& a, const auto& b) { return key_of(a) < key_of(b); });
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<std::uint64_t> keys;
  for (const auto& cell : cells) keys.push_back(key_of(cell));
  const CellIndex index(keys, cell_m);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Eigen::Vector3d at(random.uniform(20000 + 3 * i, -10.0, 10.0), random.uniform(20001 + 3 * i, -10.0, 10.0),
                             random.uniform(20002 + 3 * i, -10.0, 10.0));
    std::vector<std::size_t> found, expected;
    index.visit_near(cell_m * at, [&](std::size_t slot) { found.push_back(slot); });
    for (std::size_t slot = 0; slot < cells.size(); ++slot) {
      const auto& c = cells[slot];
      if ((Eigen::Vector3d(c[0], c[1], c[2]) - Eigen::Vector3d(at.array().floor())).cwiseAbs().maxCoeff() < 1.5)
        expected.push_back(slot);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
  std::size_t beyond = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {-1e9, 1e9, 1e300, nan}) index.visit_near({x, 0.0, 0.0}, [&](std::size_t) { ++beyond; });
  CellIndex().visit_near({0.0, 0.0, 0.0}, [&](std::size_t) { ++beyond; });
  EXPECT_EQ(beyond, 0U);
}

TEST(CellSums, TilesGiveWhatTheirPointsGive) {
  PointCloud cloud;
  cloud.points = bumpy_corner(3, 30000);
  Progress progress;
  const auto of_tiles = cell_sums(CloudTiles(cloud, 1000), 0.5, 0.5, 5.0, progress);
  std::erase_if(cloud.points, [](const Eigen::Vector3f& p) { return p.norm() < 0.5F || p.norm() > 5.0F; });
  const auto of_points = cell_sums(cloud.points, 0.5);
  ASSERT_EQ(of_tiles.size(), of_points.size());
  for (std::size_t i = 0; i < of_points.size(); ++i) {
    EXPECT_EQ(of_tiles[i].key, of_points[i].key);
    EXPECT_EQ(of_tiles[i].points, of_points[i].points);
  }
  const std::vector<Eigen::Vector3f> far{{3e6F, 0.0F, 0.0F}};
  EXPECT_THROW(cell_sums(far, 1.0), Error);
  const std::vector<Eigen::Vector3f> nan{{std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}};
  EXPECT_THROW(cell_sums(nan, 1.0), Error);
}

/// Central differences of the score about a pose, by the form's own way of turning.
NdtScore numeric(const DistributionMap& target, const std::vector<NormalDistribution>& source, const Pose& pose,
                 const NdtScoreOptions& options) {
  Progress progress;
  const auto at = [&](const Vector6d& step) {
    Pose moved = pose;
    Eigen::Matrix3d turn = rotation_from_vector(step.head<3>());
    if (options.rotation == RotationForm::small_angle)
      turn << 1, -step[2], step[1], step[2], 1, -step[0], -step[1], step[0], 1;
    moved.linear() = turn * pose.linear();
    moved.translation() += step.tail<3>();
    return ndt_score(target, source, moved, options, progress).score;
  };
  NdtScore result;
  constexpr double h = 2e-5;  // far less than the thickness of a distribution
  for (int i = 0; i < 6; ++i) {
    result.gradient[i] = (at(h * Vector6d::Unit(i)) - at(-h * Vector6d::Unit(i))) / (2.0 * h);
    for (int k = 0; k < 6; ++k) {
      const Vector6d a = h * Vector6d::Unit(i);
      const Vector6d b = h * Vector6d::Unit(k);
      result.hessian(i, k) = (at(a + b) - at(a - b) - at(b - a) + at(-a - b)) / (4.0 * h * h);
    }
  }
  return result;
}

TEST(NdtScore, DerivativesAreThoseOfNumericDifferentiation) {
  const DistributionMap target = map_of(bumpy_corner(4, 20000), 1.0);
  const auto points = bumpy_corner(5, 1500);
  const Pose pose = make_pose({0.13, -0.08, 0.05}, {0.02, -0.01, 0.015});
  Progress progress;
  for (const RotationForm form : {RotationForm::full, RotationForm::small_angle})
    for (const bool distributions : {false, true}) {
      const auto source = distributions ? map_of(points, 1.0).distributions() : as_points(points);
      NdtScoreOptions options;
      options.rotation = form;
      const NdtScore analytic = ndt_score(target, source, pose, options, progress);
      const NdtScore differences = numeric(target, source, pose, options);
      EXPECT_LT((analytic.gradient - differences.gradient).norm(), 1e-5 * analytic.gradient.norm());
      EXPECT_LT((analytic.hessian - differences.hessian).norm(), 1e-4 * analytic.hessian.norm());
    }
}

/// A point on its way through many cells: no step in the score, which a plain sum over cells would have.
TEST(NdtScore, HasNoStepsWhereAPointGoesFromCellToCell) {
  const DistributionMap target = map_of(bumpy_corner(6, 40000), 1.0);
  Progress progress;
  const std::vector<NormalDistribution> point(1);
  NdtScoreOptions options;
  double greatest = 0.0;
  for (const double step_m : {1e-3, 1e-4}) {
    double before = 0.0;
    double largest_change = 0.0;
    for (int i = 0; i < 40000 && i * step_m < 8.0; ++i) {
      Pose pose = Pose::Identity();
      pose.translation() = Eigen::Vector3d(-4.0 + i * step_m, 2.0 + 0.3 * i * step_m, 0.05);
      const double score = ndt_score(target, point, pose, options, progress).score;
      if (i > 0) largest_change = std::max(largest_change, std::abs(score - before));
      before = score;
    }
    if (greatest > 0.0) {
      EXPECT_LT(largest_change, 0.12 * greatest);  // a tenth of the way, a tenth of the change
    }
    greatest = largest_change;
  }
}

TEST(Newton, NeverAcceptsAWorseScore) {
  const DistributionMap target = map_of(bumpy_corner(7, 40000), 1.0);
  const auto source = map_of(bumpy_corner(8, 40000), 1.0).distributions();
  Progress progress;
  std::vector<double> best;
  const auto score = [&](const Pose& pose) { return ndt_score(target, source, pose, {}, progress); };
  NewtonOptions options;
  const Random random(9);
  for (std::uint64_t trial = 0; trial < 5; ++trial) {
    const auto number = [&](std::uint64_t i) { return random.uniform(6 * trial + i, -1.0, 1.0); };
    const Pose start = make_pose(0.8 * Eigen::Vector3d(number(0), number(1), number(2)),
                                 {0.1 * number(3), 0.1 * number(4), 0.1 * number(5)});
    options.most_iterations = 0;
    double last = descend(start, score, options).at.score;
    for (options.most_iterations = 1; options.most_iterations < 8; ++options.most_iterations) {
      const NewtonResult found = descend(start, score, options);
      EXPECT_LE(found.at.score, last);
      last = found.at.score;
    }
  }
}

TEST(Newton, StaysWhereNothingOverlaps) {
  const DistributionMap target = map_of(bumpy_corner(7, 4000), 1.0);
  const auto source = map_of(bumpy_corner(8, 4000), 0.5).distributions();
  Progress progress;
  const Pose far = make_pose({500.0, 0.0, 0.0}, {});
  const NewtonResult found =
      descend(far, [&](const Pose& pose) { return ndt_score(target, source, pose, {}, progress); }, {});
  EXPECT_EQ(found.pose.matrix(), far.matrix());
  EXPECT_EQ(found.at.score, 0.0);
}

struct SimulatedPair {
  RockTunnel rock = tests::sample_rock();
  Pose truth;
  DistributionPyramid target, source;

  SimulatedPair() {
    const Pose first = tests::station(rock.design(), 36.0, 10.0);
    const Pose second = tests::station(rock.design(), 44.0, 140.0);
    truth = first.inverse() * second;
    target = pyramid_of(tests::scan_at(rock, first, 1, 300000));
    source = pyramid_of(tests::scan_at(rock, second, 2, 300000));
  }
  static DistributionPyramid pyramid_of(const PointCloud& cloud) {
    Progress progress;
    return distribution_pyramid(cell_sums(CloudTiles(cloud), 0.125, 0.6, 45.0, progress), 0.125, 10.0, {});
  }
  Pose found(const Pose& guess, const NdtOptions& options = {}) const {
    Progress progress;
    return ndt_align(target, source, guess, options, progress).target_from_source;
  }
};

TEST(NdtSlow, FindsAPairFromThreeMetresAndTenDegrees) {
  const SimulatedPair pair;
  const Random random(17);
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Eigen::Vector3d direction(random.normal(3 * i), random.normal(3 * i + 1), 0.3 * random.normal(3 * i + 2));
    const Pose guess = tests::off(pair.truth, 3.0 * direction.normalized(), i % 2 == 0 ? 10.0 : -10.0);
    const Pose found = pair.found(guess);
    EXPECT_LT(distance_between_m(found, pair.truth), 0.001) << i;
    EXPECT_LT(rotation_between_rad(found, pair.truth), rad_from_deg(0.005)) << i;
  }
}

TEST(NdtSlow, PointsOnDistributionsFindTheSamePlace) {
  const SimulatedPair pair;
  NdtOptions options;
  options.sources = NdtSources::points;
  const Pose guess = tests::off(pair.truth, {0.7, 0.3, 0.1}, 2.0);
  const Pose found = pair.found(guess, options);
  EXPECT_LT(distance_between_m(found, pair.truth), 0.005);
  EXPECT_LT(rotation_between_rad(found, pair.truth), rad_from_deg(0.02));
  EXPECT_NE(found.matrix(), pair.found(guess).matrix());
}

TEST(NdtSlow, SameBytesOnAnyNumberOfThreads) {
  std::vector<Eigen::Matrix4d> found;
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const SimulatedPair pair;
    found.push_back(pair.found(tests::off(pair.truth, {0.7, 0.3, 0.1}, 2.0)).matrix());
  }
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

}  // namespace
}  // namespace adit
