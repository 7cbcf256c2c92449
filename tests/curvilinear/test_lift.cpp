#include <catch2/catch.hpp>

#include "curvilinear/cut_sphere.h"
#include "curvilinear/lift.h"
#include "sphparam/sphere/spherical_coordinates.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("lift: a lifted map lies on the sphere, its poles at z = 1 and z = -1") {
  const CutSphere s(tube(12, 6));
  const CurvilinearMap map =
      harmonic_map(s.mesh, s.topology, s.cut, cylinder_boundary(s.mesh, s.cut, 0.02, 0.02),
                   WeightKind::SymmetricMeanValue);
  const SphereMap sphere = lift(s.cut, map);
  for (Vertex v = 0; v < s.topology.vertex_count(); ++v) {
    CHECK(std::abs(sphere.point(v).norm() - 1) < 1e-15);
    if (s.cut.is_pole(v)) continue;
    const SphericalCoordinates back = to_spherical(sphere.point(v));
    CHECK(std::abs(back.phi - map.phi[v]) < 1e-12);
    CHECK(std::abs(std::remainder(back.theta - map.theta[v], 2 * std::numbers::pi)) < 1e-12);
  }
  CHECK(sphere.point(s.poles.north) == Vector3(0, 0, 1));
  CHECK(sphere.point(s.poles.south) == Vector3(0, 0, -1));
}
