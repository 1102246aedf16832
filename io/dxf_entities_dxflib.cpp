#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/dxf_entities.h"

namespace adit::io {
namespace {

constexpr std::uint64_t largest_file_bytes = std::uint64_t{256} << 20;

std::optional<double> metres_per_unit(int insunits) {
  switch (insunits) {
    case 0:  // unitless
    case 6:
      return 1.0;
    case 1:
      return 0.0254;
    case 2:
      return 0.3048;
    case 4:
      return 0.001;
    case 5:
      return 0.01;
    case 14:
      return 0.1;
    case 21:
      return 1200.0 / 3937.0;
    default:
      return std::nullopt;
  }
}

/// Collects the entities of model and paper space as the library reports them.
class Collector : public DL_CreationAdapter {
 public:
  using DL_CreationAdapter::setVariableInt;

  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") insunits_ = value;
  }
  void addBlock(const DL_BlockData&) override { in_block_ = true; }
  void endBlock() override {
    finish_polyline();
    in_block_ = false;
  }
  void addLine(const DL_LineData& line) override {
    finish_polyline();
    add({{{line.x1, line.y1}, {line.x2, line.y2}, 0.0}}, false, {line.z1, line.z2});
  }
  void addArc(const DL_ArcData& arc) override {
    finish_polyline();
    double sweep = rad_from_deg(std::fmod(arc.angle2 - arc.angle1, 360.0));
    if (sweep <= 0.0) sweep += 2.0 * pi;
    add_arc({arc.cx, arc.cy}, arc.radius, rad_from_deg(arc.angle1), sweep, false, arc.cz);
  }
  void addCircle(const DL_CircleData& circle) override {
    finish_polyline();
    add_arc({circle.cx, circle.cy}, circle.radius, 0.0, 2.0 * pi, true, circle.cz);
  }
  void addPolyline(const DL_PolylineData& polyline) override {
    finish_polyline();
    constexpr int closed = 1, in_space = 8, mesh = 16, faces = 64;
    if ((polyline.flags & (mesh | faces)) != 0) return;
    polyline_open_ = true;
    polyline_closed_ = (polyline.flags & closed) != 0;
    polyline_mirrored_ = mirrored();
    polyline_layer_ = getAttributes().getLayer();
    polyline_height_ = (polyline.flags & in_space) != 0 ? 0.0 : polyline.elevation;
  }
  void addVertex(const DL_VertexData& vertex) override {
    if (polyline_open_) vertices_.push_back(vertex);
  }
  void endSequence() override { finish_polyline(); }
  void addEllipse(const DL_EllipseData&) override { skip("ELLIPSE"); }
  void addSpline(const DL_SplineData&) override { skip("SPLINE"); }
  void addInsert(const DL_InsertData&) override { skip("INSERT"); }

  int insunits() const { return insunits_; }
  DxfDrawing taken() {
    finish_polyline();
    return std::move(drawing_);
  }

 private:
  /// An entity drawn from behind: its plane's x axis runs to the left.
  bool mirrored() {
    const DL_Extrusion* plane = getExtrusion();
    return plane != nullptr && plane->getDirection()[2] < 0.0;
  }

  static void mirror(std::vector<ProfileSegment>& segments) {
    for (ProfileSegment& segment : segments) {
      segment.start.x() *= -1.0;
      segment.end.x() *= -1.0;
      segment.bulge *= -1.0;
    }
  }

  void skip(const std::string& kind) {
    finish_polyline();
    if (in_block_ || drawing_.unread.find(kind) != std::string::npos) return;
    drawing_.unread += (drawing_.unread.empty() ? "" : ", ") + kind;
  }

  void add(std::vector<ProfileSegment> segments, bool closed, std::vector<double> heights, int directed = 1) {
    if (!in_block_)
      drawing_.lines.push_back({getAttributes().getLayer(), std::move(segments), closed, std::move(heights), directed});
  }

  /// Two halves, so that a bulge says even a full circle.
  void add_arc(const Eigen::Vector2d& centre, double radius, double from_rad, double sweep_rad, bool closed,
               double height) {
    const auto place = [&](double turn) -> Eigen::Vector2d {
      return centre + radius * Eigen::Vector2d(std::cos(from_rad + turn), std::sin(from_rad + turn));
    };
    const double bulge = std::tan(sweep_rad / 8.0);
    const Eigen::Vector2d end = closed ? place(0.0) : place(sweep_rad);
    std::vector<ProfileSegment> halves{{place(0.0), place(0.5 * sweep_rad), bulge},
                                       {place(0.5 * sweep_rad), end, bulge}};
    if (mirrored()) mirror(halves);
    add(std::move(halves), closed, {height, height, height}, 0);
  }

  void finish_polyline() {
    if (!polyline_open_) return;
    std::vector<ProfileSegment> segments;
    std::vector<double> heights;
    const std::size_t n = vertices_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (i + 1 == n && !polyline_closed_) break;
      const DL_VertexData& a = vertices_[i];
      const DL_VertexData& b = vertices_[(i + 1) % n];
      segments.push_back({{a.x, a.y}, {b.x, b.y}, a.bulge});
      if (heights.empty()) heights.push_back(polyline_height_ != 0.0 ? polyline_height_ : a.z);
      heights.push_back(polyline_height_ != 0.0 ? polyline_height_ : b.z);
    }
    if (polyline_mirrored_) mirror(segments);
    if (!in_block_ && !segments.empty())
      drawing_.lines.push_back({polyline_layer_, std::move(segments), polyline_closed_, std::move(heights)});
    vertices_.clear();
    polyline_open_ = false;
  }

  DxfDrawing drawing_;
  int insunits_ = 0;
  bool in_block_ = false;
  bool polyline_open_ = false;
  bool polyline_closed_ = false;
  bool polyline_mirrored_ = false;
  std::string polyline_layer_;
  double polyline_height_ = 0.0;  ///< of all places of a flat one
  std::vector<DL_VertexData> vertices_;
};

std::string read_all(const std::filesystem::path& path) {
  const InputFile file(path);
  if (file.size() > largest_file_bytes) {
    throw Error("the drawing is larger than 256 MiB", file.name(), "save the profile alone");
  }
  return file.beginning(static_cast<std::size_t>(file.size()));
}

}  // namespace

DxfDrawing read_dxf_entities(const std::filesystem::path& file) {
  check_dxf_text(file);
  std::istringstream text(read_all(file));
  Collector collector;
  DL_Dxf library;
  library.in(text, &collector);
  const auto unit = metres_per_unit(collector.insunits());
  if (!unit) {
    throw Error("the drawing's unit ($INSUNITS " + std::to_string(collector.insunits()) + ") is not supported",
                file.string(), "use millimetres, centimetres, metres or feet");
  }
  DxfDrawing drawing = collector.taken();
  drawing.metres_per_unit = *unit;
  return drawing;
}

}  // namespace adit::io
