#include "core/profiling/reason_zones.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

bool is_whole(const ReasonZone& zone) {
  return zone.from_deg <= -180.0 && zone.to_deg >= 180.0;
}

/// The zone as stretches of degrees that do not pass straight down.
std::vector<std::pair<double, double>> spans(const ReasonZone& zone) {
  if (zone.to_deg > zone.from_deg) return {{zone.from_deg, zone.to_deg}};
  return {{zone.from_deg, 180.0}, {-180.0, zone.to_deg}};
}

bool overlap(const ReasonZone& a, const ReasonZone& b) {
  constexpr double nothing = 1e-9;
  if (std::min(a.to_m, b.to_m) - std::max(a.from_m, b.from_m) <= nothing) return false;
  for (const auto& [a0, a1] : spans(a))
    for (const auto& [b0, b1] : spans(b))
      if (std::min(a1, b1) - std::max(a0, b0) > nothing) return true;
  return false;
}

}  // namespace

const std::vector<std::string>& reason_codes() {
  static const std::vector<std::string> codes{"technical", "geological", "look_out", "other"};
  return codes;
}

void check_zones(const std::vector<ReasonZone>& zones) {
  for (std::size_t i = 0; i < zones.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(zones[i], zones[j]))
        throw Error("zones " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
                        " overlap: what lies in both would count twice",
                    {}, "let one begin where the other ends");
}

std::vector<ZoneVolume> zone_volumes(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line,
                                     const std::vector<ReasonZone>& zones, double gap_m) {
  std::vector<ZoneVolume> volumes;
  for (const ReasonZone& zone : zones) {
    ZoneVolume volume{zone, {}};
    const double from_m = std::max(zone.from_m, map.from_m), to_m = std::min(zone.to_m, map.to_m);
    if (to_m > from_m) {
      std::vector<Sector> sectors{{zone.reason, zone.from_deg, zone.to_deg}};
      if (!is_whole(zone)) sectors.push_back({"rest", zone.to_deg, zone.from_deg});
      volume.zone.from_m = from_m;
      volume.zone.to_m = to_m;
      volume.amounts = sector_volumes(map, design, line, sectors, from_m, to_m, gap_m).front();
    }
    volume.amounts.name = zone.reason;
    volumes.push_back(std::move(volume));
  }
  return volumes;
}

}  // namespace adit
