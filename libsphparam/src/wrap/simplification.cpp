// A queue of all edges by what their collapse costs. Entries are not taken back: one that is older
// than its ends is passed over when it comes up, and when most are, all of them go. Corners at a
// vertex are a list through all corners, so that those of two vertices are joined at once.

#include "wrap/simplification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "edge_collapse.h"
#include "mesh/unit_size.h"
#include "wrap/quadric.h"

namespace sphparam {

namespace {

constexpr double least_cosine = 0.5;   // of a triangle's normal before and after a collapse
constexpr double least_quality = 0.1;  // of a triangle that a collapse makes worse; 1: equilateral
constexpr int steps_a_look = 4096;

/// The corners of a mesh by their vertices, 3 f + k; faces may go and vertices become one.
class Corners {
 public:
  explicit Corners(Triangles triangles, Eigen::Index vertices)
      : vertices_(std::move(triangles)),
        next_(static_cast<size_t>(vertices_.size()), none),
        first_(static_cast<size_t>(vertices), none),
        last_(first_) {
    for (int c = 0; c < static_cast<int>(next_.size()); ++c) {
      const auto v = static_cast<size_t>(vertices_.data()[c]);
      (first_[v] == none ? first_[v] : next_[static_cast<size_t>(last_[v])]) = c;
      last_[v] = c;
    }
  }

  Vertex at(Face f, int k) const { return vertices_(f, k); }
  bool is_gone(Face f) const { return vertices_(f, 0) < 0; }
  bool is_empty(Vertex v) const { return first_[static_cast<size_t>(v)] == none; }
  bool has(Face f, Vertex v) const { return at(f, 0) == v || at(f, 1) == v || at(f, 2) == v; }
  const Triangles& triangles() const { return vertices_; }

  void remove(Face f) { vertices_.row(f).setConstant(-1); }

  /// Corners of `from` become those of `to`.
  void join(Vertex from, Vertex to) {
    for_each_face(from, [&](Face f, int k) { vertices_(f, k) = to; });
    const auto a = static_cast<size_t>(from), b = static_cast<size_t>(to);
    if (first_[a] == none) return;
    (first_[b] == none ? first_[b] : next_[static_cast<size_t>(last_[b])]) = first_[a];
    last_[b] = last_[a];
    first_[a] = last_[a] = none;
  }

  /// visit(face, which of its corners); what is gone leaves the list.
  template <class Visit>
  void for_each_face(Vertex v, const Visit& visit) {
    int before = none;
    for (int c = first_[static_cast<size_t>(v)]; c != none;) {
      const int next = next_[static_cast<size_t>(c)];
      const Face f = c / 3;
      if (is_gone(f)) {
        (before == none ? first_[static_cast<size_t>(v)] : next_[static_cast<size_t>(before)]) =
            next;
        if (next == none) last_[static_cast<size_t>(v)] = before;
      } else {
        visit(f, c % 3);
        before = c;
      }
      c = next;
    }
  }

 private:
  static constexpr int none = -1;
  Triangles vertices_;  // −1: gone
  std::vector<int> next_, first_, last_;
};

class Simplifier {
 public:
  explicit Simplifier(TriangleMesh mesh)
      : centre_((mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff()) / 2),
        places_(std::move(mesh.positions)),
        corners_(std::move(mesh.triangles), places_.rows()),
        quadrics_(static_cast<size_t>(places_.rows())),
        ages_(quadrics_.size(), 0),
        stamps_(quadrics_.size(), 0),
        left_(corners_.triangles().rows()) {
    places_.rowwise() -= centre_;
    for (Face f = 0; f < left_; ++f) {
      const Quadric plane = Quadric::of_triangle(place(f, 0), place(f, 1), place(f, 2));
      for (int k = 0; k < 3; ++k) quadrics_[static_cast<size_t>(corners_.at(f, k))] += plane;
    }
    queue_.reserve(static_cast<size_t>(most_entries()));
    for (Vertex v = 0; v < places_.rows(); ++v)
      for_each_neighbour(v, [&](Vertex w) {
        if (w > v) queue_.push_back(collapse_of(v, w));
      });
    std::make_heap(queue_.begin(), queue_.end());
  }

  void run(long triangles, const Progress& progress) {
    const long all = left_;
    for (long step = 0; left_ > triangles && !queue_.empty(); ++step) {
      if (step % steps_a_look == 0)
        report(progress, "simplify",
               static_cast<double>(all - left_) / static_cast<double>(all - triangles));
      std::pop_heap(queue_.begin(), queue_.end());
      const EdgeCollapse next = queue_.back();
      queue_.pop_back();
      if (!is_current(next) || !keeps_topology(next)) continue;
      const Vector3 to = best_place(next.from, next.to);
      if (keeps_shape(next, to)) collapse(next, to);
    }
  }

  TriangleMesh result() {
    std::vector<Vertex> number(quadrics_.size(), -1);
    TriangleMesh mesh;
    mesh.triangles.resize(left_, 3);
    Vertex vertices = 0;
    for (Vertex v = 0; v < places_.rows(); ++v) {
      if (corners_.is_empty(v)) continue;
      places_.row(vertices) = places_.row(v);
      number[static_cast<size_t>(v)] = vertices++;
    }
    mesh.positions = places_.topRows(vertices).rowwise() + centre_;
    Face count = 0;
    for (Face f = 0; f < corners_.triangles().rows(); ++f) {
      if (corners_.is_gone(f)) continue;
      for (int k = 0; k < 3; ++k)
        mesh.triangles(count, k) = number[static_cast<size_t>(corners_.at(f, k))];
      ++count;
    }
    return mesh;
  }

