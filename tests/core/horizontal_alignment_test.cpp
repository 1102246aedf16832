#include "core/design/horizontal_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

HorizontalElement element(double length_m, double k0, double k1) {
  HorizontalElement e;
  e.kind = k0 != k1 ? HorizontalKind::clothoid : (k0 == 0.0 ? HorizontalKind::line : HorizontalKind::arc);
  e.start = {1000.0, 2000.0};
  e.azimuth_rad = 0.7;
  e.length_m = length_m;
  e.start_curvature_per_m = k0;
  e.end_curvature_per_m = k1;
  return e;
}

/// Elements put end to end from the place of the first one.
HorizontalAlignment chained(std::vector<HorizontalElement> elements, double start_chainage_m = 100.0) {
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const PlanPoint end = element_point(elements[i - 1], elements[i - 1].length_m);
    elements[i].start = end.position;
    elements[i].azimuth_rad = end.azimuth_rad;
  }
  return HorizontalAlignment(std::move(elements), start_chainage_m);
}

/// Line, clothoid, arc, egg clothoid, arc, S of two clothoids, left arc, clothoid, line.
HorizontalAlignment winding_axis() {
  return chained({element(80, 0, 0), element(60, 0, 1.0 / 250), element(50, 1.0 / 250, 1.0 / 250),
                  element(40, 1.0 / 250, 1.0 / 120), element(70, 1.0 / 120, 1.0 / 120), element(50, 1.0 / 120, 0),
                  element(50, 0, -1.0 / 90), element(65, -1.0 / 90, -1.0 / 90), element(45, -1.0 / 90, 0),
                  element(30, 0, 0)});
}

/// Simpson's rule with very many steps in long double: independent of the Gauss-Legendre panels.
Eigen::Vector2d simpson(const HorizontalElement& e, double along_m) {
  const long double rate = (static_cast<long double>(e.end_curvature_per_m) - e.start_curvature_per_m) / e.length_m;
  const int n = 20000;
  const long double h = static_cast<long double>(along_m) / n;
  long double east = 0, north = 0;
  for (int i = 0; i <= n; ++i) {
    const long double t = h * i;
    const long double azimuth = e.azimuth_rad + t * (e.start_curvature_per_m + rate * t / 2);
    const int weight = i == 0 || i == n ? 1 : (i % 2 == 1 ? 4 : 2);
    east += weight * std::sin(azimuth);
    north += weight * std::cos(azimuth);
  }
  return {static_cast<double>(east * h / 3), static_cast<double>(north * h / 3)};
}

TEST(PlanElement, AgreesWithAnIndependentIntegrationBetweenAnyCurvatures) {
  const double straight = 0.0;
  for (const double k0 : {straight, 1.0 / 300, -1.0 / 300, 1.0 / 40, -1.0 / 15}) {
    for (const double k1 : {straight, 1.0 / 2000, -1.0 / 100, 1.0 / 15}) {
      for (const double length : {0.001, 7.0, 150.0, 1200.0}) {
        HorizontalElement e = element(length, k0, k1);
        e.start.setZero();
        const Eigen::Vector2d end = element_point(e, length).position;
        // Simpson's own error: h^4 / 180 * length * fourth derivative (about curvature^4)
        const double tightest = std::max(std::abs(k0), std::abs(k1));
        const double simpson_error = length * std::pow(length / 20000 * tightest, 4) + 1e-14 * length;
        EXPECT_LT((end - simpson(e, length)).norm(), 1e-11 + simpson_error) << k0 << " " << k1 << " " << length;
      }
    }
  }
}

TEST(PlanElement, ClothoidFromAStraightIsTheFresnelSeries) {
  HorizontalElement e = element(120.0, 0.0, 1.0 / 150);
  e.start.setZero();
  e.azimuth_rad = 0.0;
  // With theta = L^2 / (2 R L): north = L sum (-1)^n theta^2n / ((4n+1) (2n)!), east likewise with odd powers.
  const double theta = 120.0 / 300.0;
  double north = 0, east = 0, power = 1;
  for (int n = 0; n < 20; ++n) {
    (n % 2 == 0 ? north : east) += (n / 2 % 2 == 0 ? 1 : -1) * power / (2 * n + 1);
    power *= theta / (n + 1);
  }
  const PlanPoint end = element_point(e, 120.0);
  EXPECT_NEAR(end.position.x(), 120.0 * east, 1e-11);
  EXPECT_NEAR(end.position.y(), 120.0 * north, 1e-11);
  EXPECT_NEAR(end.azimuth_rad, theta, 1e-15);
}

