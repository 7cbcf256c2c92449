#include <catch2/catch.hpp>

#include "maps.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Charted {
  TriangleMesh mesh = random_sphere_mesh(60, 7);
  SphericalChart chart;

  Charted() {
    std::mt19937 random(1);
    const SphereMap map = rotated(parameterize(mesh).map, random_rotation(random));
    chart = spherical_chart(mesh, Topology(mesh), map);
  }
};

}  // namespace

TEST_CASE("attributes: refined positions lie in their source triangles, and cover their area") {
  const auto [mesh, chart] = Charted();
  const Attributes positions = carry_vertex_attribute(chart, mesh.triangles, mesh.positions);
  CHECK(positions.topRows(mesh.vertex_count()) == mesh.positions);
  // Vector areas of the children sum to that of the parent: same plane, nothing twice.
  Points left = Points::Zero(mesh.face_count(), 3);
  const auto area = [](const auto& p, const Triangles& t, Face f) -> Vector3 {
    const Vector3 a = p.row(t(f, 0)), b = p.row(t(f, 1)), c = p.row(t(f, 2));
    return (b - a).cross(c - a);
  };
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f)
    left.row(f) += area(mesh.positions, mesh.triangles, f);
  for (Face f = 0; f < static_cast<Face>(chart.triangles.rows()); ++f) {
    const Face parent = chart.source_faces[static_cast<size_t>(f)];
    const Vector3 child = area(positions, chart.triangles, f);
    left.row(parent) -= child;
    CHECK(child.dot(area(mesh.positions, mesh.triangles, parent)) > 0);
  }
  CHECK(left.cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("attributes: constants stay constant, whole columns with infinities are copied") {
  const auto [mesh, chart] = Charted();
  Attributes values = Attributes::Constant(mesh.vertex_count(), 2, 0.3);
  CHECK((carry_vertex_attribute(chart, mesh.triangles, values).array() - 0.3).abs().maxCoeff() <
        1e-15);
  values(5, 1) = std::numeric_limits<double>::infinity();
  const Attributes carried = carry_vertex_attribute(chart, mesh.triangles, values);
  CHECK(carried.topRows(mesh.vertex_count()) == values);
}

TEST_CASE("attributes: corners keep what differs across an edge of the source") {
  const auto [mesh, chart] = Charted();
  // A vertex attribute at the corners, shifted by the face: no two faces agree anywhere.
  const Attributes positions = carry_vertex_attribute(chart, mesh.triangles, mesh.positions);
  Attributes corners(mesh.triangles.size(), 3);
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    for (int k = 0; k < 3; ++k)
      corners.row(3 * f + k) = mesh.positions.row(mesh.triangles(f, k)).array() + 10.0 * f;
  }
  const Attributes carried = carry_corner_attribute(chart, mesh.triangles, corners);
  for (Face f = 0; f < static_cast<Face>(chart.triangles.rows()); ++f) {
    const double shift = 10.0 * chart.source_faces[static_cast<size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      const auto expected = positions.row(chart.triangles(f, k)).array() + shift;
      CHECK((carried.row(3 * f + k).array() - expected).abs().maxCoeff() < 1e-10);
    }
  }
}

TEST_CASE("attributes: the same bytes for any number of threads") {
  const TriangleMesh mesh = icosphere(5);
  std::mt19937 random(2);
  const SphereMap map = rotated({mesh.positions}, random_rotation(random));
  const SphericalChart chart = spherical_chart(mesh, Topology(mesh), map);
  const Attributes corners = Attributes::Random(mesh.triangles.size(), 2);
  for (const int threads : {1, 2, 5}) {
    CHECK(carry_vertex_attribute(chart, mesh.triangles, mesh.positions, threads) ==
          carry_vertex_attribute(chart, mesh.triangles, mesh.positions));
    CHECK(carry_corner_attribute(chart, mesh.triangles, corners, threads) ==
          carry_corner_attribute(chart, mesh.triangles, corners));
  }
}

TEST_CASE("attributes: faces pass theirs on, wrong sizes are refused") {
  const auto [mesh, chart] = Charted();
  Attributes numbers(mesh.face_count(), 1);
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) numbers(f, 0) = f;
  const Attributes carried = carry_face_attribute(chart, mesh.triangles, numbers);
  for (Face f = 0; f < static_cast<Face>(carried.rows()); ++f)
    CHECK(carried(f, 0) == chart.source_faces[static_cast<size_t>(f)]);
  CHECK_THROWS_AS(carry_vertex_attribute(chart, mesh.triangles, numbers), std::invalid_argument);
  CHECK_THROWS_AS(carry_corner_attribute(chart, mesh.triangles, numbers), std::invalid_argument);
  CHECK_THROWS_AS(carry_face_attribute(chart, mesh.triangles, mesh.positions),
                  std::invalid_argument);
}