 private:
  Vector3 place(Vertex v) const { return places_.row(v); }
  Vector3 place(Face f, int k) const { return places_.row(corners_.at(f, k)); }
  int& age(Vertex v) { return ages_[static_cast<size_t>(v)]; }

  /// Twice as many as there are edges, so that old entries are half of them at most.
  long most_entries() const { return 3 * left_; }

  /// Each once.
  template <class Visit>
  void for_each_neighbour(Vertex v, const Visit& visit) {
    const int stamp = ++last_stamp_;
    corners_.for_each_face(v, [&](Face f, int k) {
      for (const int other : {1, 2}) {
        const Vertex w = corners_.at(f, (k + other) % 3);
        if (std::exchange(stamps_[static_cast<size_t>(w)], stamp) != stamp) visit(w);
      }
    });
  }

  Quadric quadric_of(Vertex a, Vertex b) const {
    return quadrics_[static_cast<size_t>(a)] + quadrics_[static_cast<size_t>(b)];
  }

  Vector3 best_place(Vertex a, Vertex b) const {
    return quadric_of(a, b).lowest((place(a) + place(b)) / 2);
  }

  EdgeCollapse collapse_of(Vertex a, Vertex b) {
    const Quadric both = quadric_of(a, b);
    return {both.at(both.lowest((place(a) + place(b)) / 2)), std::max(a, b), std::min(a, b),
            age(a) + age(b)};
  }

  void push_edges(Vertex v) {
    for_each_neighbour(v, [&](Vertex w) {
      queue_.push_back(collapse_of(v, w));
      std::push_heap(queue_.begin(), queue_.end());
    });
    if (std::ssize(queue_) <= most_entries()) return;
    std::erase_if(queue_, [&](const EdgeCollapse& edge) { return !is_current(edge); });
    std::make_heap(queue_.begin(), queue_.end());
  }

  bool is_current(const EdgeCollapse& edge) {
    return !corners_.is_empty(edge.from) && !corners_.is_empty(edge.to) &&
           age(edge.from) + age(edge.to) == edge.age;
  }

  /// The link condition; a tetrahedron stays.
  bool keeps_topology(const EdgeCollapse& edge) {
    if (left_ <= 4) return false;
    for_each_neighbour(edge.from, [](Vertex) {});
    const int of_from = last_stamp_;
    int common = 0;
    corners_.for_each_face(edge.to, [&](Face f, int k) {
      // Each neighbour of a vertex of a closed surface is once the next corner of a face.
      common += stamps_[static_cast<size_t>(corners_.at(f, (k + 1) % 3))] == of_from;
    });
    return common == 2;
  }

  bool keeps_shape(const EdgeCollapse& edge, const Vector3& to) {
    return keeps_faces(edge.from, edge.to, to) && keeps_faces(edge.to, edge.from, to);
  }

  /// Whether the triangles that stay may have their corner v moved.
  bool keeps_faces(Vertex v, Vertex other, const Vector3& to) {
    bool keeps = true;
    corners_.for_each_face(v, [&](Face f, int k) {
      if (keeps && !corners_.has(f, other)) keeps = keeps_face(f, k, to);
    });
    return keeps;
  }

  bool keeps_face(Face f, int moved, const Vector3& to) const {
    const std::array<Vector3, 3> old = {place(f, 0), place(f, 1), place(f, 2)};
    std::array<Vector3, 3> now = old;
    now[static_cast<size_t>(moved)] = to;
    const Vector3 before = (old[1] - old[0]).cross(old[2] - old[0]),
                  after = (now[1] - now[0]).cross(now[2] - now[0]);
    const double good = triangle_quality(now[0], now[1], now[2]);
    return before.dot(after) >= least_cosine * before.norm() * after.norm() &&
           (good >= least_quality || good >= triangle_quality(old[0], old[1], old[2]));
  }

  void collapse(const EdgeCollapse& edge, const Vector3& to) {
    places_.row(edge.to) = to;
    quadrics_[static_cast<size_t>(edge.to)] += quadrics_[static_cast<size_t>(edge.from)];
    corners_.for_each_face(edge.from, [&](Face f, int) {
      if (!corners_.has(f, edge.to)) return;
      corners_.remove(f);
      --left_;
    });
    corners_.join(edge.from, edge.to);
    ++age(edge.to);
    push_edges(edge.to);
  }

  Eigen::RowVector3d centre_;
  Points places_;  // about the centre, so that quadrics lose no digits
  Corners corners_;
  std::vector<Quadric> quadrics_;
  std::vector<int> ages_;    // how often a vertex has moved
  std::vector<int> stamps_;  // of the visit of neighbours that came to a vertex last
  int last_stamp_ = 0;
  long left_;
  std::vector<EdgeCollapse> queue_;  // a heap
};

}  // namespace

TriangleMesh simplified(TriangleMesh sphere, long triangles, const Progress& progress) {
  if (sphere.face_count() <= triangles) return sphere;
  if (std::optional<Rescaled> unit = at_unit_size(sphere)) {  // sixth powers must be numbers
    TriangleMesh made = simplified(std::move(unit->mesh), triangles, progress);
    for (double& x : made.positions.reshaped()) x = std::ldexp(x, unit->exponent);
    return made;
  }
  Simplifier simplifier(std::move(sphere));
  simplifier.run(triangles, progress);
  return simplifier.result();
}

}  // namespace sphparam
