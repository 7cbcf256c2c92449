#include <catch2/catch.hpp>
#include <numbers>

#include "maps.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/parameterize.h"
#include "support/instruction_limit.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Framed {
  SphericalChart chart;
  Points positions, normals;
  ShadingFrame frame;

  Framed(const TriangleMesh& mesh, const SphereMap& map, const Points& vertex_normals) {
    chart = spherical_chart(mesh, Topology(mesh), map);
    positions = carry_vertex_attribute(chart, mesh.triangles, mesh.positions);
    normals = carry_normals(chart, mesh.triangles, vertex_normals);
    frame = tangent_frame(chart, positions, normals);
  }
};

Framed framed_sphere(int level, unsigned seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh = icosphere(level);
  mesh.positions = rotated({mesh.positions}, random_rotation(random)).points;
  return {mesh, {mesh.positions}, mesh.positions};
}

void check_orthonormal(const ShadingFrame& frame) {
  for (Eigen::Index w = 0; w < frame.normals.rows(); ++w) {
    const Vector3 n = frame.normals.row(w), t = frame.tangents.row(w).head<3>();
    CHECK(std::abs(n.norm() - 1) < 1e-14);
    CHECK(std::abs(t.norm() - 1) < 1e-14);
    CHECK(std::abs(n.dot(t)) < 1e-14);
    CHECK(frame.tangents(w, 3) == 1);
  }
}

}  // namespace

TEST_CASE("tangent_frame: on the sphere itself tangents point east") {
  const Framed sphere = framed_sphere(4, 3);
  check_orthonormal(sphere.frame);
  for (int w = 0; w < static_cast<int>(sphere.chart.wedge_count()); ++w) {
    const double theta = 2 * std::numbers::pi * sphere.chart.uv(w, 0);
    const double phi = std::numbers::pi * sphere.chart.uv(w, 1);
    const Vector3 east(-std::sin(theta), std::cos(theta), 0);
    const Vector3 tangent = sphere.frame.tangents.row(w).head<3>();
    // Faces near the poles are coarse in θ.
    const double tolerance = std::sin(phi) > 0.5 ? 0.03 : 0.5;
    CHECK((tangent - east).norm() < tolerance);
  }
}

TEST_CASE("tangent_frame: the bitangent points to decreasing v") {
  const Framed sphere = framed_sphere(3, 4);
  for (int w = 0; w < static_cast<int>(sphere.chart.wedge_count()); ++w) {
    const Vector3 n = sphere.frame.normals.row(w), t = sphere.frame.tangents.row(w).head<3>();
    if (std::abs(n.z()) > 0.9) continue;
    CHECK((sphere.frame.tangents(w, 3) * n.cross(t)).z() > 0.3);
  }
}

TEST_CASE("tangent_frame: a vertex has the mean of where u grows in its faces, by their angles") {
  TriangleMesh mesh = random_sphere_mesh(60, 4);
  const SphereMap map = parameterize(mesh).map;
  const Framed framed(mesh, map, map.points);
  std::vector<Vector3> sums(framed.chart.surface_points.size(), Vector3::Zero());
  for (Face f = 0; f < static_cast<Face>(framed.chart.triangles.rows()); ++f) {
    const auto at = [&](int k) -> Vector3 {
      return framed.positions.row(framed.chart.triangles(f, k % 3));
    };
    const auto uv = [&](int k) -> Eigen::Vector2d {
      return framed.chart.uv.row(framed.chart.wedges(f, k));
    };
    Eigen::Matrix2d of_uv;
    of_uv << uv(1) - uv(0), uv(2) - uv(0);
    Eigen::Matrix<double, 3, 2> of_space;
    of_space << at(1) - at(0), at(2) - at(0);
    const Vector3 along = (of_space * of_uv.inverse()).col(0).normalized();
    for (int k = 0; k < 3; ++k) {
      const Vector3 a = (at(k + 1) - at(k)).normalized(), b = (at(k + 2) - at(k)).normalized();
      sums[static_cast<size_t>(framed.chart.triangles(f, k))] += std::acos(a.dot(b)) * along;
    }
  }
  int compared = 0;
  for (int w = 0; w < static_cast<int>(framed.chart.wedge_count()); ++w) {
    if (framed.chart.wedge_kinds[static_cast<size_t>(w)] == WedgeKind::PoleFan) continue;
    const Vector3
        sum = sums[static_cast<size_t>(framed.chart.wedge_vertices[static_cast<size_t>(w)])],
        normal = framed.frame.normals.row(w);
    const Vector3 wanted = (sum - sum.dot(normal) * normal).normalized();
    CHECK((framed.frame.tangents.row(w).head<3>().transpose() - wanted).norm() < 1e-6);
    ++compared;
  }
  CHECK(compared > 60);
}

