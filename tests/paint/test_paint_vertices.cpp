#include <catch2/catch.hpp>

#include "paint/paint_vertices.h"
#include "srgb_curves.h"
#include "support/direction_image.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

Image painted(const TriangleMesh& mesh, const TexturePyramid& pyramid, int threads = 0) {
  return paint_vertices(Topology(mesh), normalised(mesh.positions),
                        EquirectangularImage(pyramid, Convention::Sphparam), {}, threads);
}

}  // namespace

TEST_CASE("paint_vertices: an image of directions paints each vertex with its direction") {
  const TexturePyramid pyramid(direction_image(256), true);
  for (const TriangleMesh& mesh : {icosphere(4), uv_sphere(40, 19)}) {
    const SphereMap map = normalised(mesh.positions);
    const Image colours = painted(mesh, pyramid);
    REQUIRE(colours.width == mesh.vertex_count());
    double worst = 0;
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      for (int c = 0; c < 3; ++c) {
        const double linear = SrgbCurves::get().to_linear(colours.pixel(v, 0)[c]);
        worst = std::max(worst, std::abs(2 * linear - 1 - map.point(v)[c]));
      }
    }
    CHECK(worst < 20.0 / static_cast<double>(mesh.vertex_count()));  // falls as cells do
  }
}

TEST_CASE("paint_vertices: a constant stays constant") {
  const TexturePyramid pyramid(uniform_image(64, 0.6F));
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(3), uv_sphere(9, 4)}) {
    const Image colours = painted(mesh, pyramid);
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(colours.pixel(v, 0)[0] == Approx(0.6).margin(2e-4));
      CHECK(colours.pixel(v, 0)[3] == 1);
    }
  }
}

TEST_CASE("paint_vertices: where the image is finer than the mesh, light is averaged") {
  Image stripes(1024, 512, 3);  // black and white columns
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; x += 2) std::fill_n(stripes.pixel(x, y), 3, 1.0F);
  }
  const TexturePyramid pyramid(stripes);
  const Image colours = painted(icosphere(2), pyramid);
  const double half = SrgbCurves::get().to_srgb(0.5F);  // 0.735, not 0.5
  for (int v = 0; v < colours.width; ++v) {
    CHECK(colours.pixel(v, 0)[0] == Approx(half).margin(0.01));
  }
}

TEST_CASE("paint_vertices: the same values for any number of threads, can be cancelled") {
  const TexturePyramid pyramid(direction_image(64));
  const TriangleMesh mesh = icosphere(4);
  CHECK(painted(mesh, pyramid, 1).pixels == painted(mesh, pyramid, 3).pixels);
  CHECK_THROWS_AS(paint_vertices(Topology(mesh), normalised(mesh.positions),
                                 EquirectangularImage(pyramid, Convention::Sphparam),
                                 [](std::string_view, double) { return false; }),
                  Cancelled);
}
