#pragma once
// Targets, cameras, landmarks and pictures of a job.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/job/job.h"
#include "io/json_place.h"

namespace adit::io {

/// "cameras" and "landmarks" of the job, and then the pictures of its scans, which are read already.
void read_job_cameras(const JsonPlace& root, const std::filesystem::path& folder, Job& job);

/// The pictures of a scan: names, or objects with file and camera.
std::vector<JobPicture> read_job_pictures(const JsonPlace& place, const std::filesystem::path& folder);

/// "targets": the name of a file, or what to look for in the scans, with or without a file.
void read_job_targets(const JsonPlace& place, const std::filesystem::path& folder, Job& job);
void add_job_targets(const Job& job, nlohmann::ordered_json& root);

/// Adds what read_job_cameras reads.
void add_job_cameras(const Job& job, nlohmann::ordered_json& root);
nlohmann::ordered_json pictures_json(const std::vector<JobPicture>& pictures);

}  // namespace adit::io