TEST_CASE("tangent_frame: copies of a seam vertex have one frame, wedges of a pole their own") {
  const Framed sphere = framed_sphere(3, 5);
  int copies = 0, fans = 0;
  for (int w = 0; w < static_cast<int>(sphere.chart.wedge_count()); ++w) {
    const Vertex v = sphere.chart.wedge_vertices[static_cast<size_t>(w)];
    const auto kind = sphere.chart.wedge_kinds[static_cast<size_t>(w)];
    if (kind == WedgeKind::SeamCopy) {
      ++copies;
      CHECK(sphere.frame.tangents.row(w) == sphere.frame.tangents.row(v));
    } else if (kind == WedgeKind::PoleFan && w != v) {
      ++fans;
      CHECK((sphere.frame.tangents.row(w) - sphere.frame.tangents.row(v)).norm() > 0.1);
    }
  }
  CHECK(copies > 5);
  CHECK(fans > 3);
}

TEST_CASE("tangent_frame: is a frame also where triangles have no area, of any size") {
  const TriangleMesh mesh = random_sphere_mesh(80, 11);
  const SphereMap map = parameterize(mesh).map;
  TriangleMesh flat = mesh;
  for (Eigen::Index v = 0; v < 40; ++v) flat.positions.row(v) = flat.positions.row(v % 7);
  for (const double scale : {0.0, 1e-300, 1e-30, 1.0, 1e150, 1e300}) {
    TriangleMesh scaled = flat;
    scaled.positions *= scale;
    const Framed framed(scaled, map, map.points);
    check_orthonormal(framed.frame);
  }
}

TEST_CASE("tangent_frame: normals that cancel are replaced") {
  const TriangleMesh mesh = icosphere(1);
  std::mt19937 random(6);
  const SphereMap map = rotated({mesh.positions}, random_rotation(random));
  const Framed zero(mesh, map, Points::Zero(mesh.vertex_count(), 3));
  check_orthonormal(zero.frame);
  Points alternating = mesh.positions;
  for (Eigen::Index v = 0; v < alternating.rows(); v += 2) alternating.row(v) *= -1;
  check_orthonormal(Framed(mesh, map, alternating).frame);
}

