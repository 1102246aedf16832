// Figures 3, 4, 5 and 8 of Magnusson, Elsrud, Skagerlund and Duckett, 3D Modelling for Underground Mining Vehicles, on
// a simulated junction.

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/foundation/random.h"
#include "core/geometry/statistics.h"
#include "core/registration/icp.h"
#include "core/registration/icp_selection.h"
#include "core/registration/newton.h"
#include "core/registration/register_pair.h"
#include "io/atomic_file.h"
#include "render/canvas.h"
#include "tests/bench/bench.h"
#include "tests/bench/box_plot.h"
#include "tests/bench/pcl_peers.h"
#include "tests/core/sample_mine.h"

namespace adit::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t source_points = 139642;  // as the paper's scans
constexpr std::size_t target_points = 72417;
constexpr int samples = 3000;
constexpr std::uint64_t runs = 100;
constexpr double off_m = 1.0;
constexpr double good_m = 0.15;
const fs::path folder = "build/paper";

/// The end of a tunnel with a small passage to its side; the scanner 10 m before the face, or so much farther back.
struct Junction {
  std::vector<RockTunnel> tunnels;
  Pose station(double back_m) const {
    const Alignment& axis = tunnels.front().design().alignment();
    return tests::mine_station(axis, 50.0 - back_m, Random(7, 1), 3, 0.0);
  }
};

Junction junction() {
  RockTunnelOptions rock;
  rock.clutter = false;
  const Alignment axis = tests::mine_axis(Eigen::Vector3d::Zero(), 0.4, 64.0, 0.0, 0.0);
  Junction scene;
  scene.tunnels.push_back(tests::mine_tunnel(axis, 60.0, 11, rock));
  scene.tunnels.push_back(tests::mine_branch(scene.tunnels.front(), 54.0, 90.0, 12.0, 12));
  return scene;
}

/// Exactly so many points, evenly along the scan's order.
PointCloud scanned(const Junction& scene, const Pose& station, std::size_t points, std::uint64_t seed) {
  ScannerOptions scanner;
  scanner.seed = seed;
  scanner.pulses = points + points / 2;
  scanner.range_sigma_m = 0.01;
  scanner.least_range_m = 3.0;  // that scanner's
  Progress progress;
  const PointCloud all = scan_tunnel(scene.tunnels, station, scanner, {}, progress);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points; ++i) kept.push_back(i * all.size() / points);
  return selected(all, kept);
}

struct Scans {
  PointCloud target, source;
  Pose truth = Pose::Identity();
};

Pose start_of(const Scans& scans, std::uint64_t run) {
  const Random random(23, run);
  const Eigen::Vector3d towards(random.normal(0), random.normal(1), random.normal(2));
  Pose start = scans.truth;
  start.translation() += off_m * towards.normalized();
  return start;
}

/// What one way of matching does from all starts.
struct Outcome {
  std::vector<double> error_m, error_deg, seconds;

  void print(const char* name) const {
    const auto good = std::count_if(error_m.begin(), error_m.end(), [](double e) { return e < good_m; });
    std::printf("| %s | %td of %zu | %.4f | %.4f | %.4f | %.3f | %.2f |\n", name, good, error_m.size(),
                quantile(error_m, 0.25), median(error_m), quantile(error_m, 0.75), median(error_deg), median(seconds));
    std::fflush(stdout);
  }
};

template <typename Engine>
Outcome outcome(const char* name, const Scans& scans, std::uint64_t starts, const Engine& engine) {
  Outcome result;
  for (std::uint64_t run = 0; run < starts; ++run) {
    Pose found;
    result.seconds.push_back(seconds_of(1, [&] { found = engine(start_of(scans, run), run); }));
    result.error_m.push_back(std::max(1e-6, distance_between_m(found, scans.truth)));
    result.error_deg.push_back(std::max(1e-6, deg_from_rad(rotation_between_rad(found, scans.truth))));
  }
  result.print(name);
  return result;
}

void heading(const char* words) {
  std::printf("\n%s\n\n| matching | good | error m: quartile | median | quartile | median deg | median s |\n", words);
  std::printf("|---|---|---|---|---|---|---|\n");
}

void save(const std::string& name, const render::Picture& picture) {
  fs::create_directories(folder);
  io::write_file_atomically(folder / name, render::png_bytes(picture));
  std::printf("%s\n", (folder / name).c_str());
}

