#include "io/comparison_json.h"

namespace adit::io {
namespace {

using json = nlohmann::ordered_json;

json face_json(const FaceMap& face) {
  if (face.cells.empty()) return nullptr;
  const FaceSummary summary = summarise(face);
  return {{"mean_chainage", summary.mean_m},    {"min_chainage", summary.least_m},
          {"max_chainage", summary.greatest_m}, {"spread_m", summary.spread_m},
          {"seen_m2", summary.seen_m2},         {"hidden_m2", summary.hidden_m2},
          {"coverage", summary.share()},        {"cell_m", face.step_m}};
}

json between_json(const CompareResult& result) {
  const FaceVolume& between = result.between;
  if (!between.whole) return nullptr;
  json one{{"advance_m", between.advance_m},        {"sigma_advance_m", between.sigma_advance_m},
           {"excavated_m3", between.excavated_m3},  {"sigma_m3", between.sigma_m3},
           {"design_m3", between.design_m3},        {"guessed_m2", between.guessed_m2},
           {"contour_share", between.contour_share}};
  const bool round = result.drilled_m > 0.0;
  one["round"] = round ? json(result.round) : json(nullptr);
  one["pull_efficiency"] = round ? json(between.advance_m / result.drilled_m) : json(nullptr);
  one["rock_left"] = round ? json({{"mean_m", result.left.mean_m},
                                   {"max_m", result.left.most_m},
                                   {"share_over_0.3m", result.left.over_03_share}})
                           : json(nullptr);
  return one;
}

json layer_json(const LayerResult& layer) {
  const bool said = layer.design.nominal_m > 0.0;
  const auto share = [&](double value) { return said ? json(value) : json(nullptr); };
  const json sectors = layer.design.sectors.empty() ? json("all") : json(layer.design.sectors);
  return {{"sectors", sectors},
          {"minimum_m", said ? json(layer.design.minimum_m) : json(nullptr)},
          {"nominal_m", said ? json(layer.design.nominal_m) : json(nullptr)},
          {"surface_m2", layer.surface_m2},
          {"measured_m2", layer.measured_m2},
          {"mean_m", layer.mean_m},
          {"volume_m3", layer.volume_m3},
          {"sigma_volume_m3", layer.sigma_volume_m3},
          {"missing_m2", layer.missing_m2},
          {"whole_volume_m3", layer.whole_volume_m3},
          {"sigma_whole_m3", layer.sigma_whole_m3},
          {"blocks", layer.blocks.size()},
          {"below_minimum", share(layer.below_minimum)},
          {"below_nominal", share(layer.below_nominal)},
          {"from_nominal", share(layer.from_nominal)}};
}

json direction_json(const UndulationDirection& direction) {
  if (direction.places == 0) return nullptr;
  return {{"places", direction.places},         {"max_depth_m", direction.max_depth_m},
          {"chainage", direction.chainage_m},   {"p_m", direction.p_m},
          {"depth_95_m", direction.depth_95_m}, {"max_ratio", direction.max_ratio},
          {"over_limit", direction.over_limit}};
}

}  // namespace

void add_comparison(const CompareResult& result, json& root) {
  if (!result.face.cells.empty()) root["face"] = face_json(result.face);
  if (!result.before.empty()) {
    root["before"]["job"] = result.before;
    root["before"]["face"] = face_json(result.face_before);
    root["before"]["between_faces"] = between_json(result);
    root["before"]["layer"] = layer_json(result.layer);
    const ChangeResult& change = result.change;
    root["before"]["change"] = {{"level_of_detection_m", change.level_m}, {"compared_m2", change.compared_m2},
                                {"inwards_m2", change.inwards_m2},        {"outwards_m2", change.outwards_m2},
                                {"inwards_m3", change.inwards_m3},        {"outwards_m3", change.outwards_m3}};
  }
  if (result.undulation.straightedge_m <= 0.0) return;
  const UndulationResult& undulation = result.undulation;
  root["undulation"] = {{"straightedge_m", undulation.straightedge_m},
                        {"limit_ratio", undulation.limit_ratio > 0.0 ? json(undulation.limit_ratio) : json(nullptr)},
                        {"along", direction_json(undulation.along)},
                        {"around", direction_json(undulation.around)}};
}

}  // namespace adit::io
