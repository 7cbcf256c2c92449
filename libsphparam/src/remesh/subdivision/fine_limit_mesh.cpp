// Where faces are no patches the control mesh is subdivided once: then every patch has neighbours
// of its own degree, and is cut as they are.

#include "remesh/subdivision/patch_net.h"
#include "sphparam/remesh/subdivision.h"

namespace sphparam {

TriangleMesh fine_limit_mesh(const SubdivisionFit& fit, const Polygons& faces, std::int64_t pieces,
                             int threads) {
  const Scheme scheme = fit.topology->scheme();
  ControlMesh control{faces, {fit.control}};
  if (!faces_are_patches(faces, scheme)) control = subdivide_to_quads(control);
  const std::int64_t patches = control.faces.count();
  int cuts = 2;
  while (cuts <= most_cuts && std::int64_t{cuts} * cuts * patches < pieces) ++cuts;
  const Points& points = control.points[0];
  const Tessellation fine = tessellate(control.faces, static_cast<int>(points.rows()), cuts);
  const std::vector<LimitPoint> limit =
      LimitSurface(control.faces, points, scheme).evaluate_all(fine.vertices, threads);
  TriangleMesh mesh;
  mesh.positions.resize(std::ssize(limit), 3);
  for (size_t v = 0; v < limit.size(); ++v)
    mesh.positions.row(static_cast<Eigen::Index>(v)) = limit[v].position;
  mesh.triangles = triangulate(mesh.positions, fine.faces).triangles;
  return mesh;
}

}  // namespace sphparam
