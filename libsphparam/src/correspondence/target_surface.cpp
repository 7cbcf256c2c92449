#include "correspondence/target_surface.h"

#include <cmath>
#include <numbers>

#include "correspondence/surface_area.h"
#include "mesh/flat_face.h"
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
  if (is_flat(x[0], x[1], x[2])) {
    frame.u = frame.v = frame.of_u = frame.of_v = frame.turn_u = frame.turn_v = Vector3::Zero();
    return;
  }
  const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
  const TangentFrame tangents = tangent_frame(normal.normalized());
  const double length = ray.norm();
  const auto change = [&](const Vector3& way, Vector3& position, Vector3& direction) {
    position.setZero();
    direction.setZero();
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      const Vector3 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
      const double weight = way.dot(normal.cross(edge)) / normal.squaredNorm();
      position += weight * rounded[i] + w[k] * (way - normals[i].dot(way) * normals[i]);
      direction += weight * rays[i];
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
  if (is_flat(x[0], x[1], x[2])) return changes;
  const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
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
    if (is_flat(x[0], x[1], x[2])) break;
    const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
    Vector3 change;
    for (int k = 0; k < 3; ++k) {
      const Vector3 edge = x[(k + 2) % 3] - x[(k + 1) % 3];
      change[k] = left.dot(normal.cross(edge)) / normal.squaredNorm();
    }
    const Crossing crossing = first_crossing(at.barycentric, change, entered);
    at.barycentric += crossing.part * change;
    if (crossing.corner < 0) break;
    at.barycentric[crossing.corner] = 0;
    at.barycentric = clamped(at.barycentric);
    const Halfedge out = 3 * at.face + (crossing.corner + 1) % 3, in = topology_.twin(out);
    const Vector3 from_corner = x[(crossing.corner + 1) % 3], to = x[(crossing.corner + 2) % 3];
    const Vector3 along = (to - from_corner).normalized();
    const Vector3 across = along.cross(normal.normalized());  // out of the face
    const Face next = in / 3;
    const Corners y = corners(next);
    const Vector3 next_normal = (y[1] - y[0]).cross(y[2] - y[0]).normalized();
    left *= 1 - crossing.part;
    left = left.dot(along) * along + left.dot(across) * along.cross(next_normal);
    const int corner = in % 3;  // in: from `to` to `from_corner`
    Vector3 weights = Vector3::Zero();
    weights[corner] = at.barycentric[(crossing.corner + 2) % 3];
    weights[(corner + 1) % 3] = at.barycentric[(crossing.corner + 1) % 3];
    if (is_flat(y[0], y[1], y[2])) break;
    entered = (corner + 2) % 3;
    at = {next, weights};
  }
  at.barycentric = clamped(at.barycentric);
  return place(at);
}

}  // namespace sphparam
