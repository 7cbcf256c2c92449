// Charts are found by flooding. The end of a chart is found by halving the way from the middle to
// the corner.

#include "remesh/seams.h"

#include <algorithm>

#include "remesh/faces_of_point.h"

namespace sphparam {

namespace {

constexpr int halvings = 30;

/// Are all corners that the point has a weight at corners of that face too?
bool lies_on(Face face, const SurfacePoint& point, const Topology& topology) {
  if (face == point.face) return true;
  for (int i = 0; i < 3; ++i) {
    if (point.barycentric[i] == 0) continue;
    const Vertex v = topology.vertex(point.face, i);
    if (topology.vertex(face, 0) != v && topology.vertex(face, 1) != v &&
        topology.vertex(face, 2) != v) {
      return false;
    }
  }
  return true;
}

/// The same point with weights at the corners of another face that it lies on.
SurfacePoint on_face(Face face, const SurfacePoint& point, const Topology& topology) {
  if (face == point.face) return point;
  SurfacePoint moved{face, Vector3::Zero()};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (topology.vertex(point.face, i) == topology.vertex(face, k)) {
        moved.barycentric[k] = point.barycentric[i];
      }
    }
  }
  return moved;
}

}  // namespace

Seams::Seams(const Topology& topology, const SphereLocator& locator, const double* values,
             int width)
    : topology_(topology),
      locator_(locator),
      values_(values),
      width_(width),
      chart_of_(static_cast<size_t>(topology.face_count()), -1) {
  std::vector<Face> waiting;
  const auto claim = [&](Face f) {
    int& chart = chart_of_[static_cast<size_t>(f)];
    if (chart >= 0) return;
    chart = chart_count_;
    waiting.push_back(f);
  };
  for (Face seed = 0; seed < topology.face_count(); ++seed) {
    if (chart_of_[static_cast<size_t>(seed)] >= 0) continue;
    claim(seed);
    while (!waiting.empty()) {
      const Face f = waiting.back();
      waiting.pop_back();
      for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
        if (agree_across(h)) claim(Topology::face(topology.twin(h)));
      }
    }
    ++chart_count_;
  }
}

bool Seams::agree(Halfedge a, Halfedge b) const {
  const double* const of_a = values_ + std::int64_t{a} * width_;
  return std::equal(of_a, of_a + width_, values_ + std::int64_t{b} * width_);
}

bool Seams::agree_across(Halfedge h) const {
  const Halfedge twin = topology_.twin(h);
  return agree(h, Topology::next(twin)) && agree(Topology::next(h), twin);
}

void Seams::put(const SurfacePoint& point, double* result) const {
  const double* const corners = values_ + 3 * std::int64_t{point.face} * width_;
  for (int c = 0; c < width_; ++c) {
    const double a = corners[c], b = corners[width_ + c], d = corners[2 * width_ + c];
    const double sum =
        point.barycentric[0] * a + point.barycentric[1] * b + point.barycentric[2] * d;
    result[c] = std::clamp(sum, std::min({a, b, d}), std::max({a, b, d}));
  }
}

bool Seams::find_in_chart(int chart, const SurfacePoint& at, SurfacePoint& found) const {
  return any_face_of(at, topology_, [&](Face f) {
    if (chart_of_[static_cast<size_t>(f)] != chart) return false;
    found = on_face(f, at, topology_);
    return true;
  });
}

void Seams::evaluate(const Middle& middle, const Vector3& direction, const SurfacePoint& at,
                     double* result) const {
  // The middle's own face before others of its chart: a vertex may have several values in it.
  SurfacePoint end = middle.point;
  const Face home = middle.point.face;
  const int chart = chart_of_[static_cast<size_t>(home)];
  // Asked of the face, not of the ring: a ring may be as long as the mesh.
  if (lies_on(home, at, topology_)) return put(on_face(home, at, topology_), result);
  if (find_in_chart(chart, at, end)) return put(end, result);
  Vector3 inside = middle.direction, outside = direction;
  for (int i = 0; i < halvings; ++i) {
    const Vector3 half = (inside + outside).normalized();
    (find_in_chart(chart, locator_.locate(half), end) ? inside : outside) = half;
  }
  put(end, result);
}

}  // namespace sphparam
