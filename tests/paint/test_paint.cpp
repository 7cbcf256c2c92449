#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bake/baked_chart.h"
#include "paint/paint_vertices.h"
#include "sphparam/paint/paint.h"
#include "support/direction_image.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

MappedMesh ball() {
  MeshFile file;
  file.mesh = icosphere(3);
  SphereMap map = normalised(file.mesh.positions);
  return MappedMesh({.file = std::move(file), .map = std::move(map), .mapped_here = true});
}

}  // namespace

TEST_CASE("paint: vertices get whole numbers to 255, and the mesh keeps its map") {
  const TexturePyramid pyramid(direction_image(64), true);
  const EquirectangularImage image(pyramid, Convention::Sphparam);
  CHECK(image.width() == 64);
  CHECK(image.height() == 32);
  const MappedMesh mapped = ball();
  const MeshFile painted = paint_vertices(mapped, image);
  const Image colours = paint_vertices(mapped.topology(), mapped.map(), image);
  const Property* red = painted.find_vertex_property("red");
  REQUIRE(red);
  CHECK(painted.find_vertex_property("sx"));
  CHECK_FALSE(painted.find_vertex_property("alpha"));
  for (int v = 0; v < colours.width; ++v) {
    REQUIRE(red->values[static_cast<size_t>(v)] == std::round(255.0 * colours.pixel(v, 0)[0]));
  }
}

TEST_CASE("paint: the texture of the mesh, which would be seen instead, is left out") {
  MeshFile file = ball().file();
  file.comments = {"TextureFile skin.png", "scanned"};
  file.materials = {"skin.png"};
  file.base_colours = {MaterialTexture{.image = "skin.png"}};
  const MappedMesh mapped({.file = file, .map = ball().map()});
  const TexturePyramid pyramid(uniform_image(8, 0.5F));
  const MeshFile painted =
      paint_vertices(mapped, EquirectangularImage(pyramid, Convention::Sphparam));
  CHECK(painted.comments == std::vector<std::string>{"scanned"});
  CHECK(painted.base_colours.empty());
}

TEST_CASE("paint: triangles that overlap are told by their numbers in the file") {
  PaintedAtlas atlas;
  CHECK(overlap_warning(atlas, ball().file()).empty());
  atlas.painted = 90;
  atlas.overlapping = 7;
  atlas.rivals = {3, 5};
  CHECK(overlap_warning(atlas, ball().file()) ==
        "its texture coordinates overlap: 7 of 90 texels belong to two triangles or more (3 and 5, "
        "for one); the first has them");
  MeshFile quads = ball().file();
  Property source{"source_face", ScalarType::Int32, {}};
  for (Face face = 0; face < quads.mesh.face_count(); ++face) source.values.push_back(face / 2);
  quads.set_face_property(source);
  CHECK(overlap_warning(atlas, quads).find("(1 and 2, for one)") != std::string::npos);
  atlas.rivals = {4, 5};
  CHECK(overlap_warning(atlas, quads).find("(2 and itself, for one)") != std::string::npos);
  atlas.rivals = {3, 3};
  CHECK(overlap_warning(atlas, ball().file())
            .find("(3 and itself in another repetition of the image, for one)") !=
        std::string::npos);
}

TEST_CASE("paint: an image that was baked on another map of the mesh is told") {
  const MappedMesh mapped = ball();
  const auto warning = [&](const std::string& rays) {
    const auto pyramid = std::make_shared<const TexturePyramid>(uniform_image(8, 0.5F));
    return warning_of_map("a.png", {pyramid, Convention::Sphparam, "", rays}, mapped);
  };
  const std::string own = texts_of_map(mapped).front().second;
  CHECK(warning("").empty());
  CHECK(warning(own).empty());
  CHECK(warning("7 rays, 12").empty());  // of another mesh
  CHECK(warning("642 rays, 12").starts_with("a.png is baked on another map of this mesh than "));
}

TEST_CASE("paint: what an atlas cannot be is refused") {
  const TexturePyramid pyramid(uniform_image(8, 0.5F));
  const EquirectangularImage image(pyramid, Convention::Sphparam);
  CHECK_THROWS_AS(paint_atlas(ball(), image), AtlasError);  // no texture coordinates
  CHECK_THROWS_AS(paint_atlas(ball(), image, {.size = 0}), std::invalid_argument);
  CHECK_THROWS_AS(paint_atlas(ball(), image, {.padding = 255}), std::invalid_argument);
  CHECK_THROWS_AS(read_equirectangular("no/such.png"), ImageError);
}
