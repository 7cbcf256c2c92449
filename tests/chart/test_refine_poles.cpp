#include <catch2/catch.hpp>

#include "maps.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/refine_poles.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

double surface_area(const Points& p, const Triangles& t) {
  double area = 0;
  for (Eigen::Index f = 0; f < t.rows(); ++f) {
    const Vector3 a = p.row(t(f, 0)), b = p.row(t(f, 1)), c = p.row(t(f, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

int pole_faces(const SphericalChart& chart) {
  int count = 0;
  for (Face f = 0; f < static_cast<Face>(chart.triangles.rows()); ++f)
    count += chart.pole_corner(f) >= 0;
  return count;
}

}  // namespace

TEST_CASE("refine_poles: a certified chart of the same surface, each pole triangle in n") {
  std::mt19937 random(5);
  for (const TriangleMesh& mesh :
       {tetrahedron(), octahedron(), icosphere(2), uv_sphere(9, 4), random_sphere_mesh(60, 3)}) {
    const SphereMap map = rotated(parameterize(mesh).map, random_rotation(random));
    const SphericalChart chart = spherical_chart(mesh, Topology(mesh), map);
    REQUIRE(chart.certificate.one_to_one());
    for (const int wedges : {2, 3, 8}) {
      const SphericalChart fine = refine_poles(chart, mesh.triangles, wedges);
      CHECK(fine.certificate.one_to_one());
      CHECK(pole_faces(fine) == wedges * pole_faces(chart));
      const Points positions = carry_vertex_attribute(fine, mesh.triangles, mesh.positions);
      CHECK(surface_area(positions, fine.triangles) ==
            Approx(surface_area(mesh.positions, mesh.triangles)));
      CHECK(static_cast<Eigen::Index>(fine.wedge_kinds.size()) == fine.wedge_count());
      CHECK(static_cast<Eigen::Index>(fine.source_faces.size()) == fine.triangles.rows());
    }
  }
}

TEST_CASE("refine_poles: also where a triangle has two sides about a pole, or all") {
  std::mt19937 random(6);
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const TriangleMesh mesh = random_sphere_mesh(8, seed);
    const SphereMap map = rotated(parameterize(mesh).map, random_rotation(random));
    const SphericalChart chart = spherical_chart(mesh, Topology(mesh), map);
    REQUIRE(chart.certificate.one_to_one());
    CHECK(refine_poles(chart, mesh.triangles, 3).certificate.one_to_one());
  }
}

TEST_CASE("refine_poles: outside the caps every vertex keeps its (u, v)") {
  const TriangleMesh mesh = icosphere(3);
  std::mt19937 random(8);
  const SphericalChart chart =
      spherical_chart(mesh, Topology(mesh), rotated({mesh.positions}, random_rotation(random)));
  const SphericalChart fine = refine_poles(chart, mesh.triangles, 5);
  for (Vertex v = 0; v < static_cast<Vertex>(chart.points.rows()); ++v) {
    if (chart.wedge_kinds[static_cast<size_t>(v)] == WedgeKind::PoleFan) continue;
    CHECK(fine.uv.row(v) == chart.uv.row(v));
  }
}

TEST_CASE("refine_poles: one wedge changes nothing, an uncertified chart is refused") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  std::mt19937 random(9);
  const SphereMap map = rotated({mesh.positions}, random_rotation(random));
  const SphericalChart chart = spherical_chart(mesh, topology, map);
  CHECK(refine_poles(chart, mesh.triangles, 1).wedges == chart.wedges);
  CHECK_THROWS_AS(refine_poles(wrapped_chart(mesh, topology, map), mesh.triangles, 4),
                  std::invalid_argument);
}

TEST_CASE("refine_poles: more wedges than numbers for them are refused") {
  const TriangleMesh mesh = icosphere(2);
  std::mt19937 random(9);
  const SphereMap map = rotated({mesh.positions}, random_rotation(random));
  const SphericalChart chart = spherical_chart(mesh, Topology(mesh), map);
  CHECK_THROWS_WITH(refine_poles(chart, mesh.triangles, 1 << 30), Catch::Contains("2^31"));
}
