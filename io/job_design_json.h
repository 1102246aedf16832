#pragma once
// The part of job.json that says what the tunnel should be, and how it is judged.

#include <nlohmann/json.hpp>

#include "core/job/job.h"
#include "io/json_place.h"

namespace adit::io {

/// Profiles, lines, stretch, rounds, zones, tolerances, sectors and swell of the job at `place`.
void read_job_design(const JsonPlace& place, const std::filesystem::path& folder, Job& job);

/// The same as members of `root`, without those that are as by default.
void add_job_design(const Job& job, nlohmann::ordered_json& root);

}  // namespace adit::io
