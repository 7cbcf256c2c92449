// A queue of all edges by what their collapse costs. Entries are not taken back: one that is older
// than its ends is passed over when it comes up.

#include "wrap/simplification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "wrap/quadric.h"

namespace sphparam {

namespace {

constexpr double least_cosine = 0.5;   // of a triangle's normal before and after a collapse
constexpr double least_quality = 0.1;  // of a triangle that a collapse makes worse; 1: equilateral
constexpr int steps_a_look = 4096;

double quality(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return lengths > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / lengths : 0;
}

struct Collapse {
  double cost;
  Vertex from, to;  // `from` goes
  int age;          // of both ends, added up
  Vector3 place;

  bool operator<(const Collapse& other) const {  // the cheapest comes first
    return std::tie(other.cost, other.from, other.to) < std::tie(cost, from, to);
  }
};

class Simplifier {
 public:
  explicit Simplifier(const TriangleMesh& mesh)
      : centre_((mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff()) / 2),
        places_(mesh.positions.rowwise() - centre_),
        corners_(mesh.triangles),
        faces_(static_cast<size_t>(mesh.vertex_count())),
        quadrics_(faces_.size()),
        ages_(faces_.size(), 0),
        left_(mesh.face_count()) {
    for (Face f = 0; f < mesh.face_count(); ++f) {
      const Quadric plane = Quadric::of_triangle(place(f, 0), place(f, 1), place(f, 2));
      for (const Vertex v : corners_.row(f)) {
        faces_[static_cast<size_t>(v)].push_back(f);
        quadrics_[static_cast<size_t>(v)] += plane;
      }
    }
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) push_edges(v, true);
  }

  void run(long triangles, const Progress& progress) {
    const long all = left_;
    for (long step = 0; left_ > triangles && !queue_.empty(); ++step) {
      if (step % steps_a_look == 0)
        report(progress, "simplify",
               static_cast<double>(all - left_) / static_cast<double>(all - triangles));
      const Collapse next = queue_.top();
      queue_.pop();
      if (is_current(next) && keeps_topology(next) && keeps_shape(next)) collapse(next);
    }
  }

  TriangleMesh result() const {
    std::vector<Vertex> number(faces_.size(), -1);
    TriangleMesh mesh;
    mesh.positions.resize(places_.rows(), 3);
    mesh.triangles.resize(left_, 3);
    Vertex vertices = 0;
    for (size_t v = 0; v < faces_.size(); ++v) {
      if (faces_[v].empty()) continue;
      mesh.positions.row(vertices) = places_.row(static_cast<Eigen::Index>(v)) + centre_;
      number[v] = vertices++;
    }
    mesh.positions.conservativeResize(vertices, 3);
    Face count = 0;
    for (Eigen::Index f = 0; f < corners_.rows(); ++f) {
      if (corners_(f, 0) < 0) continue;
      for (int k = 0; k < 3; ++k)
        mesh.triangles(count, k) = number[static_cast<size_t>(corners_(f, k))];
      ++count;
    }
    return mesh;
  }

 private:
  Vector3 place(Vertex v) const { return places_.row(v); }
  Vector3 place(Face f, int k) const { return places_.row(corners_(f, k)); }
  const std::vector<Face>& faces(Vertex v) const { return faces_[static_cast<size_t>(v)]; }
  int& age(Vertex v) { return ages_[static_cast<size_t>(v)]; }
  bool has(Face f, Vertex v) const {
    return corners_(f, 0) == v || corners_(f, 1) == v || corners_(f, 2) == v;
  }

  std::vector<Vertex> neighbours(Vertex v) const {
    std::vector<Vertex> found;
    for (const Face f : faces(v))
      for (const Vertex w : corners_.row(f))
        if (w != v) found.push_back(w);
    std::ranges::sort(found);
    found.erase(std::ranges::unique(found).begin(), found.end());
    return found;
  }

  void push(Vertex a, Vertex b) {
    const Quadric both = quadrics_[static_cast<size_t>(a)] + quadrics_[static_cast<size_t>(b)];
    const Vector3 best = both.lowest((place(a) + place(b)) / 2);
    queue_.push({both.at(best), std::max(a, b), std::min(a, b), age(a) + age(b), best});
  }

  void push_edges(Vertex v, bool only_greater = false) {
    for (const Vertex w : neighbours(v))
      if (!only_greater || w > v) push(v, w);
  }

  bool is_current(const Collapse& edge) {
    return !faces(edge.from).empty() && !faces(edge.to).empty() &&
           age(edge.from) + age(edge.to) == edge.age;
  }

  /// The link condition; a tetrahedron stays.
  bool keeps_topology(const Collapse& edge) const {
    if (left_ <= 4) return false;
    const std::vector<Vertex> a = neighbours(edge.from), b = neighbours(edge.to);
    std::vector<Vertex> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return both.size() == 2;
  }

  bool keeps_shape(const Collapse& edge) const {
    return keeps_faces(edge.from, edge.to, edge.place) &&
           keeps_faces(edge.to, edge.from, edge.place);
  }

  /// Whether the triangles that stay may have their corner v moved.
  bool keeps_faces(Vertex v, Vertex other, const Vector3& to) const {
    return std::ranges::all_of(faces(v), [&](Face f) {
      if (has(f, other)) return true;
      std::array<Vector3, 3> old, now;
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<size_t>(k);
        old[i] = place(f, k);
        now[i] = corners_(f, k) == v ? to : old[i];
      }
      const Vector3 before = (old[1] - old[0]).cross(old[2] - old[0]),
                    after = (now[1] - now[0]).cross(now[2] - now[0]);
      const double good = quality(now[0], now[1], now[2]);
      return before.dot(after) >= least_cosine * before.norm() * after.norm() &&
             (good >= least_quality || good >= quality(old[0], old[1], old[2]));
    });
  }

  void collapse(const Collapse& edge) {
    places_.row(edge.to) = edge.place;
    quadrics_[static_cast<size_t>(edge.to)] += quadrics_[static_cast<size_t>(edge.from)];
    std::vector<Face>& gone = faces_[static_cast<size_t>(edge.from)];
    for (const Face f : gone) {
      if (has(f, edge.to)) {
        remove(f, edge.from);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (corners_(f, k) == edge.from) corners_(f, k) = edge.to;
      faces_[static_cast<size_t>(edge.to)].push_back(f);
    }
    gone.clear();
    ++age(edge.to);
    push_edges(edge.to);
  }

  /// From the lists of its corners too, but for one.
  void remove(Face f, Vertex but) {
    for (const Vertex v : corners_.row(f))
      if (v != but) std::erase(faces_[static_cast<size_t>(v)], f);
    corners_.row(f).setConstant(-1);
    --left_;
  }

  Eigen::RowVector3d centre_;
  Points places_;      // about the centre, so that quadrics lose no digits
  Triangles corners_;  // −1: gone
  std::vector<std::vector<Face>> faces_;
  std::vector<Quadric> quadrics_;
  std::vector<int> ages_;  // how often a vertex has moved
  long left_;
  std::priority_queue<Collapse> queue_;
};

}  // namespace

TriangleMesh simplified(const TriangleMesh& sphere, long triangles, const Progress& progress) {
  if (sphere.face_count() <= triangles) return sphere;
  Simplifier simplifier(sphere);
  simplifier.run(triangles, progress);
  return simplifier.result();
}

}  // namespace sphparam
