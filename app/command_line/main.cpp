// adit: the table of commands, and the only place where errors become exit codes.

#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/terminal_progress.h"
#include "app/version.h"
#include "core/foundation/error.h"
#include "io/scan_formats.h"

namespace {

using namespace adit;
using namespace adit::app;

std::atomic<bool> stop_wanted{false};

constexpr unsigned patience_s = 1;

/// Nothing but what a signal handler may do. The next run removes what a file that was being written leaves.
[[noreturn]] void leave_at_once() {
  constexpr char words[] = "adit: cancelled; finished steps are kept\n";
  if (::write(STDERR_FILENO, words, sizeof words - 1) < 0) std::_Exit(exit_cancelled);
  std::_Exit(exit_cancelled);
}

extern "C" void on_patience_gone(int) {
  leave_at_once();
}

extern "C" void on_interrupt(int) {
  if (stop_wanted.exchange(true)) leave_at_once();  // a second Ctrl-C does not wait
  ::alarm(patience_s);                              // some calls of libraries hear nothing for longer
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
      {"compare", "faces, layers and evenness of a job, and what they need", up_to("compare")},
      {"report", "the report of a job, and what it needs", up_to("report")},
      {"info", "what a scan, alignment, profile, control file or job holds", declare_info},
      {"convert", "a scan into another format", declare_convert},
      {"axis", "coordinate list of an alignment, or chainage and offset of points", declare_axis},
      {"target", "coded targets: print, detect, locate, calibrate", declare_target},
  };
}

/// The version, and what this build lacks.
std::string version_words() {
  std::string absent;
  for (const std::string& ending : io::endings_not_built_in()) absent += (absent.empty() ? "" : ", ") + ending;
  return std::string("adit ") + version +
         (absent.empty() ? "" : "\nnot built in: " + absent + " (run packaging/setup and build again)");
}

/// One line, whatever the words hold.
void print_error(std::string words) {
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = '?';
  std::fprintf(stderr, "adit: %s\n", words.c_str());
}

int refused_words(CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
  std::string known, command;
  for (const CLI::App* sub : app.get_subcommands({})) {
    known += (known.empty() ? "" : ", ") + sub->get_name();
    if (argc > 1 && sub->get_name() == argv[1]) command = sub->get_name() + " ";
  }
  std::string words = error.what();
  std::replace(words.begin(), words.end(), '\n', ' ');
  if (command.empty() && argc > 1 && argv[1][0] != '-')
    words = "\"" + std::string(argv[1]) + "\" is none of the commands " + known;
  print_error("command line: " + words + "; see adit " + command + "--help");
  return exit_bad_input;
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
    print_error(words);
  };
  try {
    const int code = action(common, progress);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Error(std::string("the output cannot be written (") + std::strerror(errno) + ")", "standard output",
                  "free some space");
    return code;
  } catch (const Cancelled&) {
    say("cancelled; finished steps are kept");
    return exit_cancelled;
  } catch (const Error& error) {
    say(error.what());
    return exit_bad_input;
  } catch (const BadFiles& bad) {
    for (const Error& error : bad.errors) say(error.what());
    return exit_bad_input;
  } catch (const std::filesystem::filesystem_error& error) {
    say(error.path1().string() + ": " + error.code().message() + "; check the name and the permissions");
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
  std::signal(SIGALRM, on_patience_gone);
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app("Adit: tunnel scans in, defensible overbreak and volumes out.", "adit");
  app.set_version_flag("--version", version_words());
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
    return refused_words(app, error, argc, argv);
  }
  for (const auto& [sub, action] : actions)
    if (sub->parsed()) return acted(action, common);
  return exit_bad_input;
}
