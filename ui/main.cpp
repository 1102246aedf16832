// adit-gui: arguments, the window, and the only place where errors become exit codes.

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "app/version.h"
#include "core/foundation/error.h"
#include "ui/window.h"
#include "ui/workspace.h"

namespace {

constexpr int exit_good = 0;
constexpr int exit_bad_input = 2;
constexpr int exit_our_fault = 3;

void show(const std::string& job, const std::string& out) {
  adit::ui::Window window;
  adit::ui::Workspace workspace(window.step_context(), out);
  if (!job.empty()) workspace.open(job);
  window.run(workspace);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Adit's window: shows a job that has been run, and runs it.", "adit-gui");
  app.set_version_flag("--version", std::string("adit-gui ") + adit::app::version);
  std::string job, out;
  app.add_option("JOB", job, "folder of a job, or its job.json");
  app.add_option("--out", out, "folder of everything derived (\"out\" in the job's folder)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_good : exit_bad_input;
  }
  try {
    show(job, out);
    return exit_good;
  } catch (const adit::Error& error) {
    std::fprintf(stderr, "adit-gui: %s\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "adit-gui: a fault of Adit: %s; please report it\n", error.what());
    return exit_our_fault;
  }
}
