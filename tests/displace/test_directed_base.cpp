#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "displace/directed_base.h"

using namespace sphparam;

namespace {

/// Parameters of a face's corners.
std::vector<std::array<double, 2>> corners(int degree) {
  if (degree == 3) return {{0, 0}, {1, 0}, {0, 1}};
  return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

bool same(const LimitPlace& a, const LimitPlace& b) {
  return a.patch == b.patch && a.s == b.s && a.t == b.t;
}

}  // namespace

TEST_CASE("directed base: triangles among quads are divided, and the surface stays as it is") {
  const SphereGrid grid = make_grid(parse_grid("uv:9x6"));
  const DirectedBase base(grid, grid.directions, Scheme::CatmullClark);
  for (std::int64_t f = 0; f < base.faces().count(); ++f) CHECK(base.faces().degree(f) == 4);
  const LimitSurface whole(grid.faces, grid.directions, Scheme::CatmullClark);
  // A pole is a corner of the first faces before and after.
  const Vector3 pole = whole.evaluate({0, 0, 0}).position;
  double nearest = 1;
  for (int p = 0; p < base.net().patch_count(); ++p)
    nearest = std::min(nearest, (base.surface().evaluate({p, 0, 0}).position - pole).norm());
  CHECK(nearest < 1e-12);
}

TEST_CASE("directed base: a guess is where the flat faces have the direction") {
  for (const auto& [name, scheme] :
       {std::pair("ico:1", Scheme::Loop), {"cube:3", Scheme::CatmullClark}}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const DirectedBase base(grid, grid.directions, scheme);
    const Triangulation cut = triangulate(grid.directions, grid.faces);
    for (std::int64_t i = 0; i < 3 * cut.triangles.rows(); ++i) {  // most at this corner
      const std::int64_t t = i / 3, first = 3 * t;
      const auto face = static_cast<int>(cut.polygon_of(t));
      Vector3 direction = Vector3::Zero();
      double s_there = 0, t_there = 0;
      for (std::int64_t k = 0; k < 3; ++k) {
        const double weight = first + k == i ? 0.5 : first + (k + 1) % 3 == i ? 0.2 : 0.3;
        direction += weight * grid.directions.row(cut.triangles(t, k)).transpose();
        const std::int64_t corner = cut.corner_of(first + k) - grid.faces.starts[face];
        s_there += weight * corners(grid.faces.degree(face))[corner][0];
        t_there += weight * corners(grid.faces.degree(face))[corner][1];
      }
      const LimitPlace guess = base.guess(direction.normalized());
      CHECK(guess.patch == face);
      CHECK(guess.s == Approx(s_there).margin(1e-12));
      CHECK(guess.t == Approx(t_there).margin(1e-12));
    }
  }
}

TEST_CASE("directed base: of divided faces a guess is near the middle of the patch at its corner") {
  for (const char* name : {"uv:9x6", "ico:1"}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const DirectedBase base(grid, grid.directions, Scheme::CatmullClark);
    for (int f = 0; f < grid.faces.count(); ++f) {
      for (int k = 0; k < grid.faces.degree(f); ++k) {
        const auto polygon = grid.faces.polygon(f);
        Vector3 direction = Vector3::Zero();
        for (const int v : polygon) direction += grid.directions.row(v);
        direction += 20 * grid.directions.row(polygon[k]);
        const LimitPlace guess = base.guess(direction.normalized());
        CHECK(same(guess, {grid.faces.starts[f] + k, 1.0 / 3, 1.0 / 3}));
        CHECK(base.faces().polygon(guess.patch)[0] == polygon[k]);
      }
    }
  }
}

TEST_CASE("directed base: what is beyond the end of a divided face is at its end") {
  const SphereGrid grid = make_grid(parse_grid("uv:8x5"));
  const DirectedBase base(grid, grid.directions, Scheme::CatmullClark);
  for (int f = 0; f < grid.faces.count(); ++f) {
    CHECK(same(base.on_patches({f, -0.2, 0.3}), base.on_patches({f, 0, 0.3})));
    CHECK(same(base.on_patches({f, 0.3, -0.2}), base.on_patches({f, 0.3, 0})));
    CHECK(same(base.on_patches({f, 1.2, 0}), base.on_patches({f, 1, 0})));
    CHECK(same(base.on_patches({f, 0, 1.2}), base.on_patches({f, 0, 1})));
  }
}

TEST_CASE(
    "directed base: where faces are patches a place is itself, beyond its end across the edge") {
  for (const auto& [name, scheme] :
       {std::pair("ico:1", Scheme::Loop), {"cube:3", Scheme::CatmullClark}}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const DirectedBase base(grid, grid.directions, scheme);
    for (int f = 0; f < grid.faces.count(); ++f) {
      const LimitPlace here{f, 0.1 + 0.7 * f / grid.faces.count(), 0.07}, beyond{f, 0.3, -0.1};
      CHECK(same(base.on_patches(here), here));
      CHECK(same(base.on_face(here), here));
      CHECK(same(base.on_patches(beyond), base.net().cross(beyond)));
    }
  }
}
