// Coded targets: found in rendered pictures over the stated range, and none where none is. The stations that they place
// are in target_stations_bench.cpp.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/simulation/ray_cast.h"
#include "render/canvas.h"
#include "render/gl_context.h"
#include "tests/bench/bench.h"
#include "tests/bench/sift_look.h"
#include "tests/bench/target_pictures.h"

namespace adit::bench {
namespace {

struct Score {
  int shown = 0, found = 0;
  double squares = 0.0, normalised = 0.0;  ///< of what was found, both axes
  double rms_px() const { return std::sqrt(squares / std::max(1, 2 * found)); }
  double sigmas() const { return std::sqrt(normalised / std::max(1, 2 * found)); }
};

/// What a table of detections holds.
struct Detections {
  Score all;
  int wrong = 0, invented = 0;
  double worst_px = 0.0;
  std::map<int, Score> by_size, by_tilt;

  void add(const PictureOfTargets& truth, const std::vector<DetectedTarget>& found) {
    std::vector<bool> hit(found.size(), false);
    for (const PictureOfTargets::Truth& target : truth.targets) {
      const int size = static_cast<int>(std::floor(std::log2(target.diameter_px / 20.0)));
      const int tilt = static_cast<int>(deg_from_rad(target.tilt_rad) / 15.0);
      for (Score* score : {&all, &by_size[size], &by_tilt[tilt]}) ++score->shown;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Eigen::Vector2d off = found[i].center - target.pixel;
        if (off.norm() > 0.4 * target.diameter_px) continue;
        hit[i] = true;
        if (found[i].id != target.id) {
          ++wrong;
          continue;
        }
        for (Score* score : {&all, &by_size[size], &by_tilt[tilt]}) {
          ++score->found;
          score->squares += off.squaredNorm();
          score->normalised += off.dot(found[i].covariance_px2.inverse() * off);
        }
        worst_px = std::max(worst_px, off.norm());
      }
    }
    invented += static_cast<int>(std::count(hit.begin(), hit.end(), false));
  }
};

std::string share(const Score& score) {
  char text[40];
  std::snprintf(text, sizeof text, "%d of %d (%.1f %%)", score.found, score.shown,
                100.0 * score.found / std::max(1, score.shown));
  return text;
}

/// Targets strewn before a camera so that each has its size and tilt in the picture, none before another.
void strew_targets(render::CameraScene& scene, const RayCast& rock, const CameraLens& lens,
                   const Pose& site_from_camera, int count, const Random& random, std::uint64_t& k, int most_id) {
  std::vector<std::pair<Eigen::Vector2d, double>> taken;
  for (int tries = 0; tries < 600 && static_cast<int>(scene.targets.size()) < count; ++tries) {
    const double diameter_px = 20.0 * std::pow(20.0, random.uniform(k++)),
                 tilt = rad_from_deg(60.0 * random.uniform(k++));
    const double u = random.uniform(k++, 0.0, lens.width), v = random.uniform(k++, 0.0, lens.height);
    const double wanted_m = random.uniform(k++, 1.2, 4.0), towards = random.uniform(k++, 0.0, 2.0 * pi);
    const double turn = random.uniform(k++, 0.0, 2.0 * pi);
    const int id = 1 + static_cast<int>(random.uniform(k++) * most_id);
    const double room = 0.5 * coded_pattern::clear_radius * diameter_px + 4.0;
    if (u < room || v < room || u > lens.width - room || v > lens.height - room) continue;
    if (std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
          return (other.first - Eigen::Vector2d(u, v)).norm() < 1.4 * (room + other.second);
        }))
      continue;
    const auto place = place_of(lens, {u, v});
    if (!place) continue;
    // Before the rock, whatever way the target is tilted.
    const Eigen::Vector3d ray = Eigen::Vector3d(place->x(), place->y(), 1.0);
    const auto hit =
        rock.first_hit(site_from_camera.translation(), (site_from_camera.linear() * ray).normalized(), 60.0, {});
    const double reach = 1.0 + coded_pattern::clear_radius * 0.5 * diameter_px / lens.focal_px();
    const double depth = std::min(wanted_m, hit ? 0.9 * hit->range_m / ray.norm() / reach : wanted_m);
    const Eigen::Vector3d at = depth * ray;
    render::SceneTarget target;
    target.code = code_of_id(id);
    target.radius_m = 0.5 * diameter_px * depth / lens.focal_px();
    const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -at.normalized());
    Pose pose = Pose::Identity();
    pose.linear() = (facing * Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(towards), std::sin(towards), 0.0)) *
                     Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
                        .toRotationMatrix();
    pose.translation() = at;
    target.site_from_target = site_from_camera * pose;
    scene.targets.push_back(target);
    taken.emplace_back(Eigen::Vector2d(u, v), room);
  }
}

