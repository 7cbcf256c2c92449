#include "sphparam/baselines/stereographic.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "baselines/harmless_mesh.h"
#include "baselines/outcome.h"
#include "baselines/vertex_system.h"
#include "elementary.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphparam/mesh/edge_weights.h"

// D (u + iv) = a + ib with D_PQ = −½(cot R + cot S) and, for the cut triangle ABC with E = A + θ(B
// − A) the foot of the height from C,
//   a + ib = −1/|B−A| − i(1−θ)/|C−E| at A,  1/|B−A| − iθ/|C−E| at B,  i/|C−E| at C,
// the gradient of a linear function on ABC (their formula, with the sign of v for triangles that
// are counter-clockwise seen from outside). D is singular: vertex C stays at 0.

namespace sphparam {
namespace {

using Plane = Eigen::Matrix<double, Eigen::Dynamic, 2>;

std::array<Vector3, 3> corners(const TriangleMesh& mesh, Face f) {
  const auto t = mesh.triangles.row(f);
  return {mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2])};
}

/// The largest triangle with angles between 30° and 120°; of all, if there is none.
Face triangle_to_cut(const TriangleMesh& mesh) {
  Face best = 0;
  double best_area = -1;
  bool best_is_round = false;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto p = corners(mesh, f);
    const double twice_area = doubled_area(p[0], p[1], p[2]);
    bool is_round = twice_area > 0;
    for (size_t k = 0; k < 3; ++k) {
      const Vector3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      const double angle = elementary::atan2(twice_area, a.dot(b));
      is_round = is_round && angle >= std::numbers::pi / 6 && angle <= 2 * std::numbers::pi / 3;
    }
    if (is_round < best_is_round || (is_round == best_is_round && twice_area <= best_area))
      continue;
    best = f;
    best_area = twice_area;
    best_is_round = is_round;
  }
  return best;
}

Plane right_side(const TriangleMesh& mesh, Face cut) {
  const auto [a, b, c] = corners(mesh, cut);
  const double base = (b - a).norm();
  const double theta = (c - a).dot(b - a) / (base * base);
  const double height = (c - (a + theta * (b - a))).norm();
  Plane side = Plane::Zero(mesh.vertex_count(), 2);
  side.row(mesh.triangles(cut, 0)) << -1 / base, -(1 - theta) / height;
  side.row(mesh.triangles(cut, 1)) << 1 / base, -theta / height;
  side.row(mesh.triangles(cut, 2)) << 0, 1 / height;
  return side;
}

Plane solve_plane(const TriangleMesh& mesh, const Topology& topology, Face cut, int threads) {
  const EdgeWeights cotangent(mesh, topology, WeightKind::Cotangent, threads);
  std::vector<double> entries = cotangent.with(topology, {}, threads);
  std::vector<double> diagonal(static_cast<size_t>(topology.vertex_count()), 0);
  const Vertex pinned = topology.vertex(cut, 2);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    double& w = entries[static_cast<size_t>(h)];
    diagonal[static_cast<size_t>(topology.origin(h))] += w;
    w = topology.origin(h) == pinned || topology.target(h) == pinned ? 0 : -w;
  }
  diagonal[static_cast<size_t>(pinned)] = 1;
  Plane side = right_side(mesh, cut);
  side.row(pinned).setZero();
  VertexSystem system(topology, 1);
  system.factorise(diagonal, entries);
  return system.solve(side);
}

double median(VectorX values) {
  double* middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

/// The inverse of the projection from the north pole: (2u, 2v, r² − 1) / (r² + 1).
SphereMap to_sphere(Plane plane) {
  for (int k = 0; k < 2; ++k) plane.col(k).array() -= median(plane.col(k));
  const double scale = median(plane.rowwise().norm());
  if (scale > 0) plane /= scale;
  SphereMap map{Points(plane.rows(), 3)};
  for (Eigen::Index v = 0; v < plane.rows(); ++v) {
    const double r2 = plane.row(v).squaredNorm();
    const Vector3 x(2 * plane(v, 0), 2 * plane(v, 1), r2 - 1);
    map.points.row(v) = (x / (r2 + 1)).normalized();
  }
  return map;
}

}  // namespace

BaselineResult map_stereographic(const TriangleMesh& given, const Topology& topology,
                                 const StereographicOptions& options, const Progress& progress) {
  if (options.cut) {
    require_between("cut", *options.cut, 0, static_cast<double>(given.face_count() - 1));
  }
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  return run_rival([&](Outcome& outcome) {
    report(progress, "conformal map to the plane", 0);
    const Face cut = options.cut.value_or(triangle_to_cut(mesh));
    Plane plane = solve_plane(mesh, topology, cut, options.threads);
    outcome.finish_stage("conformal map to the plane");
    SphereMap map = to_sphere(std::move(plane));
    outcome.finish_stage("inverse stereographic projection");
    return outcome.take(std::move(map), BaselineEnd::Converged,
                        "solved; triangle " + std::to_string(cut) + " lies around infinity");
  });
}

}  // namespace sphparam
