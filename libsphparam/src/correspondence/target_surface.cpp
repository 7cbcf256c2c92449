#include "correspondence/target_surface.h"

#include <array>
#include <cmath>
#include <numbers>

#include "mesh/flat_face.h"
#include "mesh/triangle_geometry.h"
#include "mesh/vertex_normals.h"
#include "sphparam/errors.h"

// A walk: barycentric weights change linearly, dλ_k = way · ∇λ_k with ∇λ_k = n × e_k / |n|², e_k
// the edge opposite to corner k and n twice the face's area times its normal. The first weight that
// becomes 0 names the edge to cross; beyond it the part along the edge stays, the part across it
// turns into the next face.

namespace sphparam {
namespace {

constexpr int most_faces = 512;  // of one walk

struct Crossing {
  int corner = -1;  // opposite to the edge; -1: the walk ends in the face
  double part = 1;  // of the way
};

/// `entered`: the corner opposite to the edge that the walk came over, or -1.
Crossing first_crossing(const Vector3& weights, const Vector3& change, int entered) {
  Crossing first;
  for (int k = 0; k < 3; ++k) {
    if (k == entered || !(change[k] < 0) || weights[k] + change[k] >= 0) continue;
    const double part = std::max(0.0, -weights[k] / change[k]);
    if (first.corner < 0 || part < first.part) first = {k, part};
  }
  return first;
}

Vector3 clamped(const Vector3& weights) {
  const Vector3 positive = weights.cwiseMax(0);
  return positive / positive.sum();
}

using Corners = std::array<Vector3, 3>;

bool is_flat(const Corners& x) { return sphparam::is_flat(x[0], x[1], x[2]); }

/// Twice the area times the normal.
Vector3 normal_of(const Corners& x) { return (x[1] - x[0]).cross(x[2] - x[0]); }

/// What the weights of a face change by along a way in its plane.
Vector3 changes_along(const Vector3& way, const Corners& x, const Vector3& normal) {
  Vector3 changes;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    const Vector3 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
    changes[k] = way.dot(normal.cross(edge)) / normal.squaredNorm();
  }
  return changes;
}

/// A way turned round an edge, of length 1, into the plane of the face beyond it.
Vector3 unfolded(const Vector3& way, const Vector3& edge, const Vector3& unit_normal,
                 const Vector3& unit_normal_beyond) {
  const Vector3 across = edge.cross(unit_normal);  // out of the face
  return way.dot(edge) * edge + way.dot(across) * edge.cross(unit_normal_beyond);
}

/// A point of the edge opposite to a corner, with the weights of the face beyond it, which the edge
/// enters as `in`.
SurfacePoint seen_from_beyond(const SurfacePoint& at, int corner, Halfedge in) {
  Vector3 weights = Vector3::Zero();
  weights[in % 3] = at.barycentric[(corner + 2) % 3];
  weights[(in % 3 + 1) % 3] = at.barycentric[(corner + 1) % 3];
  return {in / 3, weights};
}

}  // namespace

Points scaled_to_sphere(const TriangleMesh& mesh) {
  const double area = surface_area(mesh);
  if (!(area > 0) || !std::isfinite(area)) {
    throw UnmeasurableMesh("the surface has no area that can be measured");
  }
  const Eigen::RowVector3d middle = mesh.positions.colwise().mean();
  return (mesh.positions.rowwise() - middle) * std::sqrt(4 * std::numbers::pi / area);
}

TargetSurface::TargetSurface(const MappedMesh& mapped)
    : TargetSurface(mapped, mapped.mesh().positions) {}

TargetSurface::TargetSurface(const MappedMesh& mapped, const Points& positions)
    : topology_(mapped.topology()),
      map_(mapped.map()),
      locator_(mapped.locator()),
      positions_(scaled_to_sphere({positions, mapped.mesh().triangles})),
      normals_(vertex_normals({positions_, mapped.mesh().triangles})) {}

