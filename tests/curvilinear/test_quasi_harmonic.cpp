#include <catch2/catch.hpp>
#include <cmath>

#include "curvilinear/cut_sphere.h"
#include "curvilinear/lift.h"
#include "curvilinear/quasi_harmonic.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

TEST_CASE("quasi_harmonic: kappa is 1 where areas agree, whatever the scale") {
  // The chords of a level subdivision have nearly, those of the icosahedron exactly, equal shares.
  TriangleMesh mesh = icosahedron();
  const SphereMap map{mesh.positions.rowwise().normalized()};
  mesh.positions *= 17;
  for (const double kappa : area_distortion(mesh, map)) CHECK(kappa == Approx(1));
  CHECK(mean_abs_ln(area_distortion(mesh, map)) < 1e-12);
}

TEST_CASE("quasi_harmonic: the source area's mean of kappa is 1") {
  const TriangleMesh mesh = tube(20, 8);
  SphereMap map{mesh.positions.rowwise() - mesh.positions.colwise().mean()};
  map.points.rowwise().normalize();
  const std::vector<double> kappa = area_distortion(mesh, map);
  double weighted = 0, area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.triangles.row(f);
    const Vector3 p = mesh.position(t[0]);
    const double a = (mesh.position(t[1]) - p).cross(mesh.position(t[2]) - p).norm();
    weighted += a * kappa[static_cast<size_t>(f)];
    area += a;
  }
  CHECK(weighted / area == Approx(1).epsilon(1e-12));
  CHECK(mean_abs_ln(kappa) > 0.1);
}

TEST_CASE("quasi_harmonic: areas are those of spherical triangles") {
  // An octant: a vertex of the octahedron's face moved to make one face half of its neighbour.
  TriangleMesh mesh = octahedron();
  const std::vector<double> kappa = area_distortion(mesh, {mesh.positions});
  for (const double k : kappa) CHECK(k == Approx(1));
  // Sixteen times as many faces of an icosphere: their areas sum up to the whole sphere.
  const TriangleMesh fine = icosphere(2);
  TriangleMesh flat = fine;
  double sum = 0;
  const std::vector<double> ratio = area_distortion(flat, {fine.positions});
  double source = 0;
  for (Face f = 0; f < flat.face_count(); ++f) {
    const auto t = flat.triangles.row(f);
    const Vector3 p = flat.position(t[0]);
    const double a = 0.5 * (flat.position(t[1]) - p).cross(flat.position(t[2]) - p).norm();
    const Vector3 x = fine.position(t[0]), y = fine.position(t[1]), z = fine.position(t[2]);
    // Girard: the area is the sum of the angles less π.
    const auto angle = [](const Vector3& u, const Vector3& v, const Vector3& w) {
      const Vector3 m = u.cross(v), n = u.cross(w);
      return std::atan2(m.cross(n).norm(), m.dot(n));
    };
    const double girard = angle(x, y, z) + angle(y, z, x) + angle(z, x, y) - std::numbers::pi;
    sum += girard;
    source += a;
    CHECK(ratio[static_cast<size_t>(f)] * a == Approx(girard).epsilon(0.05));
  }
  CHECK(sum == Approx(4 * std::numbers::pi));
  for (Face f = 0; f < flat.face_count(); ++f) CHECK(std::isfinite(ratio[static_cast<size_t>(f)]));
  CHECK(source < sum);
}

TEST_CASE("quasi_harmonic: kappa is positive and finite for triangles of no area") {
  TriangleMesh mesh = icosphere(2);
  SphereMap map{mesh.positions};
  mesh.positions.row(mesh.triangles(0, 1)) = mesh.positions.row(mesh.triangles(0, 0));
  map.points.row(mesh.triangles(50, 1)) = map.points.row(mesh.triangles(50, 0));
  for (const double kappa : area_distortion(mesh, map)) {
    CHECK(kappa > 0);
    CHECK(std::isfinite(kappa));
  }
}

TEST_CASE("quasi_harmonic: powers of kappa accumulate") {
  std::vector<double> accumulated;
  accumulate_kappa(accumulated, {4, 9, 1}, 0.5);
  CHECK(accumulated == std::vector<double>{2, 3, 1});
  accumulate_kappa(accumulated, {16, 1, 0.25}, 0.5);
  CHECK(accumulated == std::vector<double>{8, 3, 0.5});
  accumulate_kappa(accumulated, {2, 3, 4}, 1);
  CHECK(accumulated == std::vector<double>{16, 9, 2});
}

TEST_CASE("quasi_harmonic: constant kappa gives the initial map again") {
  const CutSphere s(icosphere(3));
  const EdgeWeights weights(s.mesh, s.topology, WeightKind::SymmetricMeanValue);
  HarmonicSolver solver(s.topology, s.cut, cylinder_boundary(s.mesh, s.cut, 0.02, 0.02), true);
  const CurvilinearMap initial = solver.solve(weights.with(s.topology));
  const std::vector<double> kappa(static_cast<size_t>(s.topology.face_count()), 3.7);
  const CurvilinearMap again = solver.solve(weights.with(s.topology, kappa));
  CHECK((initial.theta - again.theta).cwiseAbs().maxCoeff() < 1e-10);
  CHECK((initial.phi - again.phi).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("quasi_harmonic: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(5);
  TriangleMesh source = mesh;
  source.positions.col(2) *= 3;
  const std::vector<double> one = area_distortion(source, {mesh.positions}, 1);
  for (const int threads : {2, 4}) {
    CHECK(area_distortion(source, {mesh.positions}, threads) == one);
    CHECK(mean_abs_ln(one, threads) == mean_abs_ln(one, 1));
  }
}
