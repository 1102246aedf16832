#pragma once
// Runs a job as the command line does, without a screen.

#include <filesystem>
#include <memory>
#include <string>

#include "app/demo.h"
#include "app/run_job.h"
#include "render/gl_context.h"

namespace adit::tests {

inline std::shared_ptr<app::JobState> run(const std::filesystem::path& job, const std::filesystem::path& out = {},
                                          const std::string& last_step = {}) {
  app::RunOptions options;
  options.out = out;
  options.last_step = last_step;
  options.context.make_gl_context = [] { return render::make_osmesa_context(); };
  Progress progress;
  return app::run_job(job, options, progress);
}

/// A small demo: few points, two stations.
inline void small_demo(const std::filesystem::path& folder, std::uint64_t points = 120000, int stations = 2) {
  app::DemoOptions options;
  options.points = points;
  options.stations = stations;
  Progress progress;
  app::make_demo(folder, options, progress);
}

}  // namespace adit::tests
