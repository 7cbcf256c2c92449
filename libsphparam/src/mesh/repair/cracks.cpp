#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "mesh/box.h"
#include "mesh/face_sides.h"
#include "mesh/repair/repair_state.h"

// Only what lies on boundaries is looked at: vertices of edges with one face. Where welding is
// asked for, each becomes one with the vertex of lowest id within the tolerance, unless a face has
// both, and is more than a needle that rounding made, as at the pole of a grid; as those that stay
// are apart by more than the tolerance, nothing creeps. Then an edge with
// one face is split at the boundary vertices that lie within the tolerance of its interior
// (T-junctions); without a tolerance at those that lie on it but for rounding. Without one
// vertices become one too where rounding alone keeps some of them apart, as on the seam and at the
// poles of a grid that was computed, and the surface is closed then; whether exact copies alone do
// is the reader's to say. What
// stays is found by a grid of cells of twice the tolerance, of which each has few; what lies along
// an edge by a tree of boxes, whatever the lengths of edges are, and however many vertices lie in
// one place.

namespace sphparam {
namespace {

constexpr double rounding = 0x1p-50;  // of a place on an edge, in lengths of the unit box

constexpr double needle = 0x1p-16;  // a side of a face that welding may close, in its longest side

constexpr double least_cell = 0x1p-60;  // whose numbers are whole ones in the box from −1 to 1

/// Boundary vertices by the cells of a grid.
class Grid {
 public:
  explicit Grid(double cell) : cell_(cell) {}

  void add(Vertex v, const Vector3& place) { cells_[cell_of(place)].push_back(v); }

  /// Calls visit(v) for all in the cell of this place and those around it.
  template <class Visit>
  void around(const Vector3& place, const Visit& visit) const {
    const Cell centre = cell_of(place);
    for (int i = 0; i < 27; ++i) {
      const auto found =
          cells_.find({centre[0] + i / 9 - 1, centre[1] + i / 3 % 3 - 1, centre[2] + i % 3 - 1});
      if (found == cells_.end()) continue;
      for (const Vertex v : found->second) visit(v);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  /// Each coordinate times a large odd number.
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 0;
      for (const std::int64_t i : cell)
        hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U, hash ^= hash >> 29;
      return hash;
    }
  };
  Cell cell_of(const Vector3& p) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(p[k] / cell_));
    return cell;
  }

  double cell_;
  std::unordered_map<Cell, std::vector<Vertex>, CellHash> cells_;
};

/// Vertices by their places, in halves of halves.
class PlaceTree {
 public:
  using Place = std::span<const Vertex>;  // all that are there, in ascending order

  PlaceTree(const std::vector<Vector3>& shape, std::vector<Vertex> vertices)
      : shape_(shape), vertices_(std::move(vertices)) {
    std::sort(vertices_.begin(), vertices_.end(), [&](Vertex a, Vertex b) {
      return std::tie(shape_[a].x(), shape_[a].y(), shape_[a].z(), a) <
             std::tie(shape_[b].x(), shape_[b].y(), shape_[b].z(), b);
    });
    for (size_t i = 0, j = 0; i < vertices_.size(); i = j) {
      while (j < vertices_.size() && shape_[vertices_[j]] == shape_[vertices_[i]]) ++j;
      places_.emplace_back(&vertices_[i], j - i);
    }
    if (!places_.empty()) grow(0, places_.size());
  }
  PlaceTree(const PlaceTree&) = delete;
  PlaceTree& operator=(const PlaceTree&) = delete;

  /// Calls visit(place) for all that are as near as this to the segment, and a few more.
  template <class Visit>
  void along(const Vector3& a, const Vector3& b, double near, const Visit& visit) const {
    std::vector<size_t> waiting;
    if (!nodes_.empty()) waiting.push_back(0);
    while (!waiting.empty()) {
      const size_t at = waiting.back();
      const Node& node = nodes_[at];
      waiting.pop_back();
      if (!meets(node.box, a, b, near)) continue;
      if (node.right > 0) {
        waiting.insert(waiting.end(), {node.right, at + 1});
      } else {
        for (size_t i = node.first; i < node.last; ++i) visit(places_[i]);
      }
    }
  }

 private:
  struct Node {
    Box box;
    size_t first, last;
    size_t right = 0;  // 0: a leaf; else its left half comes next
  };

  const Vector3& point(const Place& place) const { return shape_[place.front()]; }

  void grow(size_t first, size_t last) {
    constexpr size_t leaf = 8;
    const size_t at = nodes_.size(), middle = first + (last - first) / 2;
    nodes_.push_back({Box{}, first, last});
    Box& box = nodes_.back().box;
    for (size_t i = first; i < last; ++i) box.add(point(places_[i]));
    if (last - first <= leaf) return;
    Eigen::Index axis = 0;
    (box.upper - box.lower).maxCoeff(&axis);
    const auto begin = places_.begin();
    std::nth_element(
        begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
        begin + static_cast<std::ptrdiff_t>(last), [&](const Place& x, const Place& y) {
          return std::pair(point(x)[axis], x.front()) < std::pair(point(y)[axis], y.front());
        });
    grow(first, middle);
    nodes_[at].right = nodes_.size();
    grow(middle, last);
  }

