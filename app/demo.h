#pragma once
// A synthetic job with exact truth.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/foundation/progress.h"
#include "render/gl_context.h"

namespace adit::app {

struct DemoOptions {
  std::uint64_t seed = 1;
  int stations = 4;                ///< 1 to 40, 13 m apart
  std::uint64_t points = 1000000;  ///< pulses a station; a few per cent have no echo
  double guess_error_m = 0.5;      ///< how far the guesses in job.json are off
  double guess_error_deg = 2.0;
  double east_m = 612345.0;  ///< where the axis begins
  double north_m = 6998765.0;
  double elevation_m = 412.0;
  bool control = true;  ///< write control.csv and targets.csv
  /// Hang spheres and boards for the scans to be searched for, instead of targets.csv. They need some four million
  /// pulses a station.
  bool scan_targets = false;
  /// Hang coded targets, fix a camera to the scanner and take a picture at each station; the scanners then look along
  /// the tunnel. Empty: none. The context is made once, to draw in.
  std::function<std::unique_ptr<render::GlContext>()> pictures_in;
  int rounds_back = 0;  ///< the face stands so many rounds (of 4 m) back
  std::string before;   ///< folder of an earlier demo of the same seed, as the job names it; empty: none
};

/// Writes scans/, axis.xml, profile.dxf, control.csv, targets.csv, truth.json and job.json into the folder (made when
/// absent); with pictures camera.yaml, landmarks.csv and pictures/, too. Throws Error when the folder holds something
/// that is not a demo.
void make_demo(const std::filesystem::path& folder, const DemoOptions& options, Progress& progress);

}  // namespace adit::app
