#include <catch2/catch.hpp>
#include <cmath>

#include "embedding/newton/outlook.h"

using namespace sphparam;

namespace {

GlobalNewton::Step step(double length, double promised, Curvature curvature, bool complete = true) {
  return {.energy = 0,
          .iterations = 2,
          .length = length,
          .decrement = promised,
          .complete = complete,
          .curvature = curvature};
}

/// A step at energy 1 that keeps what it promises.
void gain(Outlook& outlook, double share, Curvature curvature = Curvature::Projected) {
  outlook.note(step(1, share, curvature), 1, 1 - share);
}

}  // namespace

TEST_CASE("outlook: of gains that shrink by a factor at least what is to come is left") {
  for (const double factor : {0.2, 0.5, 0.7, 0.85}) {
    Outlook outlook(1e-3);
    CHECK_FALSE(outlook.settled());
    int steps = 0;
    double share = 0.1;
    for (; !outlook.settled(); share *= factor, ++steps) {
      gain(outlook, share);
      // One gain tells nothing of the factor.
      CHECK((steps == 0 || outlook.left() >= 0.999 * share * factor / (1 - factor)));
    }
    CHECK(outlook.first_gain() == Approx(0.1));
    const double needed =
        std::log(1e-2) / std::log(factor);  // until a gain is no more than the rest
    CHECK(steps > needed);
    CHECK(steps < 2 + 2 * needed);
  }
}

TEST_CASE("outlook: a step cut short leaves what it could not keep of its promise") {
  Outlook outlook(1e-3);
  outlook.note(step(0.25, 0.4, Curvature::Projected), 1, 0.95);
  CHECK(outlook.left() == Approx(0.3));
  CHECK(outlook.first_gain() == Approx(0.4));
  outlook.note(step(0, 0.4, Curvature::Projected), 1, 1);
  CHECK(outlook.left() == Approx(0.4));
}

TEST_CASE("outlook: three steps in a row that hardly move are the last") {
  Outlook outlook(1e-3);
  const auto idle = [&] { outlook.note(step(0.01, 0.4, Curvature::Projected), 1, 1 - 5e-5); };
  idle();
  idle();
  gain(outlook, 0.2);
  idle();
  idle();
  CHECK_FALSE(outlook.settled());
  idle();
  CHECK(outlook.settled());
  CHECK(outlook.left() > 0.3);
}

TEST_CASE("outlook: the next step is exact once little is promised, until one is cut short") {
  Outlook outlook(1e-9);
  gain(outlook, 1e-2);
  CHECK(outlook.next() == Curvature::Projected);
  gain(outlook, 1e-3);
  CHECK(outlook.next() == Curvature::Exact);
  gain(outlook, 1e-2, Curvature::Exact);
  CHECK(outlook.next() == Curvature::Exact);
  outlook.note(step(0.25, 1e-4, Curvature::Exact), 1, 1 - 1e-5);
  CHECK(outlook.next() == Curvature::Projected);
  gain(outlook, 1e-4);
  CHECK(outlook.next() == Curvature::Exact);
  CHECK(outlook.left() > 2e-4);
  gain(outlook, 1e-4, Curvature::Exact);
  CHECK(outlook.left() == Approx(1e-4));
}

TEST_CASE("outlook: a step whose system was given up tells little of what is left") {
  Outlook outlook(1e-9);
  gain(outlook, 1e-3);
  gain(outlook, 1e-3, Curvature::Exact);
  const double left = outlook.left();
  outlook.note(step(1, 1e-4, Curvature::Exact, false), 1, 1 - 1e-4);
  CHECK(outlook.next() == Curvature::Projected);
  CHECK(outlook.left() > 2e-4);
  CHECK(outlook.left() < left);
}
