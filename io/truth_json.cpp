#include "io/truth_json.h"

#include "io/json_place.h"

namespace adit::io {

std::string truth_text(const Truth& truth) {
  nlohmann::ordered_json root;
  root["truth"] = 1;
  root["scans"] = nlohmann::json::array();
  for (std::size_t i = 0; i < truth.scan_names.size(); ++i) {
    nlohmann::ordered_json scan{{"name", truth.scan_names[i]}};
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) scan["pose"].push_back(truth.site_from_scan[i].matrix()(r, c));
    root["scans"].push_back(scan);
  }
  root["face_chainage_m"] = truth.face_chainage_m;
  root["from"] = truth.from_m;
  root["to"] = truth.to_m;
  root["volume"] = {{"design_m3", truth.volume.design_m3},
                    {"excavated_m3", truth.volume.excavated_m3},
                    {"overbreak_m3", truth.volume.overbreak_m3},
                    {"underbreak_m3", truth.volume.underbreak_m3}};
  root["sections"] = nlohmann::json::array();
  for (const TrueSection& section : truth.sections)
    root["sections"].push_back({{"chainage", section.chainage_m},
                                {"design_area_m2", section.design_area_m2},
                                {"area_m2", section.area_m2},
                                {"overbreak_m2", section.overbreak_m2},
                                {"underbreak_m2", section.underbreak_m2}});
  return root.dump(1) + "\n";
}

Truth read_truth(const std::filesystem::path& file) {
  const nlohmann::json root = parse_json_file(file);
  const JsonPlace place(root, file.string());
  Truth truth;
  for (const JsonPlace& scan : place.at("scans").items()) {
    truth.scan_names.push_back(scan.at("name").text());
    const auto values = scan.at("pose").numbers(16);
    Eigen::Matrix4d matrix;
    for (int k = 0; k < 16; ++k) matrix(k / 4, k % 4) = values[static_cast<std::size_t>(k)];
    if (!is_rigid(matrix)) scan.at("pose").refuse("this is no rigid transform", "make the job again with adit demo");
    truth.site_from_scan.emplace_back(matrix);
  }
  truth.face_chainage_m = place.at("face_chainage_m").number();
  truth.from_m = place.at("from").number();
  truth.to_m = place.at("to").number();
  const JsonPlace volume = place.at("volume");
  truth.volume = {volume.at("design_m3").number(), volume.at("excavated_m3").number(),
                  volume.at("overbreak_m3").number(), volume.at("underbreak_m3").number()};
  for (const JsonPlace& one : place.at("sections").items()) {
    TrueSection section;
    section.chainage_m = one.at("chainage").number();
    section.design_area_m2 = one.at("design_area_m2").number();
    section.area_m2 = one.at("area_m2").number();
    section.overbreak_m2 = one.at("overbreak_m2").number();
    section.underbreak_m2 = one.at("underbreak_m2").number();
    truth.sections.push_back(section);
  }
  return truth;
}

}  // namespace adit::io
