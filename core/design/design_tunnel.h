#pragma once
// The design: an axis, profiles along it and named lines.

#include <string>
#include <vector>

#include "core/design/alignment.h"
#include "core/design/profile.h"
#include "core/design/section_plane.h"

namespace adit {

/// A line parallel to the profile: every number of the results names its line. offset_m outwards positive.
struct DesignLine {
  std::string name = "excavation";
  double offset_m = 0.0;
  double growth_per_m = 0.0;  ///< look-out envelope: the offset grows by this with every metre of a round
  bool clearance = false;     ///< whatever lies inside it is listed
  bool operator==(const DesignLine&) const = default;
};

/// The rounds a tunnel is driven in, and whether chainage grows with them.
struct Drive {
  struct Round {
    double from_m = 0.0;
    double to_m = 0.0;
  };
  std::vector<Round> rounds;
  bool up_chainage = true;
};

/// A profile and the chainage it holds from: up to the next one, or, interpolated, changing evenly into it.
struct ProfileFrom {
  double from_m = 0.0;
  Profile profile;
  bool interpolated = false;
};

class DesignTunnel {
 public:
  DesignTunnel() = default;
  /// Interpolated stretches become profiles every 0.1 m, or where the profile has changed by a millimetre. Throws Error
  /// when there is no profile, no line, two lines of one name, profiles are not in order of chainage, or the last one
  /// is interpolated.
  /// `turned_by_cant`: every profile is turned and raised with the axis's cant (Cant::at), in steps of the same size.
  DesignTunnel(Alignment alignment, std::vector<ProfileFrom> profiles, std::vector<DesignLine> lines,
               bool turned_by_cant = false);

  const Alignment& alignment() const { return alignment_; }
  const std::vector<ProfileFrom>& profiles() const { return profiles_; }
  const std::vector<DesignLine>& lines() const { return lines_; }
  SectionPlane plane() const { return plane_; }
  /// The same design with its profiles standing in other planes.
  DesignTunnel standing(SectionPlane plane) const;
  /// A place of vertical sections in the planes of this design.
  TunnelPoint in_section(const TunnelPoint& vertical) const {
    return plane_ == SectionPlane::vertical ? vertical : square_from_vertical(alignment_, vertical);
  }
  /// By how much the chainage of a point may differ between vertical planes and those of this design, within a stretch.
  double lean_m(double from_m, double to_m) const;
  /// The place in the design's frame of a point of one of its sections.
  Eigen::Vector3d to_site(const TunnelPoint& in_section) const {
    return plane_ == SectionPlane::vertical ? alignment_.to_site(in_section) : site_of_square(alignment_, in_section);
  }
  SliceShape slice_shape(double chainage_m) const { return adit::slice_shape(alignment_, plane_, chainage_m); }
  const Drive& drive() const { return drive_; }
  /// The same design, driven in rounds: where lines with a growth begin to grow. Outside of rounds they do not.
  DesignTunnel driven(Drive drive) const;
  /// A line as it is at a chainage: its offset there, no growth.
  DesignLine line_at(const DesignLine& line, double chainage_m) const;
  /// The profile that holds at a chainage; the first one also holds before its own.
  const Profile& profile_at(double chainage_m) const;

  DesignTunnel relative_to(const Eigen::Vector3d& origin) const;

 private:
  Alignment alignment_;
  std::vector<ProfileFrom> profiles_;
  std::vector<DesignLine> lines_;
  Drive drive_;
  SectionPlane plane_ = SectionPlane::vertical;
};

}  // namespace adit