TargetSurface::Corners TargetSurface::corners(Face face) const {
  const auto corner = [&](int k) -> Vector3 { return positions_.row(topology_.vertex(face, k)); };
  return {corner(0), corner(1), corner(2)};
}

Place TargetSurface::place(const SurfacePoint& at) const {
  Vector3 direction = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    direction += at.barycentric[k] * map_.point(topology_.vertex(at.face, k));
  Place result{at, {}, direction.normalized(), {}};
  measure(result);
  return result;
}

Place TargetSurface::place(const Vector3& direction) const {
  Place result{locator_.locate(direction), {}, direction, {}};
  measure(result);
  return result;
}

void TargetSurface::measure(Place& place) const {
  const Corners x = corners(place.at.face);
  const Vector3& w = place.at.barycentric;
  const Vector3 flat = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
  std::array<Vector3, 3> normals, rounded, rays;
  Vector3 ray = Vector3::Zero();
  place.position.setZero();
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    const Vertex v = topology_.vertex(place.at.face, k);
    normals[i] = normals_.row(v);
    rays[i] = map_.point(v);
    rounded[i] = flat - normals[i].dot(flat - x[i]) * normals[i];
    place.position += w[k] * rounded[i];
    ray += w[k] * rays[i];
  }
  PlaceFrame& frame = place.frame;
  if (is_flat(x)) {
    frame.u = frame.v = frame.of_u = frame.of_v = frame.turn_u = frame.turn_v = Vector3::Zero();
    return;
  }
  const Vector3 normal = normal_of(x);
  const TangentFrame tangents = tangent_frame(normal.normalized());
  const double length = ray.norm();
  const auto change = [&](const Vector3& way, Vector3& position, Vector3& direction) {
    const Vector3 changes = changes_along(way, x, normal);
    position.setZero();
    direction.setZero();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      position += changes[k] * rounded[i] + w[k] * (way - normals[i].dot(way) * normals[i]);
      direction += changes[k] * rays[i];
    }
    direction = (direction - direction.dot(ray) / (length * length) * ray) / length;
  };
  frame.u = tangents.u;
  frame.v = tangents.v;
  change(frame.u, frame.of_u, frame.turn_u);
  change(frame.v, frame.of_v, frame.turn_v);
}

Eigen::Matrix<double, 3, 2> TargetSurface::changes_of_weights(const Place& place) const {
  Eigen::Matrix<double, 3, 2> changes = Eigen::Matrix<double, 3, 2>::Zero();
  const Corners x = corners(place.at.face);
  if (is_flat(x)) return changes;
  const Vector3 normal = normal_of(x);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    const Vector3 slope = normal.cross(x[(i + 2) % 3] - x[(i + 1) % 3]) / normal.squaredNorm();
    changes.row(k) << place.frame.u.dot(slope), place.frame.v.dot(slope);
  }
  return changes;
}

Place TargetSurface::walk(const Place& from, const Vector3& way) const {
  SurfacePoint at = from.at;
  Vector3 left = way;
  int entered = -1;
  for (int n = 0; n < most_faces; ++n) {
    const Corners x = corners(at.face);
    if (is_flat(x)) break;
    const Vector3 normal = normal_of(x);
    const Vector3 change = changes_along(left, x, normal);
    const auto [corner, part] = first_crossing(at.barycentric, change, entered);
    at.barycentric += part * change;
    if (corner < 0) break;
    at.barycentric[corner] = 0;
    at.barycentric = clamped(at.barycentric);
    const int first = (corner + 1) % 3, last = (corner + 2) % 3;  // of the edge
    const Halfedge in = topology_.twin(3 * at.face + first);
    const Corners y = corners(in / 3);
    const Vector3 edge = (x[last] - x[first]).normalized();
    left = unfolded((1 - part) * left, edge, normal.normalized(), normal_of(y).normalized());
    if (is_flat(y)) break;
    entered = (in % 3 + 2) % 3;
    at = seen_from_beyond(at, corner, in);
  }
  at.barycentric = clamped(at.barycentric);
  return place(at);
}

}  // namespace sphparam
