#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "remesh/texture_lattice.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/remesh/texture_layout.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

constexpr std::int64_t texels = 1 << 16;

struct Laid {
  GridSpec spec;
  SphereGrid grid;
  TextureLayout layout;
  TextureLattice lattice;
  explicit Laid(const std::string& name)
      : spec(parse_grid(name)),
        grid(make_grid(spec)),
        layout(texture_layout(spec, texels)),
        lattice(spec, grid, layout) {}

  /// Twice the signed area of a face in texels, v upwards.
  double area(std::int64_t f) const {
    double sum = 0;
    const int first = grid.faces.starts[static_cast<size_t>(f)], degree = grid.faces.degree(f);
    for (int k = 0; k < degree; ++k) {
      const TexelPoint a = lattice.corner(first + k), b = lattice.corner(first + (k + 1) % degree);
      sum -= a.x() * b.y() - a.y() * b.x();
    }
    return sum;
  }
  /// Of a place on the flat grid.
  Vector3 direction(const LimitPlace& place) const {
    const auto corners = grid.faces.polygon(place.patch);
    const auto at = [&](size_t k) -> Vector3 { return grid.directions.row(corners[k]); };
    const double s = place.s, t = place.t;
    const Vector3 flat =
        corners.size() == 3
            ? Vector3((1 - s - t) * at(0) + s * at(1) + t * at(2))
            : Vector3((1 - t) * ((1 - s) * at(0) + s * at(1)) + t * ((1 - s) * at(3) + s * at(2)));
    return flat.normalized();
  }
};

const std::vector<std::string> names = {"cube:1", "cube:4",  "cube:5", "octa:3",  "octa:9",
                                        "octa:7", "ico:0",   "ico:2",  "ico:f=1", "ico:f=3",
                                        "uv:8x5", "uv:16x8", "uv:3x2"};

}  // namespace

TEST_CASE("texture layout: faces are counter-clockwise and fill the tiles") {
  for (const std::string& name : names) {
    INFO(name);
    const Laid laid(name);
    double sum = 0;
    for (std::int64_t f = 0; f < laid.grid.faces.count(); ++f) {
      REQUIRE(laid.area(f) > 0);
      sum += laid.area(f) / 2;
    }
    const TextureLayout& layout = laid.layout;
    const double rim = layout.gutter > 0 ? 1 + 2 * layout.gutter : 0,
                 wide = layout.width - layout.columns * rim,
                 high = layout.height - layout.rows * rim;
    // Of the two rows at the poles of the chart half is beside the triangles.
    const double beside = laid.spec.kind == GridKind::Geographic ? wide * layout.steps : 0;
    CHECK(sum == Approx(wide * high - beside));
  }
}