  /// Whether a segment meets a box that is larger by `near` on all sides.
  static bool meets(const Box& box, const Vector3& a, const Vector3& b, double near) {
    double enters = 0, leaves = 1;
    for (int k = 0; k < 3; ++k) {
      const double lower = box.lower[k] - near, upper = box.upper[k] + near;
      const double along = b[k] - a[k];
      if (std::max(a[k], b[k]) < lower || std::min(a[k], b[k]) > upper) return false;
      if (std::abs(along) <= near) continue;
      const double first = (lower - a[k]) / along, last = (upper - a[k]) / along;
      enters = std::max(enters, std::min(first, last));
      leaves = std::min(leaves, std::max(first, last));
    }
    return enters <= leaves;
  }

  const std::vector<Vector3>& shape_;
  std::vector<Vertex> vertices_;
  std::vector<Place> places_;
  std::vector<Node> nodes_;
};

/// Sides with no face on the other side, by half-edge.
std::vector<FaceSide> boundary_sides(const RepairState& state) {
  const std::vector<FaceSide> sides = sorted_sides(state.triangles(), [](Face) { return true; });
  std::vector<FaceSide> boundary;
  for_each_edge(sides, [&](size_t i, size_t j) {
    if (j - i == 1) boundary.push_back(sides[i]);
  });
  std::sort(boundary.begin(), boundary.end(),
            [](const FaceSide& x, const FaceSide& y) { return x.halfedge < y.halfedge; });
  return boundary;
}

