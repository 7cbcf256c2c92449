// A limit surface is cut fine: patches into so many pieces that their flatness is not what is seen.

#include "cli/remesh_level.h"

#include "remesh/patch_net.h"

namespace sphparam::tools {

namespace {

constexpr std::int64_t pieces_of_limit_surface = 250'000;

TriangleMesh fine_limit_mesh(const SubdivisionFit& fit, const Polygons& faces, int threads) {
  ControlMesh control{faces, {fit.control}};
  if (!faces_are_patches(faces, fit.topology->scheme())) control = subdivide_to_quads(control);
  int cuts = 2;
  while (cuts * cuts * control.faces.count() < pieces_of_limit_surface) ++cuts;
  const Tessellation fine =
      tessellate(control.faces, static_cast<int>(control.points[0].rows()), cuts);
  const auto points = LimitSurface(control.faces, control.points[0], fit.topology->scheme())
                          .evaluate_all(fine.vertices, threads);
  TriangleMesh mesh;
  mesh.positions.resize(std::ssize(points), 3);
  for (size_t v = 0; v < points.size(); ++v)
    mesh.positions.row(static_cast<Eigen::Index>(v)) = points[v].position;
  mesh.triangles = triangulate(mesh.positions, fine.faces).triangles;
  return mesh;
}

}  // namespace

TriangleMesh shown_mesh(const RemeshLevel& level) {
  return level.fit ? fine_limit_mesh(*level.fit, level.mesh.faces, level.arguments.threads)
                   : level.mesh.file.mesh;
}

}  // namespace sphparam::tools