TEST_CASE("texture layout: every texel shows one place, and that place lies on it") {
  for (const std::string& name : names) {
    INFO(name);
    const Laid laid(name);
    const TextureLayout& layout = laid.layout;
    const int wide = layout.width / layout.columns, high = layout.height / layout.rows;
    for (int row = 0; row < layout.height; ++row) {
      for (int column = 0; column < layout.width; ++column) {
        const LimitPlace place = laid.lattice.place(column, row);
        REQUIRE(place.patch >= 0);
        const TexelPoint back = laid.lattice.point(place);
        const bool inside = column % wide >= layout.gutter &&
                            column % wide < wide - layout.gutter && row % high >= layout.gutter &&
                            row % high < high - layout.gutter;
        const bool at_pole =
            laid.lattice.closed() && (row < layout.steps || row >= layout.height - layout.steps);
        if (inside && !at_pole) {
          REQUIRE(back.x() == Approx(column).margin(1e-9));
          REQUIRE(back.y() == Approx(row).margin(1e-9));
          REQUIRE(place.s > -1e-9);
          REQUIRE(place.t > -1e-9);
          REQUIRE(std::max(place.s, place.t) < 1 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE(
    "texture layout: a vertex is at the middle of a texel, the same point on every side of a cut") {
  for (const std::string& name : names) {
    INFO(name);
    const Laid laid(name);
    if (laid.lattice.closed()) continue;
    for (size_t i = 0; i < laid.grid.faces.corners.size(); ++i) {
      const TexelPoint at = laid.lattice.corner(static_cast<int>(i));
      REQUIRE(at.array().round().isApprox(at.array(), 1e-14));
      const Vector3 shown =
          laid.direction(laid.lattice.place(static_cast<int>(at.x()), static_cast<int>(at.y())));
      const Vector3 vertex = laid.grid.directions.row(laid.grid.faces.corners[i]);
      REQUIRE((shown - vertex).norm() < 1e-12);
    }
  }
}

TEST_CASE("texture layout: beside a tile its faces go on, so that a gutter's texel has its place") {
  for (const std::string& name : {"cube:4", "octa:9", "ico:2"}) {
    INFO(name);
    const Laid laid(name);
    const TextureLayout& layout = laid.layout;
    const TexelPoint corner = laid.lattice.corner(0);
    int beyond = 0;
    for (int row = 0; row < layout.height; ++row) {
      for (int column = 0; column < layout.width; ++column) {
        const LimitPlace place = laid.lattice.place(column, row);
        const TexelPoint shown = laid.lattice.point(place);
        const bool goes_on = place.s < 0 || place.t < 0 || place.s > 1 || place.t > 1;
        beyond += goes_on;
        if (goes_on) REQUIRE((shown - TexelPoint(column, row)).norm() < 1e-9);
      }
    }
    CHECK(beyond > 2 * layout.gutter * (layout.width / 4));
    CHECK(corner.x() >= layout.gutter);
  }
}

TEST_CASE("texture layout: a vertex lies where it did in the equirectangular chart of uv:WxH") {
  const Laid laid("uv:16x8");
  CHECK(laid.layout.width == 16 * laid.layout.steps);
  CHECK(laid.layout.height == 8 * laid.layout.steps);
  for (std::int64_t f = 16; f < 16 * 7; ++f) {
    const Vector3 q = laid.grid.directions.row(laid.grid.faces.polygon(f)[0]);
    const Eigen::Vector2d uv = laid.lattice.coordinates(
        laid.lattice.corner(laid.grid.faces.starts[static_cast<size_t>(f)]));
    const double turn = 2 * std::numbers::pi;
    CHECK(std::cos(turn * uv.x()) * q.head(2).norm() == Approx(q.x()).margin(1e-12));
    CHECK(uv.y() == Approx(1 - std::acos(q.z()) / std::numbers::pi));
  }
}

TEST_CASE("texture layout: the finest that fits, or a texel a vertex") {
  const GridSpec cube = parse_grid("cube:16");
  const TextureLayout layout = texture_layout(cube, 4096 * 2048);
  CHECK(layout == TextureLayout{3 * (16 * 64 + 9), 2 * (16 * 64 + 9), 3, 2, 6, 64, 4});
  CHECK(texture_layout(cube, 1) == TextureLayout{3 * 25, 2 * 25, 3, 2, 0, 1, 4});
  CHECK(texture_layout(parse_grid("octa:17"), 1 << 20).width == 16 * 32 + 9);
  CHECK(texture_layout(parse_grid("uv:64x32"), 4096 * 2048).width == 4096);
  CHECK(has_texture_layout(parse_grid("ico:3")));
  CHECK_FALSE(has_texture_layout(parse_grid("healpix:4")));
}

TEST_CASE("texture layout: grids that have none are refused") {
  const TriangleMesh ball = tests::icosphere(2);
  const MappedMesh source({.file = {.mesh = ball}, .map = {ball.positions}});
  CHECK_THROWS_AS(texture_layout(parse_grid("healpix:2"), texels), std::invalid_argument);
  CHECK_THROWS_AS(texture_layout({GridKind::Octahedron, 4}, texels), std::invalid_argument);
  for (const Remeshed& made :
       {remesh(source, parse_grid("healpix:2")), remesh(source, grid_of(source))})
    CHECK_THROWS_AS(with_grid_texture(made, {}), std::invalid_argument);
}

TEST_CASE("texture layout: coarser grids by halves have the layout of the finer one") {
  for (const auto& [fine, coarse] :
       {std::pair("cube:16", "cube:8"), {"ico:3", "ico:2"}, {"octa:17", "octa:9"}}) {
    const TextureLayout a = texture_layout(parse_grid(fine), texels),
                        b = texture_layout(parse_grid(coarse), texels);
    CHECK(a.width == b.width);
    CHECK(a.height == b.height);
    CHECK(2 * a.steps == b.steps);
  }
}

TEST_CASE("texture layout: the texture of the mesh, which lies on others, is left out") {
  const TriangleMesh ball = tests::icosphere(2);
  const MappedMesh source({.file = {.mesh = ball, .comments = {"TextureFile skin.png", "scanned"}},
                           .map = {ball.positions}});
  const Remeshed made = remesh(source, parse_grid("cube:2"));
  const auto comments = with_grid_texture(made, texture_layout(*made.spec(), 64)).file().comments;
  CHECK(std::ranges::count(comments, "scanned") == 1);
  CHECK(std::ranges::count(comments, "TextureFile skin.png") == 0);
}

TEST_CASE("texture layout: a mesh gets its coordinates, quads and all") {
  const TriangleMesh ball = tests::icosphere(3);
  const MappedMesh source({.file = {.mesh = ball}, .map = {ball.positions}});
  for (const std::string& name : {"cube:4", "octa:9", "ico:2", "uv:8x5"}) {
    INFO(name);
    const Remeshed made = remesh(source, parse_grid(name));
    const TextureLayout layout = texture_layout(*made.spec(), texels);
    const Remeshed with = with_grid_texture(made, layout);
    REQUIRE(with.file().corner_texcoords);
    const auto& uv = *with.file().corner_texcoords;
    REQUIRE(uv.rows() == 3 * with.mesh().face_count());
    CHECK(uv.minCoeff() >= 0);
    CHECK(uv.maxCoeff() <= 1);
    for (Eigen::Index f = 0; f < with.mesh().face_count(); ++f) {
      const Eigen::Vector2d a = uv.row(3 * f), b = uv.row(3 * f + 1), c = uv.row(3 * f + 2);
      const Eigen::Vector2d ab = b - a, ac = c - a;
      REQUIRE(ab.x() * ac.y() - ab.y() * ac.x() > 0);
    }
    CHECK(with.mesh().positions == made.mesh().positions);
    CHECK(with.file().comments.back().find("texture coordinates: the layout of " + name) == 0);
  }
}
