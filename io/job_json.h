#pragma once
// job.json <-> Job (docs/formats.md).

#include <filesystem>
#include <string>

#include "core/job/job.h"

namespace adit::io {

/// Reads and checks a job. Throws Error with file, key and mend for unknown keys, wrong types, impossible values and
/// files that are named but absent.
Job read_job(const std::filesystem::path& file);

/// job.json text of a job; options that stand at their defaults are left out.
std::string job_text(const Job& job);

}  // namespace adit::io
