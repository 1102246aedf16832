// adit demo: makes a synthetic job and runs it to its report.

#include "app/demo.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/summary.h"
#include "app/run_job.h"
#include "io/results_json.h"
#include "render/gl_context.h"

namespace adit::app {
namespace {

/// The demo, and with it an earlier one of the same rock, in which the last round has not been blasted yet.
void make_with_earlier(const std::string& folder, DemoOptions options, bool with_earlier, Progress& progress) {
  if (!with_earlier) return make_demo(folder, options, progress);
  Progress later = progress.part(0.5, "making the job");
  options.before = "before";
  make_demo(folder, options, later);
  Progress earlier = progress.part(0.5, "making the earlier job");
  options.before.clear();
  options.rounds_back = 1;
  make_demo(std::filesystem::path(folder) / "before", options, earlier);
}

}  // namespace

Action declare_demo(CLI::App& command) {
  struct Arguments {
    std::string folder;
    DemoOptions demo;
    bool no_control = false;
    bool pictures = false;
    bool before = false;
    bool no_run = false;
  };
  auto arguments = std::make_shared<Arguments>();
  command.add_option("DIR", arguments->folder, "folder to make the job in")->required()->check(some_name);
  command.add_option("--seed", arguments->demo.seed, "every choice of chance follows from it")
      ->check(CLI::Range(0.0, 1e15))
      ->capture_default_str();
  command.add_option("--stations", arguments->demo.stations, "number of scans")
      ->check(CLI::Range(1, 40))
      ->capture_default_str();
  command.add_option("--points", arguments->demo.points, "pulses a scan")
      ->check(CLI::Range(20000, 200000000))
      ->capture_default_str();
  command.add_option("--guess-error-m", arguments->demo.guess_error_m, "how far the guesses are off")
      ->check(number_between(0.0, 20.0))
      ->capture_default_str();
  command.add_option("--guess-error-deg", arguments->demo.guess_error_deg, "how far the guesses are turned")
      ->check(number_between(0.0, 180.0))
      ->capture_default_str();
  auto* no_control = command.add_flag("--no-control", arguments->no_control, "no control points and targets");
  command
      .add_flag("--targets", arguments->demo.scan_targets,
                "spheres and boards on the walls, to be found in the scans; with --points 4000000 or more")
      ->excludes(no_control);
  command.add_flag("--pictures", arguments->pictures,
                   "a camera on the scanner, coded targets on the walls and a picture at each station");
  command.add_flag("--before", arguments->before, "an earlier job, a round back, in DIR/before, to be compared with");
  command.add_flag("--no-run", arguments->no_run, "make the job only");
  return [arguments](const CommonOptions& common, Progress& progress) {
    arguments->demo.control = !arguments->no_control;
    if (arguments->pictures) arguments->demo.pictures_in = [] { return render::make_osmesa_context(); };
    Progress making = progress.part(0.3, "making the job");
    make_with_earlier(arguments->folder, arguments->demo, arguments->before, making);
    if (arguments->no_run) {
      if (!common.quiet) std::printf("Job: %s/job.json\n", arguments->folder.c_str());
      return exit_good;
    }
    RunOptions options;
    options.context.make_gl_context = [] { return render::make_osmesa_context(); };
    Progress running = progress.part(0.7, "running the job");
    if (arguments->before) {
      RunOptions earlier = options;
      earlier.last_step = "register";
      Progress part = running.part(0.3, "running the earlier job");
      run_job(std::filesystem::path(arguments->folder) / "before", earlier, part);
    }
    const auto state = run_job(arguments->folder, options, running);
    const std::string text = common.json    ? io::results_text(state->results)
                             : common.quiet ? std::string()
                                            : summary_text(*state);
    std::fputs(text.c_str(), stdout);
    return needs_a_person(state->results) ? exit_needs_a_person : exit_good;
  };
}

}  // namespace adit::app
