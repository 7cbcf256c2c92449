#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

#include "image/image_codec.h"
#include "sphparam/bake/bake.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Of every face a chart of its own in a cell of 8 × 8 texels: red where it looks north, blue where
/// south, black between the charts.
Image atlas_of(const TriangleMesh& mesh, int cells) {
  Image image(8 * cells, 8 * cells, 3);
  for (int f = 0; f < static_cast<int>(mesh.face_count()); ++f) {
    const double z = (mesh.position(mesh.triangles(f, 0)) + mesh.position(mesh.triangles(f, 1)) +
                      mesh.position(mesh.triangles(f, 2)))
                         .z();
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 7 && i + j < 10; ++i)
        image.pixel(8 * (f % cells) + i, 8 * (f / cells) + j)[z > 0 ? 0 : 2] = 1;
  }
  return image;
}

CornerTexcoords charts_of(int faces, int cells) {
  CornerTexcoords corners(3 * faces, 2);
  const double places[3][2] = {{1.5, 1.5}, {6.5, 1.5}, {1.5, 6.5}};
  for (int f = 0; f < faces; ++f) {
    for (int k = 0; k < 3; ++k) {
      corners(3 * f + k, 0) = (8 * (f % cells) + places[k][0]) / (8 * cells);
      corners(3 * f + k, 1) = 1 - (8 * (f / cells) + places[k][1]) / (8 * cells);
    }
  }
  return corners;
}

}  // namespace

TEST_CASE("bake images: of an atlas neither its gutters nor its other charts are in a colour") {
  const Folder folder;
  MeshFile file;
  file.mesh = icosphere(3);
  const int faces = static_cast<int>(file.mesh.face_count()), cells = 36;
  write_image(folder / "atlas.png", atlas_of(file.mesh, cells));
  file.corner_texcoords = charts_of(faces, cells);
  const SphereMap map{file.mesh.positions};
  const MappedMesh ball({.file = std::move(file), .map = map, .name = "ball"});
  for (const int width : {32, 128, 512}) {
    BakeSettings settings{.width = width, .threads = 1};
    settings.texture = folder / "atlas.png";
    bake(ball, {{"basecolor", folder / "c.png"}}, settings);
    const Image baked = read_image(folder / "c.png");
    const int height = width / 2, near = height / 8;  // to the equator
    for (int y = 0; y < height; ++y) {
      if (std::abs(y - height / 2) <= near) continue;
      const int channel = y < height / 2 ? 0 : 2;
      for (int x = 0; x < width; ++x) {
        REQUIRE(baked.pixel(x, y)[channel] == 1);
        REQUIRE(baked.pixel(x, y)[2 - channel] == 0);
      }
    }
  }
}
