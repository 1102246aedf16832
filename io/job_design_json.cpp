#include "io/job_design_json.h"

#include <algorithm>
#include <set>

#include "core/foundation/error.h"
#include "io/existing_file.h"
#include "io/file_ending.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;

/// A name that fits on a sheet.
std::string name_of(const JsonPlace& place, const std::string& what) {
  constexpr std::size_t most_letters = 100;
  const std::string name = place.text();
  if (name.find_first_not_of(" \t") == std::string::npos)
    place.refuse(what + " needs a name", "every number names what it is about: write one");
  if (name.size() > most_letters) place.refuse("the name is longer than 100 letters", "write a shorter one");
  return name;
}

std::vector<JobProfile> read_profiles(const JsonPlace& place, const fs::path& folder) {
  std::vector<JobProfile> profiles;
  if (place.is_text()) {
    profiles.emplace_back();
    profiles.back().file = existing_file(place, folder);
    profiles.back().from_m = -1e9;
    return profiles;
  }
  const std::vector<JsonPlace> places = place.is_object() ? std::vector<JsonPlace>{place} : place.items();
  for (const JsonPlace& one : places) {
    one.only_keys({"file", "layer", "library", "sizes", "from", "to_next"});
    JobProfile profile;
    if (one.has("file") == one.has("library"))
      one.refuse("a profile is a \"file\" or one of the \"library\"", "write one of the two");
    if (one.has("file")) profile.file = existing_file(one.at("file"), folder);
    if (one.has("library")) profile.library = name_of(one.at("library"), "a profile");
    if (one.has("sizes"))
      for (const std::string& name : one.at("sizes").keys())
        profile.sizes[name] = one.at("sizes").at(name).number_between(-1000.0, 1000.0, "m");
    if (one.has("to_next")) {
      const std::string way = one.at("to_next").text();
      if (way != "stepped" && way != "interpolated")
        one.at("to_next").refuse("unknown word", "write stepped or interpolated");
      profile.interpolated = way == "interpolated";
    }
    profile.layer = one.text_or("layer", "");
    profile.from_m = one.number_or("from", -1e9);
    if (!profiles.empty() && profile.from_m <= profiles.back().from_m)
      one.refuse("profiles must stand in order of \"from\"", "give every profile but the first a larger \"from\"");
    profiles.push_back(profile);
  }
  const auto is_landxml = [](const JobProfile& profile) {
    return lower_ending(profile.file) == ".xml" || lower_ending(profile.file) == ".landxml";
  };
  if (!profiles.empty() && profiles.back().interpolated && !is_landxml(profiles.back()))
    places.back().refuse("nothing follows the last profile", "leave its \"to_next\" out");
  if (profiles.empty()) place.refuse("at least one profile is needed", "name a file");
  return profiles;
}

std::vector<DesignLine> read_lines(const JsonPlace& place) {
  std::vector<DesignLine> lines;
  std::set<std::string> names;
  for (const JsonPlace& one : place.items()) {
    one.only_keys({"name", "offset", "look_out_per_m", "clearance"});
    lines.push_back({name_of(one.at("name"), "a line"), one.at("offset").number_between(-10.0, 10.0, "m")});
    if (one.has("look_out_per_m"))
      lines.back().growth_per_m = one.at("look_out_per_m").number_between(0.0, 0.5, "m per m");
    if (one.has("clearance")) lines.back().clearance = one.at("clearance").yes_or_no();
    if (!names.insert(lines.back().name).second)
      one.refuse("two lines have this name", "every number names its line: rename one");
  }
  if (!lines.empty() && lines.front().clearance)
    place.refuse("the first line is the reference, and a clearance line is none", "write the excavation line first");
  if (lines.empty())
    place.refuse("at least one line is needed", "for instance {\"name\": \"excavation\", \"offset\": 0.0}");
  return lines;
}

JobChainage read_chainage(const JsonPlace& place) {
  place.only_keys({"from", "to", "interval"});
  JobChainage chainage;
  chainage.from_m = place.at("from").number();
  chainage.to_m = place.at("to").number();
  if (place.has("interval")) chainage.interval_m = place.at("interval").number_between(0.01, 1e5, "m");
  if (!(chainage.to_m > chainage.from_m))
    place.refuse("\"to\" must be greater than \"from\"", "chainage increases along the axis");
  if ((chainage.to_m - chainage.from_m) / chainage.interval_m > 100000.0)
    place.refuse("more than 100,000 sections", "use a larger interval");
  return chainage;
}

