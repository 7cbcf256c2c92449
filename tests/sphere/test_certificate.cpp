#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

Certificate certify_rays(const TriangleMesh& mesh, const Points& rays, int threads = 1) {
  return certify(Topology(mesh), SphereMap{rays}, threads);
}

}  // namespace

TEST_CASE("certificate: a convex polyhedron around the origin is mapped one-to-one") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), icosphere(3), uv_sphere(17, 9)}) {
    const Certificate certificate = certify_rays(mesh, mesh.positions);
    CHECK(certificate.bijective());
    CHECK(certificate.degree == 1);
    CHECK(certificate.covering == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("certificate: the length of a ray does not matter") {
  const TriangleMesh mesh = icosphere(2);
  Points rays = mesh.positions;
  for (Eigen::Index v = 0; v < rays.rows(); ++v)
    rays.row(v) *= std::ldexp(1.0, static_cast<int>(v % 90) - 45);
  const Certificate certificate = certify_rays(mesh, rays);
  CHECK(certificate.bijective());
  CHECK(certificate.max_length_error > 1e9);
}

TEST_CASE("certificate: the sphere that winds k times has only positive signs and is refused") {
  for (const int turns : {2, 3}) {
    const TriangleMesh mesh = uv_sphere(12, 5);
    const Certificate certificate = certify_rays(mesh, wound_rays(12, 5, turns));
    CHECK(certificate.folded.empty());
    CHECK(certificate.degenerate.empty());
    CHECK(certificate.degree == turns);
    CHECK(certificate.covering == Approx(turns).epsilon(1e-12));
    CHECK(certificate.branch_vertices == std::vector<Vertex>{0, 61});  // the two poles
    CHECK_FALSE(certificate.bijective());
  }
}

TEST_CASE("certificate: a planted fold is found, and only its faces") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  Points rays = mesh.positions;
  // One vertex pushed across the far edge of one of its faces.
  const Vertex v = 100;
  const Halfedge opposite = Topology::next(topology.outgoing(v));
  const Vector3 middle =
      (mesh.position(topology.origin(opposite)) + mesh.position(topology.target(opposite))) / 2;
  rays.row(v) = (middle + 0.3 * (middle - mesh.position(v))).normalized();
  const Certificate certificate = certify_rays(mesh, rays);
  CHECK_FALSE(certificate.bijective());
  REQUIRE_FALSE(certificate.folded.empty());
  CHECK(std::count(certificate.folded.begin(), certificate.folded.end(),
                   Topology::face(opposite)) == 1);
  for (const Face f : certificate.folded) {
    CHECK((mesh.triangles.row(f).array() == v).any());
  }
}

TEST_CASE("certificate: a triangle without area is not positive") {
  const TriangleMesh mesh = icosphere(2);
  Points rays = mesh.positions;
  rays.row(20) = rays.row(Topology(mesh).target(Topology(mesh).outgoing(20)));
  const Certificate certificate = certify_rays(mesh, rays);
  CHECK(certificate.degenerate.size() >= 2);
  CHECK_FALSE(certificate.bijective());
}

TEST_CASE("certificate: a reversed sphere is named as such") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.col(0).swap(mesh.triangles.col(1));
  const Certificate certificate = certify_rays(mesh, mesh.positions);
  CHECK(certificate.reversed);
  CHECK(certificate.covering == Approx(-1));
  CHECK_FALSE(certificate.bijective());
  const Certificate of_nothing = certify_rays({}, {});
  CHECK_FALSE(of_nothing.reversed);
  CHECK_FALSE(of_nothing.bijective());
}

TEST_CASE("certificate: rays that are no directions are refused before any arithmetic") {
  const TriangleMesh mesh = icosphere(1);
  for (const Vector3& bad :
       {Vector3(0, 0, 0), Vector3(std::numeric_limits<double>::quiet_NaN(), 0, 1),
        Vector3(std::numeric_limits<double>::infinity(), 0, 1), Vector3(1e30, 0, 0)}) {
    Points rays = mesh.positions;
    rays.row(5) = bad;
    const Certificate certificate = certify_rays(mesh, rays);
    CHECK(certificate.unusable_points == std::vector<Vertex>{5});
    CHECK_FALSE(certificate.bijective());
  }
}

TEST_CASE("certificate: random rays agree with an overlap oracle") {
  // The oracle: a map is one-to-one when sampled directions each lie in exactly one triangle of
  // positive determinant and no triangle is folded, computed in floating point.
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vector3(normal(random), normal(random), normal(random)).normalized();
  };
  int accepted = 0;
  for (int round = 0; round < 400; ++round) {
    const TriangleMesh mesh = octahedron();
    Points rays = mesh.positions;
    for (Eigen::Index v = 0; v < 6; ++v) rays.row(v) += 1.3 * direction();
    bool once_everywhere = true;
    for (int sample = 0; sample < 300 && once_everywhere; ++sample) {
      const Vector3 r = direction();
      int covered = 0;
      for (Eigen::Index f = 0; f < 8; ++f) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) corners.col(k) = rays.row(mesh.triangles(f, k));
        covered += (corners.inverse() * r).minCoeff() > 0;
      }
      once_everywhere = covered == 1;
    }
    const bool certified = certify_rays(mesh, rays).bijective();
    if (certified) REQUIRE(once_everywhere);
    if (!once_everywhere) REQUIRE_FALSE(certified);
    accepted += certified;
  }
  CHECK(accepted > 20);
  CHECK(accepted < 400);
}

TEST_CASE("certificate: a map of another number of rays is refused") {
  const TriangleMesh mesh = icosphere(1);
  for (const Points& rays : {Points(), Points(mesh.positions.topRows(41)), icosphere(2).positions})
    CHECK_THROWS_AS(certify_rays(mesh, rays), std::invalid_argument);
}

TEST_CASE("certificate: the same for any number of threads") {
  const TriangleMesh mesh = icosphere(5);
  Points rays = mesh.positions;
  rays.row(77) *= -1;
  const Certificate one = certify_rays(mesh, rays, 1);
  for (const int threads : {2, 4}) {
    const Certificate many = certify_rays(mesh, rays, threads);
    CHECK(many.folded == one.folded);
    CHECK(many.covering == one.covering);
  }
}