TEST_CASE(
    "tangent_frame: normals of wedges that agree are those of vertices, others have their own") {
  const Framed sphere = framed_sphere(3, 8);
  const auto wedges = static_cast<int>(sphere.chart.wedge_count());
  Points spread(wedges, 3);
  for (int w = 0; w < wedges; ++w)
    spread.row(w) = sphere.normals.row(sphere.chart.wedge_vertices[static_cast<size_t>(w)]);
  const ShadingFrame same = tangent_frame(sphere.chart, sphere.positions, spread);
  CHECK(same.tangents == sphere.frame.tangents);
  CHECK(same.normals == sphere.frame.normals);

  // Every face flat: a wedge for each corner, and its tangent in the plane of its face.
  SphericalChart faceted = sphere.chart;
  const Eigen::Index corners = faceted.wedges.size();
  TextureCoordinates uv(corners, 2);
  Points flat(corners, 3);
  std::vector<Vertex> vertices;
  std::vector<WedgeKind> kinds;
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    const auto w = static_cast<size_t>(sphere.chart.wedges.data()[corner]);
    uv.row(corner) = sphere.chart.uv.row(static_cast<Eigen::Index>(w));
    vertices.push_back(sphere.chart.wedge_vertices[w]);
    kinds.push_back(sphere.chart.wedge_kinds[w]);
    const auto triangle = sphere.chart.triangles.row(corner / 3);
    const Vector3 a = sphere.positions.row(triangle[0]), b = sphere.positions.row(triangle[1]),
                  c = sphere.positions.row(triangle[2]);
    flat.row(corner) = (b - a).cross(c - a).normalized();
    faceted.wedges.data()[corner] = static_cast<int>(corner);
  }
  faceted.uv = uv;
  faceted.wedge_vertices = vertices;
  faceted.wedge_kinds = kinds;
  CHECK(certify_chart(faceted).one_to_one());
  const ShadingFrame frame = tangent_frame(faceted, sphere.positions, flat);
  check_orthonormal(frame);
  CHECK(frame.normals == flat);
  for (Eigen::Index corner = 0; corner < corners; corner += 3) {
    // One direction of growing u in a flat triangle.
    const Vector3 first = frame.tangents.row(corner).head<3>();
    for (int k = 1; k < 3; ++k)
      CHECK((first - frame.tangents.row(corner + k).head<3>().transpose()).norm() < 1e-12);
  }
}

TEST_CASE("tangent_frame: where normals are not the surface's, tangents lie in their plane") {
  // A normal of its own a corner, so that no two directions are summed.
  const Framed sphere = framed_sphere(2, 9);
  SphericalChart chart = sphere.chart;
  const Eigen::Index corners = chart.wedges.size();
  TextureCoordinates uv(corners, 2);
  Points flat(corners, 3);
  std::vector<Vertex> vertices;
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    const auto w = sphere.chart.wedges.data()[corner];
    uv.row(corner) = sphere.chart.uv.row(w);
    vertices.push_back(sphere.chart.wedge_vertices[static_cast<size_t>(w)]);
    const auto at = [&](int k) -> Vector3 {
      return sphere.positions.row(sphere.chart.triangles(corner / 3, k));
    };
    flat.row(corner) = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    chart.wedges.data()[corner] = static_cast<int>(corner);
  }
  chart.uv = uv;
  chart.wedge_vertices = vertices;
  chart.wedge_kinds.assign(vertices.size(), WedgeKind::Ordinary);
  const ShadingFrame frame = tangent_frame(chart, sphere.positions, flat);
  Points tilted = flat;
  for (Eigen::Index corner = 0; corner < corners; ++corner)
    tilted.row(corner) = (flat.row(corner) + 0.7 * frame.tangents.row(corner).head<3>() +
                          Vector3(0.01 * std::cos(corner), 0.2, 0.1).transpose())
                             .normalized();
  const ShadingFrame found = tangent_frame(chart, sphere.positions, tilted);
  check_orthonormal(found);
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    const Vector3 along = frame.tangents.row(corner).head<3>(), normal = tilted.row(corner);
    const Vector3 wanted = (along - along.dot(normal) * normal).normalized();
    CHECK((found.tangents.row(corner).head<3>().transpose() - wanted).norm() < 1e-12);
  }
}

TEST_CASE("tangent_frame: the same bytes for any number of threads, wrong sizes are refused") {
  const Framed sphere = framed_sphere(5, 7);
  for (const int threads : {1, 2, 5}) {
    const ShadingFrame frame =
        tangent_frame(sphere.chart, sphere.positions, sphere.normals, threads);
    CHECK(frame.tangents == sphere.frame.tangents);
    CHECK(frame.normals == sphere.frame.normals);
  }
  for (const InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2}) {
    const tests::InstructionLimit limit(set);
    CHECK(tangent_frame(sphere.chart, sphere.positions, sphere.normals).tangents ==
          sphere.frame.tangents);
  }
  CHECK_THROWS_AS(tangent_frame(sphere.chart, sphere.positions, Points::Zero(3, 3)),
                  std::invalid_argument);
  CHECK_THROWS_AS(tangent_frame(sphere.chart, Points::Zero(3, 3), sphere.normals),
                  std::invalid_argument);
}