/// Constant weights, nearest points, 3,000 random points of the source, all of the target, 1 m.
IcpOptions paper_icp(std::uint64_t run) {
  IcpOptions options;
  options.selection = IcpSelection::random;
  options.samples = samples;
  options.seed = static_cast<int>(run);
  options.reach_m = 1.0;
  options.boundary_rejected = false;
  options.most_normals_deg = 90.0;
  options.metric = IcpMetric::point_to_point;
  options.most_iterations = 50;
  options.least_step_m = 1e-4;
  return options;
}

IcpCloud plain(const PointCloud& cloud) {
  return {cloud.points, {}};
}

/// With normals from planes in cells of 0.4 m.
IcpCloud with_normals(const PointCloud& cloud) {
  const DistributionMap planes(cell_sums(cloud.points, 0.4), 0.4, {});
  return icp_cloud(SurfaceMap(cell_sums(cloud.points, 0.02), 0.02, std::span(&planes, 1)));
}

/// Whole jobs, the tree included.
Pose icp(const IcpCloud& target, const IcpCloud& source, const Pose& start, const IcpOptions& options) {
  Progress progress;
  return icp_align(IcpTarget(target, options), source, start, options, progress).target_from_source;
}

std::vector<NormalDistribution> sampled_points(const PointCloud& cloud, std::uint64_t run) {
  std::vector<NormalDistribution> points;
  for (const std::size_t i : selected_points(plain(cloud), paper_icp(run), 0)) {
    points.emplace_back();
    points.back().mean = cloud.points[i].cast<double>();
  }
  return points;
}

/// The paper's: cells of 1 m, 3,000 points on distributions.
Pose paper_ndt(const Scans& scans, const Pose& start, std::uint64_t run, RotationForm form) {
  Progress progress;
  const DistributionMap cells(cell_sums(scans.target.points, 1.0), 1.0, {});
  const auto points = sampled_points(scans.source, run);
  NdtScoreOptions options;
  options.rotation = form;
  return descend(start, [&](const Pose& pose) { return ndt_score(cells, points, pose, options, progress); }, {}).pose;
}

Pose whole_pair(const CloudTiles& target, const CloudTiles& source, const Pose& start) {
  Progress progress;
  const auto prepared = [&](const CloudTiles& tiles) { return prepare_scan("scan", tiles, 0.1, 0.6, 45.0, progress); };
  return register_pair(prepared(target), prepared(source), start, Start::guess, Eigen::Vector3d::UnitX(), {}, progress)
      .target_from_source;
}

/// Figure 3: from above, the pairs of points of the first iteration.
void figure_3(const Scans& scans) {
  constexpr double mm_per_m = 7.0;
  const IcpOptions options = paper_icp(0);
  Progress progress;
  const Pose start = start_of(scans, 0);
  const auto pairs =
      icp_matches(IcpTarget(plain(scans.target), options), plain(scans.source), start, options, 0, progress);
  Eigen::AlignedBox2d box;
  for (const auto& p : scans.target.points) box.extend(p.head<2>().cast<double>());
  const Eigen::Vector2d size = mm_per_m * (box.sizes() + Eigen::Vector2d(2.0, 2.0));
  render::Canvas canvas = render::Canvas::raster(size.x(), size.y() + 6.0, 110.0);
  const auto at = [&](const Eigen::Vector3d& p) {
    return render::PaperPoint(mm_per_m * (p.x() - box.min().x() + 1.0), mm_per_m * (box.max().y() + 1.0 - p.y()));
  };
  for (std::size_t i = 0; i < scans.target.points.size(); i += 6)
    canvas.disc(at(scans.target.points[i].cast<double>()), 0.15, {0.05, 0.30, 0.10});
  for (std::size_t i = 0; i < scans.source.points.size(); i += 12)
    canvas.disc(at(start * scans.source.points[i].cast<double>()), 0.15, {0.90, 0.80, 0.15});
  for (const IcpMatch& match : pairs) canvas.line(at(match.place), at(match.target), {{0.15, 0.85, 0.25}, 0.15, {}});
  canvas.text({2.0, size.y()}, "figure 3: pairs of points in the first iteration, from above", {.size_mm = 3.0});
  save("figure-3.png", canvas.finish_picture());
}

/// The paper's with one thing changed.
template <typename Change>
Outcome paper_outcome(const char* name, const Scans& scans, const IcpCloud& target, const IcpCloud& source,
                      const Change& change) {
  return outcome(name, scans, runs, [&](const Pose& start, std::uint64_t run) {
    IcpOptions options = paper_icp(run);
    change(options);
    return icp(target, source, start, options);
  });
}

