#include "io/job_json.h"

#include <set>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "io/existing_file.h"
#include "io/job_design_json.h"
#include "io/job_targets_json.h"
#include "io/json_place.h"
#include "io/options_json.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

Eigen::Vector3d vector3(const JsonPlace& place) {
  const auto values = place.numbers(3);
  for (const double value : values)
    if (std::abs(value) > 1e8) place.refuse("a coordinate beyond 100,000 km", "metres are needed");
  return {values[0], values[1], values[2]};
}

JobScan read_scan(const JsonPlace& place, const fs::path& folder) {
  place.only_keys({"name", "file", "scan", "pose", "pictures"});
  JobScan scan;
  scan.name = place.at("name").text();
  if (scan.name.empty()) place.at("name").refuse("a scan needs a name", "write one, for instance S1");
  if (scan.name.size() > 200) place.at("name").refuse("the name is longer than 200 letters", "write a shorter one");
  scan.file = existing_file(place.at("file"), folder);
  if (place.has("scan")) {
    const std::int64_t number = place.at("scan").whole_number();
    if (number < 1 || number > 1000000)
      place.at("scan").refuse("scans of a file are counted from 1", "write the number of the scan");
    scan.number = static_cast<int>(number);
  }
  if (place.has("pictures")) scan.pictures = read_job_pictures(place.at("pictures"), folder);
  if (!place.has("pose")) return scan;
  const JsonPlace pose = place.at("pose");
  pose.only_keys({"position", "yaw_pitch_roll_deg"});
  scan.position = vector3(pose.at("position"));
  if (pose.has("yaw_pitch_roll_deg")) {
    const auto turns = pose.at("yaw_pitch_roll_deg").numbers(3);
    for (const double turn : turns)
      if (std::abs(turn) > 360.0)
        pose.at("yaw_pitch_roll_deg").refuse("an angle beyond 360 degrees", "degrees are needed");
    scan.angles = {rad_from_deg(turns[0]), rad_from_deg(turns[1]), rad_from_deg(turns[2])};
  }
  return scan;
}

JobRings read_job_rings(const JsonPlace& place, const fs::path& folder) {
  JobRings rings;
  if (place.is_text()) {
    rings.file = existing_file(place, folder);
    return rings;
  }
  place.only_keys({"file", "target_offset", "center", "radius", "tolerance"});
  rings.file = existing_file(place.at("file"), folder);
  if (place.has("target_offset")) rings.target_offset_m = place.at("target_offset").number_between(-0.5, 0.5, "m");
  if (place.has("radius")) rings.design.radius_m = place.at("radius").number_between(0.1, 100.0, "m");
  if (place.has("tolerance")) rings.design.tolerance_m = place.at("tolerance").number_between(0.001, 1.0, "m");
  if (!place.has("center")) return rings;
  const auto center = place.at("center").numbers(2);
  for (const double value : center)
    if (std::abs(value) > 100.0) place.at("center").refuse("more than 100 m from the axis", "metres are needed");
  rings.design.center_offset_m = center[0];
  rings.design.center_height_m = center[1];
  return rings;
}

void check_names(const Job& job, const JsonPlace& scans) {
  std::set<std::string> names;
  for (const JobScan& scan : job.scans)
    if (!names.insert(scan.name).second) scans.refuse("two scans are named \"" + scan.name + "\"", "rename one");
}

/// Members of every group, by group.
json options_json(JobOptions options) {
  json groups = json::object();
  for_each_group(options, [&](const char* group, auto& members) {
    OptionsToJson writer;
    describe(writer, members);
    groups[group] = writer.json;
  });
  return groups;
}

/// Only what differs from the defaults.
json changed_options(const JobOptions& options) {
  const json standard = options_json(JobOptions{});
  const json own = options_json(options);
  json changed = json::object();
  for (const auto& [group, members] : own.items())
    for (const auto& [name, value] : members.items())
      if (standard[group][name] != value) changed[group][name] = value;
  return changed;
}

}  // namespace

