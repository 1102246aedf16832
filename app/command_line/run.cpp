// adit run, and one command for each step: all steps up to it.

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/summary.h"
#include "app/registration_figures.h"
#include "app/run_job.h"
#include "io/results_json.h"
#include "render/gl_context.h"

namespace adit::app {

namespace {

/// Empty when there is enough to work with.
std::string refused_memory(const std::string& bytes) {
  constexpr double least = 268435456.0, most = 1e15;
  const double value = std::strtod(bytes.c_str(), nullptr);
  return value >= least && value <= most ? "" : "give 256MiB or more, as 8GB";
}

}  // namespace

Action declare_run(CLI::App& command, const std::string& last_step) {
  struct Arguments {
    std::string job;
    std::string out;
    std::uint64_t memory_bytes = 0;
    bool figures = false;
  };
  auto arguments = std::make_shared<Arguments>();
  command.add_option("JOB", arguments->job, "job.json or its folder")->required()->check(some_name);
  command.add_option("--out", arguments->out, "folder for everything derived (out beside job.json)")->check(some_name);
  command
      .add_option("--memory", arguments->memory_bytes,
                  "budget for points on their way, as 8GB; 256MiB at least (half of the machine's)")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::Validator(refused_memory, "SIZE"));
  if (last_step == "register")
    command.add_flag("--figures", arguments->figures,
                     "pictures of each scan's normal distributions and of each pair's overlap, into out/figures");
  return [arguments, last_step](const CommonOptions& common, Progress& progress) {
    RunOptions options;
    options.out = arguments->out;
    options.last_step = last_step;
    options.memory_bytes = arguments->memory_bytes;
    options.context.make_gl_context = [] { return render::make_osmesa_context(); };
    Progress running = progress.part(arguments->figures ? 0.9 : 1.0, "");
    const auto state = run_job(arguments->job, options, running);
    if (arguments->figures) {
      Progress drawing = progress.part(0.1, "drawing figures");
      for (const auto& file : write_registration_figures(*state, drawing))
        if (!common.quiet && !common.json) std::printf("%s\n", file.c_str());
    }
    const std::string text = common.json    ? io::results_text(state->results)
                             : common.quiet ? std::string()
                                            : summary_text(*state);
    std::fputs(text.c_str(), stdout);
    return needs_a_person(state->results) ? exit_needs_a_person : exit_good;
  };
}

}  // namespace adit::app
