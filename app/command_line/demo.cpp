// adit demo: makes a synthetic job and runs it to its report.

#include "app/demo.h"

#include <cstdio>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/summary.h"
#include "app/run_job.h"
#include "io/results_json.h"
#include "render/gl_context.h"

namespace adit::app {

Action declare_demo(CLI::App& command) {
  struct Arguments {
    std::string folder;
    DemoOptions demo;
    bool no_control = false;
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
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command.add_option("--guess-error-deg", arguments->demo.guess_error_deg, "how far the guesses are turned")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command.add_flag("--no-control", arguments->no_control, "no control points and targets");
  command.add_flag("--no-run", arguments->no_run, "make the job only");
  return [arguments](const CommonOptions& common, Progress& progress) {
    arguments->demo.control = !arguments->no_control;
    Progress making = progress.part(0.3, "making the job");
    make_demo(arguments->folder, arguments->demo, making);
    if (arguments->no_run) {
      if (!common.quiet) std::printf("Job: %s/job.json\n", arguments->folder.c_str());
      return exit_good;
    }
    RunOptions options;
    options.context.make_gl_context = [] { return render::make_osmesa_context(); };
    Progress running = progress.part(0.7, "running the job");
    const auto state = run_job(arguments->folder, options, running);
    const std::string text = common.json    ? io::results_text(state->results)
                             : common.quiet ? std::string()
                                            : summary_text(*state);
    std::fputs(text.c_str(), stdout);
    return needs_a_person(state->results) ? exit_needs_a_person : exit_good;
  };
}

}  // namespace adit::app
