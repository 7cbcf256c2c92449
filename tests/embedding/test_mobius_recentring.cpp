#include <catch2/catch.hpp>

#include "embedding/frame/mobius_recentring.h"
#include "sphparam/embedding/distortion_energy.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("recentre: finds the way back from a Möbius transformation, lower at every step") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const auto energy_of = [&](const std::vector<ImagePoint>& image) {
    SphereMap map;
    map.points.resize(topology.vertex_count(), 3);
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      map.points.row(v) = image[static_cast<size_t>(v)].vector().transpose();
    }
    return distortion_energy(topology, source, map, {});
  };
  // x ↦ (1 − |a|²) (x + a) / |x + a|² + a
  const Vector3 a(0.3, -0.2, 0.4);
  std::vector<ImagePoint> image, centred;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v).normalized(), y = x + a;
    centred.push_back(image_point(x));
    image.push_back(image_point(((1 - a.squaredNorm()) * y / y.squaredNorm() + a).normalized()));
  }
  const double least = energy_of(centred);
  double energy = energy_of(image);
  REQUIRE(energy > 1.1 * least);
  for (int i = 0; i < 10; ++i) {
    const double after = recentre(image, energy, energy_of, 1);
    CHECK(after <= energy);
    CHECK(after == energy_of(image));
    energy = after;
  }
  CHECK(energy == Approx(least).epsilon(1e-4));
}