CameraEffects drawn_effects(const Random& random, std::uint64_t& k, std::uint64_t seed) {
  CameraEffects effects;
  effects.seed = seed;
  effects.exposure = std::pow(2.0, random.uniform(k++, -2.0, 0.6));
  effects.blur_px = random.uniform(k++, 0.5, 1.1);
  effects.vignetting = random.uniform(k++, 0.0, 0.4);
  effects.gamma = random.uniform(k++) < 0.5 ? 1.0 : 2.2;
  effects.read_noise = random.uniform(k++, 0.5, 2.0);
  effects.dust = static_cast<int>(random.uniform(k++, 0.0, 60.0));
  effects.glare = static_cast<int>(random.uniform(k++, 0.0, 4.0));
  return effects;
}

void print_detections(const char* title, const Detections& d) {
  std::printf("| %s | %s | %d | %d | %.3f | %.2f | %.2f |\n", title, share(d.all).c_str(), d.wrong, d.invented,
              d.all.rms_px(), d.worst_px, d.all.sigmas());
}

void bench_detection(const RockTunnel& tunnel, const RockMesh& rock) {
  const CameraLens lens = picture_lens();
  Progress progress;
  Detections any, known;
  SiftLook sift;
  const RayCast seen(tunnel);
  for (std::uint64_t picture = 1; any.all.shown < 1000; ++picture) {
    const Random random(picture, 61);
    std::uint64_t k = 0;
    const double chainage = random.uniform(k++, 15.0, 45.0), aside = random.uniform(k++, -1.0, 1.0);
    const Pose camera =
        camera_in(tunnel, chainage, aside, 1.6,
                  {random.uniform(k, -0.2, 0.2), random.uniform(k + 1, -0.3, 0.3), random.uniform(k + 2, -0.1, 0.1)});
    k += 3;
    render::CameraScene scene{rock.mesh, rock.albedo, {}};
    strew_targets(scene, seen, lens, camera, 12, random, k, 40);
    const PictureOfTargets taken =
        take_picture(scene, lens, camera, random.uniform(k++, 3.0, 9.0), drawn_effects(random, k, picture));
    if (picture <= 6) keep(taken.picture, "targets_" + std::to_string(picture));
    any.add(taken, detect_targets(taken.picture, options_of(lens, target_code_count), progress));
    known.add(taken, detect_targets(taken.picture, options_of(lens, 40), progress));
    sift.add(taken);
  }
  std::printf(
      "\n### Targets in rendered pictures\n\nA rock tunnel by the light of a lamp, targets of 20 to 400 pixels, up to 60 degrees oblique; exposure a quarter to one and a half, blur 0.5 to 1.1 pixels, noise 0.5 to 2 grey levels and shot noise, up to 60 grains of dust and 4 reflections, gamma 1 or 2.2.\n\n"
      "| codes | found | wrong ids | invented | off, rms px per axis | worst px | off over sigma |\n|---|---|---|---|---|---|---|\n");
  print_detections("any of 4017", any);
  print_detections("40 that are known to hang there", known);
  std::printf("\n| | any code | 40 codes | off, rms px per axis | off over sigma |\n|---|---|---|---|---|\n");
  for (const auto& [size, score] : any.by_size)
    std::printf("| %.0f to %.0f px | %s | %s | %.3f | %.2f |\n", 20.0 * std::pow(2.0, size),
                20.0 * std::pow(2.0, size + 1), share(score).c_str(), share(known.by_size.at(size)).c_str(),
                known.by_size.at(size).rms_px(), known.by_size.at(size).sigmas());
  for (const auto& [tilt, score] : any.by_tilt)
    std::printf("| %d to %d degrees | %s | %s | %.3f | %.2f |\n", 15 * tilt, 15 * tilt + 15, share(score).c_str(),
                share(known.by_tilt.at(tilt)).c_str(), known.by_tilt.at(tilt).rms_px(),
                known.by_tilt.at(tilt).sigmas());
  sift.print();
}

