#include <catch2/catch.hpp>
#include <cmath>

#include "correspondence/composed_energy.h"

namespace sphparam::tests {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

const RestTriangle rest{.area = 0.3, .inverse_base = 1.25, .inverse_height = 1.6, .foot = 0.4};

/// Three places that change linearly along their ways.
struct Triangle {
  std::array<Place, 3> places;

  Triangle() {
    const ImageTriangle positions{Vector3(0.1, 0.2, -0.3), Vector3(1.1, 0.4, 0.1),
                                  Vector3(0.2, 1.3, 0.6)};
    const ImageTriangle directions{Vector3(0.9, 0.1, 0.1), Vector3(0.2, 0.9, 0.2),
                                   Vector3(0.1, 0.2, 0.8)};
    for (size_t k = 0; k < 3; ++k) {
      const double i = static_cast<double>(k);
      places[k] = {
          {},
          positions[k],
          directions[k],
          {Vector3::UnitX(), Vector3::UnitY(), Vector3(0.9, 0.1 * i, 0.2),
           Vector3(-0.2, 0.8, 0.1 - i), Vector3(0.3, 0.1, -0.2 * i), Vector3(0.1 * i, -0.2, 0.4)}};
    }
  }
  Triangle moved(const Vector6& ways) const {
    Triangle result = *this;
    for (size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(2 * k);
      const PlaceFrame& frame = places[k].frame;
      result.places[k].position += ways[i] * frame.of_u + ways[i + 1] * frame.of_v;
      result.places[k].direction += ways[i] * frame.turn_u + ways[i + 1] * frame.turn_v;
    }
    return result;
  }
  Places3 corners() const { return {&places[0], &places[1], &places[2]}; }
};

/// A triangle in space that is isometric to the rest triangle.
Triangle isometric() {
  Triangle result;
  const Vector3 base(0, 1 / rest.inverse_base, 0);
  result.places[0].position.setZero();
  result.places[1].position = base;
  result.places[2].position = rest.foot * base + Vector3(0, 0, 1 / rest.inverse_height);
  return result;
}

}  // namespace

TEST_CASE("composed energy: derivatives are those of differences, of both kinds") {
  for (const EnergyKind kind : {EnergyKind::SymmetricDirichlet, EnergyKind::AngleAndArea}) {
    const ComposedEnergy energy{{.kind = kind, .lambda = 0.7, .epsilon = 0.2}, 0.4};
    const Triangle triangle;
    const ComposedTerms terms = composed_terms(energy, rest, triangle.corners());
    CHECK(terms.value == Approx(composed_energy(energy, rest, triangle.corners())));
    const double h = 1e-5;
    for (int i = 0; i < 6; ++i) {
      const Vector6 way = h * Vector6::Unit(i);
      const ComposedTerms up = composed_terms(energy, rest, triangle.moved(way).corners());
      const ComposedTerms down = composed_terms(energy, rest, triangle.moved(-way).corners());
      CHECK(terms.gradient[i] == Approx((up.value - down.value) / (2 * h)).margin(1e-7));
      for (int k = 0; k < 6; ++k) {
        const double difference = (up.gradient[k] - down.gradient[k]) / (2 * h);
        CHECK(terms.hessian(i, k) == Approx(difference).margin(1e-6));
      }
    }
  }
}

TEST_CASE("composed energy: an isometry has the least there is") {
  const ComposedEnergy energy{{.kind = EnergyKind::SymmetricDirichlet}, 0};
  const Triangle triangle = isometric();
  CHECK(composed_energy(energy, rest, triangle.corners()) == Approx(2 * rest.area));
  CHECK(composed_terms(energy, rest, triangle.corners()).gradient.norm() < 1e-12);
}

TEST_CASE("composed energy: the more a triangle shrinks, the more it costs, with ε, too") {
  const ComposedEnergy energy{ComposedEnergy{}.energy, 0};
  Triangle triangle = isometric();
  double before = composed_energy(energy, rest, triangle.corners());
  CHECK(before == Approx(2 * rest.area).epsilon(1e-6));
  for (int halving = 0; halving < 12; ++halving) {
    for (Place& place : triangle.places) place.position /= 2;
    const double after = composed_energy(energy, rest, triangle.corners());
    CHECK(after > before);
    before = after;
  }
}

TEST_CASE(
    "composed energy: infinite where the sphere folds, finite where an image stands on edge") {
  const ComposedEnergy energy;
  Triangle triangle = isometric();
  triangle.places[2].position = 3 * triangle.places[1].position;
  CHECK(std::isfinite(composed_energy(energy, rest, triangle.corners())));
  std::swap(triangle.places[1].direction, triangle.places[2].direction);
  CHECK(std::isinf(composed_energy(energy, rest, triangle.corners())));
}

}  // namespace sphparam::tests