std::vector<Vertex> vertices_of(const std::vector<FaceSide>& sides) {
  std::vector<Vertex> vertices;
  for (const FaceSide& side : sides) vertices.insert(vertices.end(), {side.low, side.high});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

class CrackCloser {
 public:
  CrackCloser(RepairState& state, double tolerance)
      : state_(state), sides_(boundary_sides(state)), tolerance_(tolerance) {}

  /// Whether some vertices are not in one place, but as near as rounding has it.
  bool is_torn_by_rounding() const {
    Grid places(2 * rounding);
    for (const Vertex v : vertices_of(sides_)) {
      bool is_there = false, is_near = false;
      places.around(state_.shape[v], [&](Vertex other) {
        const double distance = (state_.shape[v] - state_.shape[other]).norm();
        (distance > 0 ? is_near : is_there) |= distance <= rounding;
      });
      if (is_near) return true;
      if (!is_there) places.add(v, state_.shape[v]);
    }
    return false;
  }

  bool is_closed() const { return sides_.empty(); }

  void weld() {
    if (sides_.empty()) return;
    find_faces_of_boundary();
    Grid staying(std::max(2 * tolerance_, least_cell));
    for (const Vertex v : vertices_of(sides_)) {
      const std::optional<Vertex> onto = twin(v, staying);
      if (onto)
        merge(v, *onto);
      else
        staying.add(v, state_.shape[v]);
    }
    remove_invalid_faces(state_);  // needles that are closed now
    sides_ = boundary_sides(state_);
  }

  void split_at_vertices() {
    constexpr int most_rounds = 16;  // a face is split along one side in each
    for (int round = 0; round < most_rounds && !sides_.empty(); ++round) {
      if (!split_once()) return;
      sides_ = boundary_sides(state_);
    }
  }

 private:
  bool split_once() {
    const PlaceTree tree(state_.shape, vertices_of(sides_));
    std::vector<char> is_split(state_.faces.size(), 0);
    bool any = false;
    for (const FaceSide& side : sides_) {
      const Face f = side.halfedge / 3;
      if (is_split[f]) continue;
      const std::vector<Vertex> stops = on_side(side, tree);
      if (stops.empty()) continue;
      is_split[f] = any = true;
      split(side.halfedge, stops);
    }
    return any;
  }

  /// As near as this to an edge is on it.
  double near() const { return std::max(tolerance_, rounding); }

  void find_faces_of_boundary() {
    std::vector<char> on_boundary(state_.positions.size(), 0);
    for (const Vertex v : vertices_of(sides_)) on_boundary[v] = 1;
    for (Face f = 0; f < state_.face_count(); ++f) {
      for (const Vertex v : state_.faces[f])
        if (on_boundary[v]) faces_of_[v].push_back(f);
    }
  }

  /// The vertex of lowest id within the tolerance that may become one with v.
  std::optional<Vertex> twin(Vertex v, const Grid& staying) const {
    std::optional<Vertex> found;
    staying.around(state_.shape[v], [&](Vertex other) {
      const double distance = (state_.shape[v] - state_.shape[other]).norm();
      if (distance > tolerance_ || (found && *found < other) || are_held_apart(v, other)) return;
      found = other;
    });
    return found;
  }

  /// By a face that has both, unless it would hardly notice.
  bool are_held_apart(Vertex v, Vertex other) const {
    const double apart = (state_.shape[v] - state_.shape[other]).norm();
    return std::ranges::any_of(faces_of_.at(v), [&](Face f) {
      const auto& corners = state_.faces[f];
      return std::ranges::find(corners, other) != corners.end() && apart > needle * longest_side(f);
    });
  }

  double longest_side(Face f) const {
    const auto& [a, b, c] = state_.faces[f];
    const Vector3 &p = state_.shape[a], &q = state_.shape[b], &r = state_.shape[c];
    return std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
  }

  void merge(Vertex v, Vertex onto) {
    state_.log(RepairKind::VertexWelded, {state_.vertex_origin[v]});
    std::vector<Face> faces = std::move(faces_of_.at(v));
    for (const Face f : faces)
      std::replace(state_.faces[f].begin(), state_.faces[f].end(), v, onto);
    std::vector<Face>& all = faces_of_.at(onto);
    all.insert(all.end(), faces.begin(), faces.end());
  }

  /// How far along a side a vertex lies, from 0 to 1.
  double share_along(Vertex a, Vertex b, Vertex v) const {
    const Vector3 edge = state_.shape[b] - state_.shape[a], to = state_.shape[v] - state_.shape[a];
    return std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  }

  /// Where on a side a vertex lies, from 0 to 1 the way its face runs; nothing where it does not.
  std::optional<double> place_on(Vertex a, Vertex b, Vertex v) const {
    const Vector3 edge = state_.shape[b] - state_.shape[a], to = state_.shape[v] - state_.shape[a];
    const double length = edge.norm();
    if (!(length > 0)) return std::nullopt;
    const double t = to.dot(edge) / (length * length);
    const bool inside = t * length > near() && (1 - t) * length > near();
    if (!inside || (to - t * edge).norm() > near()) return std::nullopt;
    return t;
  }

  /// The vertices on a side in the order of its face: of one place that with the lowest number, of
  /// places side by side too.
  std::vector<Vertex> on_side(const FaceSide& side, const PlaceTree& tree) const {
    const Vertex a = state_.corner(side.halfedge), b = a == side.low ? side.high : side.low;
    const auto& corners = state_.faces[side.halfedge / 3];
    std::map<double, Vertex> stops;
    tree.along(state_.shape[a], state_.shape[b], 2 * near(), [&](const PlaceTree::Place& place) {
      const auto v = std::find_if(place.begin(), place.end(), [&](Vertex other) {
        return std::find(corners.begin(), corners.end(), other) == corners.end();
      });
      const std::optional<double> t = v == place.end() ? std::nullopt : place_on(a, b, *v);
      if (!t) return;
      const auto [stop, is_new] = stops.try_emplace(*t, *v);
      if (!is_new) stop->second = std::min(stop->second, *v);
    });
    std::vector<Vertex> vertices;
    for (const auto& [t, v] : stops) vertices.push_back(v);
    return vertices;
  }

  // The face a b c, with stops s t … between a and b, becomes a s c, s t c, …, t b c.
  void split(Halfedge h, const std::vector<Vertex>& stops) {
    const Face f = h / 3;
    const int k = h % 3;
    const std::array<Vertex, 3> face = state_.faces[f];
    const std::array<int, 3> like = state_.corner_origin[f];
    const Vertex a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
    const auto corner_like = [&](Vertex v) {
      return state_.blend(like[k], like[(k + 1) % 3], share_along(a, b, v));
    };
    for (std::size_t i = 0; i < stops.size(); ++i) {
      state_.log(RepairKind::EdgeSplitAtVertex, {state_.vertex_origin[stops[i]]});
      const bool last = i + 1 == stops.size();
      const Vertex end = last ? b : stops[i + 1];
      const int end_like = last ? like[(k + 1) % 3] : corner_like(end);
      state_.add_face({stops[i], end, c}, {corner_like(stops[i]), end_like, like[(k + 2) % 3]});
      state_.face_origin.back() = state_.face_origin[f];
    }
    state_.faces[f] = {a, stops.front(), c};
    state_.corner_origin[f] = {like[k], corner_like(stops.front()), like[(k + 2) % 3]};
  }

  RepairState& state_;
  std::vector<FaceSide> sides_;
  double tolerance_;  // in the unit box
  std::map<Vertex, std::vector<Face>> faces_of_;
};

/// Where that closes the surface; else nothing is done.
void weld_what_rounding_tears(RepairState& state) {
  if (!CrackCloser(state, rounding).is_torn_by_rounding()) return;
  RepairState welded = state;
  CrackCloser closer(welded, rounding);
  closer.weld();
  if (closer.is_closed()) state = std::move(welded);
}

}  // namespace

void close_cracks(RepairState& state, const RepairOptions& options) {
  const bool welds = options.weld_share >= 0 || options.weld_length >= 0;
  const double tolerance = options.weld_length >= 0 ? options.weld_length / state.scale
                           : welds                  ? options.weld_share * state.diagonal()
                                                    : 0;
  if (!welds) weld_what_rounding_tears(state);
  CrackCloser closer(state, tolerance);
  if (welds) closer.weld();
  closer.split_at_vertices();
}

}  // namespace sphparam
