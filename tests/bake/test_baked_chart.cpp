#include <catch2/catch.hpp>

#include "bake/baked_chart.h"
#include "support/test_meshes.h"
#include "texture/baked_texts.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("baked chart: what an image says of its chart is read again, a text each or all in one") {
  CHECK(pole_wedges_of(texts_of_chart(true, 4)) == 4);
  CHECK(pole_wedges_of(texts_of_chart(false, 4)) == std::nullopt);
  CHECK(pole_wedges_of({{"sphparam:interpolation", "uv"}}) == 1);
  CHECK(pole_wedges_of({}) == std::nullopt);
  const ImageTexts one = {{"Software", "sphparam:interpolation=sphere"},
                          {"ImageDescription",
                           "sphparam:map=position\nsphparam:interpolation=uv\n"
                           "sphparam:refine_poles=16\nsphparam:convention=gis"}};
  CHECK(pole_wedges_of(one) == 16);
  CHECK(baked_convention_of(one) == Convention::Gis);
  CHECK(baked_text(one, "sphparam:map") == "position");
  CHECK(baked_text(one, "sphparam:ma").empty());
  CHECK(baked_text(one, "Software") == "sphparam:interpolation=sphere");
}

TEST_CASE(
    "baked chart: an image of another map of the same mesh is told, of another mesh it is not") {
  const auto mapped = [](const TriangleMesh& mesh, const Points& rays) {
    MeshFile file;
    file.mesh = mesh;
    return MappedMesh({.file = file, .map = SphereMap{rays}, .name = "ball.sph.ply"});
  };
  const TriangleMesh ball = icosphere(1);
  Points rays = ball.positions.rowwise().normalized(), turned = rays;
  turned << rays.col(1), rays.col(2), rays.col(0);
  const MappedMesh own = mapped(ball, rays), other = mapped(ball, turned);
  const ImageTexts texts = texts_of_map(own);
  CHECK(texts.front().first == "sphparam:rays");
  CHECK(texts.front().second.starts_with("42 rays, "));
  CHECK(warning_of_other_map("ao.png", texts, own).empty());
  rays.row(0) *= 1 + 1e-12;
  CHECK(texts_of_map(mapped(ball, rays)) == texts);
  for (const double off : {1e-9, 1e-6}) {  // of files that round: no texel shows it
    Points near = rays;
    near.col(0).array() += off;
    CHECK(warning_of_other_map("ao.png", texts, mapped(ball, near)).empty());
  }
  Points moved = rays;
  moved.row(7) = (moved.row(7) + Eigen::RowVector3d(0, 1e-3, 0)).normalized();
  CHECK_FALSE(warning_of_other_map("ao.png", texts, mapped(ball, moved)).empty());
  const std::string hash_alone = texts.front().second.substr(0, texts.front().second.rfind(','));
  CHECK(warning_of_other_map("ao.png", {{"sphparam:rays", hash_alone}}, own).empty());
  CHECK_FALSE(warning_of_other_map("ao.png", {{"sphparam:rays", hash_alone}}, other).empty());
  CHECK(
      warning_of_other_map("ao.png", texts, other) ==
      "ao.png is baked on another map of this mesh than ball.sph.ply has, and stands elsewhere on "
      "it: `sphparam bake` with the map of ball.sph.ply makes the image anew, the mesh with the "
      "map that it was baked on shows it as it is");
  const TriangleMesh fine = icosphere(2);
  CHECK(warning_of_other_map("ao.png", texts, mapped(fine, fine.positions.rowwise().normalized()))
            .empty());
  CHECK(warning_of_other_map("ao.png", {}, other).empty());
}

TEST_CASE("baked chart: an image for a coarse mesh is told on another map of the fine one") {
  const auto mapped = [](const TriangleMesh& mesh, bool turned) {
    const Points own = mesh.positions.rowwise().normalized();
    Points rays = own;
    if (turned) rays << own.col(1), own.col(2), own.col(0);
    MeshFile file;
    file.mesh = mesh;
    return MappedMesh({.file = file, .map = SphereMap{rays}, .name = "ball.sph.ply"});
  };
  const TriangleMesh fine = icosphere(2), coarse = icosphere(1);
  const MappedMesh source = mapped(fine, false);
  const ImageTexts texts = texts_of_map(mapped(coarse, false), &source);
  CHECK(texts.front().second == texts_of_map(mapped(coarse, false)).front().second + "; " +
                                    texts_of_map(source).front().second);
  CHECK(warning_of_other_map("ao.png", texts, source).empty());
  CHECK(warning_of_other_map("ao.png", texts, mapped(coarse, false)).empty());
  for (const TriangleMesh& mesh : {fine, coarse})
    CHECK(warning_of_other_map("ao.png", texts, mapped(mesh, true))
              .starts_with("ao.png is baked on another map of this mesh than ball.sph.ply has"));
}
