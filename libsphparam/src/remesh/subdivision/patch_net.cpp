// Edges are found by sorting: those of the same two vertices are one.
//
// Catmull and Clark: a face's new point F is its mean; an edge's is (A + B + F₁ + F₂)/4; a vertex's
// is (Q + 2R + (n − 3)V)/n, with Q the mean of the F about it and R that of its edges' middles.

#include "remesh/subdivision/patch_net.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace sphparam {

namespace {

struct EdgeKey {
  int low, high, edge;
  bool operator<(const EdgeKey& other) const {
    return std::tie(low, high, edge) < std::tie(other.low, other.high, other.edge);
  }
};

/// The corner after corner `i` of the list, around its face.
std::vector<int> next_corners(const Polygons& faces) {
  std::vector<int> next(faces.corners.size());
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const int first = faces.starts[static_cast<size_t>(f)],
              last = faces.starts[static_cast<size_t>(f) + 1];
    for (int i = first; i < last; ++i) next[static_cast<size_t>(i)] = i + 1 < last ? i + 1 : first;
  }
  return next;
}

/// Edge i runs from corner i to the next: the edge that runs the other way.
std::vector<int> pair_edges(const Polygons& faces) {
  const std::vector<int> next = next_corners(faces);
  std::vector<EdgeKey> keys(next.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    const int a = faces.corners[i], b = faces.corners[static_cast<size_t>(next[i])];
    keys[i] = {std::min(a, b), std::max(a, b), static_cast<int>(i)};
  }
  std::sort(keys.begin(), keys.end());
  const auto is_same = [](const EdgeKey& a, const EdgeKey& b) {
    return a.low == b.low && a.high == b.high;
  };
  std::vector<int> across(keys.size());
  for (size_t i = 0; i < keys.size(); i += 2) {
    if (i + 1 == keys.size() || !is_same(keys[i], keys[i + 1]) ||
        (i + 2 < keys.size() && is_same(keys[i], keys[i + 2]))) {
      throw std::invalid_argument("the faces are no closed manifold");
    }
    across[static_cast<size_t>(keys[i].edge)] = keys[i + 1].edge;
    across[static_cast<size_t>(keys[i + 1].edge)] = keys[i].edge;
  }
  return across;
}

/// Numbers edges once for both of their directions, from 0.
std::vector<int> number_edges(const std::vector<int>& across) {
  std::vector<int> number(across.size());
  int count = 0;
  for (size_t e = 0; e < across.size(); ++e) {
    const auto other = static_cast<size_t>(across[e]);
    number[e] = e < other ? count++ : number[other];
  }
  return number;
}

/// Points after one step: of vertices, then of edges, then of faces.
Points subdivide_points(const Polygons& faces, const std::vector<int>& next,
                        const std::vector<int>& edge_of, const Points& old) {
  const auto edges = static_cast<Eigen::Index>(edge_of.size() / 2);
  const Eigen::Index of_faces = old.rows() + edges;
  Points result = Points::Zero(of_faces + faces.count(), 3);
  Points about = Points::Zero(old.rows(), 3);  // Σ of F + 2·middle, one of each a face
  std::vector<int> valence(static_cast<size_t>(old.rows()), 0);
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    Vector3 mean = Vector3::Zero();
    for (const int v : faces.polygon(f)) mean += old.row(v);
    mean /= faces.degree(f);
    result.row(of_faces + f) = mean;
    for (int i = faces.starts[static_cast<size_t>(f)]; i < faces.starts[static_cast<size_t>(f) + 1];
         ++i) {
      const auto corner = static_cast<size_t>(i);
      const int a = faces.corners[corner], b = faces.corners[static_cast<size_t>(next[corner])];
      result.row(old.rows() + edge_of[corner]) += (old.row(a) + mean.transpose()) / 4;
      about.row(a) += mean.transpose() + old.row(a) + old.row(b);
      ++valence[static_cast<size_t>(a)];
    }
  }
  for (Eigen::Index v = 0; v < old.rows(); ++v) {
    const double n = valence[static_cast<size_t>(v)];
    result.row(v) = (about.row(v) / n + (n - 3) * old.row(v)) / n;
  }
  return result;
}

