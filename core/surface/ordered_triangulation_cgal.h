#pragma once
// The Delaunay triangulation under the advancing front, with an order that follows its making alone. CGAL's own orders
// vertices, cells and equal candidates of the front by their addresses, which differ from run to run with what the
// memory held before: the same points then give another surface now and then.
//
// Only for the .cpp files that call CGAL.

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace adit {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL compares and hashes handles of what is so stamped by the number of its making. The stamp begins anew with each
/// construction: CGAL's own classes hand the old one on through memory that no object lives in.
class Stamped {
 public:
  using Has_timestamp = CGAL::Tag_true;

  [[nodiscard]] std::size_t time_stamp() const { return stamp_; }
  void set_time_stamp(std::size_t stamp) { stamp_ = stamp; }

 private:
  std::size_t stamp_ = static_cast<std::size_t>(-1);  // CGAL's sign for "none yet"
};

/// A border edge that waits for the front, first by its value, then by the numbers of its two points. CGAL's pair of
/// value and address stands here with the names of its members.
template <typename Value, typename Edge>
struct WaitingEdge {
  Value first;
  Edge* second;
  std::pair<std::size_t, std::size_t> points;

  WaitingEdge(const Value& value, Edge* edge) : first(value), second(edge) {
    const auto& [cell, from, to] = edge->first.first;
    points = std::minmax({cell->vertex(from)->info(), cell->vertex(to)->info()});
  }

  friend bool operator<(const WaitingEdge& a, const WaitingEdge& b) {
    return std::tie(a.first, a.points) < std::tie(b.first, b.points);
  }
};

template <typename Base = CGAL::Advancing_front_surface_reconstruction_vertex_base_3<Kernel>>
class FrontVertex : public Base, public Stamped {
 public:
  template <typename Structure>
  struct Rebind_TDS {
    using Other = FrontVertex<typename Base::template Rebind_TDS<Structure>::Other>;
  };
  using Radius_ptr_type = WaitingEdge<typename Base::criteria, typename Base::IO_edge_type>;
  using Base::Base;
};

template <typename Base = CGAL::Advancing_front_surface_reconstruction_cell_base_3<Kernel>>
class FrontCell : public Base, public Stamped {
 public:
  template <typename Structure>
  struct Rebind_TDS {
    using Other = FrontCell<typename Base::template Rebind_TDS<Structure>::Other>;
  };
  using Base::Base;
};

using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<FrontVertex<>, FrontCell<>>>;

}  // namespace adit
