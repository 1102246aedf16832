#include "io/landxml_polyline.h"

#include <cmath>
#include <sstream>

#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr double same_place_m = 1e-3;

std::vector<Eigen::Vector2d> listed_points(const LandXmlNode& node, const std::string& name) {
  auto list = node.child("PntList2D");
  const std::size_t size = list ? 2 : 3;
  if (!list) list = node.child("PntList3D");
  if (!list) node.fail(name + " holds no list of points", "export it with its PntList2D or PntList3D");
  const std::vector<double> values = list->numbers(2 * size);
  if (values.size() % size != 0)
    list->fail(name + ": its list holds " + std::to_string(values.size()) + " numbers, which are no whole points",
               "write northing easting, with an elevation in a PntList3D");
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < values.size(); i += size)
    points.push_back(node.units().metres_per_unit * Eigen::Vector2d(values[i + 1], values[i]));
  for (const auto& [end, there] : {std::pair{"Start", points.front()}, {"End", points.back()}})
    if ((node.point_m(end) - there).norm() > same_place_m)
      node.fail(name + ": its list of points does not meet its " + end, "list all its points, both ends among them");
  return points;
}

std::vector<Eigen::Vector2d> chained_points(const LandXmlNode& node, const std::string& name) {
  std::vector<Eigen::Vector2d> points;
  std::istringstream words(node.content());
  for (std::string word; words >> word;) {
    const auto point = node.referenced_point_m(word);
    if (!point) node.fail(name + ": there is no CgPoint " + quoted_word(word), "export the points with the chain");
    points.push_back(*point);
  }
  if (points.size() < 2) node.fail(name + " names fewer than two points", "name its points in order");
  return points;
}

}  // namespace

std::vector<LandXmlElement> read_landxml_polyline(const LandXmlNode& node, const std::string& name) {
  const std::vector<Eigen::Vector2d> points =
      node.name() == "Chain" ? chained_points(node, name) : listed_points(node, name);
  std::vector<LandXmlElement> pieces;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d chord = points[i] - points[i - 1];
    if (chord.norm() < same_place_m) continue;
    LandXmlElement piece;
    piece.geometry = {HorizontalKind::line, name + ", piece " + std::to_string(i), points[i - 1],
                      std::atan2(chord.x(), chord.y()), chord.norm()};
    piece.stated_end = points[i];
    piece.place = node.place();
    piece.of_polyline = true;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace adit::io