LimitPlace place_on_edge(int degree, int edge, double along, double inside) {
  const int patch = edge / degree, k = edge % degree;
  if (degree == 3) {
    // Inwards is towards the third corner, from the middle of the edge.
    std::array<double, 3> weights{};
    weights[static_cast<size_t>(k)] = 1 - along - inside / 2;
    weights[static_cast<size_t>((k + 1) % 3)] = along - inside / 2;
    weights[static_cast<size_t>((k + 2) % 3)] = inside;
    return {patch, weights[1], weights[2]};
  }
  switch (k) {
    case 0:
      return {patch, along, inside};
    case 1:
      return {patch, 1 - inside, along};
    case 2:
      return {patch, 1 - along, 1 - inside};
    default:
      return {patch, inside, 1 - along};
  }
}

/// The inverse: how far along edge k and how far inside of it.
std::array<double, 2> on_edge(int degree, int k, const LimitPlace& place) {
  if (degree == 3) {
    const std::array<double, 3> weights = {1 - place.s - place.t, place.s, place.t};
    const double inside = weights[static_cast<size_t>((k + 2) % 3)];
    return {weights[static_cast<size_t>((k + 1) % 3)] + inside / 2, inside};
  }
  switch (k) {
    case 0:
      return {place.s, place.t};
    case 1:
      return {place.t, 1 - place.s};
    case 2:
      return {1 - place.s, 1 - place.t};
    default:
      return {1 - place.t, place.s};
  }
}

/// Numbers the lattice points of patches: (i, j) of n in s and t.
class Lattice {
 public:
  Lattice(const Polygons& faces, const PatchNet& net, int vertex_count, int n)
      : faces_(faces), degree_(net.degree()), n_(n), of_edges_(vertex_count) {
    across_.resize(faces.corners.size());
    for (size_t e = 0; e < across_.size(); ++e) across_[e] = net.across(static_cast<int>(e));
    number_ = number_edges(across_);
    of_patches_ = of_edges_ + static_cast<int>(number_.size() / 2) * (n - 1);
    within_ = degree_ == 3 ? (n - 1) * (n - 2) / 2 : (n - 1) * (n - 1);
  }

  int count(int patches) const { return of_patches_ + within_ * patches; }
  int last_i(int j) const { return degree_ == 3 ? n_ - j : n_; }

  int vertex(int patch, int i, int j) const {
    if (j == 0 && i < n_) return on_edge(patch, 0, i);
    if (i == last_i(j) && j < n_) return on_edge(patch, 1, j);
    if (degree_ == 3 && i == 0) return on_edge(patch, 2, n_ - j);
    if (j == n_ && i > 0) return on_edge(patch, 2, n_ - i);
    if (i == 0) return on_edge(patch, 3, n_ - j);
    const int skipped = degree_ == 3 ? j * (j - 1) / 2 : 0;
    return of_patches_ + within_ * patch + (j - 1) * (n_ - 1) - skipped + i - 1;
  }

 private:
  /// `along` steps of n from corner k to the next, which it does not reach.
  int on_edge(int patch, int k, int along) const {
    const auto edge = static_cast<size_t>(degree_ * patch + k);
    if (along == 0) return faces_.corners[edge];
    const bool forwards = static_cast<int>(edge) < across_[edge];
    return of_edges_ + number_[edge] * (n_ - 1) + (forwards ? along : n_ - along) - 1;
  }

  const Polygons& faces_;
  int degree_, n_, of_edges_, of_patches_, within_;
  std::vector<int> across_, number_;
};

