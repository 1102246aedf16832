#include "io/csv_tables.h"

#include <cmath>
#include <cstdio>

#include "core/foundation/angle.h"
#include "io/csv_cells.h"

namespace adit::io {
namespace {

void add_volume_row(std::string& csv, const std::string& what, const Volume& volume, const char* method,
                    const VolumeAmounts& amounts, bool has_sigma) {
  csv += what + "," + cell_word(volume.line) + "," + csv_number(volume.line_offset_m, 4) + "," +
         csv_number(volume.from_m, 3) + "," + csv_number(volume.to_m, 3) + "," + method + "," +
         csv_number(amounts.design_m3, 4) + "," + csv_number(amounts.excavated_m3, 4) + "," +
         csv_number(amounts.overbreak_m3, 4) + "," + csv_number(amounts.underbreak_m3, 4) + ",";
  csv += has_sigma ? csv_number(volume.sigma_excavated_m3, 4) + "," + csv_number(volume.sigma_overbreak_m3, 4) + "," +
                         csv_number(volume.sigma_underbreak_m3, 4)
                   : std::string(",,");
  csv += "," + csv_number(volume.coverage, 4) + "," + csv_number(volume.interpolated_m2, 3) + "," +
         csv_number(volume.unseen_m2, 3) + "," + csv_number(volume.opening_m2, 3) + "\n";
}

void add_volume(std::string& csv, const std::string& what, const Volume& volume) {
  add_volume_row(csv, what, volume, "slices", volume.slices, true);
  add_volume_row(csv, what, volume, "average_end_area", volume.average_end_area, false);
  add_volume_row(csv, what, volume, "prismoidal", volume.prismoidal, false);
  if (!volume.mesh.closed) return;
  VolumeAmounts mesh;
  mesh.design_m3 = mesh.overbreak_m3 = mesh.underbreak_m3 = std::nan("");
  mesh.excavated_m3 = volume.mesh.excavated_m3;
  add_volume_row(csv, what, volume, "mesh", mesh, false);
}

}  // namespace

std::string sections_csv(const Results& results) {
  std::string csv =
      "chainage_m,station_m,axis_east_m,axis_north_m,axis_elevation_m,line,line_offset_m,design_area_m2,area_m2,"
      "overbreak_m2,"
      "underbreak_m2,max_overbreak_m,max_overbreak_p_m,max_underbreak_m,max_underbreak_p_m,coverage,interpolated,openings,plane\n";
  if (!results.profile) return csv;
  const auto add = [&](const Section& section) {
    for (const SectionAreas& a : section.lines)
      csv += csv_number(section.chainage_m, 3) + "," + csv_number(section.station_m, 3) + "," +
             csv_number(section.axis_site.x(), 4) + "," + csv_number(section.axis_site.y(), 4) + "," +
             csv_number(section.axis_site.z(), 4) + "," + cell_word(a.line) + "," + csv_number(a.line_offset_m, 4) +
             "," + csv_number(a.design_area_m2, 4) + "," + csv_number(a.area_m2, 4) + "," +
             csv_number(a.overbreak_m2, 4) + "," + csv_number(a.underbreak_m2, 4) + "," +
             csv_number(a.max_overbreak_m, 4) + "," + csv_number(a.max_overbreak_p_m, 3) + "," +
             csv_number(a.max_underbreak_m, 4) + "," + csv_number(a.max_underbreak_p_m, 3) + "," +
             csv_number(a.coverage, 4) + "," + csv_number(a.interpolated, 4) + "," +
             std::to_string(section.openings.size()) +
             (section.plane == SectionPlane::vertical ? ",vertical\n" : ",square\n");
  };
  for (const Section& section : results.profile->sections) add(section);
  for (const Section& section : results.profile->square_sections) add(section);
  return csv;
}

std::string volumes_csv(const Results& results) {
  std::string csv =
      "stretch,line,line_offset_m,from_m,to_m,method,design_m3,excavated_m3,overbreak_m3,underbreak_m3,sigma_excavated_m3,"
      "sigma_overbreak_m3,sigma_underbreak_m3,coverage,interpolated_m2,unseen_m2,opening_m2\n";
  if (!results.volume) return csv;
  for (const Volume& volume : results.volume->lines) add_volume(csv, "total", volume);
  for (const RoundVolume& round : results.volume->rounds)
    add_volume(csv, "round " + std::to_string(round.number), round.volume);
  return csv;
}

std::string registration_csv(const Results& results) {
  std::string csv =
      "scan,placed_by,east_m,north_m,elevation_m,yaw_deg,pitch_deg,roll_deg,sigma_along_mm,sigma_across_mm,sigma_up_mm,"
      "sigma_roll_mdeg,sigma_pitch_mdeg,sigma_yaw_mdeg,undetermined\n";
  for (std::size_t i = 0; i < results.registration.scans.size(); ++i) {
    const PlacedScan& scan = results.registration.scans[i];
    if (!scan.placed) {
      csv += cell_word(scan.name) + ",not placed,,,,,,,,,,,,,\n";
      continue;
    }
    const Pose pose = site_from_scan(results, i);
    const YawPitchRoll turn = yaw_pitch_roll(pose);
    std::string weak;
    for (const auto& direction : scan.undetermined) weak += (weak.empty() ? "" : " ") + direction;
    csv += cell_word(scan.name) + "," + scan.placed_by + "," + csv_number(pose.translation().x(), 4) + "," +
           csv_number(pose.translation().y(), 4) + "," + csv_number(pose.translation().z(), 4) + "," +
           csv_number(deg_from_rad(turn.yaw_rad), 5) + "," + csv_number(deg_from_rad(turn.pitch_rad), 5) + "," +
           csv_number(deg_from_rad(turn.roll_rad), 5) + "," + csv_number(1e3 * scan.sigma.along_m, 2) + "," +
           csv_number(1e3 * scan.sigma.across_m, 2) + "," + csv_number(1e3 * scan.sigma.up_m, 2) + "," +
           csv_number(1e3 * deg_from_rad(scan.sigma.roll_rad), 2) + "," +
           csv_number(1e3 * deg_from_rad(scan.sigma.pitch_rad), 2) + "," +
           csv_number(1e3 * deg_from_rad(scan.sigma.yaw_rad), 2) + "," + weak + "\n";
  }
  return csv;
}

std::string sectors_csv(const Results& results) {
  std::string csv =
      "stretch,line,line_offset_m,from_m,to_m,sector,surface_m2,coverage,overbreak_m3,underbreak_m3,mean_overbreak_m,"
      "max_overbreak_m,max_overbreak_chainage_m,max_overbreak_clock_deg\n";
  if (!results.volume) return csv;
  const auto add = [&](const std::string& stretch, const Volume& volume) {
    for (const SectorVolume& s : volume.sectors) {
      const double surface_m2 = s.surface_m2 > 0.0 ? s.surface_m2 : 1.0;
      csv += stretch + "," + cell_word(volume.line) + "," + csv_number(volume.line_offset_m, 4) + "," +
             csv_number(volume.from_m, 3) + "," + csv_number(volume.to_m, 3) + "," + cell_word(s.name) + "," +
             csv_number(s.surface_m2, 3) + "," + csv_number(s.measured_m2 / surface_m2, 4) + "," +
             csv_number(s.overbreak_m3, 4) + "," + csv_number(s.underbreak_m3, 4) + "," +
             csv_number(s.overbreak_m3 / surface_m2, 4) + "," + csv_number(s.max_overbreak_m, 4) + ",";
      csv += s.max_overbreak_m > 0.0
                 ? csv_number(s.max_overbreak_chainage_m, 3) + "," + csv_number(s.max_overbreak_clock_deg, 1) + "\n"
                 : std::string(",\n");
    }
  };
  for (const Volume& volume : results.volume->lines) add("total", volume);
  for (const RoundVolume& round : results.volume->rounds) add("round " + std::to_string(round.number), round.volume);
  return csv;
}

std::string circles_csv(const Results& results) {
  std::string csv =
      "chainage_m,station_m,center_offset_m,center_height_m,horizontal_deviation_m,vertical_deviation_m,radius_m,"
      "design_radius_m,ovality_m,major_clock_deg,rms_m,covered_deg,"
      "sigma_center_m,sigma_radius_m\n";
  if (!results.profile) return csv;
  for (const Section& section : results.profile->sections) {
    const SectionCircle& c = section.circle;
    if (!c.there) continue;
    csv += csv_number(section.chainage_m, 3) + "," + csv_number(section.station_m, 3) + "," +
           csv_number(c.center.x(), 4) + "," + csv_number(c.center.y(), 4) + "," + csv_number(c.deviation_m.x(), 4) +
           "," + csv_number(c.deviation_m.y(), 4) + "," + csv_number(c.radius_m, 4) + "," +
           csv_number(c.design_radius_m, 4) + "," + csv_number(c.ovality_m, 4) + "," +
           csv_number(c.major_clock_deg, 1) + "," + csv_number(c.rms_m, 4) + "," + csv_number(c.covered_deg, 0) + "," +
           csv_number(c.sigma_center_m, 4) + "," + csv_number(c.sigma_radius_m, 4) + "\n";
  }
  return csv;
}

std::string rings_csv(const Results& results) {
  std::string csv =
      "ring,chainage_m,station_m,center_east_m,center_north_m,center_elevation_m,horizontal_deviation_m,"
      "vertical_deviation_m,radius_m,ovality_m,major_clock_deg,rms_m,sigma_center_m,sigma_radius_m,tilt_deg,points,"
      "design_radius_m,tolerance_m,verdict\n";
  if (!results.rings) return csv;
  const auto known = [](double value, int decimals) {
    return std::isfinite(value) ? csv_number(value, decimals) : std::string();
  };
  const RingDesign& design = results.rings->design;
  for (const RingResult& r : results.rings->rings)
    csv += cell_word(r.ring) + "," + csv_number(r.chainage_m, 4) + "," + csv_number(r.station_m, 4) + "," +
           csv_number(r.center.x(), 4) + "," + csv_number(r.center.y(), 4) + "," + csv_number(r.center.z(), 4) + "," +
           csv_number(r.horizontal_deviation_m, 4) + "," + csv_number(r.vertical_deviation_m, 4) + "," +
           csv_number(r.radius_m, 4) + "," + known(r.ovality_m, 4) + "," + known(r.major_clock_deg, 1) + "," +
           csv_number(r.rms_m, 4) + "," + known(r.sigma_center_m, 4) + "," + known(r.sigma_radius_m, 4) + "," +
           csv_number(r.tilt_deg, 2) + "," + std::to_string(r.residuals.size()) + "," +
           (design.radius_m > 0.0 ? csv_number(design.radius_m, 4) : "") + "," +
           (design.tolerance_m > 0.0 ? csv_number(design.tolerance_m, 4) + "," + words_of(r.verdict) : ",") + "\n";
  return csv;
}

}  // namespace adit::io
