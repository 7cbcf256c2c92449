#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "displace/displacement_file.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/remesh/displacement.h"
#include "support/folder.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

/// A ball with bumps that no base of so few faces follows; 162 vertices.
MappedMesh bumpy_ball() {
  TriangleMesh ball = tests::icosphere(2);
  const SphereMap map{ball.positions};
  for (Vertex v = 0; v < ball.vertex_count(); ++v)
    ball.positions.row(v) *= 1 + 0.05 * std::sin(9 * ball.position(v).x());
  return tests::mapped(ball, map);
}

struct Written {
  tests::Folder folder;
  WrittenDisplacement told;

  Written(const std::string& grid, Scheme scheme, const std::string& image,
          const std::string& rebuilt, const DisplacementOptions& options) {
    const MappedMesh source = bumpy_ball();
    const Remeshed control = remesh(source, parse_grid(grid));
    const SubdivisionFit fit = fit_subdivision(source, control.grid(), {.scheme = scheme});
    PendingFiles files;
    told = add_displacement(files, {.image = folder / image, .rebuilt = folder / rebuilt}, source,
                            control, fit, options);
    CHECK(folder.names().size() <= 2);
    files.publish();
    CHECK(folder.names() == std::vector{image, rebuilt});
  }
};

}  // namespace

TEST_CASE("written displacement: image and rebuilt mesh, with what they are told to be") {
  const Written written("ico:1", Scheme::Loop, "d.exr", "r.ply", {.width = 128, .height = 64});
  CHECK(written.told.width == 128);
  CHECK(written.told.height == 64);
  CHECK_FALSE(written.told.layout);
  CHECK(written.told.scale == 1);
  CHECK(written.told.midlevel == 0);
  const DisplacementFigures& figures = written.told.figures;
  CHECK(figures.walked + figures.cast + figures.missed == 128 * 64);
  REQUIRE(written.told.proof);
  const RebuildProof& proof = *written.told.proof;
  // A vertex of four texels, more than two a vertex of the mesh: eight cuts of 80 triangles.
  CHECK(proof.vertices == 2562);
  CHECK(proof.triangles == 5120);
  CHECK(proof.certified);
  CHECK(proof.rebuilt.rms < proof.base.rms / 2);
  CHECK_FALSE(proof.farther_than_base());
  const MeshFile rebuilt = read_mesh(written.folder / "r.ply");
  CHECK(rebuilt.mesh.vertex_count() == 2562);
  CHECK(rebuilt.mesh.face_count() == 5120);
}

TEST_CASE("written displacement: in the layout of a grid, vertices meet middles of texels") {
  struct Expected {
    std::string grid;
    Scheme scheme;
    int width, height;  // at most
    int steps;          // texels from one vertex of the grid to the next
    int quads, cuts;    // and the rebuilt mesh has `cuts`² vertices a quad
  };
  // In quads, and in diamonds of two triangles, the steps are the cuts; where faces are divided
  // once, half of them; every other one where those are vertices enough, and more where the mesh
  // has more.
  for (const Expected& is : {Expected{"ico:1", Scheme::Loop, 128, 64, 8, 40, 8},
                             Expected{"cube:3", Scheme::CatmullClark, 128, 64, 8, 54, 8},
                             Expected{"cube:3", Scheme::CatmullClark, 18, 18, 1, 54, 3},
                             Expected{"uv:8x5", Scheme::CatmullClark, 64, 32, 4, 144, 2},
                             Expected{"ico:1", Scheme::CatmullClark, 512, 128, 32, 240, 8},
                             Expected{"ico:0", Scheme::CatmullClark, 4, 4, 1, 60, 3}}) {
    INFO(is.grid << ", " << is.steps << " steps");
    const int vertices = is.quads * is.cuts * is.cuts + 2;
    const Written written(
        is.grid, is.scheme, "d.png", "r.obj",
        {.width = is.width, .height = is.height, .layout = DisplacementLayout::Grid});
    const TextureLayout layout =
        texture_layout(parse_grid(is.grid), std::int64_t{is.width} * is.height);
    REQUIRE(written.told.layout);
    CHECK(*written.told.layout == layout);
    CHECK(written.told.width == layout.width);
    CHECK(written.told.height == layout.height);
    const DisplacementFigures& figures = written.told.figures;
    CHECK(written.told.scale == figures.greatest - figures.least);
    CHECK(written.told.midlevel == -figures.least / written.told.scale);
    CHECK(written.told.proof->vertices == vertices);
    CHECK(layout.steps == is.steps);
    CHECK(written.told.proof->triangles == 2 * vertices - 4);
    CHECK((is.steps == 1 || written.told.proof->rebuilt.rms < written.told.proof->base.rms));
    CHECK(read_mesh(written.folder / "r.obj").mesh.vertex_count() == vertices);
  }
}
