#pragma once
// Profiles between two others, and profiles that cant turns.

#include "core/design/profile.h"

namespace adit {

/// The profile at a share of the way from one to another. Where both have the same lines and arcs in the same order
/// from the crown, corners and bulges are blended; else points at the same share of both lengths from the crown, every
/// 5 cm and at all corners, joined straight. Throws Error as Profile does.
Profile blended_profile(const Profile& from, const Profile& to, double share);

/// The profile turned by `turn_rad` clockwise (looking up-chainage) about the axis, and raised. Its crown is the point
/// that is highest then.
Profile turned_profile(const Profile& profile, double turn_rad, double rise_m);

/// Greatest distance between points at the same share of both lengths [m].
double blend_distance_m(const Profile& from, const Profile& to);

}  // namespace adit