/// Brickwork, wire mesh, bolts with plates and letters, drawn large and seen obliquely.
GreyPicture decoy(int kind, const Random& random, const CameraLens& lens, std::uint64_t seed) {
  std::uint64_t k = 0;
  const double dpi = 25.4 * 4.0;  // four pixels a millimetre of paper
  render::Canvas canvas = render::Canvas::raster(600.0, 480.0, dpi);
  const auto grey = [](double shade) { return render::Colour{shade, shade, shade, 1.0}; };
  canvas.fill(render::Rect{0, 0, 600, 480}, grey(random.uniform(k++, 0.4, 0.9)));
  const double size = random.uniform(k++, 4.0, 30.0), dark = random.uniform(k++, 0.02, 0.25);
  if (kind == 0)
    for (int r = 0; r * size * 0.5 < 480.0; ++r)
      for (double x = (r % 2) * -0.5 * size; x < 600.0; x += size)
        canvas.fill(render::Rect{x + 0.04 * size, r * size * 0.5 + 0.04 * size, 0.92 * size, 0.42 * size},
                    grey(dark + random.uniform(k++, 0.0, 0.2)));
  if (kind == 1)
    for (double at = 0.0; at < 600.0; at += size) {
      canvas.line({at, 0}, {at, 480}, {grey(dark), 0.12 * size, {}});
      canvas.line({0, at}, {600, at}, {grey(dark), 0.12 * size, {}});
    }
  if (kind == 2)
    for (int i = 0; i < 120; ++i) {
      const double x = random.uniform(k++, 0.0, 600.0), y = random.uniform(k++, 0.0, 480.0);
      const render::PaperPoint at(x, y);
      canvas.disc(at, size, grey(0.75));
      canvas.disc(at, size * random.uniform(k++, 0.5, 0.9), grey(dark));
      canvas.disc(at, size * 0.48, grey(0.8));
      canvas.disc(at, size * random.uniform(k++, 0.2, 0.36), grey(dark));
    }
  if (kind == 3)
    for (double y = 0.0; y < 480.0; y += size) {
      std::string words;
      for (int i = 0; i < 60; ++i) words += static_cast<char>(33 + static_cast<int>(random.uniform(k++) * 93.0));
      canvas.text({2.0, y}, words, {.size_mm = size, .colour = grey(dark), .bold = random.uniform(k++) < 0.5});
    }
  const render::Picture drawn = canvas.finish_picture();
  GreyPicture ideal(drawn.width, drawn.height);
  for (int v = 0; v < drawn.height; ++v)
    for (int u = 0; u < drawn.width; ++u) ideal.pixels[ideal.index(u, v)] = drawn.pixel(u, v)[0];
  CameraEffects effects = drawn_effects(random, k, seed);
  return stored_picture(ideal, lens.focal_px() * random.uniform(k++, 1.2, 2.5), lens, effects);
}

void bench_decoys(const RockTunnel& tunnel, const RockMesh& rock) {
  const CameraLens lens = picture_lens();
  Progress progress;
  int pictures = 0, any = 0, known = 0;
  for (std::uint64_t i = 1; i <= 200; ++i) {
    const Random random(i, 62);
    GreyPicture picture;
    if (i % 5 == 0) {
      std::uint64_t k = 5000;
      const double chainage = random.uniform(k++, 15.0, 45.0);
      const Pose camera = camera_in(tunnel, chainage, 0.0, 1.6, {0.0, random.uniform(k++, -1.5, 1.5), 0.0});
      picture = take_picture({rock.mesh, rock.albedo, {}}, lens, camera, random.uniform(k++, 3.0, 9.0),
                             drawn_effects(random, k, i))
                    .picture;
    } else {
      picture = decoy(static_cast<int>(i % 5) - 1, random, lens, i);
    }
    if (i <= 5) keep(picture, "decoy_" + std::to_string(i));
    ++pictures;
    any += static_cast<int>(detect_targets(picture, options_of(lens, target_code_count), progress).size());
    known += static_cast<int>(detect_targets(picture, options_of(lens, 40), progress).size());
  }
  std::printf(
      "\n%d pictures without a target (bricks, wire mesh, bolts with plates and rings, letters, bare rock): %d targets found of any code, %d of 40.\n",
      pictures, any, known);
}

}  // namespace

void bench_targets() {
  const auto context = render::make_osmesa_context();
  context->make_current();
  const RockTunnel tunnel = picture_tunnel(1);
  const RockMesh rock = rock_mesh(tunnel, 2.0, 62.0, 0.12);
  bench_target_stations(tunnel, rock);
  bench_detection(tunnel, rock);
  bench_decoys(tunnel, rock);
}

}  // namespace adit::bench
