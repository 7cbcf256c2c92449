#include "cli/like_grid.h"

#include "cli/exit_codes.h"
#include "cli/mapped_source.h"
#include "cli/paths.h"
#include "cli/repairing.h"
#include "cli/source.h"
#include "cli/wording.h"
#include "mesh_io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam::tools {

SphereGrid read_like_grid(const std::string& path, int threads) {
  const Source source = read_source(path);
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
  grid.faces.corners.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  grid.faces.starts.resize(static_cast<size_t>(mesh.face_count()) + 1);
  for (size_t f = 0; f < grid.faces.starts.size(); ++f) {
    grid.faces.starts[f] = 3 * static_cast<int>(f);
  }
  return grid;
}

}  // namespace sphparam::tools