Job read_job(const fs::path& file) {
  const json root = parse_json_file(file);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const JsonPlace place(root, file.string());
  place.only_keys({"adit",    "name",      "client",         "surveyor",        "scans",   "control",
                   "targets", "alignment", "alignment_name", "alignment_start", "profile", "cant",
                   "lines",   "chainage",  "rounds",         "drive",           "zones",   "tolerances",
                   "before",  "face",      "straightedge",   "sections",        "sectors", "swell",
                   "rings",   "cameras",   "landmarks",      "options"});
  if (place.at("adit").whole_number() != 1)
    place.at("adit").refuse("this version reads jobs of format 1", "use the version of Adit that wrote the job");
  Job job;
  job.name = place.text_or("name", fs::weakly_canonical(folder).filename().string());
  job.client = place.text_or("client", "");
  job.surveyor = place.text_or("surveyor", "");
  if (place.has("rings")) job.rings = read_job_rings(place.at("rings"), folder);
  if (place.has("scans") || !job.rings) {
    for (const JsonPlace& scan : place.at("scans").items()) job.scans.push_back(read_scan(scan, folder));
    if (job.scans.empty() && !job.rings) place.at("scans").refuse("the job has no scan", "name at least one scan file");
    check_names(job, place.at("scans"));
  }
  if (place.has("control")) job.control = existing_file(place.at("control"), folder);
  if (place.has("targets")) read_job_targets(place.at("targets"), folder, job);
  if (place.has("targets") && job.control.empty())
    place.refuse("\"targets\" without \"control\"", "name the control file, too");
  read_job_cameras(place, folder, job);
  if (place.has("alignment")) job.alignment = existing_file(place.at("alignment"), folder);
  job.alignment_name = place.text_or("alignment_name", "");
  if (place.has("alignment_start")) job.alignment_start_m = place.at("alignment_start").number_between(-1e6, 1e7, "m");
  read_job_design(place, folder, job);
  if (place.has("options")) {
    const JsonPlace options = place.at("options");
    std::vector<std::string> groups;
    for_each_group(job.options, [&](const char* group, auto&) { groups.emplace_back(group); });
    options.only_keys(groups);
    for_each_group(job.options, [&](const char* group, auto& members) {
      if (!options.has(group)) return;
      OptionsFromJson reader(options.at(group));
      describe(reader, members);
      reader.refuse_unknown();
    });
  }
  return job;
}

std::string job_text(const Job& job) {
  nlohmann::ordered_json root;
  root["adit"] = 1;
  root["name"] = job.name;
  if (!job.client.empty()) root["client"] = job.client;
  if (!job.surveyor.empty()) root["surveyor"] = job.surveyor;
  for (const JobScan& scan : job.scans) {
    nlohmann::ordered_json one{{"name", scan.name}, {"file", scan.file}};
    if (scan.number > 0) one["scan"] = scan.number;
    if (scan.position) {
      one["pose"]["position"] = {scan.position->x(), scan.position->y(), scan.position->z()};
      one["pose"]["yaw_pitch_roll_deg"] = {deg_from_rad(scan.angles.yaw_rad), deg_from_rad(scan.angles.pitch_rad),
                                           deg_from_rad(scan.angles.roll_rad)};
    }
    if (!scan.pictures.empty()) one["pictures"] = pictures_json(scan.pictures);
    root["scans"].push_back(one);
  }
  if (!job.control.empty()) root["control"] = job.control;
  add_job_targets(job, root);
  add_job_cameras(job, root);
  if (!job.alignment.empty()) root["alignment"] = job.alignment;
  if (!job.alignment_name.empty()) root["alignment_name"] = job.alignment_name;
  if (job.alignment_start_m) root["alignment_start"] = *job.alignment_start_m;
  add_job_design(job, root);
  if (job.rings) {
    nlohmann::ordered_json one{{"file", job.rings->file}};
    if (job.rings->target_offset_m != 0.0) one["target_offset"] = job.rings->target_offset_m;
    const RingDesign& design = job.rings->design;
    if (design.center_offset_m != 0.0 || design.center_height_m != 0.0)
      one["center"] = {design.center_offset_m, design.center_height_m};
    if (design.radius_m > 0.0) one["radius"] = design.radius_m;
    if (design.tolerance_m > 0.0) one["tolerance"] = design.tolerance_m;
    root["rings"] = one;
  }
  if (const json changed = changed_options(job.options); !changed.empty()) root["options"] = changed;
  return root.dump(2) + "\n";
}

}  // namespace adit::io
