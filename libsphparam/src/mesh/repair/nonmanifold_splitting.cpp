#include <algorithm>
#include <cmath>

#include "mesh/face_sides.h"
#include "mesh/repair/paired_faces.h"
#include "mesh/repair/repair_state.h"
#include "mesh/union_find.h"

// Sides are joined edge by edge; corners beside joined sides are one fan. About an edge of several
// faces these are sorted by angle: where material begins (turning about the edge) a face opens,
// where it ends one closes, and they pair like parentheses, across the material: bodies that touch
// come apart. Across the air instead where that joins fewer fans, hence makes fewer handles, or
// just as many where one sheet is too many: an inner wall is left over. Each fan but a vertex's
// first gets a copy of it. Where two pairs still have the same two vertices, all but one get their
// other diagonal, or a vertex in the middle. A face that names a vertex twice, where these are not
// to be removed, is none of the surface: it stays as it is.

namespace sphparam {
namespace {

constexpr Halfedge none = -1;

bool names_three(const RepairState& state, Face f) {
  const auto& [a, b, c] = state.faces[f];
  return a != b && b != c && c != a;
}

std::vector<FaceSide> all_sides(const RepairState& state) {
  return sorted_sides(state.triangles(), [&](Face f) { return names_three(state, f); });
}

double signed_volume(const RepairState& state) {
  double volume = 0;
  for (const auto& [a, b, c] : state.faces) {
    volume += state.shape[a].dot(state.shape[b].cross(state.shape[c]));
  }
  return volume;
}

/// Grows with the angle of (x, y) from 0 to 4; rational, hence the same on every machine.
double diamond_angle(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (!(size > 0)) return 0;
  const double slope = y / size;
  return x >= 0 ? (y >= 0 ? slope : 4 + slope) : 2 - slope;
}

class SideJoiner {
 public:
  explicit SideJoiner(RepairState& state)
      : state_(state),
        inside_out_(signed_volume(state) < 0),
        twin_(state.faces.size() * 3, none),
        fans_(twin_.size()) {}

  /// Twins, and vertices split into their fans.
  std::vector<Halfedge> run(const std::vector<FaceSide>& sides) {
    for_each_edge(sides, [&](size_t i, size_t j) {
      if (j - i == 2) join({sides[i].halfedge, sides[i + 1].halfedge});
    });
    for_each_edge(sides, [&](size_t i, size_t j) {
      if (j - i <= 2) return;
      for (const Pair& pair : best_pairs(sorted_sheets(sides, i, j))) join(pair);
      state_.log(RepairKind::EdgeSplit,
                 {state_.vertex_origin[sides[i].low], state_.vertex_origin[sides[i].high]});
    });
    split_vertices();
    return std::move(twin_);
  }

 private:
  using Pair = std::array<Halfedge, 2>;
  struct Sheet {
    double angle;
    bool opens;
    Vertex apex;
    Halfedge halfedge;
  };

  /// The corners that are one when two sides are: at either end of the edge.
  std::array<Pair, 2> joined_corners(const Pair& pair) const {
    const auto [h, t] = pair;
    const Halfedge at_end = PairedFaces::next(h), beside = PairedFaces::next(t);
    const bool runs_alike = state_.corner(t) == state_.corner(h);
    return {Pair{h, runs_alike ? t : beside}, Pair{at_end, runs_alike ? beside : t}};
  }

  void join(const Pair& pair) {
    twin_[pair[0]] = pair[1];
    twin_[pair[1]] = pair[0];
    for (const auto& [one, other] : joined_corners(pair)) fans_.unite(one, other);
  }

