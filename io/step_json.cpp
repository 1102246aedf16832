#include "io/step_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/foundation/error.h"

// Eigen types as flat lists.
namespace nlohmann {

template <int Rows, int Columns>
struct adl_serializer<Eigen::Matrix<double, Rows, Columns>> {
  static void to_json(json& out, const Eigen::Matrix<double, Rows, Columns>& matrix) {
    out = json::array();
    for (Eigen::Index i = 0; i < matrix.size(); ++i) out.push_back(matrix.data()[i]);
  }
  static void from_json(const json& in, Eigen::Matrix<double, Rows, Columns>& matrix) {
    if (static_cast<Eigen::Index>(in.size()) != matrix.size()) throw adit::Error("a matrix of another size");
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      matrix.data()[i] = in.at(static_cast<std::size_t>(i)).get<double>();
  }
};

template <>
struct adl_serializer<adit::Pose> {
  static void to_json(json& out, const adit::Pose& pose) { out = Eigen::Matrix4d(pose.matrix()); }
  static void from_json(const json& in, adit::Pose& pose) { pose.matrix() = in.get<Eigen::Matrix4d>(); }
};

/// [kind] or, of a seen cell, [kind, chainage].
template <>
struct adl_serializer<adit::FaceCell> {
  static void to_json(json& out, const adit::FaceCell& cell) {
    out = json::array({static_cast<int>(cell.kind)});
    if (cell.kind == adit::FaceKind::seen) out.push_back(cell.chainage_m);
  }
  static void from_json(const json& in, adit::FaceCell& cell) {
    const int kind = in.at(0).get<int>();
    if (kind < 0 || kind > static_cast<int>(adit::FaceKind::seen)) throw adit::Error("a cell of no kind");
    cell.kind = static_cast<adit::FaceKind>(kind);
    if (cell.kind == adit::FaceKind::seen) cell.chainage_m = in.at(1).get<double>();
  }
};

}  // namespace nlohmann

namespace adit {

NLOHMANN_JSON_SERIALIZE_ENUM(Severity, {{Severity::note, "note"},
                                        {Severity::warning, "warning"},
                                        {Severity::decision, "decision"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, severity, subject, words, mend)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InputRecord, file, sha256, points)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ProjectOrigin, position)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImportedScan, name, offset, points, no_returns)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImportResult, inputs, scans, origin, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PoseSigma, along_m, across_m, up_m, roll_rad, pitch_rad, yaw_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Stretch, from_m, to_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PairResult, source, target, target_from_source, overlap, rms_m, median_m,
                                   median_distance_m, within_6mm, balance, agreeing, seen_through, noise_m, scale,
                                   scale_sigma, iterations, sigma, undetermined, alike_m, moved, moved_m, lone_witness,
                                   used, why_not, information)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoopClosure, scans, before_m, before_rad, after_m, after_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlacedScan, name, placed, local_from_scan, sigma, placed_by, undetermined)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ControlResidual, scan, id, residual_m, used, redundancy, normalised)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PictureResult, scan, picture, camera, located, used, local_from_camera, sigma_m,
                                   sigma_rad, residual_m, turned_rad, normalised, targets, rejected, unknown, rms_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CameraSight, scan, picture, camera, local_from_camera, covariance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LocatedPicture, result, sight, by_focal_length_m)
