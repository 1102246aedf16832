// adit: the table of commands, and the only place where errors become exit codes.

#include <tbb/global_control.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/terminal_progress.h"
#include "app/version.h"
#include "core/foundation/error.h"

namespace {

using namespace adit;
using namespace adit::app;

std::atomic<bool> stop_wanted{false};

extern "C" void on_interrupt(int) {
  if (stop_wanted.exchange(true)) std::_Exit(exit_cancelled);  // a second Ctrl-C does not wait
}

struct Command {
  const char* name;
  const char* words;
  std::function<Action(CLI::App&)> declare;
};

std::function<Action(CLI::App&)> up_to(const char* step) {
  return [step](CLI::App& command) { return declare_run(command, step); };
}

std::vector<Command> commands() {
  return {
      {"demo", "make a synthetic job with known truth in DIR and run it to its report", declare_demo},
      {"run", "run a job: all steps", up_to("")},
      {"import", "read the scans of a job", up_to("import")},
      {"register", "place the scans of a job", up_to("register")},
      {"surface", "make the surface of a job, and what it needs", up_to("surface")},
      {"profile", "map and sections of a job, and what they need", up_to("profile")},
      {"volume", "volumes of a job, and what they need", up_to("volume")},
      {"report", "the report of a job, and what it needs", up_to("report")},
      {"info", "what a scan, alignment, profile, control file or job holds", declare_info},
      {"convert", "a scan into another format", declare_convert},
  };
}

int acted(const Action& action, const CommonOptions& common) {
  std::optional<tbb::global_control> limit;
  if (common.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(common.threads));
  TerminalProgress terminal(common.quiet);
  ProgressTarget target(&terminal, &stop_wanted);
  Progress progress(target);
  const auto say = [&](const std::string& words) {
    terminal.clear();
    std::fprintf(stderr, "adit: %s\n", words.c_str());
  };
  try {
    return action(common, progress);
  } catch (const Cancelled&) {
    say("cancelled; finished steps are kept");
    return exit_cancelled;
  } catch (const Error& error) {
    say(error.what());
    return exit_bad_input;
  } catch (const std::bad_alloc&) {
    say("there is not enough memory for this job");
    return exit_our_fault;
  } catch (const std::exception& error) {
    say(std::string("a fault of Adit: ") + error.what() + "; please report it");
    return exit_our_fault;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app("Adit: tunnel scans in, defensible overbreak and volumes out.", "adit");
  app.set_version_flag("--version", std::string("adit ") + version);
  app.require_subcommand(1);
  CommonOptions common;
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const Command& command : commands()) {
    CLI::App* sub = app.add_subcommand(command.name, command.words);
    actions.emplace_back(sub, command.declare(*sub));
    sub->add_flag("--quiet,-q", common.quiet, "no progress and no summary");
    sub->add_flag("--json", common.json, "results as JSON on stdout");
    sub->add_option("--threads", common.threads, "threads to use (all cores)")->check(CLI::Range(1, 1024));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_good : exit_bad_input;
  }
  for (const auto& [sub, action] : actions)
    if (sub->parsed()) return acted(action, common);
  return exit_bad_input;
}