/// The law of each transition, from its definition and independent of the code, on [0, 1].
double share_of_change(HorizontalKind kind, double u) {
  if (kind == HorizontalKind::bloss) return 3 * u * u - 2 * u * u * u;
  if (kind == HorizontalKind::cosine) return (1 - std::cos(pi * u)) / 2;
  if (kind == HorizontalKind::sinusoid) return u - std::sin(2 * pi * u) / (2 * pi);
  if (kind == HorizontalKind::biquadratic) return u < 0.5 ? 2 * u * u : 1 - 2 * (1 - u) * (1 - u);
  return u;
}

/// Steps of 5 mm by the midpoint rule.
PlanPoint walked(const HorizontalElement& e) {
  const int n = static_cast<int>(e.length_m / 0.005);
  const double h = e.length_m / n;
  const auto curvature = [&](double u) {
    return e.start_curvature_per_m + (e.end_curvature_per_m - e.start_curvature_per_m) * share_of_change(e.kind, u);
  };
  PlanPoint at{e.start, e.azimuth_rad, e.end_curvature_per_m};
  for (int i = 0; i < n; ++i) {
    const double before = at.azimuth_rad;
    at.azimuth_rad += h * curvature((i + 0.5) / n);
    at.position +=
        h * Eigen::Vector2d(std::sin(0.5 * (before + at.azimuth_rad)), std::cos(0.5 * (before + at.azimuth_rad)));
  }
  return at;
}

constexpr HorizontalKind transitions[] = {HorizontalKind::clothoid, HorizontalKind::bloss, HorizontalKind::cosine,
                                          HorizontalKind::sinusoid, HorizontalKind::biquadratic};

TEST(PlanElement, EveryTransitionFollowsItsLawBetweenAnyCurvatures) {
  for (const HorizontalKind kind : transitions)
    for (const auto& [k0, k1] : {std::pair{0.0, 1.0 / 300}, {1.0 / 40, 0.0}, {-1.0 / 500, -1.0 / 80}, {-0.01, 0.02}}) {
      HorizontalElement e = element(90.0, k0, k1);
      e.kind = kind;
      const PlanPoint end = element_point(e, e.length_m), truth = walked(e);
      EXPECT_LT((end.position - truth.position).norm(), 1e-6) << static_cast<int>(kind);
      EXPECT_NEAR(end.azimuth_rad, truth.azimuth_rad, 1e-9);
      EXPECT_NEAR(end.azimuth_rad, e.azimuth_rad + 45.0 * (k0 + k1), 1e-12);  // all are symmetric
      EXPECT_NEAR(end.curvature_per_m, k1, 1e-15);
      EXPECT_NEAR(element_point(e, 0.0).curvature_per_m, k0, 1e-15);
    }
}

TEST(PlanElement, CubicParabolaIsOne) {
  // From the straight to x = 80 m with y'' = 1/200 there: C = 16000 m2, y = x^3 / 96000.
  const double x1 = 80.0, c = 16000.0;
  double length = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double x = x1 * (i + 0.5) / 100000;
    length += x1 / 100000 * std::hypot(1.0, x * x / (2 * c));
  }
  HorizontalElement e = element(length, 0.0, 1.0 / 200);
  e.kind = HorizontalKind::cubic_parabola;
  e.start.setZero();
  e.azimuth_rad = 0.0;
  const PlanPoint end = element_point(e, length);
  EXPECT_NEAR(end.position.y(), x1, 1e-8);
  EXPECT_NEAR(end.position.x(), x1 * x1 * x1 / (6 * c), 1e-8);
  EXPECT_NEAR(std::tan(end.azimuth_rad), x1 * x1 / (2 * c), 1e-10);
  EXPECT_NEAR(end.curvature_per_m, 1.0 / 200 / std::pow(1 + 0.04, 1.5), 1e-12);
  // Its second half by itself, and backwards.
  const PlanPoint half = element_point(e, 0.5 * length);
  HorizontalElement rest = e;
  rest.start = half.position;
  rest.azimuth_rad = half.azimuth_rad;
  rest.length_m = 0.5 * length;
  rest.start_curvature_per_m = half.position.y() / c;
  EXPECT_LT((element_point(rest, rest.length_m).position - end.position).norm(), 1e-8);
  HorizontalElement back = e;
  back.start_curvature_per_m = -e.end_curvature_per_m;
  back.end_curvature_per_m = 0.0;
  back.start = end.position;
  back.azimuth_rad = end.azimuth_rad + pi;
  EXPECT_LT(element_point(back, length).position.norm(), 1e-8);
}

