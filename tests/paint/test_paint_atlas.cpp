#include <catch2/catch.hpp>
#include <cmath>

#include "paint/paint_atlas.h"
#include "srgb_curves.h"
#include "support/direction_image.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Every triangle has a cell of a square grid to itself.
MeshFile with_grid_atlas(const TriangleMesh& mesh, double shift = 0) {
  MeshFile file;
  file.mesh = mesh;
  const int side = static_cast<int>(std::ceil(std::sqrt(mesh.face_count())));
  CornerTexcoords texcoords(3 * mesh.face_count(), 2);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector2d cell(static_cast<double>(f % side), static_cast<double>(f / side));
    const Eigen::RowVector2d corners[3] = {{0.11, 0.13}, {0.92, 0.17}, {0.12, 0.91}};
    for (int k = 0; k < 3; ++k) {
      texcoords.row(3 * f + k) = (cell + corners[k]) / side + Eigen::RowVector2d(shift, -shift);
    }
  }
  file.corner_texcoords = texcoords;
  return file;
}

PaintedAtlas painted(const MeshFile& file, const TexturePyramid& pyramid, int size, int padding = 4,
                     int threads = 0) {
  return paint_atlas(file, normalised(file.mesh.positions),
                     EquirectangularImage(pyramid, Convention::Sphparam),
                     {.size = size, .padding = padding, .threads = threads});
}

}  // namespace

TEST_CASE("paint_atlas: each texel has the image's colour where its point goes on the sphere") {
  const TriangleMesh mesh = icosphere(2);
  const MeshFile file = with_grid_atlas(mesh);
  const TexturePyramid pyramid(direction_image(512), true);
  constexpr int size = 256;
  const Image image = painted(file, pyramid, size).image;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector2d st =
        file.corner_texcoords->middleRows<3>(3 * f).colwise().mean();  // of the middle
    const float* colour =
        image.pixel(static_cast<int>(st.x() * size), static_cast<int>((1 - st.y()) * size));
    Vector3 direction = Vector3::Zero();
    for (int k = 0; k < 3; ++k) direction += mesh.position(mesh.triangles(f, k));
    direction.normalize();
    for (int c = 0; c < 3; ++c) {
      const double found = 2 * SrgbCurves::get().to_linear(colour[c]) - 1;
      CHECK(found == Approx(direction[c]).margin(0.04));  // half a texel of the atlas
    }
  }
}

TEST_CASE("paint_atlas: a constant image fills all of the square") {
  const TexturePyramid pyramid(uniform_image(32, 0.4F));
  const PaintedAtlas result = painted(with_grid_atlas(icosphere(1)), pyramid, 100);
  CHECK(result.overlapping == 0);
  CHECK(result.painted < 100 * 100);
  CHECK(result.painted > 2000);
  for (size_t i = 0; i < result.image.pixels.size(); i += 4) {
    REQUIRE(result.image.pixels[i] == Approx(0.4).margin(2e-4));
  }
}

TEST_CASE("paint_atlas: coordinates repeat, and mirrored triangles are painted as others") {
  const TexturePyramid pyramid(direction_image(128));
  const TriangleMesh mesh = icosphere(1);
  const Image plain = painted(with_grid_atlas(mesh), pyramid, 64).image;
  const Image moved = painted(with_grid_atlas(mesh, 3), pyramid, 64).image;
  double worst = 0;
  for (size_t i = 0; i < plain.pixels.size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(plain.pixels[i] - moved.pixels[i])));
  }
  CHECK(worst < 1e-3);
  MeshFile mirrored = with_grid_atlas(mesh);
  mirrored.corner_texcoords->col(0) = 1 - mirrored.corner_texcoords->col(0).array();
  CHECK(painted(mirrored, pyramid, 64).overlapping == 0);
}

TEST_CASE("paint_atlas: overlapping charts are counted and named, common edges are not") {
  const TexturePyramid pyramid(uniform_image(16, 0.5F));
  MeshFile file = with_grid_atlas(octahedron());
  file.corner_texcoords->middleRows<3>(3 * 5) = file.corner_texcoords->middleRows<3>(3 * 2);
  const PaintedAtlas result = painted(file, pyramid, 60);
  CHECK(result.overlapping > 0);
  CHECK(result.overlapping < result.painted / 6);
  CHECK(result.rivals == std::array<Face, 2>{2, 5});

  // Two triangles of a square, and nothing else with an area.
  MeshFile square = with_grid_atlas(octahedron());
  square.corner_texcoords->setZero();
  square.corner_texcoords->topRows<6>() << 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1;
  const PaintedAtlas whole = painted(square, pyramid, 50);
  CHECK(whole.painted == 2500);
  CHECK(whole.overlapping == 0);
}

TEST_CASE(
    "paint_atlas: a triangle over several repetitions overlaps itself, and may be cancelled") {
  const TexturePyramid pyramid(uniform_image(16, 0.5F));
  MeshFile file = with_grid_atlas(octahedron());
  file.corner_texcoords->setZero();
  file.corner_texcoords->topRows<3>() << 0, 0, 8, 0, 0, 8;
  const PaintedAtlas result = painted(file, pyramid, 50);
  CHECK(result.painted == 2500);
  CHECK(result.overlapping == 2500);
  CHECK(result.rivals == std::array<Face, 2>{0, 0});
  // A large one is looked at in bands: all of it, and not without asking between them.
  CHECK(painted(file, pyramid, 400).painted == 400 * 400);
  const auto paint = [&](int may_ask) {
    int asked = 0;
    const auto count = [&](std::string_view, double done) {
      asked += done == 0;
      return asked <= may_ask;
    };
    paint_atlas(file, normalised(file.mesh.positions),
                EquirectangularImage(pyramid, Convention::Sphparam),
                {.size = 400, .padding = 4, .progress = count});
    return asked;
  };
  CHECK(paint(10) == 3);  // of 3200 × 3200 samples twice, and before the first row is painted
  CHECK_THROWS_AS(paint(0), Cancelled);
}

TEST_CASE("paint_atlas: what cannot be painted for is refused") {
  const TexturePyramid pyramid(uniform_image(16, 0.5F));
  MeshFile file = with_grid_atlas(octahedron());
  file.corner_texcoords->setConstant(0.5);
  CHECK_THROWS_AS(painted(file, pyramid, 16), AtlasError);
  file.corner_texcoords->row(4) << 1e300, 2;
  CHECK_THROWS_WITH(painted(file, pyramid, 16), Catch::Contains("repetitions"));
  file.corner_texcoords.reset();
  CHECK_THROWS_WITH(painted(file, pyramid, 16), Catch::Contains("no texture coordinates"));
}

TEST_CASE("paint_atlas: the same values for any number of threads") {
  const TexturePyramid pyramid(direction_image(64));
  const MeshFile file = with_grid_atlas(icosphere(2));
  CHECK(painted(file, pyramid, 128, 3, 1).image.pixels ==
        painted(file, pyramid, 128, 3, 4).image.pixels);
}
