#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "displace/directed_base.h"
#include "remesh/limit_subject.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

const std::vector<LimitSubject> subjects = {
    {"ico:0", Scheme::Loop},          {"ico:3", Scheme::Loop},
    {"octa:9", Scheme::Loop},         {"cube:2", Scheme::CatmullClark},
    {"cube:7", Scheme::CatmullClark}, {"uv:12x7", Scheme::CatmullClark}};

std::vector<Vector3> random_directions(int count) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Vector3> directions = {Vector3::UnitX(), -Vector3::UnitY(), Vector3::UnitZ(),
                                     -Vector3::UnitZ()};
  while (std::ssize(directions) < count)
    directions.push_back(Vector3(normal(engine), normal(engine), normal(engine)).normalized());
  return directions;
}

Vector3 direction_at(const PlaceFinder::Found& found) {
  return found.patch->direction.evaluate(found.place.s, found.place.t).position.normalized();
}

}  // namespace

TEST_CASE("directed base: the place found has the direction asked for") {
  for (const LimitSubject& subject : subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    PlaceFinder finder(base);
    for (const Vector3& direction : random_directions(2000)) {
      const PlaceFinder::Found found = finder.find(direction);
      INFO(subject.name << ": " << direction.transpose());
      REQUIRE(found.exact);
      REQUIRE(base.net().beyond(found.place) <= 0);
      REQUIRE((direction_at(found) - direction).norm() < 5e-8);
      REQUIRE((direction_at(found) - base.directions().evaluate(found.place).position.normalized())
                  .norm() == 0);
    }
  }
}

TEST_CASE("directed base: along a row and anew the same places are found") {
  for (const LimitSubject& subject : subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, grid.directions, subject.scheme);
    PlaceFinder along(base), anew(base);
    for (int i = 0; i < 1000; ++i) {
      const Vector3 direction =
          Vector3(std::cos(0.01 * i), std::sin(0.01 * i), 0.3 + 0.001 * i).normalized();
      anew.start_anew();
      const PlaceFinder::Found a = along.find(direction), b = anew.find(direction);
      const auto at = [](const PlaceFinder::Found& found) {
        return found.patch->surface.evaluate(found.place.s, found.place.t).position;
      };
      INFO(subject.name << ", step " << i);
      REQUIRE((at(a) - at(b)).norm() < 1e-8);
    }
  }
}

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

TEST_CASE("directed base: where directions fold over, the flat grid's place is given and told") {
  SphereGrid grid = make_grid(parse_grid("ico:1"));
  const DirectedBase sound(grid, grid.directions, Scheme::Loop);
  PlaceFinder finder(sound);
  CHECK(finder.find(Vector3::UnitX()).exact);
  // A grid vertex drawn far along an edge: still one-to-one, its smooth limit hardly.
  grid.directions.row(0) =
      (grid.directions.row(0) + 0.9 * grid.directions.row(grid.faces.polygon(0)[1])).normalized();
  const DirectedBase odd(grid, grid.directions, Scheme::Loop);
  PlaceFinder in_odd(odd);
  for (const Vector3& direction : random_directions(500)) {
    const PlaceFinder::Found found = in_odd.find(direction);
    CHECK(odd.net().beyond(found.place) <= 0);
    if (found.exact) CHECK((direction_at(found) - direction).norm() < 1e-6);
  }
}
