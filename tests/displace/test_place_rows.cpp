#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "displace/base_normals.h"
#include "displace/base_subjects.h"
#include "displace/crumpled_grid.h"
#include "displace/place_rows.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr int width = 101;  // a last run that is not full

DirectionTable row_at(double phi) {
  DirectionTable directions(width);
  for (size_t c = 0; c < width; ++c) {
    const double theta = 2 * std::numbers::pi * (static_cast<double>(c) + 0.5) / width;
    directions.x[0][c] = std::cos(theta) * std::sin(phi);
    directions.x[1][c] = std::sin(theta) * std::sin(phi);
    directions.x[2][c] = std::cos(phi);
  }
  return directions;
}

bool same(const LimitPlace& a, const LimitPlace& b) {
  return a.patch == b.patch && a.s == b.s && a.t == b.t;
}

}  // namespace

TEST_CASE("place rows: what is found below a row is what a search anew finds, near rows and far") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    for (const double step : {0.03, 0.2}) {
      PlaceFinder finder(base), anew(base);
      PlaceRows rows(finder);
      LineTable lines(width);
      for (double phi = 0.005; phi < std::numbers::pi; phi += step) {
        const DirectionTable directions = row_at(phi);
        rows.find_next(directions, lines);
        for (size_t c = 0; c < width; ++c) {
          INFO(subject.name << ", ϕ " << phi << ", column " << c);
          const LimitPlace place = rows.places()[c];
          REQUIRE(rows.exact(c));
          REQUIRE(base.net().beyond(place) <= 0);
          const Vector3 direction = directions[c];
          REQUIRE((base.directions().evaluate(place).position.normalized() - direction).norm() <
                  5e-8);
          anew.start_anew();
          const Vector3 found = base.surface().evaluate(anew.find(direction).place).position;
          REQUIRE((base.surface().evaluate(place).position - found).norm() < 2e-7);
        }
      }
    }
  }
}

TEST_CASE(
    "place rows: where patches are no polynomials each place is found to the last digits too") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    double worst = 0;
    for (const double step : {0.01, 0.05, 0.1, 0.15}) {
      PlaceFinder finder(base);
      PlaceRows rows(finder);
      LineTable lines(width);
      for (double phi = 0.005; phi < std::numbers::pi; phi += step) {
        const DirectionTable directions = row_at(phi);
        rows.find_next(directions, lines);
        for (size_t c = 0; c < width; ++c) {
          const LimitPlace place = rows.places()[c];
          const Vector3 found = base.directions().evaluate(place).position.normalized();
          worst = std::max(worst, (found - directions[c]).norm());
        }
      }
    }
    INFO(subject.name);
    CHECK(worst < 1e-7);
  }
}

TEST_CASE("place rows: of a finder that was asked before the first row is the same to the bit") {
  for (const LimitSubject& subject : base_subjects) {
    INFO(subject.name);
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, grid.directions, subject.scheme);
    PlaceFinder fresh(base), asked(base);
    const DirectionTable directions = row_at(1.1);
    asked.find((directions[0] + directions[1]).normalized());
    PlaceRows of_fresh(fresh), of_asked(asked);
    LineTable lines(width);
    of_fresh.find_next(directions, lines);
    of_asked.find_next(directions, lines);
    for (size_t c = 0; c < width; ++c) CHECK(same(of_fresh.places()[c], of_asked.places()[c]));
  }
}

TEST_CASE("place rows: where directions fold over, the flat grid's place is told") {
  const SphereGrid crumpled = crumpled_grid();
  const DirectedBase odd(crumpled, crumpled.directions, Scheme::Loop);
  PlaceFinder finder(odd);
  PlaceRows rows(finder);
  LineTable lines(width);
  int inexact = 0;
  for (double phi = 0.01; phi < std::numbers::pi; phi += 0.02) {
    const DirectionTable directions = row_at(phi);
    rows.find_next(directions, lines);
    for (size_t c = 0; c < width; ++c) {
      const LimitPlace place = rows.places()[c];
      CHECK(odd.net().beyond(place) <= 0);
      const Vector3 there = odd.directions().evaluate(place).position.normalized();
      const Vector3 direction = directions[c];
      if (rows.exact(c)) {
        CHECK((there - direction).norm() < 1e-6);
      } else {
        ++inexact;
        CHECK(same(place, clamped(odd.guess(direction), odd.net().degree())));
      }
    }
  }
  CHECK(inexact > 10);
  CHECK(inexact < 150 * width);
}

