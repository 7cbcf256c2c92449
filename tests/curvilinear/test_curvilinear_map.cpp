#include <catch2/catch.hpp>
#include <cstring>

#include "curvilinear/curvilinear_map.h"
#include "curvilinear/cut_sphere.h"
#include "curvilinear/quasi_harmonic.h"
#include "sphparam/sphere/certificate.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

TEST_CASE("curvilinear_map: the chart has no folds, whatever the mesh") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    const CurvilinearResult result = map_curvilinear(s.mesh, s.topology, s.poles);
    CHECK(result.planar_folds == 0);
    CHECK(is_induced(s.topology, result.date_line));
    CHECK((result.map.points.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
  }
}

TEST_CASE(
    "curvilinear_map: on a fine round mesh the lift is one-to-one as well, and right way out") {
  const CutSphere s(icosphere(4));
  CHECK(certify(s.topology, map_curvilinear(s.mesh, s.topology, s.poles).map).bijective());
}

TEST_CASE("curvilinear_map: every iteration that is kept lowers the area distortion") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    const CurvilinearResult result =
        map_curvilinear(s.mesh, s.topology, s.poles, {.iterations = 12});
    REQUIRE(result.area_distortion.size() == static_cast<size_t>(result.iterations) + 1);
    for (size_t i = 1; i < result.area_distortion.size(); ++i) {
      CHECK(result.area_distortion[i] < result.area_distortion[i - 1]);
    }
    CHECK(mean_abs_ln(area_distortion(s.mesh, result.map)) == result.area_distortion.back());
  }
}

TEST_CASE("curvilinear_map: fewer iterations are a prefix of more") {
  const CutSphere s(tube(15, 9));
  const CurvilinearResult two = map_curvilinear(s.mesh, s.topology, s.poles, {.iterations = 2});
  const CurvilinearResult four = map_curvilinear(s.mesh, s.topology, s.poles, {.iterations = 4});
  REQUIRE(two.iterations == 2);
  REQUIRE(four.area_distortion.size() > 2);
  CHECK(two.area_distortion[2] == four.area_distortion[2]);
}

TEST_CASE("curvilinear_map: the caps get the share of area that their stars have") {
  const CutSphere s(icosphere(3));
  const CurvilinearResult result = map_curvilinear(s.mesh, s.topology, s.poles, {.iterations = 0});
  double star = 0, whole = 0;
  for (Face f = 0; f < s.topology.face_count(); ++f) {
    const auto t = s.mesh.triangles.row(f);
    const Vector3 p = s.mesh.position(t[0]);
    const double a = (s.mesh.position(t[1]) - p).cross(s.mesh.position(t[2]) - p).norm();
    whole += a;
    if ((t.array() == s.poles.north).any()) star += a;
  }
  const Vector3 rim = result.map.point(s.cut.north_link()[0]);
  CHECK((1 - rim.z()) / 2 == Approx(star / whole));
}

TEST_CASE("curvilinear_map: it can be cancelled") {
  const CutSphere s(icosphere(2));
  int calls = 0;
  CHECK_THROWS_AS(map_curvilinear(s.mesh, s.topology, s.poles, {},
                                  [&](std::string_view, double) { return ++calls < 4; }),
                  Cancelled);
}

TEST_CASE("curvilinear_map: the same bytes for 1, 2 and 4 threads") {
  const CutSphere s(icosphere(5));
  const CurvilinearResult one = map_curvilinear(s.mesh, s.topology, s.poles, {.threads = 1});
  for (const int threads : {2, 4}) {
    const CurvilinearResult more =
        map_curvilinear(s.mesh, s.topology, s.poles, {.threads = threads});
    CHECK(std::memcmp(more.map.points.data(), one.map.points.data(),
                      sizeof(double) * static_cast<size_t>(one.map.points.size())) == 0);
  }
}
