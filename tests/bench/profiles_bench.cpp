// Volumes of simulated tunnels against their exact truth, and the way to chainage and back on a real axis.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>

#include "core/design/transition_curve.h"
#include "core/foundation/parallel.h"
#include "core/foundation/random.h"
#include "core/profiling/map_change.h"
#include "core/profiling/profiling.h"
#include "io/read_axis.h"
#include "tests/bench/bench.h"

namespace adit::bench {
namespace {

constexpr double axis_length_m = 140.0;
constexpr double from_m = 30.0, to_m = 60.0, first_station_m = 25.0, station_spacing_m = 8.0;
constexpr int stations = 6;
constexpr std::uint64_t pulses = 1000000;
constexpr double end_area_interval_m = 5.0;

struct Scenario {
  const char* name;
  HorizontalKind kind = HorizontalKind::line;
  double start_curvature_per_m = 0.0, end_curvature_per_m = 0.0;
  double grade = 0.0;
  double vertical_radius_m = 0.0;
  double roughness_m = 0.045;
  double collar_m = 0.06, toe_m = 0.38;
  double floor_m = -0.04;
  bool niche = false;
};

/// Overbreak shares: look-out and roughness grow together.
const Scenario scenarios[] = {
    {.name = "straight"},
    {.name = "R = 120 m",
     .kind = HorizontalKind::arc,
     .start_curvature_per_m = 1 / 120.0,
     .end_curvature_per_m = 1 / 120.0},
    {.name = "clothoid to R = 80 m left", .kind = HorizontalKind::clothoid, .end_curvature_per_m = -1 / 80.0},
    {.name = "grade 10 %", .grade = 0.10},
    {.name = "vertical curve, R = 500 m", .grade = 0.08, .vertical_radius_m = 500.0},
    {.name = "hardly any overbreak", .roughness_m = 0.01, .collar_m = 0.0, .toe_m = 0.02},
    {.name = "no look-out", .collar_m = 0.15, .toe_m = 0.15},
    {.name = "15 %", .roughness_m = 0.08, .collar_m = 0.15, .toe_m = 0.55},
    {.name = "niche of 2.4 x 1.7 x 1 m", .niche = true},
    {.name = "30 %", .roughness_m = 0.12, .collar_m = 0.40, .toe_m = 0.90},
};

Alignment axis_of(const Scenario& scenario) {
  HorizontalElement element;
  element.kind = scenario.kind;
  element.azimuth_rad = 0.5;
  element.length_m = axis_length_m;
  element.start_curvature_per_m = scenario.start_curvature_per_m;
  element.end_curvature_per_m = scenario.end_curvature_per_m;
  std::vector<VerticalPoint> grade{{0.0, 0.0}, {axis_length_m, scenario.grade * axis_length_m}};
  if (scenario.vertical_radius_m > 0.0)
    grade = {{0.0, 0.0},
             {45.0, 45.0 * scenario.grade, VerticalCurveKind::circle, 0.0, scenario.vertical_radius_m},
             {axis_length_m, 45.0 * scenario.grade}};
  return {"simulated", HorizontalAlignment({element}, 0.0), VerticalAlignment(std::move(grade))};
}

RockTunnel rock_of(const Scenario& scenario, std::uint64_t seed) {
  RockTunnelOptions options;
  options.seed = seed;
  options.from_m = 1.0;
  options.face_m = 100.0;
  options.clutter = false;
  options.roughness_sigma_m = scenario.roughness_m;
  options.lookout_collar_m = scenario.collar_m;
  options.lookout_toe_m = scenario.toe_m;
  options.floor_mean_m = scenario.floor_m;
  return {DesignTunnel(axis_of(scenario), {{0.0, tests::arch_profile()}}, {{"excavation", 0.0}}), options};
}

constexpr double niche_at_m = 45.0, niche_half_m = 1.2, niche_low_m = 0.05, niche_high_m = 1.75, niche_deep_m = 5.0;

/// A smooth niche to the right, whose end stands niche_deep_m from the axis.
RockTunnel niche_in(const RockTunnel& main) {
  const Alignment& axis = main.design().alignment();
  HorizontalElement across;
  const PlanPoint plan = axis.horizontal().at(niche_at_m);
  across.start = plan.position;
  across.azimuth_rad = std::atan2(plan.tangent().x(), plan.tangent().y()) + 0.5 * pi;
  across.length_m = niche_deep_m + 2.0;
  const double floor_m = axis.vertical().at(niche_at_m).elevation_m;
  const Profile door("niche", {{{-niche_half_m, niche_low_m}, {-niche_half_m, niche_high_m}, 0.0},
                               {{-niche_half_m, niche_high_m}, {niche_half_m, niche_high_m}, 0.0},
                               {{niche_half_m, niche_high_m}, {niche_half_m, niche_low_m}, 0.0},
                               {{niche_half_m, niche_low_m}, {-niche_half_m, niche_low_m}, 0.0}});
  RockTunnelOptions smooth;
  smooth.from_m = 0.5;
  smooth.face_m = niche_deep_m;
  smooth.clutter = false;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 1e-5;
  smooth.lookout_collar_m = smooth.lookout_toe_m = smooth.floor_mean_m = smooth.corner_m = 0.0;
  return {DesignTunnel({"niche", HorizontalAlignment({across}, 0.0),
                        VerticalAlignment({{0.0, floor_m}, {niche_deep_m + 2.0, floor_m}})},
                       {{0.0, door}}, {{"excavation", 0.0}}),
          smooth};
}

/// What the niche adds to a straight, level tunnel: on a fine grid, its air where the main tunnel has rock. Its end is
/// the simulated face, which is not quite flat.
double true_niche_m3(const RockTunnel& main, const RockTunnel& niche) {
  constexpr double step = 0.01;
  double sum = 0.0;
  for (double s = niche_at_m - niche_half_m + 0.5 * step; s < niche_at_m + niche_half_m; s += step)
    for (double z = niche_low_m + 0.5 * step; z < niche_high_m; z += step)
      for (double x = 3.8 + 0.5 * step; x < niche_deep_m + 0.3; x += step) {
        const ProfileFoot foot = main.profile().nearest({x, z});
        if (foot.deviation_m <= main.deviation(s, foot.p_m)) continue;
        if (x < niche.face_chainage(niche_at_m - s, z)) sum += step * step * step;
      }
  return sum;
}

double percent_off(double value, double truth) {
  return 100.0 * (value / truth - 1.0);
}

void bench_scenario(const Scenario& scenario, std::uint64_t seed) {
  Progress progress;
  std::vector<RockTunnel> tunnels{rock_of(scenario, seed)};
  if (scenario.niche) tunnels.push_back(niche_in(tunnels.front()));
  const RockTunnel& rock = tunnels.front();
  std::vector<PlacedTiles> scans;
  for (int i = 0; i < stations; ++i) {
    const Pose pose = tests::station(rock.design(), first_station_m + station_spacing_m * i, 70.0 * i);
    ScannerOptions scanner;
    scanner.seed = 100 * seed + static_cast<std::uint64_t>(i);
    scanner.pulses = pulses;
    PointCloud cloud = scan_tunnel(tunnels, pose, scanner, {}, progress);
    scans.push_back({"S" + std::to_string(i), std::make_shared<CloudTiles>(std::move(cloud)), pose});
  }
  const MapResult map = map_deviations(scans, rock.design(), from_m, to_m, {}, progress);
  const Volume volume =
      compute_volume(map.map, rock.design(), {"excavation", 0.0}, from_m, to_m, end_area_interval_m, {}, {}, progress);
  VolumeAmounts truth = true_volume(rock, from_m, to_m, progress);
  if (scenario.niche) {
    const double niche_m3 = true_niche_m3(rock, tunnels.back());
    truth.overbreak_m3 += niche_m3;
    truth.excavated_m3 += niche_m3;
  }
  const double two_sigmas = 200.0 * volume.sigma_overbreak_m3 / truth.overbreak_m3;
  std::printf("| %s | %.1f %% | %.2f | %+.3f | %.2f | %+.4f | %.1f | %+.2f | %+.2f |\n", scenario.name,
              100.0 * truth.overbreak_m3 / truth.design_m3, truth.overbreak_m3,
              percent_off(volume.slices.overbreak_m3, truth.overbreak_m3), two_sigmas,
              percent_off(volume.slices.excavated_m3, truth.excavated_m3), 100.0 * volume.coverage,
              percent_off(volume.average_end_area.overbreak_m3, truth.overbreak_m3),
              percent_off(volume.prismoidal.overbreak_m3, truth.overbreak_m3));
  std::fflush(stdout);
}

/// Every point farther along its ray.
PointCloud with_range_bias(PointCloud cloud, double bias_m) {
  for (Eigen::Vector3f& point : cloud.points) point *= 1.0F + static_cast<float>(bias_m) / point.norm();
  return cloud;
}

Eigen::Vector3d normal3(const Random& random, std::uint64_t index) {
  return {random.normal(index), random.normal(index + 1), random.normal(index + 2)};
}

/// How often the truth lies within two stated sigmas when poses, datum and distances err by what they state.
struct Inside {
  int draws = 0;
  struct Part {
    int within = 0;
    double squares = 0.0;  ///< of errors over sigmas
    void add(double error, double sigma) {
      within += std::abs(error) <= 2.0 * sigma ? 1 : 0;
      squares += error * error / (sigma * sigma);
    }
  };
  Part over, under, excavated;
};

Inside draws_of_tunnel(std::uint64_t seed, int draws, bool clutter) {
  constexpr int few_stations = 4;
  constexpr std::uint64_t few_pulses = 250000;
  constexpr double datum_sigma_m = 0.002, scan_sigma_m = 0.001;
  Progress progress;
  RockTunnelOptions options;
  options.seed = seed;
  options.from_m = 1.0;
  options.face_m = 100.0;
  options.clutter = clutter;
  const RockTunnel rock(tests::sample_design(tests::arch_profile(), seed % 2 == 0 ? 150.0 : 0.0), options);
  std::vector<Pose> poses;
  std::vector<PointCloud> clouds;
  RegistrationResult registration;
  registration.datum_sigma_m = datum_sigma_m;
  for (int i = 0; i < few_stations; ++i) {
    poses.push_back(tests::station(rock.design(), 28.0 + station_spacing_m * i, 70.0 * i));
    clouds.push_back(tests::scan_at(rock, poses.back(), 1000 * seed + static_cast<std::uint64_t>(i), few_pulses));
    PlacedScan scan;
    scan.placed = true;
    scan.sigma.along_m = scan.sigma.across_m = scan.sigma.up_m = scan_sigma_m;
    registration.scans.push_back(scan);
  }
  constexpr double first_m = 32.0, last_m = 50.0;
  const VolumeAmounts truth = true_volume(rock, first_m, last_m, progress);
  Inside inside;
  for (int draw = 0; draw < draws; ++draw) {
    const Random random(seed, 7000 + static_cast<std::uint64_t>(draw));
    const double bias_m = ProfilingOptions{}.range_bias_sigma_m * random.normal(0);
    const Eigen::Vector3d datum = datum_sigma_m * normal3(random, 1);
    std::vector<PlacedTiles> scans;
    for (int i = 0; i < few_stations; ++i) {
      const auto k = static_cast<std::size_t>(i);
      Pose pose = poses[k];
      pose.translation() += datum + scan_sigma_m * normal3(random, 10 + 3 * k);
      scans.push_back({"S", std::make_shared<CloudTiles>(with_range_bias(clouds[k], bias_m)), pose});
    }
    const MapResult map = map_deviations(scans, rock.design(), first_m, last_m, {}, progress);
    const Volume v =
        compute_volume(map.map, rock.design(), {"excavation", 0.0}, first_m, last_m, 1.0, registration, {}, progress);
    ++inside.draws;
    inside.over.add(v.slices.overbreak_m3 - truth.overbreak_m3, v.sigma_overbreak_m3);
    inside.under.add(v.slices.underbreak_m3 - truth.underbreak_m3, v.sigma_underbreak_m3);
    inside.excavated.add(v.slices.excavated_m3 - truth.excavated_m3, v.sigma_excavated_m3);
  }
  return inside;
}

void bench_uncertainty() {
  constexpr int tunnels = 8, draws = 25;
  std::printf(
      "\nTruth within two stated sigmas, %d simulated tunnels of %d draws each: datum off by 2 mm, each scan by "
      "1 mm more, all distances by a common 1 mm (one sigma each), and root mean square of errors over sigmas; four stations, 18 m.\n\n"
      "| clutter | overbreak | underbreak | excavated |\n|---|---|---|---|\n",
      tunnels, draws);
  for (const bool clutter : {false, true}) {
    Inside sum;
    for (int t = 1; t <= tunnels; ++t) {
      const Inside one = draws_of_tunnel(static_cast<std::uint64_t>(t), draws, clutter);
      sum.draws += one.draws;
      for (const auto part : {&Inside::over, &Inside::under, &Inside::excavated}) {
        (sum.*part).within += (one.*part).within;
        (sum.*part).squares += (one.*part).squares;
      }
    }
    std::printf("| %s |", clutter ? "yes" : "no");
    for (const auto part : {&Inside::over, &Inside::under, &Inside::excavated})
      std::printf(" %.1f %%, %.2f |", 100.0 * (sum.*part).within / sum.draws,
                  std::sqrt((sum.*part).squares / sum.draws));
    std::printf("\n");
    std::fflush(stdout);
  }
}

/// A layer of 40 to 100 mm between two epochs, scanned with 2 mm noise: how far the means of square metres are off.
void bench_layer() {
  Progress progress;
  const DesignTunnel design = tests::sample_design(tests::arch_profile(), 120.0);
  const auto thickness_m = [](double s, double p) { return 0.07 + 0.03 * std::sin(0.9 * s) * std::cos(0.7 * p); };
  RockTunnelOptions options;
  options.seed = 3;
  options.from_m = 1.0;
  options.face_m = 100.0;
  options.clutter = false;
  const RockTunnel rock(design, options);
  const auto epoch = [&](std::uint64_t seed, bool sprayed) {
    std::vector<PlacedTiles> scans;
    for (int i = 0; i < 4; ++i) {
      const Pose pose = tests::station(design, 28.0 + station_spacing_m * i, 70.0 * i);
      ScannerOptions scanner;
      scanner.seed = seed + static_cast<std::uint64_t>(i);
      scanner.pulses = 500000;
      scanner.range_sigma_m = 0.0;
      scanner.angle_sigma_rad = 0.0;
      PointCloud cloud = scan_tunnel(std::span(&rock, 1), pose, scanner, {}, progress);
      const Random random(seed, 50 + static_cast<std::uint64_t>(i));
      for (std::size_t k = 0; k < cloud.points.size(); ++k) {
        Eigen::Vector3d local = pose * cloud.points[k].cast<double>();
        const auto at = design.alignment().to_tunnel(local);
        if (sprayed && at) {
          const ProfileFoot foot = rock.profile().nearest({at->x_m, at->z_m});
          const Eigen::Vector2d place =
              Eigen::Vector2d(at->x_m, at->z_m) - thickness_m(at->s_m, foot.p_m) * foot.direction;
          local = design.alignment().to_site({at->s_m, place.x(), place.y()});
        }
        const Eigen::Vector3d in_scan = pose.inverse() * local;
        cloud.points[k] = (in_scan * (1.0 + 0.002 * random.normal(k) / in_scan.norm())).cast<float>();
      }
      scans.push_back({"S", std::make_shared<CloudTiles>(std::move(cloud)), pose});
    }
    return map_deviations(scans, design, 32.0, 50.0, {}, progress).map;
  };
  const MapChange change =
      compare_maps(epoch(10, false), epoch(20, true), design, {0.05, 0.08, {}}, standard_sectors(), {}, {}, {});
  double squares = 0.0, worst = 0.0;
  for (const LayerBlock& block : change.layer.blocks) {
    double truth = 0.0;
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 10; ++j)
        truth += 0.01 * thickness_m(block.chainage_m - 0.45 + 0.1 * i, block.p_m - 0.45 + 0.1 * j);
    squares += std::pow(block.mean_m - truth, 2);
    worst = std::max(worst, std::abs(block.mean_m - truth));
  }
  std::printf(
      "\nA layer of 40 to 100 mm between two epochs, 4 stations each, 2 mm noise of distances, exact poses: means of %zu "
      "blocks of a square metre are off by %.2f mm (root mean square), %.2f mm at the most.\n",
      change.layer.blocks.size(), 1e3 * std::sqrt(squares / static_cast<double>(change.layer.blocks.size())),
      1e3 * worst);
}

/// (s, x, z) -> site -> (s, x, z) on random places beside a real axis.
void bench_round_trip(const std::filesystem::path& file, const std::string& name) {
  constexpr std::size_t points = 100000;
  const Alignment axis = io::choose_alignment(io::read_axis(file), name);
  const Random random(1, 1);
  std::vector<TunnelPoint> places(points);
  std::vector<Eigen::Vector3d> site(points);
  std::vector<double> off(points);
  for (std::size_t i = 0; i < points; ++i)
    places[i] = {random.uniform(3 * i, axis.from_m(), axis.to_m()), random.uniform(3 * i + 1, -8.0, 8.0),
                 random.uniform(3 * i + 2, -2.0, 8.0)};
  constexpr std::size_t block = 1000;
  const auto each = [&](const auto& work) {
    parallel_for_each_index(
        points / block,
        [&](std::size_t b) {
          for (std::size_t i = b * block; i < (b + 1) * block; ++i) work(i);
        },
        1);
  };
  const double there = seconds_of(3, [&] { each([&](std::size_t i) { site[i] = axis.to_site(places[i]); }); });
  const double back = seconds_of(3, [&] {
    each([&](std::size_t i) {
      const auto at = axis.to_tunnel(site[i], places[i].s_m + 1.5);
      off[i] = at ? std::hypot(at->s_m - places[i].s_m, at->x_m - places[i].x_m, at->z_m - places[i].z_m) : 1e9;
    });
  });
  std::size_t beyond = 0, none = 0;
  double worst = 0.0;
  for (const double distance : off) {
    if (distance > 1e8)
      ++none;
    else if (distance > 1e-5)
      ++beyond;
    if (distance < 1e-5) worst = std::max(worst, distance);
  }
  std::printf(
      "\n100,000 random places within 8 m of %s, %s: there %.1f, back %.1f, both ways %.2f million points/s; "
      "%zu at joints of the file (gaps up to 0.77 mm), %zu without a foot, the rest within %.1e m.\n",
      file.filename().c_str(), name.c_str(), 1e-6 * points / there, 1e-6 * points / back,
      1e-6 * points / (there + back), beyond, none, worst);
}

}  // namespace

void bench_profiles() {
  std::printf(
      "\n### Volumes against the truth\n\n%d stations %.0f m apart, %.1f million pulses each, exact poses, 30 m of "
      "tunnel, rounds of 4 m; walls of 2 m under a half circle of 4 m.\n\n",
      stations, station_spacing_m, 1e-6 * pulses);
  std::printf(
      "| tunnel | overbreak of design | overbreak m3 | error %% | 2 sigma %% | excavated error %% | measured %% | "
      "end areas every 5 m: error %% | prismoidal %% |\n|---|---|---|---|---|---|---|---|---|\n");
  std::uint64_t seed = 1;
  for (const Scenario& scenario : scenarios) bench_scenario(scenario, seed++);
  bench_layer();
  bench_uncertainty();
  const std::filesystem::path real = "../shared/data/axis-sbb.xml";
  if (std::filesystem::exists(real))
    bench_round_trip(real, "A50034A");
  else
    std::printf("\nreal axis absent: %s\n", real.c_str());
}

}  // namespace adit::bench