TEST_CASE("place rows: the lines of a row are those of its places to the bit") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    PlaceFinder finder(base);
    PlaceRows rows(finder);
    LineTable lines(width), anew(width);
    for (double phi = 0.005; phi < std::numbers::pi; phi += 0.03) {
      rows.find_next(row_at(phi), lines);
      std::vector<LimitPlace> places;
      for (size_t c = 0; c < width; ++c) places.push_back(rows.places()[c]);
      find_normals(places, finder, anew);
      for (size_t k = 0; k < 3; ++k) {
        for (size_t c = 0; c < width; ++c) {
          INFO(subject.name << ", ϕ " << phi << ", column " << c);
          REQUIRE(lines.origins[k][c] == anew.origins[k][c]);
          REQUIRE(lines.normals[k][c] == anew.normals[k][c]);
        }
      }
    }
  }
}

TEST_CASE("finder pool: a finder comes back with its patches, and nobody else has it meanwhile") {
  const SphereGrid grid = make_grid(parse_grid("ico:2"));
  const DirectedBase base(grid, grid.directions, Scheme::Loop);
  const FinderPool pool(base);
  const PlaceFinder* first = nullptr;
  {
    const FinderPool::Lent one = pool.lend(), other = pool.lend();
    CHECK(&*one != &*other);
    first = &*one;
  }
  CHECK(&*pool.lend() == first);
}

TEST_CASE("base normals: origins and unit normals are those of the surface's points") {
  for (const LimitSubject& subject : base_subjects) {
    const SphereGrid grid = subject.grid();
    const DirectedBase base(grid, 2 * grid.directions, subject.scheme);
    std::vector<LimitPlace> places;
    for (int p = 0; p < base.net().patch_count(); ++p) {
      for (int i = 0; i <= p % 11; ++i) places.push_back({p, 0.05 * i, 0.4 - 0.03 * i});
    }
    PlaceFinder patches(base);
    LineTable lines(places.size());
    find_normals(places, patches, lines);
    for (size_t i = 0; i < places.size(); ++i) {
      const LimitPoint point = base.surface().evaluate(places[i]);
      for (size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<int>(k);
        REQUIRE(lines.origins[k][i] == point.position[axis]);
        REQUIRE(std::abs(lines.normals[k][i] - point.normal()[axis]) < 1e-15);
      }
    }
  }
}

TEST_CASE("base normals: of a surface too small for squares there is none, as of a point") {
  const SphereGrid grid = make_grid(parse_grid("ico:2"));
  const DirectedBase base(grid, 1e-90 * grid.directions, Scheme::Loop);
  PlaceFinder patches(base);
  LineTable lines(1);
  const LimitPlace place{7, 0.2, 0.3};
  find_normals({&place, 1}, patches, lines);
  const Vector3 alone = base.surface().evaluate(place).normal();
  for (size_t k = 0; k < 3; ++k) CHECK(lines.normals[k][0] == alone[static_cast<int>(k)]);
}

TEST_CASE("base normals: where all control points are the origin, there is no normal") {
  const SphereGrid grid = make_grid(parse_grid("ico:2"));
  const DirectedBase base(grid, Points::Zero(grid.directions.rows(), 3), Scheme::Loop);
  PlaceFinder patches(base);
  LineTable lines(1);
  const LimitPlace place{7, 0.2, 0.3};
  find_normals({&place, 1}, patches, lines);
  for (size_t k = 0; k < 3; ++k) CHECK(lines.normals[k][0] == 0);
}
