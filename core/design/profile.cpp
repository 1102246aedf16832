#include "core/design/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/design/profile_checks.h"
#include "core/foundation/angle.h"
#include "core/foundation/error.h"

namespace adit {
namespace {

constexpr double as_high_m = 1e-6;
constexpr double corner_rad = 0.1 * pi / 180.0;

std::vector<ProfileSegment> reversed(const std::vector<ProfileSegment>& ring) {
  std::vector<ProfileSegment> back;
  for (auto s = ring.rbegin(); s != ring.rend(); ++s) back.push_back({s->end, s->start, -s->bulge});
  return back;
}

struct Place {
  std::size_t segment;
  double along_m;
  Eigen::Vector2d position;
};

/// Where a piece could be highest: its ends, the top of an arch, the place of a flat roof nearest to x = 0.
std::vector<Place> high_places(const ProfilePiece& piece, std::size_t segment) {
  std::vector<double> alongs{-piece.half_length_m, piece.half_length_m};
  if (piece.is_arc()) {
    const double top = std::atan2(piece.tangent.y(), piece.radial.y());
    if (std::abs(top) < piece.half_sweep_rad) alongs.push_back(top * piece.radius_m);
  } else if (std::abs(piece.end.y() - piece.start.y()) < as_high_m) {
    const double along = -piece.middle.x() / piece.tangent.x();
    if (std::abs(along) < piece.half_length_m) alongs.push_back(along);
  }
  std::vector<Place> places;
  for (const double along : alongs) places.push_back({segment, along, piece.position(along)});
  return places;
}

Place crown(const std::vector<ProfileSegment>& ring) {
  std::vector<Place> places;
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (const Place& place : high_places(ProfilePiece(ring[i]), i)) {
      places.push_back(place);
      top = std::max(top, place.position.y());
    }
  }
  std::erase_if(places, [top](const Place& place) { return place.position.y() < top - as_high_m; });
  return *std::min_element(places.begin(), places.end(), [](const Place& a, const Place& b) {
    const double further = std::abs(a.position.x()) - std::abs(b.position.x());
    if (std::abs(further) > as_high_m) return further < 0.0;
    return a.position.x() > b.position.x() + as_high_m;
  });
}

std::vector<ProfileSegment> from_crown(const std::vector<ProfileSegment>& ring) {
  const Place top = crown(ring);
  const ProfilePiece piece(ring[top.segment]);
  const double half = piece.half_length_m;
  const bool at_start = top.along_m < -half + as_high_m;
  const bool split = !at_start && top.along_m <= half - as_high_m;
  std::vector<ProfileSegment> turned;
  if (split) turned.push_back(piece.part(top.along_m, half));
  const std::size_t first = at_start ? 0 : 1;
  for (std::size_t i = 0; i < ring.size(); ++i) turned.push_back(ring[(top.segment + first + i) % ring.size()]);
  if (split) turned.back() = piece.part(-half, top.along_m);
  return turned;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Profile::Profile(std::string name, std::vector<ProfileSegment> segments) : name_(std::move(name)) {
  try {
    segments_ = checked_ring(segments);
  } catch (const Error& error) {
    throw error.at(name_.empty() ? "profile" : "profile " + name_);
  }
  const double area = signed_area_m2(segments_);
  if (area > 0.0) segments_ = reversed(segments_);
  area_m2_ = std::abs(area);
  segments_ = from_crown(segments_);
  lay_pieces();
  lay_corners();
}

void Profile::lay_pieces() {
  constexpr std::size_t group_size = 8;
  for (const ProfileSegment& segment : segments_) {
    ProfilePiece piece(segment);
    piece.first_p_m = length_m_;
    length_m_ += piece.length_m();
    box_.extend(piece.box());
    if (pieces_.size() % group_size == 0) groups_.push_back({{}, pieces_.size(), pieces_.size()});
    groups_.back().box.extend(piece.box());
    pieces_.push_back(piece);
    groups_.back().last = pieces_.size();
  }
}

void Profile::lay_corners() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const ProfilePiece& before = pieces_[(i + pieces_.size() - 1) % pieces_.size()];
    const ProfilePiece& behind = pieces_[i];
    ProfileCorner joint;
    joint.p_m = wrapped_p(behind.first_p_m);
    joint.position = behind.start;
    joint.normal_before = before.normal(before.half_length_m);
    joint.normal_after = behind.normal(-behind.half_length_m);
    joint.turn_rad =
        -std::atan2(cross(joint.normal_before, joint.normal_after), joint.normal_before.dot(joint.normal_after));
    joints_.push_back(joint);
    const bool turns = std::abs(joint.turn_rad) > corner_rad;
    corner_of_joint_.push_back(turns ? static_cast<int>(corners_.size()) : -1);
    if (turns) corners_.push_back(joint);
  }
}

double Profile::wrapped_p(double p_m) const {
  const double p = p_m - length_m_ * std::floor(p_m / length_m_ + 0.5);
  return p >= 0.5 * length_m_ ? -0.5 * length_m_ : p;
}

ProfilePoint Profile::at(double p_m) const {
  double p = wrapped_p(p_m);
  if (p < 0.0) p += length_m_;
  const auto behind = std::upper_bound(pieces_.begin() + 1, pieces_.end(), p,
                                       [](double value, const ProfilePiece& piece) { return value < piece.first_p_m; });
  const ProfilePiece& piece = *(behind - 1);
  const double along = p - piece.first_p_m - piece.half_length_m;
  return {wrapped_p(p), piece.position(along), piece.normal(along), piece.curvature_per_m()};
}

Polygon Profile::flattened(double tolerance_m) const {
  Polygon ring;
  for (const ProfilePiece& piece : pieces_) {
    int n = 1;
    if (piece.is_arc()) {
      const double step = 2.0 * std::acos(std::clamp(1.0 - tolerance_m / piece.radius_m, 0.0, 1.0));
      n = std::max(1, static_cast<int>(std::ceil(2.0 * piece.half_sweep_rad / std::max(step, 1e-6))));
    }
    ring.push_back(piece.start);
    for (int i = 1; i < n; ++i) ring.push_back(piece.position(piece.half_length_m * (2.0 * i / n - 1.0)));
  }
  return ring;
}

}  // namespace adit