TEST(PlanElement, ACubicParabolaThatGrowsFlatterAgainIsRefused) {
  HorizontalElement e = element(100.0, 0.0, 1.0 / 100);
  e.kind = HorizontalKind::cubic_parabola;
  EXPECT_THROW(HorizontalAlignment({e}, 0.0), Error);
  e.start_curvature_per_m = e.end_curvature_per_m;
  EXPECT_THROW(HorizontalAlignment({e}, 0.0), Error);
}

TEST(PlanAxis, TransitionsBetweenKnotsAndThereAndBack) {
  for (const HorizontalKind kind : {HorizontalKind::bloss, HorizontalKind::cosine, HorizontalKind::sinusoid,
                                    HorizontalKind::biquadratic, HorizontalKind::cubic_parabola}) {
    HorizontalElement e = element(61.3, 0.0, -1.0 / 120);
    e.kind = kind;
    const HorizontalAlignment axis({e}, 10.0);
    for (double along = 0.0; along < e.length_m; along += 0.29) {
      const PlanPoint truth = element_point(e, along);
      const PlanPoint point = axis.at(10.0 + along);
      EXPECT_LT((point.position - truth.position).norm(), 1e-7) << static_cast<int>(kind) << " " << along;
      EXPECT_NEAR(point.azimuth_rad, truth.azimuth_rad, 1e-6);
      for (const double x : {-30.0, 4.0}) {
        const auto foot = axis.foot(truth.position + x * truth.right());
        ASSERT_TRUE(foot.has_value());
        EXPECT_NEAR(foot->chainage_m, 10.0 + along, 1e-6);
        EXPECT_NEAR(foot->offset_m, x, 1e-6);
        const auto back = axis.foot(axis.to_plan(*foot));  // by itself it is exact
        ASSERT_TRUE(back.has_value());
        EXPECT_NEAR(back->chainage_m, foot->chainage_m, 1e-9);
        EXPECT_NEAR(back->offset_m, foot->offset_m, 1e-9);
      }
    }
  }
}

TEST(PlanElement, RightHandArcTurnsClockwise) {
  HorizontalElement e = element(pi * 50.0, 1.0 / 50, 1.0 / 50);
  e.start = {0, 0};
  e.azimuth_rad = 0.0;  // north
  const PlanPoint end = element_point(e, e.length_m);
  EXPECT_NEAR(end.position.x(), 100.0, 1e-12);  // half a circle to the east
  EXPECT_NEAR(end.position.y(), 0.0, 1e-12);
  EXPECT_NEAR(end.tangent().y(), -1.0, 1e-12);
  EXPECT_NEAR(end.right().x(), -1.0, 1e-12);
}

TEST(PlanAxis, BetweenKnotsTheElementItselfAnswers) {
  const HorizontalAlignment axis = winding_axis();
  for (std::size_t i = 0; i < axis.elements().size(); ++i) {
    const HorizontalElement& e = axis.elements()[i];
    for (double along = 0.0; along < e.length_m; along += 0.37) {
      const PlanPoint truth = element_point(e, along);
      const PlanPoint point = axis.at(axis.element_from_m(i) + along);
      EXPECT_LT((point.position - truth.position).norm(), 2e-12 * 2000);
      EXPECT_NEAR(point.azimuth_rad, truth.azimuth_rad, 1e-13);
      EXPECT_NEAR(point.curvature_per_m, truth.curvature_per_m, 1e-15);
    }
  }
}

