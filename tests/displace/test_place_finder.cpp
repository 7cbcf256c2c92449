#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "displace/base_subjects.h"
#include "displace/crumpled_grid.h"
#include "displace/place_finder.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::vector<Vector3> random_directions(int count) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Vector3> directions = {Vector3::UnitX(), -Vector3::UnitY(), Vector3::UnitZ(),
                                     -Vector3::UnitZ()};
  while (std::ssize(directions) < count)
    directions.push_back(Vector3(normal(engine), normal(engine), normal(engine)).normalized());
  return directions;
}

Vector3 direction_at(PlaceFinder& finder, const LimitPlace& place) {
  return finder.patch(place.patch).direction.evaluate(place.s, place.t).position.normalized();
}

}  // namespace

TEST_CASE("place finder: the place found has the direction asked for") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    PlaceFinder finder(base);
    for (const Vector3& direction : random_directions(2000)) {
      const PlaceFinder::Found found = finder.find(direction);
      INFO(subject.name << ": " << direction.transpose());
      REQUIRE(found.exact);
      REQUIRE(base.net().beyond(found.place) <= 0);
      REQUIRE((direction_at(finder, found.place) - direction).norm() < 5e-8);
      REQUIRE((direction_at(finder, found.place) -
               base.directions().evaluate(found.place).position.normalized())
                  .norm() == 0);
    }
  }
}

TEST_CASE("place finder: along a row and anew the same places are found") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, grid.directions, subject.scheme);
    PlaceFinder along(base), anew(base);
    for (int i = 0; i < 1000; ++i) {
      const Vector3 direction =
          Vector3(std::cos(0.01 * i), std::sin(0.01 * i), 0.3 + 0.001 * i).normalized();
      anew.start_anew();
      const PlaceFinder::Found a = along.find(direction), b = anew.find(direction);
      const auto at = [&](const PlaceFinder::Found& found) {
        return base.surface().evaluate(found.place).position;
      };
      INFO(subject.name << ", step " << i);
      REQUIRE((at(a) - at(b)).norm() < 1e-8);
    }
  }
}

TEST_CASE("place finder: where directions fold over, the flat grid's place is given and told") {
  const SphereGrid grid = make_grid(parse_grid("ico:1"));
  const DirectedBase sound(grid, grid.directions, Scheme::Loop);
  PlaceFinder finder(sound);
  CHECK(finder.find(Vector3::UnitX()).exact);
  const SphereGrid crumpled = crumpled_grid();
  const DirectedBase odd(crumpled, crumpled.directions, Scheme::Loop);
  PlaceFinder in_odd(odd);
  int inexact = 0;
  for (const Vector3& direction : random_directions(2000)) {
    const PlaceFinder::Found found = in_odd.find(direction);
    CHECK(odd.net().beyond(found.place) <= 0);
    if (found.exact) {
      CHECK((direction_at(in_odd, found.place) - direction).norm() < 1e-6);
    } else {
      ++inexact;
      CHECK(found.place.patch == odd.guess(direction).patch);
    }
  }
  CHECK(inexact == 1398);
}

TEST_CASE("place finder: however few patches are kept, the same places are found") {
  const SphereGrid grid = make_grid(parse_grid("octa:9"));
  const DirectedBase base(grid, grid.directions, Scheme::Loop);
  PlaceFinder usual(base), forgetful(base, 2);
  for (const Vector3& direction : random_directions(500)) {
    const LimitPlace a = usual.find(direction).place, b = forgetful.find(direction).place;
    CHECK(a.patch == b.patch);
    CHECK(a.s == b.s);
    CHECK(a.t == b.t);
  }
}
