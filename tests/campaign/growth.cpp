#include "growth.h"

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam::campaign {

TriangleMesh with_limb(const TriangleMesh& mesh, Vertex v, int rings, const Vector3& step,
                       double taper) {
  const Topology topology(mesh);
  std::vector<Vertex> link;
  Vector3 centre = Vector3::Zero();
  topology.for_each_outgoing(v, [&](Halfedge h) {
    link.push_back(topology.target(h));
    centre += mesh.position(link.back());
  });
  const int k = static_cast<int>(link.size());
  centre /= k;
  TriangleMesh result = mesh;
  const auto first_new = static_cast<Vertex>(mesh.vertex_count());
  result.positions.conservativeResize(mesh.vertex_count() + rings * k, 3);
  double width = 1;
  for (int r = 0; r < rings; ++r) {
    width *= taper;
    for (int i = 0; i < k; ++i) {
      const Vector3 arm = mesh.position(link[static_cast<size_t>(i)]) - centre;
      result.positions.row(first_new + r * k + i) = centre + (r + 1) * step + width * arm;
    }
  }
  result.positions.row(v) = centre + (rings + 1) * step;

  const auto at = [&](int ring, int i) {
    return ring < 0 ? link[static_cast<size_t>(i % k)] : first_new + ring * k + i % k;
  };
  Eigen::Index row = mesh.face_count();
  result.triangles.conservativeResize(row + 2 * rings * k, 3);
  int i = 0;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    result.triangles.row(Topology::face(h)) << v, at(rings - 1, i), at(rings - 1, i + 1);
    for (int r = 0; r < rings; ++r) {
      result.triangles.row(row++) << at(r - 1, i), at(r - 1, i + 1), at(r, i);
      result.triangles.row(row++) << at(r - 1, i + 1), at(r, i + 1), at(r, i);
    }
    ++i;
  });
  return result;
}

TriangleMesh with_stack(const TriangleMesh& mesh, Face face, int depth, Stacking stacking,
                        Random& random) {
  TriangleMesh result = mesh;
  result.positions.conservativeResize(mesh.vertex_count() + depth, 3);
  result.triangles.conservativeResize(mesh.face_count() + 2 * depth, 3);
  Eigen::Index row = mesh.face_count();
  for (int i = 0; i < depth; ++i) {
    const auto v = static_cast<Vertex>(mesh.vertex_count()) + i;
    const Vertex a = result.triangles(face, 0), b = result.triangles(face, 1),
                 c = result.triangles(face, 2);
    result.positions.row(v) =
        (result.positions.row(a) + result.positions.row(b) + result.positions.row(c)) / 3;
    result.triangles.row(face) << v, a, b;
    result.triangles.row(row++) << v, b, c;
    result.triangles.row(row++) << v, c, a;
    // Fan: b and c stay. Spiral: v, c and then b leave in turn.
    if (stacking == Stacking::Fan) {
      face = static_cast<Face>(row) - 2;
    } else if (stacking == Stacking::Random && random.chance(2.0 / 3)) {
      face = static_cast<Face>(row) - random.between(1, 2);
    }
  }
  return result;
}

}  // namespace sphparam::campaign