TEST(PlanAxis, ThereAndBackOnEveryKindOfElement) {
  const HorizontalAlignment axis = winding_axis();
  for (double s = axis.from_m(); s <= axis.to_m(); s += 0.61) {
    for (const double x : {-40.0, -7.5, -0.001, 0.0, 3.0, 60.0}) {
      const Eigen::Vector2d point = axis.to_plan({s, x});
      for (const double wrong : {0.0, 0.3, -4.0, 9.0}) {
        const auto foot = axis.foot(point, s + wrong);
        ASSERT_TRUE(foot.has_value()) << s << " " << x << " " << wrong;
        EXPECT_NEAR(foot->chainage_m, s, 1e-9);
        EXPECT_NEAR(foot->offset_m, x, 1e-9);
      }
      const auto foot = axis.foot(point);
      ASSERT_TRUE(foot.has_value()) << s << " " << x;
      EXPECT_LE(std::abs(foot->offset_m), std::abs(x) + 1e-9);
      if (std::abs(x) < 10.0) {  // nearer than any other part of the axis
        EXPECT_NEAR(foot->chainage_m, s, 1e-9);
      }
    }
  }
}

TEST(PlanAxis, TightElementsOfAnyTurningSenseThereAndBack) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double r0 : {inf, 12.0, -12.0, 400.0}) {
    for (const double r1 : {inf, 25.0, -9.0, 3000.0}) {
      const HorizontalAlignment axis({element(14.0, 1.0 / r0, 1.0 / r1)}, -5.0);
      for (double s = -5.0; s <= 9.0; s += 0.25) {
        for (const double x : {-6.0, 0.0, 6.0}) {
          const auto foot = axis.foot(axis.to_plan({s, x}), s + 0.5);
          ASSERT_TRUE(foot.has_value()) << r0 << " " << r1 << " " << s;
          EXPECT_NEAR(foot->chainage_m, s, 1e-9);
          EXPECT_NEAR(foot->offset_m, x, 1e-9);
        }
      }
    }
  }
}

TEST(PlanAxis, NearestFootAgreesWithBruteForce) {
  const HorizontalAlignment axis = winding_axis();
  const Random random(3);
  std::vector<Eigen::Vector2d> line;
  for (double s = axis.from_m(); s <= axis.to_m(); s += 0.02) line.push_back(axis.at(s).position);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Eigen::Vector2d point(random.uniform(2 * i, 900, 1500), random.uniform(2 * i + 1, 1900, 2400));
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& p : line) nearest = std::min(nearest, (p - point).norm());
    const double to_ends = std::min((line.front() - point).norm(), (line.back() - point).norm());
    const auto foot = axis.foot(point);
    if (to_ends <= nearest + 0.02) continue;  // the end itself is nearest
    ASSERT_TRUE(foot.has_value()) << point.transpose();
    EXPECT_NEAR(std::abs(foot->offset_m), nearest, 0.011);
    const PlanPoint there = axis.at(foot->chainage_m);
    EXPECT_NEAR((point - there.position).dot(there.tangent()), 0.0, 1e-9);
    EXPECT_NEAR((point - there.position).dot(there.right()), foot->offset_m, 1e-9);
  }
}

TEST(PlanAxis, NothingBeforeTheStartOrBehindTheEnd) {
  const HorizontalAlignment axis = winding_axis();
  const PlanPoint start = axis.at(axis.from_m());
  const PlanPoint end = axis.at(axis.to_m());
  for (const bool hinted : {false, true}) {
    const auto foot = [&](const Eigen::Vector2d& p, double s) { return hinted ? axis.foot(p, s) : axis.foot(p); };
    EXPECT_FALSE(foot(start.position - 0.002 * start.tangent() + 3.0 * start.right(), axis.from_m()));
    EXPECT_FALSE(foot(start.position - 50.0 * start.tangent(), axis.from_m()));
    EXPECT_FALSE(foot(end.position + 0.002 * end.tangent(), axis.to_m()));
    const auto near_start = foot(start.position - 0.0008 * start.tangent() + 3.0 * start.right(), axis.from_m());
    ASSERT_TRUE(near_start.has_value());
    EXPECT_DOUBLE_EQ(near_start->chainage_m, axis.from_m());
    EXPECT_NEAR(near_start->offset_m, 3.0, 1e-9);
    const auto near_end = foot(end.position + 0.0008 * end.tangent(), axis.to_m());
    ASSERT_TRUE(near_end.has_value());
    EXPECT_DOUBLE_EQ(near_end->chainage_m, axis.to_m());
  }
  EXPECT_THROW(axis.at(axis.from_m() - 0.002), Error);
  EXPECT_THROW(axis.to_plan({axis.to_m() + 0.002, 0.0}), Error);
  EXPECT_LT((axis.at(axis.to_m() + 0.0009).position - end.position).norm(), 1e-12);
}

