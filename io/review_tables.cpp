#include "io/review_tables.h"

#include <cmath>

#include "io/csv_cells.h"

namespace adit::io {
namespace {

std::string row(const std::vector<std::string>& cells) {
  std::string text;
  for (const std::string& cell : cells) text += (text.empty() ? "" : ",") + cell;
  return text + "\n";
}

std::string limit(double value) {
  return value >= ToleranceRow::unlimited ? std::string() : csv_number(value, 4);
}

}  // namespace

std::string zones_csv(const Results& results) {
  std::string csv =
      "zone,from_m,to_m,from_deg,to_deg,reason,note,surface_m2,coverage,overbreak_m3,underbreak_m3,max_overbreak_m\n";
  if (!results.volume) return csv;
  double rest_m3 = results.volume->lines.front().slices.overbreak_m3;
  for (std::size_t i = 0; i < results.volume->zones.size(); ++i) {
    const auto& [zone, amounts] = results.volume->zones[i];
    rest_m3 -= amounts.overbreak_m3;
    csv +=
        row({std::to_string(i + 1), csv_number(zone.from_m, 3), csv_number(zone.to_m, 3), csv_number(zone.from_deg, 1),
             csv_number(zone.to_deg, 1), zone.reason, cell_word(zone.note), csv_number(amounts.surface_m2, 3),
             csv_number(amounts.surface_m2 > 0.0 ? amounts.measured_m2 / amounts.surface_m2 : 0.0, 4),
             csv_number(amounts.overbreak_m3, 4), csv_number(amounts.underbreak_m3, 4),
             csv_number(amounts.max_overbreak_m, 4)});
  }
  return csv + row({"none", "", "", "", "", "unassigned", "", "", "", csv_number(rest_m3, 4), "", ""});
}

std::string tolerances_csv(const Results& results) {
  std::string csv =
      "set,rock_class,sector,verdict,surface_m2,coverage,mean_overbreak_m,limit_mean_overbreak_m,max_overbreak_m,"
      "limit_max_overbreak_m,max_overbreak_chainage_m,over_limit_m2,max_underbreak_m,limit_max_underbreak_m,"
      "max_underbreak_chainage_m,under_limit_m2,max_underbreak_area_m2,limit_max_underbreak_area_m2,"
      "sure_mean_overbreak_m,sure_overbreak_m,sure_underbreak_m,sure_underbreak_area_m2\n";
  if (!results.volume) return csv;
  for (const ToleranceCheck& c : results.volume->tolerances.checks)
    csv += row({cell_word(results.volume->tolerances.set),
                cell_word(c.rock_class),
                cell_word(c.sector),
                words_of(c.verdict()),
                csv_number(c.surface_m2, 3),
                csv_number(c.coverage(), 4),
                csv_number(c.mean_overbreak_m, 4),
                limit(c.limits.mean_overbreak_m),
                csv_number(c.max_overbreak_m, 4),
                limit(c.limits.max_overbreak_m),
                c.max_overbreak_m > 0.0 ? csv_number(c.max_overbreak_chainage_m, 3) : std::string(),
                csv_number(c.over_limit_m2, 3),
                csv_number(c.max_underbreak_m, 4),
                limit(c.limits.max_underbreak_m),
                c.max_underbreak_m > 0.0 ? csv_number(c.max_underbreak_chainage_m, 3) : std::string(),
                csv_number(c.under_limit_m2, 3),
                csv_number(c.max_underbreak_area_m2, 3),
                limit(c.limits.max_underbreak_area_m2),
                csv_number(c.sure_mean_overbreak_m, 4),
                csv_number(c.sure_overbreak_m, 4),
                csv_number(c.sure_underbreak_m, 4),
                csv_number(c.sure_underbreak_area_m2, 3)});
  return csv;
}

std::string face_csv(const CompareResult& result) {
  std::string csv = "epoch,offset_m,height_m,kind,chainage_m\n";
  constexpr const char* kinds[] = {"beside", "unseen", "hidden", "seen"};
  const auto add = [&](const char* epoch, const FaceMap& face) {
    for (std::size_t i = 0; i < face.cells.size(); ++i) {
      const FaceCell& cell = face.cells[i];
      if (cell.kind == FaceKind::beside) continue;
      const Eigen::Vector2d at = face.middle(i % face.columns, i / face.columns);
      csv += row({epoch, csv_number(at.x(), 3), csv_number(at.y(), 3), kinds[static_cast<int>(cell.kind)],
                  cell.kind == FaceKind::seen ? csv_number(cell.chainage_m, 4) : std::string()});
    }
  };
  add("before", result.face_before);
  add("after", result.face);
  return csv;
}

std::string layer_csv(const CompareResult& result) {
  std::string csv = "chainage_m,p_m,measured_m2,mean_m,sigma_m\n";
  for (const LayerBlock& block : result.layer.blocks)
    csv += row({csv_number(block.chainage_m, 3), csv_number(block.p_m, 3), csv_number(block.measured_m2, 3),
                csv_number(block.mean_m, 4), csv_number(block.sigma_m, 4)});
  return csv;
}

std::string clearance_csv_header() {
  return "line,line_offset_m,scan,chainage_m,station_m,offset_m,height_m,inside_m,east_m,north_m,elevation_m\n";
}

std::string clearance_csv_row(const ClearanceResult& clearance, const ClearancePoint& point, const std::string& scan,
                              const Eigen::Vector3d& site, double station_m) {
  return row({cell_word(clearance.line), csv_number(clearance.line_offset_m, 4), cell_word(scan),
              csv_number(point.at.s_m, 4), csv_number(station_m, 4), csv_number(point.at.x_m, 4),
              csv_number(point.at.z_m, 4), csv_number(point.inside_m, 4), csv_number(site.x(), 4),
              csv_number(site.y(), 4), csv_number(site.z(), 4)});
}

}  // namespace adit::io