void add_pieces(const Lattice& lattice, int degree, int patch, int n, std::vector<int>& corners) {
  const auto add = [&](std::initializer_list<std::array<int, 2>> piece) {
    for (const auto [i, j] : piece) corners.push_back(lattice.vertex(patch, i, j));
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < lattice.last_i(j); ++i) {
      if (degree == 4) {
        add({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
        continue;
      }
      add({{i, j}, {i + 1, j}, {i, j + 1}});
      if (i + j + 1 < n) add({{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
    }
  }
}

int require_one_degree(const Polygons& faces) {
  const int degree = faces.count() > 0 ? faces.degree(0) : 0;
  bool uniform = degree == 3 || degree == 4;
  for (std::int64_t f = 0; f < faces.count(); ++f) uniform &= faces.degree(f) == degree;
  if (!uniform) throw std::invalid_argument("triangles only or quads only are expected");
  return degree;
}

}  // namespace

bool faces_are_patches(const Polygons& faces, Scheme scheme) {
  if (scheme == Scheme::Loop) return true;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    if (faces.degree(f) != 4) return false;
  }
  return true;
}

ControlMesh subdivide_to_quads(const ControlMesh& mesh) {
  const std::vector<int> next = next_corners(mesh.faces),
                         edge_of = number_edges(pair_edges(mesh.faces));
  ControlMesh result;
  for (const Points& points : mesh.points)
    result.points.push_back(subdivide_points(mesh.faces, next, edge_of, points));
  const int of_edges = static_cast<int>(mesh.points.front().rows()),
            of_faces = of_edges + static_cast<int>(edge_of.size() / 2);
  std::vector<int> previous(next.size());
  for (size_t i = 0; i < next.size(); ++i)
    previous[static_cast<size_t>(next[i])] = static_cast<int>(i);
  for (std::int64_t f = 0; f < mesh.faces.count(); ++f) {
    for (int i = mesh.faces.starts[static_cast<size_t>(f)];
         i < mesh.faces.starts[static_cast<size_t>(f) + 1]; ++i) {
      const auto corner = static_cast<size_t>(i);
      for (const int v :
           {mesh.faces.corners[corner], of_edges + edge_of[corner], of_faces + static_cast<int>(f),
            of_edges + edge_of[static_cast<size_t>(previous[corner])]})
        result.faces.corners.push_back(v);
      result.faces.starts.push_back(static_cast<int>(result.faces.corners.size()));
    }
  }
  return result;
}

PatchNet::PatchNet(const Polygons& faces)
    : degree_(require_one_degree(faces)), across_(pair_edges(faces)) {}

LimitPlace PatchNet::cross(const LimitPlace& place) const {
  int farthest = 0;
  std::array<double, 2> there = on_edge(degree_, 0, place);
  for (int k = 1; k < degree_; ++k) {
    const std::array<double, 2> at = on_edge(degree_, k, place);
    if (at[1] < there[1]) std::tie(farthest, there) = std::tie(k, at);
  }
  return place_on_edge(degree_, across(degree_ * place.patch + farthest), 1 - there[0], -there[1]);
}

LimitPlace clamped(const LimitPlace& place, int degree) {
  LimitPlace inside = {place.patch, std::clamp(place.s, 0.0, 1.0), std::clamp(place.t, 0.0, 1.0)};
  const double sum = inside.s + inside.t;
  if (degree == 3 && sum > 1) {
    inside.s /= sum;
    inside.t = std::min(inside.t / sum, 1 - inside.s);
  }
  return inside;
}

Tessellation tessellate(const Polygons& faces, int vertex_count, int n) {
  const PatchNet net(faces);
  const int degree = net.degree(), patches = net.patch_count();
  const std::int64_t squared = std::int64_t{n} * n;
  if (n > most_cuts || squared * patches > std::numeric_limits<int>::max() / 4) {
    throw std::invalid_argument("more than " + std::to_string(std::numeric_limits<int>::max() / 4) +
                                " faces");
  }
  const Lattice lattice(faces, net, vertex_count, n);
  Tessellation result;
  result.vertices.assign(static_cast<size_t>(lattice.count(patches)),
                         {.patch = -1, .s = 0, .t = 0});
  for (int p = 0; p < patches; ++p) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= lattice.last_i(j); ++i) {
        LimitPlace& place = result.vertices[static_cast<size_t>(lattice.vertex(p, i, j))];
        if (place.patch < 0) place = {p, static_cast<double>(i) / n, static_cast<double>(j) / n};
      }
    }
    add_pieces(lattice, degree, p, n, result.faces.corners);
  }
  for (size_t i = static_cast<size_t>(degree); i <= result.faces.corners.size();
       i += static_cast<size_t>(degree))
    result.faces.starts.push_back(static_cast<int>(i));
  return result;
}

}  // namespace sphparam