std::vector<JobRound> read_rounds(const JsonPlace& place) {
  std::vector<JobRound> rounds;
  for (const JsonPlace& one : place.items()) {
    one.only_keys({"number", "from", "to", "drilled"});
    JobRound round;
    round.number = static_cast<int>(one.at("number").number_between(-1e6, 1e6, ""));
    static_cast<void>(one.at("number").whole_number());
    round.from_m = one.at("from").number();
    round.to_m = one.at("to").number();
    if (!(round.to_m > round.from_m))
      one.refuse("\"to\" must be greater than \"from\"", "chainage increases along the axis");
    if (round.to_m - round.from_m < 0.05) one.refuse("the round is shorter than 5 cm", "write its whole length");
    if (one.has("drilled")) round.drilled_m = one.at("drilled").number_between(0.1, 30.0, "m");
    for (const JobRound& other : rounds) {
      if (other.number == round.number) one.refuse("two rounds have this number", "number every round once");
      if (round.from_m < other.to_m - 1e-9 && round.to_m > other.from_m + 1e-9)
        one.refuse("it overlaps round " + std::to_string(other.number), "end a round where the next one begins");
    }
    rounds.push_back(round);
  }
  return rounds;
}

std::vector<Sector> read_sectors(const JsonPlace& place) {
  std::vector<Sector> sectors;
  for (const JsonPlace& one : place.items()) {
    one.only_keys({"name", "from_deg", "to_deg"});
    sectors.push_back({name_of(one.at("name"), "a sector"), one.at("from_deg").number_between(-180.0, 180.0, "degrees"),
                       one.at("to_deg").number_between(-180.0, 180.0, "degrees")});
  }
  try {
    check_sectors(sectors);
  } catch (const Error& error) {
    place.refuse(error.what_is_wrong(), error.mend());
  }
  return sectors;
}

std::vector<ReasonZone> read_zones(const JsonPlace& place) {
  std::vector<ReasonZone> zones;
  for (const JsonPlace& one : place.items()) {
    one.only_keys({"from", "to", "from_deg", "to_deg", "reason", "note"});
    ReasonZone zone;
    zone.from_m = one.at("from").number();
    zone.to_m = one.at("to").number();
    if (!(zone.to_m > zone.from_m))
      one.refuse("\"to\" must be greater than \"from\"", "chainage increases along the axis");
    if (one.has("from_deg") != one.has("to_deg"))
      one.refuse("\"from_deg\" and \"to_deg\" belong together", "write both, or none for the whole profile");
    if (one.has("from_deg")) {
      zone.from_deg = one.at("from_deg").number_between(-180.0, 180.0, "degrees");
      zone.to_deg = one.at("to_deg").number_between(-180.0, 180.0, "degrees");
      if (zone.from_deg == zone.to_deg || (zone.from_deg == 180.0 && zone.to_deg == -180.0))
        one.refuse("the zone is empty", "write different degrees");
    }
    zone.reason = one.at("reason").text();
    zone.note = one.text_or("note", "");
    if (zone.note.size() > 500) one.at("note").refuse("the note is longer than 500 letters", "write a shorter one");
    const auto& codes = reason_codes();
    if (std::find(codes.begin(), codes.end(), zone.reason) == codes.end())
      one.at("reason").refuse("unknown reason", "write technical, geological, look_out or other");
    zones.push_back(zone);
  }
  try {
    check_zones(zones);
  } catch (const Error& error) {
    place.refuse(error.what_is_wrong(), error.mend());
  }
  return zones;
}

JobTolerances read_job_tolerances(const JsonPlace& place, const fs::path& folder) {
  JobTolerances tolerances;
  if (place.is_text()) {
    tolerances.file = existing_file(place, folder);
    return tolerances;
  }
  if (!place.is_object()) place.refuse("tolerances are a file or one of the library", "write its name, or an object");
  place.only_keys({"file", "library", "rock_classes"});
  if (place.has("file") == place.has("library"))
    place.refuse("tolerances are a \"file\" or one of the \"library\"", "write one of the two");
  if (place.has("file")) tolerances.file = existing_file(place.at("file"), folder);
  if (place.has("library")) tolerances.library = name_of(place.at("library"), "a set");
  if (!place.has("rock_classes")) return tolerances;
  for (const JsonPlace& one : place.at("rock_classes").items()) {
    one.only_keys({"from", "class"});
    tolerances.rock_classes.push_back({one.at("from").number(), name_of(one.at("class"), "a rock class")});
    const auto& classes = tolerances.rock_classes;
    if (classes.size() > 1 && classes.back().from_m <= classes[classes.size() - 2].from_m)
      one.refuse("rock classes must stand in order of \"from\"", "give every class a larger \"from\"");
  }
  return tolerances;
}

