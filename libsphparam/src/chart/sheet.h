#pragma once

#include <array>
#include <vector>

#include "chart/halfedge_links.h"
#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// A place in the (u, v) rectangle, in cells of the grid that texture coordinates settle on: x = v
/// and y = u, so that faces are counter-clockwise.
struct SheetPoint {
  double x, y;
};

inline SheetPoint operator-(const SheetPoint& a, const SheetPoint& b) {
  return {a.x - b.x, a.y - b.y};
}
inline double cross(const SheetPoint& a, const SheetPoint& b) { return a.x * b.y - a.y * b.x; }
inline double square(const SheetPoint& a) { return a.x * a.x + a.y * a.y; }

/// Where a face sees its corners. One that is a pole has no place: the face is a trapezoid.
struct SheetFace {
  std::array<SheetPoint, 3> corners;
  int pole = -1;  // which corner is at ±z; −1: none
  bool north = false;

  /// The least altitude; of a trapezoid, its width or a side. Not above 0: folded.
  double height() const;
};

/// The pieces of a chart as a triangulation whose vertices move in the plane, and are taken out one
/// by one and put back in the opposite order.
///
/// A vertex on the seam has y = 0 for faces in the east, y = `cells` for those in the west. A face
/// with a corner at ±z is the trapezoid over its link edge. Lengths are up to rounding.
class Sheet : public HalfedgeLinks {
 public:
  static constexpr double cells = 0x1p24;  // a turn of u, and of v

  /// Requires: `chart.certificate.closed`.
  explicit Sheet(const SphericalChart& chart, int threads = 0);

  int vertex_count() const { return static_cast<int>(places_.size()); }
  int face_count() const { return static_cast<int>(in_west_.size()); }
  Halfedge outgoing(Vertex v) const { return outgoing_[static_cast<size_t>(v)]; }
  bool is_pole(Vertex v) const { return v == north_ || v == south_; }
  bool on_seam(Vertex v) const { return on_seam_[static_cast<size_t>(v)] != 0; }
  /// Has a face vanished with a vertex taken out?
  bool is_out(Face f) const { return is_out_[static_cast<size_t>(f)] != 0; }
  /// More spokes than are looked at again and again: such vertices stay where they are.
  bool is_hub(Vertex v) const;

  /// Calls visit(h) for the half-edges that start at v.
  template <class Visit>
  void for_each_spoke(Vertex v, Visit&& visit) const {
    Halfedge h = outgoing(v);
    do {
      visit(h);
      h = rotate_ccw(h);
    } while (h != outgoing(v));
  }

  const SheetPoint& place(Vertex v) const { return places_[static_cast<size_t>(v)]; }
  void move(Vertex v, const SheetPoint& to) { places_[static_cast<size_t>(v)] = to; }
  /// May v be there: inside the rectangle, on the seam if it is one of the seam's?
  bool allows(Vertex v, const SheetPoint& p) const;
  /// Where its face sees the origin of h. Requires: not a pole.
  SheetPoint corner(Halfedge h) const;
  /// From the origin of h to its end, as its face sees both; to a pole, the direction.
  SheetPoint towards(Halfedge h) const;

  SheetFace face(Face f) const;
  /// As SheetFace has it.
  double height(Face f) const { return face(f).height(); }
  /// What the height changes by with the places of the corners.
  std::array<SheetPoint, 3> height_gradient(Face f) const;
  /// Is a face positive? Exact.
  bool positive(Face f) const;
  double lowest_around(Vertex v) const;

  /// May the origin of h be taken out, so that its faces go to the target?
  bool may_take_out(Halfedge h);
  void take_out(Halfedge h);
  bool any_out() const { return !taken_.empty(); }
  /// Puts the last vertex taken out back, at the target of the half-edge returned.
  Halfedge put_back();

 private:
  struct Taken {
    Vertex vertex;
    Halfedge halfedge;
    std::vector<Halfedge> spokes;  // whose origin it was, the half-edge first
    std::vector<char> in_west;     // whether their faces were
  };

  char& west(Halfedge h) { return in_west_[static_cast<size_t>(Topology::face(h))]; }
  int pole_corner(Face f) const;
  void mark_neighbours(Vertex v);
  bool has_two_common_neighbours(Halfedge h);
  bool seam_allows(Halfedge h);
  bool has_three_spokes(Halfedge h) const;

  std::vector<Halfedge> outgoing_;
  std::vector<SheetPoint> places_;
  std::vector<char> in_west_, is_out_;  // of faces
  std::vector<char> on_seam_;           // of vertices
  Vertex north_, south_;
  std::vector<Taken> taken_;
  std::vector<int> marks_;  // of vertices
  int mark_ = 0;
};

}  // namespace sphparam
