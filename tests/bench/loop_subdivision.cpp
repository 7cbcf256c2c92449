#include "loop_subdivision.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace sphparam::bench {
namespace {

/// (1 − kβ) v + β Σ ring, β = (5/8 − (3/8 + cos(2π/k)/4)²)/k.
Vector3 smoothed_vertex(const TriangleMesh& mesh, const Topology& topology, Vertex v) {
  Vector3 sum = Vector3::Zero();
  int k = 0;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    sum += mesh.position(topology.target(h));
    ++k;
  });
  const double q = 0.375 + std::cos(2 * std::numbers::pi / k) / 4;
  const double beta = (0.625 - q * q) / k;
  return (1 - k * beta) * mesh.position(v) + beta * sum;
}

/// 3/8 of both ends, 1/8 of both apexes.
Vector3 edge_point(const TriangleMesh& mesh, const Topology& topology, Halfedge h) {
  return 0.375 * (mesh.position(topology.origin(h)) + mesh.position(topology.target(h))) +
         0.125 * (mesh.position(topology.apex(h)) + mesh.position(topology.apex(topology.twin(h))));
}

}  // namespace

TriangleMesh loop_subdivided(const TriangleMesh& mesh) {
  const Topology topology(mesh);
  TriangleMesh result;
  result.positions.resize(mesh.vertex_count() + topology.edge_count(), 3);
  result.triangles.resize(4 * mesh.face_count(), 3);
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    result.positions.row(v) = smoothed_vertex(mesh, topology, v);
  }
  std::vector<Vertex> middle(static_cast<size_t>(topology.halfedge_count()));
  Vertex next = topology.vertex_count();
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    if (topology.twin(h) < h) continue;
    result.positions.row(next) = edge_point(mesh, topology, h);
    middle[static_cast<size_t>(h)] = middle[static_cast<size_t>(topology.twin(h))] = next++;
  }
  for (Face f = 0; f < topology.face_count(); ++f) {
    const Vertex a = topology.vertex(f, 0), b = topology.vertex(f, 1), c = topology.vertex(f, 2);
    const auto m = [&](int k) { return middle[static_cast<size_t>(3 * f + k)]; };
    result.triangles.row(4 * f) << a, m(0), m(2);
    result.triangles.row(4 * f + 1) << b, m(1), m(0);
    result.triangles.row(4 * f + 2) << c, m(2), m(1);
    result.triangles.row(4 * f + 3) << m(0), m(1), m(2);
  }
  return result;
}

}  // namespace sphparam::bench
