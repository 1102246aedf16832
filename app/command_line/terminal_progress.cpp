#include "app/command_line/terminal_progress.h"

#include <unistd.h>

#include <cstdio>

namespace adit::app {

TerminalProgress::TerminalProgress(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_ - std::chrono::seconds(1)) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::clear() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

void TerminalProgress::report(double fraction, const std::string& message) {
  if (quiet_) return;
  if (!terminal_) {
    if (message == last_message_ || Clock::now() - last_ < std::chrono::seconds(1)) return;
    std::fprintf(stderr, "%3.0f %%  %s\n", 100.0 * fraction, message.c_str());
    last_message_ = message;
    last_ = Clock::now();
    return;
  }
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  char left[40] = "";
  if (fraction > 0.02) std::snprintf(left, sizeof left, ", about %.0f s left", seconds * (1.0 - fraction) / fraction);
  const int full = static_cast<int>(24.0 * fraction);
  std::fprintf(stderr, "\r\x1b[K[%.*s%.*s] %3.0f %%  %s%s", full, "========================", 24 - full,
               "                        ", 100.0 * fraction, message.c_str(), left);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace adit::app