JobBefore read_before(const JsonPlace& place, const fs::path& folder) {
  if (!place.is_text() && !place.is_object())
    place.refuse("the earlier job is a file or a folder", "write its name, or an object");
  JobBefore before;
  const JsonPlace job = place.is_text() ? place : place.at("job");
  before.job = job.text();
  std::error_code error;
  const fs::path file = folder / before.job;
  if (before.job.empty() || !fs::exists(fs::is_directory(file, error) ? file / "job.json" : file, error))
    job.refuse("there is no job " + quoted_word(before.job), "paths are relative to the folder of job.json");
  if (!fs::is_directory(file, error) && lower_ending(before.job) != ".json")
    job.refuse(quoted_word(before.job) + " is no job", "name a job.json, or the folder that holds one");
  if (place.is_text()) return before;
  place.only_keys({"job", "out", "layer"});
  before.out = place.text_or("out", "");
  if (!place.has("layer")) return before;
  const JsonPlace layer = place.at("layer");
  layer.only_keys({"minimum", "nominal", "sectors"});
  if (layer.has("minimum")) before.layer.minimum_m = layer.at("minimum").number_between(0.0, 2.0, "m");
  before.layer.nominal_m =
      layer.has("nominal") ? layer.at("nominal").number_between(0.0, 2.0, "m") : before.layer.minimum_m;
  if (layer.has("nominal") && !layer.has("minimum"))
    layer.refuse("a nominal thickness without a minimum", "write \"minimum\", too: 0 if there is none");
  if (before.layer.nominal_m < before.layer.minimum_m)
    layer.at("nominal").refuse("it is less than the minimum", "exchange them");
  if (!layer.has("sectors")) return before;
  for (const JsonPlace& sector : layer.at("sectors").items()) before.layer.sectors.push_back(sector.text());
  if (before.layer.sectors.empty())
    layer.at("sectors").refuse("no sector gets the layer", "name one, or leave \"sectors\" out for all");
  return before;
}

/// The sectors that get the layer are sectors of the job.
void expect_sectors(const JsonPlace& layer, const Job& job) {
  std::string all;
  for (const Sector& sector : job.sectors) all += (all.empty() ? "" : ", ") + sector.name;
  for (const JsonPlace& place : layer.at("sectors").items())
    if (std::none_of(job.sectors.begin(), job.sectors.end(),
                     [&](const Sector& sector) { return sector.name == place.text(); }))
      place.refuse("there is no sector " + quoted_word(place.text()), "write one of: " + all);
}

JobStraightedge read_straightedge(const JsonPlace& place) {
  place.only_keys({"length", "limit_ratio"});
  JobStraightedge edge;
  edge.length_m = place.at("length").number_between(0.3, 20.0, "m");
  if (place.has("limit_ratio")) edge.limit_ratio = place.at("limit_ratio").number_between(0.001, 1.0, "");
  return edge;
}

void add_profiles(const Job& job, nlohmann::ordered_json& root) {
  for (const JobProfile& profile : job.profiles) {
    nlohmann::ordered_json one;
    if (!profile.file.empty()) one["file"] = profile.file;
    if (!profile.library.empty()) one["library"] = profile.library;
    for (const auto& [name, size] : profile.sizes) one["sizes"][name] = size;
    if (profile.interpolated) one["to_next"] = "interpolated";
    if (!profile.layer.empty()) one["layer"] = profile.layer;
    if (profile.from_m > -1e9) one["from"] = profile.from_m;
    root["profile"].push_back(one);
  }
  if (job.turned_by_cant) root["cant"] = "turns_profile";
  for (const DesignLine& line : job.lines) {
    nlohmann::ordered_json one{{"name", line.name}, {"offset", line.offset_m}};
    if (line.growth_per_m != 0.0) one["look_out_per_m"] = line.growth_per_m;
    if (line.clearance) one["clearance"] = true;
    root["lines"].push_back(one);
  }
  if (job.chainage)
    root["chainage"] = {
        {"from", job.chainage->from_m}, {"to", job.chainage->to_m}, {"interval", job.chainage->interval_m}};
  for (const JobRound& round : job.rounds) {
    nlohmann::ordered_json one{{"number", round.number}, {"from", round.from_m}, {"to", round.to_m}};
    if (round.drilled_m > 0.0) one["drilled"] = round.drilled_m;
    root["rounds"].push_back(one);
  }
  if (job.sectors != standard_sectors())
    for (const Sector& sector : job.sectors)
      root["sectors"].push_back({{"name", sector.name}, {"from_deg", sector.from_deg}, {"to_deg", sector.to_deg}});
  if (job.swell > 0.0) root["swell"] = job.swell;
}

