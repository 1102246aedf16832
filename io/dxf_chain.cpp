#include "io/dxf_chain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace adit::io {

std::vector<ProfileSegment> reversed(const std::vector<ProfileSegment>& segments) {
  std::vector<ProfileSegment> back;
  for (auto s = segments.rbegin(); s != segments.rend(); ++s) back.push_back({s->end, s->start, -s->bulge});
  return back;
}

namespace {

constexpr double join_m = 1e-3;
constexpr double shortest_m = 1e-4;

/// Start (0) or end (1) of an entity.
struct End {
  std::size_t line;
  int side;
  bool operator==(const End&) const = default;
};

Eigen::Vector2d position(const std::vector<DxfLine>& lines, const End& end) {
  const auto& segments = lines[end.line].segments;
  return end.side == 0 ? segments.front().start : segments.back().end;
}

/// Finds ends near a place through cells of one millimetre.
class EndGrid {
 public:
  explicit EndGrid(const std::vector<DxfLine>& lines) : lines_(lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const int side : {0, 1}) cells_[cell(position(lines, {i, side}))].push_back({i, side});
    }
  }

  /// Other ends of the same layer within a millimetre.
  std::vector<End> meeting(const End& end) const {
    const Eigen::Vector2d place = position(lines_, end);
    const Cell centre = cell(place);
    std::vector<End> found;
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto there = cells_.find({centre.first + dx, centre.second + dy});
        if (there == cells_.end()) continue;
        for (const End& other : there->second) {
          if (other == end || lines_[other.line].layer != lines_[end.line].layer) continue;
          if ((position(lines_, other) - place).norm() <= join_m) found.push_back(other);
        }
      }
    }
    return found;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static Cell cell(const Eigen::Vector2d& place) {
    const auto index = [](double value) {
      return static_cast<std::int64_t>(std::floor(std::clamp(value / join_m, -1e15, 1e15)));
    };
    return {index(place.x()), index(place.y())};
  }

  const std::vector<DxfLine>& lines_;
  std::map<Cell, std::vector<End>> cells_;
};

bool closes(const DxfLine& line) {
  return line.segments.size() > 1 && (line.segments.back().end - line.segments.front().start).norm() <= join_m;
}

double size_of(const DxfLine& line) {
  double size = 0.0;
  for (const ProfileSegment& s : line.segments) size += (s.end - s.start).norm();
  return size;
}

/// Walks over joints of exactly two ends.
class Chainer {
 public:
  explicit Chainer(const std::vector<DxfLine>& loose) : lines_(loose), grid_(lines_), used_(lines_.size(), false) {}

  DxfChains chains() {
    // Chains begin at free ends first, so that each open one is walked from end to end; what is left runs in circles.
    for (const bool free_only : {true, false}) {
      for (std::size_t i = 0; i < lines_.size(); ++i) {
        for (const int side : {0, 1}) {
          if (!used_[i] && (!free_only || next({i, side}) == nullptr)) walk({i, side});
        }
      }
    }
    return std::move(result_);
  }

 private:
  /// The only other end at a joint; none at a free end or a branch.
  const End* next(const End& end) {
    meeting_ = grid_.meeting(end);
    if (meeting_.size() > 1 && !result_.branch) result_.branch = position(lines_, end);
    return meeting_.size() == 1 ? &meeting_.front() : nullptr;
  }

  void walk(End entry) {
    DxfLine chain{lines_[entry.line].layer, {}, false, {}, 0, 0};
    while (true) {
      used_[entry.line] = true;
      const auto& segments = lines_[entry.line].segments;
      const auto ordered = entry.side == 0 ? segments : reversed(segments);
      chain.segments.insert(chain.segments.end(), ordered.begin(), ordered.end());
      std::vector<double> heights = lines_[entry.line].heights;
      if (entry.side == 1) std::reverse(heights.begin(), heights.end());
      const bool first = chain.heights.empty();
      chain.heights.insert(chain.heights.end(), heights.begin() + (first || heights.empty() ? 0 : 1), heights.end());
      chain.directed += lines_[entry.line].directed;
      chain.reversed += entry.side * lines_[entry.line].directed;
      const End* follower = next({entry.line, 1 - entry.side});
      if (follower == nullptr || used_[follower->line]) break;
      entry = *follower;
    }
    chain.closed = closes(chain);
    (chain.closed ? result_.closed : result_.open).push_back(std::move(chain));
  }

  std::vector<DxfLine> lines_;
  EndGrid grid_;
  std::vector<bool> used_;
  std::vector<End> meeting_;
  DxfChains result_;
};

}  // namespace

DxfChains chained(const std::vector<DxfLine>& lines) {
  std::vector<DxfLine> closed;
  std::vector<DxfLine> loose;
  for (const DxfLine& line : lines) {
    if (size_of(line) < shortest_m) continue;
    (line.closed || closes(line) ? closed : loose).push_back(line);
  }
  DxfChains chains = Chainer(loose).chains();
  chains.closed.insert(chains.closed.begin(), closed.begin(), closed.end());
  return chains;
}

}  // namespace adit::io