NLOHMANN_JSON_SERIALIZE_ENUM(TargetKind, {{TargetKind::sphere, "sphere"},
                                          {TargetKind::quarters, "quarters"},
                                          {TargetKind::coded, "coded"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FoundTarget, scan, kind, id, position, sigma_m, size_m, pixels)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TargetsResult, looked_in_scans, found, pictures, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CameraResult, camera, scan_from_camera, moved_m, moved_rad, normalised)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RegistrationResult, accepted, scans, pairs, loops, control, control_rms_m, pictures,
                                   cameras, sigma_factor, datum_sigma_m, datum_scan, in_site, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VolumeAmounts, design_m3, excavated_m3, overbreak_m3, underbreak_m3)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SectorVolume, name, surface_m2, measured_m2, overbreak_m3, underbreak_m3,
                                   max_overbreak_m, max_overbreak_chainage_m, max_overbreak_clock_deg)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RoundReview, lookout_collar_m, lookout_toe_m, lookout_per_m, lookout_sigma_per_m,
                                   contour_ratio, overbreak_area_sd_m2, affected_share, mean_overbreak_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeshVolume, there, excavated_m3, filled_m2, closed)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Volume, mesh, line, line_offset_m, line_growth_per_m, from_m, to_m, slices,
                                   average_end_area, prismoidal, sigma_excavated_m3, sigma_overbreak_m3,
                                   sigma_underbreak_m3, coverage, measured_m2, interpolated_m2, unseen_m2, opening_m2,
                                   closure_m3, sectors)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RoundVolume, number, drilled_m, pull_m, loose_m3, review, volume)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReasonZone, from_m, to_m, from_deg, to_deg, reason, note)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ZoneVolume, zone, amounts)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceRow, rock_class, sector, mean_overbreak_m, max_overbreak_m,
                                   max_underbreak_m, max_underbreak_area_m2)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceCheck, rock_class, sector, limits, surface_m2, measured_m2,
                                   mean_overbreak_m, max_overbreak_m, max_overbreak_chainage_m, max_underbreak_m,
                                   max_underbreak_chainage_m, max_underbreak_area_m2, sure_mean_overbreak_m,
                                   sure_overbreak_m, sure_underbreak_m, sure_underbreak_area_m2, over_limit_m2,
                                   under_limit_m2)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceResult, set, source, verified_by, checks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VolumeResult, lines, rounds, zones, tolerances, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeshSummary, points, triangles, edges, boundary_loops, components, area_m2,
                                   mean_edge_m, longest_loop_m, holes_m, mean_deviation_m, sigma_deviation_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SurfaceResult, mesh, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TunnelPoint, s_m, x_m, z_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ClearancePoint, scan, at, inside_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Intrusion, points, from_m, to_m, cut, deepest, deepest_site)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ClearanceResult, line, line_offset_m, points, intrusions)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaceVolume, excavated_m3, sigma_m3, design_m3, from_m, to_m, advance_m,
                                   sigma_advance_m, guessed_m2, contour_share, whole)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RockLeft, mean_m, most_m, over_03_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LayerDesign, minimum_m, nominal_m, sectors)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LayerBlock, chainage_m, p_m, measured_m2, mean_m, sigma_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LayerResult, design, surface_m2, measured_m2, mean_m, volume_m3, sigma_volume_m3,
                                   missing_m2, whole_volume_m3, sigma_whole_m3, below_minimum, below_nominal,
                                   from_nominal, blocks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChangeResult, level_m, compared_m2, inwards_m2, outwards_m2, inwards_m3, outwards_m3)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UndulationDirection, places, max_depth_m, chainage_m, p_m, depth_95_m, over_limit,
                                   max_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UndulationResult, straightedge_m, limit_ratio, along, around)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaceMap, x_from_m, z_from_m, step_m, columns, rows, cells)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CompareResult, before, face_before, face, between, round, drilled_m, left, layer,
                                   change, undulation, findings)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RingResidual, point, clock_deg, residual_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RingResult, ring, center, chainage_m, station_m, horizontal_deviation_m,
                                   vertical_deviation_m, radius_m, ovality_m, major_clock_deg, rms_m, sigma_center_m,
                                   sigma_radius_m, verdict, tilt_deg, residuals)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RingDesign, center_offset_m, center_height_m, radius_m, tolerance_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RingsResult, design, rings, findings)

}  // namespace adit