void figure_4(const Scans& apart) {
  heading("Figure 4: boundary points (scans 8 m apart, 3,000 random points, point to point, 1 m)");
  const IcpCloud target = with_normals(apart.target), source = with_normals(apart.source);
  const Outcome kept = paper_outcome("boundary points kept", apart, target, source, [](IcpOptions&) {});
  const Outcome rejected = paper_outcome("boundary points rejected", apart, target, source,
                                         [](IcpOptions& options) { options.boundary_rejected = true; });
  save("figure-4.png", box_plot("figure 4: boundary points", "translation error [m]",
                                {{"kept", kept.error_m}, {"rejected", rejected.error_m}}, good_m));
}

void figure_5(const Scans& apart) {
  heading(
      "Figure 5: fixed and falling reach (scans 8 m apart, 3,000 random points, point to point, 1 m, 50 iterations)");
  const IcpCloud target = plain(apart.target), source = plain(apart.source);
  const Outcome fixed = paper_outcome("fixed", apart, target, source, [](IcpOptions&) {});
  const Outcome falling =
      paper_outcome("falling", apart, target, source, [](IcpOptions& options) { options.reach_falls = true; });
  save("figure-5-error.png", box_plot("figure 5: reach", "translation error [m]",
                                      {{"fixed", fixed.error_m}, {"falling", falling.error_m}}, good_m));
  save("figure-5-time.png",
       box_plot("figure 5: reach", "time [s]", {{"fixed", fixed.seconds}, {"falling", falling.seconds}}, std::nullopt));
}

void figure_8(const Scans& same) {
  heading("Figure 8: ICP and NDT (one place, 139,642 points on 72,417, 3,000 sampled, cells of 1 m)");
  const IcpCloud target = plain(same.target), source = plain(same.source);
  const CloudTiles target_tiles(same.target), source_tiles(same.source);
  struct Row {
    const char* name;
    Outcome outcome;
  };
  std::vector<Row> rows;
  const auto add = [&](const char* name, std::uint64_t starts, const auto& engine) {
    rows.push_back({name, outcome(name, same, starts, engine)});
  };
  add("ICP as in the paper", runs,
      [&](const Pose& start, std::uint64_t run) { return icp(target, source, start, paper_icp(run)); });
  add("NDT as in the paper", runs,
      [&](const Pose& start, std::uint64_t run) { return paper_ndt(same, start, run, RotationForm::full); });
  add("NDT, small angles", runs,
      [&](const Pose& start, std::uint64_t run) { return paper_ndt(same, start, run, RotationForm::small_angle); });
  add("Adit register_pair", runs,
      [&](const Pose& start, std::uint64_t) { return whole_pair(target_tiles, source_tiles, start); });
  add("PCL ICP", 20,
      [&](const Pose& start, std::uint64_t) { return pcl_icp(same.target.points, same.source.points, start); });
  add("PCL NDT", 20,
      [&](const Pose& start, std::uint64_t) { return pcl_ndt(same.target.points, same.source.points, start); });
  std::vector<Sample> errors, times;
  for (const Row& row : rows) {
    errors.push_back({row.name, row.outcome.error_m});
    times.push_back({row.name, row.outcome.seconds});
  }
  save("figure-8-error.png", box_plot("figure 8: from 1 m off", "translation error [m]", errors, good_m));
  save("figure-8-time.png", box_plot("figure 8: from 1 m off", "time [s]", times, std::nullopt));
}

}  // namespace

void bench_paper() {
  const Junction scene = junction();
  Scans same, apart;
  same.target = scanned(scene, scene.station(0.0), target_points, 1);
  same.source = scanned(scene, scene.station(0.0), source_points, 2);
  apart.target = same.target;
  apart.source = scanned(scene, scene.station(8.0), source_points, 3);
  apart.truth = scene.station(0.0).inverse() * scene.station(8.0);
  std::printf(
      "\n### The paper's figures\n\nOn a simulated junction: %zu and %zu points, 10 mm noise; starts %.0f m off in any "
      "direction. Good: within %.2f m, as in the paper.\n",
      source_points, target_points, off_m, good_m);
  figure_3(apart);
  figure_4(apart);
  figure_5(apart);
  figure_8(same);
}

}  // namespace adit::bench
