#pragma once
// What the parts of adit target share.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line/command.h"

namespace adit::app {

/// "1-40, 57, 60-62": each id once, in order. Throws Error for anything else.
std::vector<int> ids_of(const std::string& words);

/// The work's result; an Error without a place gets this one.
template <typename Work>
auto with_place(const std::string& where, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(error.what_is_wrong(), where, error.mend());
  }
}

/// "150mm", "15cm", "0.15m", "6in" in metres. Throws Error without a unit.
double length_m_of(const std::string& words, const char* option);

/// Each declares one part of adit target.
Action declare_target_print(CLI::App& command);
Action declare_target_detect(CLI::App& command);
Action declare_target_locate(CLI::App& command);
Action declare_target_calibrate(CLI::App& command);

}  // namespace adit::app
