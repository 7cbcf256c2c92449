#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "mesh/box.h"
#include "mesh/face_sides.h"
#include "mesh/repair_state.h"

// Only what lies on boundaries is looked at: vertices of edges with one face. Where welding is
// asked for, each becomes one with the vertex of lowest id within the tolerance, unless a face has
// both; as those that stay are apart by more than the tolerance, nothing creeps. Then an edge with
// one face is split at the boundary vertices that lie within the tolerance of its interior
// (T-junctions); without a tolerance at those that lie on it but for rounding. Places are found by
// a grid of cells, whose size is that of a usual edge, so that a cell has few.

namespace sphparam {
namespace {

constexpr double rounding = 0x1p-50;  // of a place on an edge, in lengths of the unit box

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

  double cell() const { return cell_; }

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
  /// Boundaries without extent have cells so small that some have no whole number: what is as far
  /// as that shares its last one.
  Cell cell_of(const Vector3& p) const {
    constexpr double far = 0x1p62;
    Cell cell;
    for (int k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::clamp(std::floor(p[k] / cell_), -far, far));
    return cell;
  }

  double cell_;
  std::unordered_map<Cell, std::vector<Vertex>, CellHash> cells_;
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

double mean_length(const RepairState& state, const std::vector<FaceSide>& sides) {
  double sum = 0;
  for (const FaceSide& side : sides) sum += (state.shape[side.low] - state.shape[side.high]).norm();
  return sum / static_cast<double>(sides.size());
}

/// Of the box about the surface, as `shape` has it.
double diagonal(const RepairState& state) {
  Box box;
  for (const auto& face : state.faces) {
    for (const Vertex v : face) box.add(state.shape[v]);
  }
  return state.faces.empty() ? 0 : (box.upper - box.lower).norm();
}

class CrackCloser {
 public:
  CrackCloser(RepairState& state, double tolerance)
      : state_(state), sides_(boundary_sides(state)), tolerance_(tolerance) {}

  void weld() {
    if (sides_.empty()) return;
    find_faces_of_boundary();
    Grid staying(cell_size());
    for (const Vertex v : vertices_of(sides_)) {
      const std::optional<Vertex> onto = twin(v, staying);
      if (onto)
        merge(v, *onto);
      else
        staying.add(v, state_.shape[v]);
    }
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
    Grid grid(cell_size());
    for (const Vertex v : vertices_of(sides_)) grid.add(v, state_.shape[v]);
    std::vector<char> is_split(state_.faces.size(), 0);
    bool any = false;
    for (const FaceSide& side : sides_) {
      const Face f = side.halfedge / 3;
      if (is_split[f]) continue;
      const std::vector<Vertex> stops = on_side(side, grid);
      if (stops.empty()) continue;
      is_split[f] = any = true;
      split(side.halfedge, stops);
    }
    return any;
  }

  double cell_size() const {
    const double least = std::numeric_limits<float>::min();
    return std::max({2 * tolerance_, mean_length(state_, sides_), least});
  }

  void find_faces_of_boundary() {
    std::vector<char> on_boundary(state_.positions.size(), 0);
    for (const Vertex v : vertices_of(sides_)) on_boundary[v] = 1;
    for (Face f = 0; f < state_.face_count(); ++f) {
      for (const Vertex v : state_.faces[f])
        if (on_boundary[v]) faces_of_[v].push_back(f);
    }
  }

  /// The vertex of lowest id within the tolerance that no face has together with v.
  std::optional<Vertex> twin(Vertex v, const Grid& staying) const {
    std::optional<Vertex> found;
    staying.around(state_.shape[v], [&](Vertex other) {
      const double distance = (state_.shape[v] - state_.shape[other]).norm();
      if (distance > tolerance_ || (found && *found < other) || share_a_face(v, other)) return;
      found = other;
    });
    return found;
  }

  bool share_a_face(Vertex v, Vertex other) const {
    const std::vector<Face>& faces = faces_of_.at(v);
    return std::any_of(faces.begin(), faces.end(), [&](Face f) {
      const auto& corners = state_.faces[f];
      return std::find(corners.begin(), corners.end(), other) != corners.end();
    });
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
    const double near = std::max(tolerance_, rounding);
    const bool inside = t * length > near && (1 - t) * length > near;
    if (!inside || (to - t * edge).norm() > near) return std::nullopt;
    return t;
  }

  std::vector<Vertex> on_side(const FaceSide& side, const Grid& grid) const {
    const Vertex a = state_.corner(side.halfedge), b = a == side.low ? side.high : side.low;
    const auto& corners = state_.faces[side.halfedge / 3];
    std::map<double, Vertex> stops;
    const Vector3 edge = state_.shape[b] - state_.shape[a];
    const auto steps = static_cast<long>(edge.norm() / grid.cell()) + 1;
    for (long i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(steps);
      grid.around(state_.shape[a] + share * edge, [&](Vertex v) {
        if (std::find(corners.begin(), corners.end(), v) != corners.end()) return;
        if (const std::optional<double> t = place_on(a, b, v)) stops.try_emplace(*t, v);
      });
    }
    std::vector<Vertex> vertices;
    for (const auto& [t, v] : stops)
      if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
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

}  // namespace

void close_cracks(RepairState& state, const RepairOptions& options) {
  const bool welds = options.weld_share >= 0 || options.weld_length >= 0;
  const double tolerance = options.weld_length >= 0 ? options.weld_length / state.scale
                           : welds                  ? options.weld_share * diagonal(state)
                                                    : 0;
  CrackCloser closer(state, tolerance);
  if (welds) closer.weld();
  closer.split_at_vertices();
}

}  // namespace sphparam
