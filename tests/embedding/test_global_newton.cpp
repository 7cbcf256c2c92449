#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "embedding/energy/map_image.h"
#include "embedding/newton/global_newton.h"
#include "sphparam/sphere/certificate.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double every_iteration = 1e-6;  // that brings so much

struct Map {
  TriangleMesh mesh;
  Topology topology{mesh};
  std::vector<ImagePoint> image;
  GlobalNewton newton;

  Map(const TriangleMesh& m, Quality quality)
      : mesh(m),
        image(image_of(*embed_progressively(mesh, topology, {.quality = quality}).map)),
        newton(topology, measure_source(mesh), image, {}, 1) {}
};

}  // namespace

TEST_CASE("Newton steps: near a minimum exact ones leave next to nothing, projected ones a part") {
  for (const TriangleMesh& mesh : {tube(20, 12), dumbbell(5, 0.1, 8), brush(1, 3, 3, 8)}) {
    double left[2];
    for (const Curvature curvature : {Curvature::Projected, Curvature::Exact}) {
      Map map(mesh, Quality::Best);
      for (int n = 0; n < 10; ++n) map.newton.step({}, every_iteration, Curvature::Exact);
      const double least = map.newton.energy({});
      for (int n = 0; n < 5; ++n) map.newton.step({.lambda = 1.01}, every_iteration);
      const double before = map.newton.energy({}) - least;
      for (int n = 0; n < 2; ++n) map.newton.step({}, every_iteration, curvature);
      left[curvature == Curvature::Exact] = (map.newton.energy({}) - least) / before;
    }
    CAPTURE(left[0], left[1]);
    CHECK(left[1] < 1e-3);
    CHECK(left[0] > 10 * left[1]);
  }
}

TEST_CASE("Newton steps: far from a minimum exact ones lower the energy, or projected ones do") {
  int projected = 0;
  for (const TriangleMesh& mesh : {dumbbell(30, 0.02, 8), brush(1, 5, 10, 30), tube(200, 12)}) {
    Map map(mesh, Quality::Draft);
    const double draft = map.newton.energy({});
    map.newton.step({.lambda = 100}, every_iteration);  // as if areas were all that counts
    double energy = map.newton.energy({});
    CHECK(energy > draft);
    for (int n = 0; n < 20; ++n) {
      const GlobalNewton::Step made = map.newton.step({}, every_iteration, Curvature::Exact);
      projected += made.curvature == Curvature::Projected;
      CHECK(made.energy <= energy);
      energy = made.energy;
    }
    CHECK(energy < draft);
    map.newton.write_to(map.image);
    CHECK(certify(map.topology, map_of(map.image)).bijective());
  }
  CHECK(projected > 0);
  CHECK(projected < 60);
}
