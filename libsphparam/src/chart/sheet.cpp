#include "chart/sheet.h"

#include <algorithm>
#include <cmath>

#include "sphere/planar_orientation.h"

// A vertex is taken out by collapsing an edge into its other end. Two faces vanish; their
// half-edges keep their twins, to be joined to them again. What must be left is a closed
// triangulation without double edges: the ends of the edge have two neighbours in common, its
// apexes, which keep three spokes each. And the seam must stay a path of edges from pole to pole,
// with no other edge between its vertices.

namespace sphparam {
namespace {

constexpr int most_spokes = 512;

/// A face at ±z, seen from there: the corners of its link edge.
struct Trapezoid {
  explicit Trapezoid(const SheetFace& face)
      : next(static_cast<size_t>(face.pole + 1) % 3),
        previous(static_cast<size_t>(face.pole + 2) % 3),
        north(face.north),
        begin(face.corners[next]),
        end(face.corners[previous]) {}

  double depth(const SheetPoint& p) const { return north ? p.x : Sheet::cells - p.x; }
  double width() const { return north ? end.y - begin.y : begin.y - end.y; }

  size_t next, previous;
  bool north;
  SheetPoint begin, end;
};

std::array<SheetPoint, 3> trapezoid_gradient(const SheetFace& face) {
  std::array<SheetPoint, 3> gradient = {SheetPoint{0, 0}, SheetPoint{0, 0}, SheetPoint{0, 0}};
  const Trapezoid it(face);
  const double sign = it.north ? 1 : -1, begin = it.depth(it.begin), end = it.depth(it.end);
  if (it.width() <= std::min(begin, end)) {
    gradient[it.next].y = -sign;
    gradient[it.previous].y = sign;
  } else {
    gradient[begin < end ? it.next : it.previous].x = sign;
  }
  return gradient;
}

}  // namespace

double SheetFace::height() const {
  if (pole >= 0) {
    const Trapezoid it(*this);
    return std::min({it.width(), it.depth(it.begin), it.depth(it.end)});
  }
  const auto& [a, b, c] = corners;
  const double longest = std::max({square(b - a), square(c - b), square(a - c)});
  return longest > 0 ? cross(b - a, c - a) / std::sqrt(longest) : 0;
}

Sheet::Sheet(const SphericalChart& chart, int threads)
    : HalfedgeLinks(static_cast<int>(chart.triangles.size())),
      outgoing_(static_cast<size_t>(chart.points.rows())),
      places_(outgoing_.size()),
      in_west_(static_cast<size_t>(chart.triangles.rows()), 0),
      is_out_(in_west_.size(), 0),
      on_seam_(outgoing_.size(), 0),
      north_(chart.north),
      south_(chart.south),
      marks_(outgoing_.size(), 0) {
  const Topology topology(chart.triangles, vertex_count(), threads);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const auto v = static_cast<size_t>(topology.origin(h));
    link_as(topology, h);
    outgoing_[v] = h;
    const auto uv = chart.uv.row(chart.wedges(Topology::face(h), Topology::corner(h)));
    if (is_pole(topology.origin(h))) continue;
    if (uv[0] == 1) west(h) = 1;
    on_seam_[v] = uv[0] == 0 || uv[0] == 1;
    places_[v] = {cells * uv[1], on_seam_[v] ? 0 : cells * uv[0]};
  }
}

bool Sheet::is_hub(Vertex v) const {
  int spokes = 0;
  for (Halfedge h = outgoing(v); ++spokes <= most_spokes;) {
    h = rotate_ccw(h);
    if (h == outgoing(v)) return false;
  }
  return true;
}

bool Sheet::allows(Vertex v, const SheetPoint& p) const {
  const auto inside = [](double x) { return x > 0 && x < cells; };
  return inside(p.x) && (on_seam(v) ? p.y == 0 : inside(p.y));
}

SheetPoint Sheet::corner(Halfedge h) const {
  const Vertex v = origin(h);
  const bool in_west = in_west_[static_cast<size_t>(Topology::face(h))] != 0;
  return on_seam(v) && in_west ? SheetPoint{place(v).x, cells} : place(v);
}

SheetPoint Sheet::towards(Halfedge h) const {
  if (target(h) == north_) return {-1, 0};
  if (target(h) == south_) return {1, 0};
  return corner(Topology::next(h)) - corner(h);
}

int Sheet::pole_corner(Face f) const {
  for (int k = 0; k < 3; ++k) {
    if (is_pole(origin(3 * f + k))) return k;
  }
  return -1;
}

SheetFace Sheet::face(Face f) const {
  SheetFace face{.corners = {}, .pole = pole_corner(f)};
  face.north = face.pole >= 0 && origin(3 * f + face.pole) == north_;
  for (int k = 0; k < 3; ++k) face.corners[static_cast<size_t>(k)] = corner(3 * f + k);
  return face;
}

