#include "core/registration/slope_likeness.h"

#include <cmath>

#include "core/foundation/parallel.h"
#include "core/registration/surface_match.h"

namespace adit {
namespace {

constexpr double middle = static_cast<double>(SlopesAlong::count) / 2.0;

std::size_t stretch_of(double along_m) {
  const double stretch = std::floor(along_m / SlopesAlong::length_m + middle);
  return static_cast<std::size_t>(std::clamp(stretch, 0.0, static_cast<double>(SlopesAlong::count - 1)));
}

}  // namespace

Slopes& Slopes::operator+=(const Slopes& other) {
  pieces += other.pieces;
  source += other.source;
  common += other.common;
  return *this;
}

Slopes& Slopes::operator-=(const Slopes& other) {
  pieces -= other.pieces;
  source -= other.source;
  common -= other.common;
  return *this;
}

double SlopesAlong::begin_m(std::size_t stretch) {
  return (static_cast<double>(stretch) - middle) * length_m;
}

Slopes SlopesAlong::all() const {
  return of(0, count);
}

Slopes SlopesAlong::of(std::size_t first, std::size_t many) const {
  Slopes sum;
  for (std::size_t i = first; i < std::min(count, first + many); ++i) sum += stretches[i];
  return sum;
}

SlopesAlong& SlopesAlong::operator+=(const SlopesAlong& other) {
  for (std::size_t i = 0; i < count; ++i) stretches[i] += other.stretches[i];
  return *this;
}

SlopesAlong slopes_along(const SurfaceMap& target, const SurfaceMap& source, const Pose& target_from_source,
                         const Eigen::Vector3d& axis, double near_m, std::size_t enough) {
  const std::vector<SurfacePiece>& pieces = source.pieces();
  const std::size_t step = pieces.size() / enough + 1;
  const std::size_t count = (pieces.size() + step - 1) / step;
  const bool from_origins = target.seen_from_origin() && source.seen_from_origin();
  return parallel_ordered_sum(count, 1024, SlopesAlong{}, [&](std::size_t begin, std::size_t end) {
    SlopesAlong sums;
    for (std::size_t i = begin; i < end; ++i) {
      const SurfacePiece& piece = pieces[i * step];
      const Meeting meeting = meeting_of(target, piece, target_from_source, from_origins);
      if (!meeting.near) continue;
      const double along_m = axis.dot(target_from_source * piece.place.cast<double>());
      const double slope = axis.dot(target_from_source.linear() * piece.normal.cast<double>());
      Slopes& sum = sums.stretches[stretch_of(along_m)];
      sum.pieces += 1.0;
      sum.source += slope * slope;
      if (!meeting.match) continue;
      const double half_sum = axis.dot(meeting.match->normal);
      const double half_difference = axis.dot(meeting.match->normal_error);
      const double off = meeting.match->residual_m / near_m;
      const double weight = std::max(0.0, 1.0 - off * off);
      sum.common += weight * (half_sum * half_sum - half_difference * half_difference);
    }
    return sums;
  });
}

}  // namespace adit