TEST(PlanAxis, NothingBehindTheCentreOfCurvature) {
  const HorizontalAlignment axis({element(60.0, 1.0 / 50, 1.0 / 50)}, 0.0);
  EXPECT_FALSE(axis.foot(axis.to_plan({30.0, 55.0}), 30.0).has_value());
  const auto inside = axis.foot(axis.to_plan({30.0, 49.0}), 28.0);
  ASSERT_TRUE(inside.has_value());
  EXPECT_NEAR(inside->chainage_m, 30.0, 1e-9);
}

TEST(PlanAxis, TheWedgeOfAKinkBelongsToTheJoint) {
  HorizontalElement a = element(20.0, 0.0, 0.0);
  a.start = {0, 0};
  a.azimuth_rad = 0.0;
  HorizontalElement b = a;
  b.start = {0, 20};
  b.azimuth_rad = 0.01;  // to the right: the wedge opens on the left
  const HorizontalAlignment axis({a, b}, 0.0);
  const Eigen::Vector2d in_wedge(-5.0 * std::cos(0.004), 20.0 + 5.0 * std::sin(0.004));
  for (const auto& foot : {axis.foot(in_wedge), axis.foot(in_wedge, 12.0), axis.foot(in_wedge, 28.0)}) {
    ASSERT_TRUE(foot.has_value());
    EXPECT_DOUBLE_EQ(foot->chainage_m, 20.0);
    EXPECT_NEAR(foot->offset_m, -5.0, 1e-12);
  }
}

TEST(PlanAxis, AGapOfTheFileBelongsToTheJointAndDoesNotDisturbOffsets) {
  HorizontalElement a = element(20.0, 0.0, 0.0);
  a.start = {0, 0};
  a.azimuth_rad = 0.0;
  HorizontalElement b = a;
  b.start = {0, 20.0008};
  const HorizontalAlignment axis({a, b}, 0.0);
  const auto foot = axis.foot({0.3, 20.0004}, 15.0);
  ASSERT_TRUE(foot.has_value());
  EXPECT_DOUBLE_EQ(foot->chainage_m, 20.0);
  EXPECT_NEAR(foot->offset_m, 0.3, 1e-12);
  const auto behind = axis.foot({-0.3, 21.0008});
  ASSERT_TRUE(behind.has_value());
  EXPECT_NEAR(behind->chainage_m, 21.0, 1e-12);  // every element keeps its own start
}

TEST(PlanAxis, LargeCoordinatesGiveTheSameFeet) {
  const HorizontalAlignment near_zero = winding_axis();
  const Eigen::Vector2d far(2683026.0, 1251466.0);
  const HorizontalAlignment at_site = near_zero.relative_to(-far);
  const HorizontalAlignment back = at_site.relative_to(far);
  for (double s = near_zero.from_m() + 0.5; s < near_zero.to_m(); s += 3.3) {
    const Eigen::Vector2d point = near_zero.to_plan({s, 8.0});
    const auto foot = at_site.foot(point + far, s + 2.0);
    ASSERT_TRUE(foot.has_value());
    EXPECT_NEAR(foot->chainage_m, s, 1e-8);
    EXPECT_NEAR(foot->offset_m, 8.0, 1e-8);
    EXPECT_LT((back.at(s).position - near_zero.at(s).position).norm(), 1e-8);
  }
}

TEST(PlanAxis, RefusesElementsThatAreNone) {
  EXPECT_THROW(HorizontalAlignment({}, 0.0), Error);
  EXPECT_THROW(HorizontalAlignment({element(0.0, 0, 0)}, 0.0), Error);
  EXPECT_THROW(HorizontalAlignment({element(10.0, 0, std::nan(""))}, 0.0), Error);
  EXPECT_THROW(HorizontalAlignment({element(1e9, 0, 0)}, 0.0), Error);
  EXPECT_THROW(HorizontalAlignment({element(1.0, 1e4, 1e4)}, 0.0), Error);
  EXPECT_THROW(HorizontalAlignment().at(0.0), Error);
  EXPECT_FALSE(HorizontalAlignment().foot({0, 0}).has_value());
}

}  // namespace
}  // namespace adit