  std::vector<Sheet> sorted_sheets(const std::vector<FaceSide>& sides, size_t i, size_t j) const {
    const Vector3& low = state_.shape[sides[i].low];
    const Vector3 along = state_.shape[sides[i].high] - low;
    Eigen::Index smallest = 0;
    along.cwiseAbs().minCoeff(&smallest);
    const Vector3 u = along.cross(Vector3::Unit(smallest)).normalized();
    const Vector3 v = along.cross(u).normalized();
    std::vector<Sheet> sheets;
    for (size_t s = i; s < j; ++s) {
      const Halfedge h = sides[s].halfedge;
      const Vertex apex = state_.corner(PairedFaces::previous(h));
      const Vector3 to_apex = state_.shape[apex] - low;
      sheets.push_back({diamond_angle(to_apex.dot(u), to_apex.dot(v)),
                        sides[s].forward == inside_out_, apex, h});
    }
    // At equal angles closing comes first: what meets there is not paired with itself.
    std::sort(sheets.begin(), sheets.end(), [](const Sheet& x, const Sheet& y) {
      return std::tie(x.angle, x.opens, x.halfedge) < std::tie(y.angle, y.opens, y.halfedge);
    });
    return sheets;
  }

  std::vector<Pair> best_pairs(std::vector<Sheet> sheets) {
    std::vector<Pair> through_material = pairs_through_flap(sheets);
    if (!through_material.empty()) return through_material;
    through_material = like_parentheses(sheets);
    std::reverse(sheets.begin(), sheets.end());
    std::vector<Pair> through_air = like_parentheses(sheets);
    const long opening =
        std::count_if(sheets.begin(), sheets.end(), [](const Sheet& s) { return s.opens; });
    const bool has_wall = 2 * opening != static_cast<long>(sheets.size());
    const long by_material = fans_joined(through_material), by_air = fans_joined(through_air);
    return by_air < by_material + has_wall ? through_air : through_material;
  }

  /// Two faces back to back and two others, one for each: the surface goes through the flap.
  static std::vector<Pair> pairs_through_flap(const std::vector<Sheet>& sheets) {
    if (sheets.size() != 4) return {};
    for (size_t i = 0; i < 4; ++i) {
      for (size_t j = i + 1; j < 4; ++j) {
        if (sheets[i].apex != sheets[j].apex || sheets[i].opens == sheets[j].opens) continue;
        size_t k = 0, l = 3;
        while (k == i || k == j) ++k;
        while (l == i || l == j) --l;
        if (sheets[k].opens == sheets[l].opens) return {};
        if (sheets[i].opens == sheets[k].opens) std::swap(k, l);
        return {{sheets[i].halfedge, sheets[k].halfedge}, {sheets[j].halfedge, sheets[l].halfedge}};
      }
    }
    return {};
  }

  static std::vector<Pair> like_parentheses(const std::vector<Sheet>& sheets) {
    std::vector<Pair> pairs;
    std::vector<Halfedge> open;
    std::vector<char> closed(sheets.size(), 0);
    for (const int round : {0, 1}) {  // the second time round: those left open before closing ones
      for (size_t i = 0; i < sheets.size(); ++i) {
        if (sheets[i].opens && round == 0) open.push_back(sheets[i].halfedge);
        if (sheets[i].opens || closed[i] || open.empty()) continue;
        pairs.push_back({open.back(), sheets[i].halfedge});
        open.pop_back();
        closed[i] = 1;
      }
    }
    return pairs;
  }

  /// How many fans these pairs would join to others.
  long fans_joined(const std::vector<Pair>& pairs) {
    std::vector<Pair> links;
    std::vector<int> roots;
    for (const Pair& pair : pairs) {
      for (const auto& [one, other] : joined_corners(pair)) {
        links.push_back({fans_.find(one), fans_.find(other)});
        roots.insert(roots.end(), links.back().begin(), links.back().end());
      }
    }
    std::sort(roots.begin(), roots.end());
    const auto rank = [&](int root) {
      return static_cast<int>(std::lower_bound(roots.begin(), roots.end(), root) - roots.begin());
    };
    UnionFind joined(roots.size());
    long count = 0;
    for (const auto& [one, other] : links) count += joined.unite(rank(one), rank(other));
    return count;
  }

  void split_vertices() {
    std::vector<char> taken(state_.positions.size(), 0);
    std::vector<Vertex> name(twin_.size());
    for (int i = 0; i < static_cast<int>(twin_.size()); ++i) {
      const Vertex v = name[i] = state_.corner(i);
      if (!names_three(state_, i / 3)) continue;
      const int fan = fans_.find(i);
      if (fan == i && taken[v]) {
        state_.log(RepairKind::VertexSplit, {state_.vertex_origin[v]});
        name[i] = state_.copy_vertex(v);
      } else {
        name[i] = fan == i ? v : name[fan];
        taken[v] = 1;
      }
    }
    for (int i = 0; i < static_cast<int>(twin_.size()); ++i) state_.faces[i / 3][i % 3] = name[i];
  }

