#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sphparam/remesh/harmonic_surface.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const double unit = std::sqrt(4 * std::numbers::pi / 3);  // times Y_11, Y_1,−1, Y_10: x, y, z

/// x, y, z and a scalar: (2x, 3y, 4z) and 7 + z, with detail of degree 3 in all of them.
HarmonicExpansion expansion() {
  HarmonicExpansion result;
  result.functions = {"x", "y", "z", "height"};
  Functions& c = result.fit.coefficients;
  c = Functions::Zero(16, 4);
  c(harmonic_index(1, 1), 0) = 2 * unit;
  c(harmonic_index(1, -1), 1) = 3 * unit;
  c(harmonic_index(1, 0), 2) = 4 * unit;
  c(0, 3) = 7 * std::sqrt(4 * std::numbers::pi);
  c(harmonic_index(1, 0), 3) = unit;
  c.row(harmonic_index(3, 2)).setConstant(0.01);
  return result;
}

std::string value_of(const MappedMesh& mesh, const std::string& key) {
  for (const auto& [name, value] : mesh.provenance())
    if (name == key) return value;
  return "";
}

}  // namespace

TEST_CASE("harmonic_surface: degree 1 is an ellipsoid, on triangles and on quads") {
  const HarmonicExpansion smooth = low_pass(expansion(), 1);
  CHECK(smooth.degree() == 1);
  for (const char* name : {"ico:3", "octa:17", "cube:8", "uv:16x8"}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const MappedMesh made = harmonic_surface(smooth, grid);
    const Points& u = grid.directions;
    CHECK(made.map().points == u);
    CHECK(made.polygons()->count() == grid.faces.count());
    CHECK((made.mesh().positions - u * Vector3(2, 3, 4).asDiagonal()).cwiseAbs().maxCoeff() <
          1e-14);
    const Property* const height = made.file().find_vertex_property("height");
    REQUIRE(height);
    for (Eigen::Index v = 0; v < u.rows(); ++v)
      CHECK(std::abs(height->values[size_t(v)] - (7 + u(v, 2))) < 1e-14);
    CHECK(value_of(made, "method") == "harmonics");
    CHECK(value_of(made, "grid") == name);
    CHECK(value_of(made, "harmonics") == "1");
  }
}

TEST_CASE("harmonic_surface: all degrees are what synthesise has, for any number of threads") {
  const SphereGrid grid = make_grid(parse_grid("ico:4"));
  const HarmonicExpansion all = expansion();
  const MappedMesh made = harmonic_surface(all, grid, 1);
  CHECK(made.mesh().positions ==
        synthesise(all.fit.coefficients, grid.directions, 1).leftCols<3>());
  CHECK(made.mesh().positions == harmonic_surface(all, grid, 3).mesh().positions);
}

TEST_CASE("harmonic_surface: of a mesh's harmonics it knows the map and what the file says") {
  MeshFile file;
  file.mesh = icosphere(3);
  file.comments = {"up axis y", "by hand"};
  const MappedMesh source({.file = file,
                           .map = {file.mesh.positions},
                           .provenance = {{"method", "radial"}, {"upright", "+y"}}});
  HarmonicExpansion found = expand_in_harmonics(source, {}, {.degree = 2});
  const GridSpec grid{GridKind::Icosahedron, 2};
  const MappedMesh made = harmonic_surface(found, make_grid(grid));
  CHECK(value_of(made, "source") == "radial");
  CHECK(value_of(made, "upright") == "+y");
  CHECK(made.file().comments == file.comments);
  align(found, source, HarmonicAlignment::SphereAndSurface);
  const MappedMesh turned = harmonic_surface(found, make_grid(grid));
  CHECK(value_of(turned, "upright").empty());
  CHECK(value_of(turned, "aligned") == "first-order ellipsoid");
  CHECK(turned.file().comments == std::vector<std::string>{"by hand"});
}

TEST_CASE("harmonic_surface: a degree that there is not, and functions that are no surface") {
  CHECK_THROWS_WITH(low_pass(expansion(), 4),
                    Catch::Contains("degree is 4") && Catch::Contains("0 to 3"));
  CHECK_THROWS_AS(low_pass(expansion(), -1), std::invalid_argument);
  const SphereGrid grid = make_grid(parse_grid("ico:1"));
  HarmonicExpansion wrong = expansion();
  wrong.functions[1] = "radius";
  CHECK_THROWS_AS(harmonic_surface(wrong, grid), std::invalid_argument);
  wrong = expansion();
  wrong.functions.pop_back();
  CHECK_THROWS_AS(harmonic_surface(wrong, grid), std::invalid_argument);
}
