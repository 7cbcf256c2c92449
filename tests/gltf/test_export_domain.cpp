#include <catch2/catch.hpp>
#include <functional>
#include <stdexcept>

#include "sphparam/gltf/export.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

/// What is said of options; empty: they are taken. Whoever works on them tells a stage.
std::string complaint(const std::function<void(ExportOptions&)>& change) {
  static const MappedMesh ball = mapped(icosphere(1), {icosphere(1).positions});
  ExportOptions options{.look = {.image_width = 64}};
  bool worked = false;
  options.progress = [&](std::string_view, double) { return worked = true; };
  change(options);
  try {
    make_asset(ball, options);
    return "";
  } catch (const std::invalid_argument& error) {
    CHECK_FALSE(worked);
    return error.what();
  }
}

}  // namespace

TEST_CASE("export domain: what is outside is refused by its name before any work") {
  using Catch::StartsWith;
  for (const int width : {10, 18, 0, -4, 1 << 20})
    CHECK_THAT(complaint([&](auto& o) { o.look.image_width = width; }),
               StartsWith("image_width is "));
  for (const int quality : {0, 101, -1})
    CHECK_THAT(complaint([&](auto& o) { o.look.webp_quality = quality; }),
               StartsWith("webp_quality is "));
  for (const int wedges : {0, 1025, -3})
    CHECK_THAT(complaint([&](auto& o) { o.refine_poles = wedges; }),
               StartsWith("refine_poles is "));
  CHECK_THAT(complaint([](auto& o) { o.convention = Convention(99); }),
             StartsWith("convention is 99"));
  CHECK_THAT(complaint([](auto& o) { o.convention = Convention(-1); }),
             StartsWith("convention is -1"));
  CHECK_THAT(complaint([](auto& o) { o.look.textures = TextureFormat(9); }),
             StartsWith("textures is 9"));
  CHECK_THAT(complaint([](auto& o) { o.shape = ShapeKind(3); }), StartsWith("shape is 3"));
  CHECK_THAT(complaint([](auto& o) { o.morph = Morph(3); }), StartsWith("morph is 3"));
}

TEST_CASE("export domain: a morph starts from the mesh, and from nothing else") {
  for (const ShapeKind shape : {ShapeKind::Sphere, ShapeKind::Flat}) {
    const auto change = [&](ExportOptions& options) {
      options.shape = shape;
      options.morph = Morph::Flat;
    };
    CHECK_THAT(complaint(change), Catch::Contains("morph starts from the mesh"));
  }
}

TEST_CASE("export domain: what cannot be of this mesh, or together, is refused before any work") {
  using Catch::Contains;
  const auto keep_and_refine = [](ExportOptions& options) {
    options.keep_topology = true;
    options.refine_poles = 2;
  };
  CHECK_THAT(complaint(keep_and_refine), Contains("refined poles need new vertices"));
  CHECK_THAT(complaint([](auto& o) { o.source_uv = true; }), Contains("no texture coordinates"));
  CHECK_THAT(complaint([](auto& o) {
               o.others = {{"few", Points::Zero(3, 3), Points::Zero(3, 3)}};
             }),
             Contains("the shape few needs a position and a normal for each vertex"));
}

TEST_CASE("export domain: its ends are in it") {
  CHECK(complaint([](auto& o) { o.look.image_width = 16; }).empty());
  CHECK(complaint([](auto& o) { o.look.webp_quality = 1; }).empty());
  CHECK(complaint([](auto& o) { o.look.webp_quality = 100; }).empty());
  CHECK(complaint([](auto& o) { o.convention = Convention::Blender; }).empty());
  CHECK(complaint([](auto& o) { o.morph = Morph::Flat; }).empty());
}

}  // namespace sphparam::tests