std::array<SheetPoint, 3> Sheet::height_gradient(Face f) const {
  const SheetFace face = this->face(f);
  if (face.pole >= 0) return trapezoid_gradient(face);
  std::array<SheetPoint, 3> edges;  // opposite to each corner
  for (size_t k = 0; k < 3; ++k) edges[k] = face.corners[(k + 2) % 3] - face.corners[(k + 1) % 3];
  size_t longest = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (square(edges[k]) > square(edges[longest])) longest = k;
  }
  const double length = std::sqrt(square(edges[longest]));
  std::array<SheetPoint, 3> gradient = {SheetPoint{0, 0}, SheetPoint{0, 0}, SheetPoint{0, 0}};
  if (length == 0) return gradient;
  // h = D / l, D twice the area: ∇h = (∇D − h ∇l) / l, where ∇D is the edge opposite, turned.
  for (size_t k = 0; k < 3; ++k) gradient[k] = {-edges[k].y / length, edges[k].x / length};
  const double by_length = cross(edges[0], edges[1]) / (length * length * length);
  SheetPoint &begin = gradient[(longest + 1) % 3], &end = gradient[(longest + 2) % 3];
  begin = {begin.x + by_length * edges[longest].x, begin.y + by_length * edges[longest].y};
  end = {end.x - by_length * edges[longest].x, end.y - by_length * edges[longest].y};
  return gradient;
}

bool Sheet::positive(Face f) const {
  if (pole_corner(f) >= 0) return height(f) > 0;
  const auto point = [&](Halfedge h) {
    const SheetPoint p = corner(h);
    return ChartPoint{p.y, p.x};
  };
  return planar_orientation(point(3 * f), point(3 * f + 1), point(3 * f + 2)) > 0;
}

double Sheet::lowest_around(Vertex v) const {
  double lowest = cells;
  for_each_spoke(v, [&](Halfedge h) { lowest = std::min(lowest, height(Topology::face(h))); });
  return lowest;
}

void Sheet::mark_neighbours(Vertex v) {
  ++mark_;
  for_each_spoke(v, [&](Halfedge h) { marks_[static_cast<size_t>(target(h))] = mark_; });
}

bool Sheet::has_two_common_neighbours(Halfedge h) {
  mark_neighbours(origin(h));
  int common = 0;
  for_each_spoke(target(h), [&](Halfedge spoke) {
    common += marks_[static_cast<size_t>(target(spoke))] == mark_;
  });
  return common == 2;
}

bool Sheet::has_three_spokes(Halfedge h) const {
  return rotate_ccw(rotate_ccw(rotate_ccw(h))) == h;
}

bool Sheet::seam_allows(Halfedge h) {
  const Vertex to = target(h);
  if (on_seam(origin(h))) return on_seam(to) && west(h) != west(twin(h));
  if (!on_seam(to)) return true;
  bool alone = true;
  for_each_spoke(origin(h), [&](Halfedge spoke) {
    const Vertex end = target(spoke);
    if (on_seam(end) && end != to && end != apex(h) && end != apex(twin(h))) alone = false;
  });
  return alone;
}

bool Sheet::may_take_out(Halfedge h) {
  for (const Vertex v : {origin(h), target(h)}) {
    if (is_pole(v) || is_hub(v)) return false;
  }
  return seam_allows(h) && has_two_common_neighbours(h) &&
         !has_three_spokes(Topology::previous(h)) && !has_three_spokes(Topology::previous(twin(h)));
}

void Sheet::take_out(Halfedge h) {
  const Vertex v = origin(h), to = target(h);
  const bool joins_seam = on_seam(to) && !on_seam(v);
  const char side = west(h);
  Taken taken{v, h, {}, {}};
  Halfedge spoke = h;
  do {
    taken.spokes.push_back(spoke);
    taken.in_west.push_back(west(spoke));
    if (joins_seam) west(spoke) = side;
    spoke = rotate_ccw(spoke);
  } while (spoke != h);
  for (const Halfedge s : taken.spokes) set_origin(s, to);
  for (const Halfedge gone : {h, twin(h)}) {
    const Halfedge next = twin(Topology::next(gone)), previous = twin(Topology::previous(gone));
    join(next, previous);
    is_out_[static_cast<size_t>(Topology::face(gone))] = 1;
    for (const Halfedge left : {next, previous})
      outgoing_[static_cast<size_t>(origin(left))] = left;
  }
  taken_.push_back(std::move(taken));
}

Halfedge Sheet::put_back() {
  const Taken taken = std::move(taken_.back());
  taken_.pop_back();
  const Halfedge h = taken.halfedge;
  for (size_t i = 0; i < taken.spokes.size(); ++i) {
    set_origin(taken.spokes[i], taken.vertex);
    west(taken.spokes[i]) = taken.in_west[i];
  }
  for (const Halfedge side : {h, twin(h)}) {
    const Halfedge next = Topology::next(side), previous = Topology::previous(side);
    join(next, twin(next));
    join(previous, twin(previous));
    is_out_[static_cast<size_t>(Topology::face(side))] = 0;
    outgoing_[static_cast<size_t>(origin(side))] = side;
    outgoing_[static_cast<size_t>(apex(side))] = previous;
  }
  move(taken.vertex, on_seam(taken.vertex) ? place(target(h)) : corner(Topology::next(h)));
  return h;
}

}  // namespace sphparam