  RepairState& state_;
  const bool inside_out_;
  std::vector<Halfedge> twin_;
  UnionFind fans_;  // of corners
};

/// What the other diagonal of two faces would be like; the smaller the better.
struct DiagonalCost {
  bool impossible, folded;
  double length;
  auto operator<=>(const DiagonalCost&) const = default;
};

DiagonalCost diagonal_cost(const RepairState& state, const PairedFaces& faces, Halfedge h) {
  if (!faces.can_turn(h)) return {true, true, 0};
  const Halfedge t = faces.twin(h);
  const Vector3 &a = state.shape[faces.origin(h)], &b = state.shape[faces.target(h)],
                &c = state.shape[faces.apex(h)], &d = state.shape[faces.apex(t)];
  const Vector3 normal = (b - a).cross(c - a) + (a - b).cross(d - b);
  const bool folded = (d - a).cross(c - a).dot(normal) < 0 || (b - d).cross(c - d).dot(normal) < 0;
  return {false, folded, (c - d).squaredNorm()};
}

class DoubledEdges {
 public:
  DoubledEdges(RepairState& state, std::vector<Halfedge> twin)
      : state_(state), faces_(state, std::move(twin)) {}

  void resolve() {
    // Half-edges move when faces are rewritten: each round touches a face once.
    constexpr int most_rounds = 16;
    for (int round = 0; round < most_rounds; ++round) {
      touched_.assign(state_.faces.size(), 0);
      const std::vector<FaceSide> sides = all_sides(state_);
      bool any = false;
      for_each_edge(sides, [&](size_t i, size_t j) {
        if (j - i <= 2) return;
        any = true;
        std::vector<Halfedge> edges;  // one half-edge of each pair, and unpaired ones
        for (size_t s = i; s < j; ++s) {
          const Halfedge h = sides[s].halfedge;
          if (is_touched(h) || is_touched(faces_.twin(h))) return;
          if (faces_.twin(h) < h) edges.push_back(h);
        }
        tell_apart(edges);
      });
      if (!any) return;
    }
  }

 private:
  bool is_touched(Halfedge h) const { return h >= 0 && touched_[h / 3]; }
  void touch(Halfedge h) {
    for (const Halfedge side : {h, faces_.twin(h)}) {
      if (side >= 0) touched_[side / 3] = 1;
    }
  }

  void tell_apart(std::vector<Halfedge> edges) {
    const auto cost = [&](Halfedge h) { return diagonal_cost(state_, faces_, h); };
    std::vector<std::pair<DiagonalCost, Halfedge>> order;
    for (const Halfedge h : edges) order.emplace_back(cost(h), h);
    std::sort(order.begin(), order.end());
    for (size_t i = 0; i + 1 < order.size(); ++i) {
      const Halfedge h = order[i].second;
      const Vertex a = state_.vertex_origin[faces_.origin(h)];
      const Vertex b = state_.vertex_origin[faces_.target(h)];
      const auto place = {std::min(a, b), std::max(a, b)};
      touch(h);
      if (faces_.can_turn(h)) {
        faces_.turn(h);
        state_.log(RepairKind::DiagonalTurned, place);
      } else {
        faces_.split(h);
        state_.log(RepairKind::EdgeMidpointAdded, place);
      }
    }
    touched_.resize(state_.faces.size(), 1);
  }

  RepairState& state_;
  PairedFaces faces_;
  std::vector<char> touched_;
};

bool has_crowded_edge(const std::vector<FaceSide>& sides) {
  bool any = false;
  for_each_edge(sides, [&](size_t i, size_t j) { any = any || j - i > 2; });
  return any;
}

}  // namespace

void split_non_manifold(RepairState& state) {
  const std::vector<FaceSide> sides = all_sides(state);
  std::vector<Halfedge> twin = SideJoiner(state).run(sides);
  if (has_crowded_edge(sides)) DoubledEdges(state, std::move(twin)).resolve();
}

}  // namespace sphparam
