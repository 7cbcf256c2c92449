#pragma once

#include <stdexcept>

#include "curvilinear/cut_mesh.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

/// A mesh with everything that the stages after the cut need.
struct CutSphere {
  explicit CutSphere(TriangleMesh surface)
      : mesh(std::move(surface)),
        topology(mesh),
        poles(choose_poles(mesh, topology).value()),
        cut(topology, induced_date_line(topology, shortest_date_line(mesh, topology, poles))) {}

  TriangleMesh mesh;
  Topology topology;
  Poles poles;
  CutMesh cut;
};

/// Meshes of different characters that all have usable poles.
inline std::vector<TriangleMesh> various_spheres() {
  return {icosphere(2),
          icosphere(4),
          uv_sphere(3, 5),
          uv_sphere(24, 11),
          tube(30, 7),
          random_sphere_mesh(200, 1),
          random_sphere_mesh(200, 2),
          random_sphere_mesh(1000, 3)};
}

}  // namespace sphparam::tests