namespace adit::io {
namespace {

/// JSON has no word for "not a number"; a value far out of every range stands for it.
constexpr double no_number = -1e300;

template <typename Result>
void read(const std::string& text, Result& result) {
  try {
    result = nlohmann::json::parse(text).get<Result>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(std::string("what an earlier run left is damaged: ") + error.what(), "", "run the job again");
  }
}

void swap_number(double& value, bool writing) {
  if (writing && std::isnan(value)) value = no_number;
  if (!writing && value <= no_number) value = std::numeric_limits<double>::quiet_NaN();
}

void swap_numbers(RegistrationResult& result, bool writing) {
  for (PairResult& pair : result.pairs)
    for (double* value : {&pair.rms_m, &pair.median_m, &pair.median_distance_m}) swap_number(*value, writing);
}

void swap_numbers(SurfaceResult& result, bool writing) {
  swap_number(result.mesh.mean_deviation_m, writing);
  swap_number(result.mesh.sigma_deviation_m, writing);
}

void swap_numbers(VolumeResult& result, bool writing) {
  for (RoundVolume& round : result.rounds) {
    RoundReview& r = round.review;
    for (double* value : {&r.lookout_collar_m, &r.lookout_toe_m, &r.lookout_per_m, &r.lookout_sigma_per_m,
                          &r.contour_ratio, &r.overbreak_area_sd_m2, &r.affected_share, &r.mean_overbreak_m})
      swap_number(*value, writing);
  }
}

void swap_numbers(RingsResult& result, bool writing) {
  for (RingResult& ring : result.rings)
    for (double* value : {&ring.ovality_m, &ring.major_clock_deg, &ring.sigma_center_m, &ring.sigma_radius_m})
      swap_number(*value, writing);
}

}  // namespace

std::string step_text(const ImportResult& result) {
  return nlohmann::json(result).dump(1);
}

std::string step_text(const TargetsResult& result) {
  return nlohmann::json(result).dump(1);
}

std::string step_text(const RegistrationResult& result) {
  RegistrationResult copy = result;
  swap_numbers(copy, true);
  return nlohmann::json(copy).dump(1);
}

std::string step_text(const SurfaceResult& result) {
  SurfaceResult copy = result;
  swap_numbers(copy, true);
  return nlohmann::json(copy).dump(1);
}

std::string step_text(const RingsResult& result) {
  RingsResult copy = result;
  swap_numbers(copy, true);
  return nlohmann::json(copy).dump(1);
}

std::string step_text(const CompareResult& result) {
  return nlohmann::json(result).dump();
}

std::string step_text(const ProfileResult& result) {
  return nlohmann::json{{"points_used", result.points_used},
                        {"points_inside", result.points_inside},
                        {"points_outside", result.points_outside},
                        {"clearances", result.clearances},
                        {"findings", result.findings}}
      .dump(1);
}

std::string step_text(const VolumeResult& result) {
  VolumeResult copy = result;
  swap_numbers(copy, true);
  return nlohmann::json(copy).dump(1);
}

void read_step_text(const std::string& text, ImportResult& result) {
  read(text, result);
}

void read_step_text(const std::string& text, TargetsResult& result) {
  read(text, result);
}

void read_step_text(const std::string& text, RegistrationResult& result) {
  read(text, result);
  swap_numbers(result, false);
}

void read_step_text(const std::string& text, SurfaceResult& result) {
  read(text, result);
  swap_numbers(result, false);
}

void read_step_text(const std::string& text, RingsResult& result) {
  read(text, result);
  swap_numbers(result, false);
}

void read_step_text(const std::string& text, ProfileResult& result) {
  nlohmann::json json;
  read(text, json);
  try {
    result.points_used = json.at("points_used").get<std::uint64_t>();
    result.points_inside = json.at("points_inside").get<std::uint64_t>();
    result.points_outside = json.at("points_outside").get<std::uint64_t>();
    result.clearances = json.at("clearances").get<std::vector<ClearanceResult>>();
    result.findings = json.at("findings").get<Findings>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(std::string("what an earlier run left is damaged: ") + error.what(), "", "run the job again");
  }
}

void read_step_text(const std::string& text, CompareResult& result) {
  read(text, result);
  for (const FaceMap* face : {&result.face_before, &result.face})
    if (face->cells.size() != face->columns * face->rows)
      throw Error("what an earlier run left is damaged: a face of another size", "", "run the job again");
}

void read_step_text(const std::string& text, VolumeResult& result) {
  read(text, result);
  swap_numbers(result, false);
}

}  // namespace adit::io