void add_review(const Job& job, nlohmann::ordered_json& root) {
  if (job.sections != JobSections::vertical) root["sections"] = job.sections == JobSections::both ? "both" : "square";
  if (!job.driven_up_chainage) root["drive"] = "down_chainage";
  for (const ReasonZone& zone : job.zones) {
    nlohmann::ordered_json one{{"from", zone.from_m}, {"to", zone.to_m}};
    if (zone.from_deg > -180.0 || zone.to_deg < 180.0) {
      one["from_deg"] = zone.from_deg;
      one["to_deg"] = zone.to_deg;
    }
    one["reason"] = zone.reason;
    if (!zone.note.empty()) one["note"] = zone.note;
    root["zones"].push_back(one);
  }
  if (job.before) {
    nlohmann::ordered_json one{{"job", job.before->job}};
    if (!job.before->out.empty()) one["out"] = job.before->out;
    if (job.before->layer.nominal_m > 0.0)
      one["layer"] = {{"minimum", job.before->layer.minimum_m}, {"nominal", job.before->layer.nominal_m}};
    if (!job.before->layer.sectors.empty()) one["layer"]["sectors"] = job.before->layer.sectors;
    root["before"] = one;
  }
  if (job.face) root["face"] = true;
  if (job.straightedge) {
    root["straightedge"]["length"] = job.straightedge->length_m;
    if (job.straightedge->limit_ratio > 0.0) root["straightedge"]["limit_ratio"] = job.straightedge->limit_ratio;
  }
  if (!job.tolerances) return;
  nlohmann::ordered_json one;
  if (!job.tolerances->file.empty()) one["file"] = job.tolerances->file;
  if (!job.tolerances->library.empty()) one["library"] = job.tolerances->library;
  for (const RockClassFrom& rock : job.tolerances->rock_classes)
    one["rock_classes"].push_back({{"from", rock.from_m}, {"class", rock.rock_class}});
  root["tolerances"] = one;
}

}  // namespace

void read_job_design(const JsonPlace& place, const fs::path& folder, Job& job) {
  if (place.has("profile")) job.profiles = read_profiles(place.at("profile"), folder);
  if (place.has("cant")) {
    const std::string way = place.at("cant").text();
    if (way != "turns_profile" && way != "ignored")
      place.at("cant").refuse("unknown word", "write turns_profile or ignored");
    job.turned_by_cant = way == "turns_profile";
  }
  if (place.has("lines")) job.lines = read_lines(place.at("lines"));
  if (place.has("chainage")) job.chainage = read_chainage(place.at("chainage"));
  if (place.has("sections")) {
    const std::string planes = place.at("sections").text();
    if (planes != "vertical" && planes != "square" && planes != "both")
      place.at("sections").refuse("unknown word", "write vertical, square or both");
    job.sections = planes == "square" ? JobSections::square
                   : planes == "both" ? JobSections::both
                                      : JobSections::vertical;
  }
  if (place.has("rounds")) job.rounds = read_rounds(place.at("rounds"));
  if (place.has("drive")) {
    const std::string way = place.at("drive").text();
    if (way != "up_chainage" && way != "down_chainage")
      place.at("drive").refuse("unknown word", "write up_chainage or down_chainage");
    job.driven_up_chainage = way == "up_chainage";
  }
  if (place.has("zones")) job.zones = read_zones(place.at("zones"));
  if (place.has("tolerances")) job.tolerances = read_job_tolerances(place.at("tolerances"), folder);
  if (place.has("before")) job.before = read_before(place.at("before"), folder);
  if (place.has("face")) job.face = place.at("face").yes_or_no();
  if (place.has("straightedge")) job.straightedge = read_straightedge(place.at("straightedge"));
  if (place.has("sectors")) job.sectors = read_sectors(place.at("sectors"));
  if (job.before && !job.before->layer.sectors.empty()) expect_sectors(place.at("before").at("layer"), job);
  if (place.has("swell")) job.swell = place.at("swell").number_between(1.0, 3.0, "");
}

void add_job_design(const Job& job, nlohmann::ordered_json& root) {
  add_profiles(job, root);
  add_review(job, root);
}

}  // namespace adit::io
