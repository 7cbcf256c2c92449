#include "commands/like_grid.h"

#include "console/exit_codes.h"
#include "sphparam/io/mapped_mesh.h"
#include "console/paths.h"
#include "commands/repairing.h"
#include "commands/source.h"
#include "reports/wording.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam::cli {

SphereGrid read_like_grid(const std::string& path, int threads) {
  const MeshSource source = read_source(path);
  require_mappable(source);
  const TriangleMesh& mesh = source.file.mesh;
  SphereMap map = read_sphere(source.file).value_or(SphereMap{mesh.positions});
  const Topology topology(mesh, threads);
  Certificate certificate = certify(topology, map, threads);
  if (certificate.bijective()) {
    map = unit_rays(std::move(map));
    certificate = certify(topology, map, threads);
  }
  if (!certificate.bijective()) {
    throw NotCertifiedError(display_name(path) + ": no sphere about the origin: " +
                            verdict(certificate) + "\n" + complaint(certificate));
  }
  SphereGrid grid;
  grid.directions = std::move(map.points);
  grid.faces = triangles_as_polygons(mesh.triangles);
  return grid;
}

}  // namespace sphparam::cli
