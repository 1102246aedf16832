#pragma once
// What a step leaves for the next run, exact to the last bit: out/steps/*.json.

#include <string>

#include "core/job/results.h"

namespace adit::io {

std::string step_text(const ImportResult& result);
std::string step_text(const TargetsResult& result);
std::string step_text(const RegistrationResult& result);
std::string step_text(const SurfaceResult& result);
/// Without the sections: they are cut again from the deviation map.
std::string step_text(const ProfileResult& result);
std::string step_text(const VolumeResult& result);
std::string step_text(const CompareResult& result);
std::string step_text(const RingsResult& result);

/// Back from text. Throws Error when the text is not what step_text wrote.
void read_step_text(const std::string& text, ImportResult& result);
void read_step_text(const std::string& text, TargetsResult& result);
void read_step_text(const std::string& text, RegistrationResult& result);
void read_step_text(const std::string& text, SurfaceResult& result);
void read_step_text(const std::string& text, ProfileResult& result);
void read_step_text(const std::string& text, VolumeResult& result);
void read_step_text(const std::string& text, CompareResult& result);
void read_step_text(const std::string& text, RingsResult& result);

}  // namespace adit::io
