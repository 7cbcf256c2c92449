#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "embedding/energy/energy_terms.h"
#include "embedding/energy/orientation_guard.h"

using namespace sphparam;

namespace {

struct Sample {
  double d, s, area;  // of the rest triangle
  double shape;       // α/β
};

Sample random_sample(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  return {between(0.5, 4), between(0.1, 3), between(1e-6, 2), between(0.1, 10)};
}

/// The terms of the whole triangle are those of `differentiate`, the corner's are F times them in
/// K = F² d and S = F s.
template <class Terms>
void check_terms(const Terms& terms, const DistortionEnergy& energy) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    const auto [d, s, area, shape] = random_sample(random);
    const EnergyDerivatives f = differentiate(energy, d, s);
    const EnergyTerms<double> whole = terms.terms(d, s);
    REQUIRE(terms.value(d, s) == Approx(f.f).epsilon(1e-13));
    REQUIRE(whole.f == Approx(f.f).epsilon(1e-13));
    REQUIRE(whole.f_d == Approx(f.f_d).epsilon(1e-13));
    REQUIRE(whole.f_s == Approx(f.f_s).epsilon(1e-12).margin(1e-12));
    REQUIRE(whole.f_ds == Approx(f.f_ds).epsilon(1e-13));
    REQUIRE(whole.f_ss == Approx(f.f_ss).epsilon(1e-12).margin(1e-12));

    const double beta = area / (4 * std::sqrt(shape)), alpha = shape * beta;  // 16αβ = F²
    const double k = area * area * d, big_s = area * s;
    const EnergyTerms<double> corner = terms.corner_terms(k, big_s, alpha, beta);
    REQUIRE(terms.corner_value(k, big_s, alpha, beta) == Approx(area * f.f).epsilon(1e-12));
    REQUIRE(corner.f == Approx(area * f.f).epsilon(1e-12));
    REQUIRE(corner.f_d * area == Approx(f.f_d).epsilon(1e-12));
    REQUIRE(corner.f_s == Approx(f.f_s).epsilon(1e-11).margin(1e-11));
    REQUIRE(corner.f_ds * area * area == Approx(f.f_ds).epsilon(1e-12));
    REQUIRE(corner.f_ss * area == Approx(f.f_ss).epsilon(1e-11).margin(1e-11));
  }
}

}  // namespace

TEST_CASE("energy_terms: of a triangle and from its corner they are the regularised ones at 0") {
  for (const double lambda : {0.0, 0.3, 1.0, 50.0}) {
    check_terms(AngleAndAreaTerms{lambda}, {.lambda = lambda});
  }
  check_terms(SymmetricDirichletTerms{}, {.kind = EnergyKind::SymmetricDirichlet});
}

TEST_CASE("energy_terms: where there is no triangle the corner's terms are finite") {
  const EnergyTerms<double> none = SymmetricDirichletTerms{}.corner_terms(0.0, 1.0, 0.0, 0.0);
  CHECK(none.f == 0);
  CHECK(none.f_s == 0);
  CHECK(none.f_ss == 0);
}

TEST_CASE("orientation_guard: nothing that rounding may have made is certain") {
  CHECK(certainly_positive(1e-3, 1.0));
  CHECK_FALSE(certainly_positive(1e-15, 1.0));
  CHECK_FALSE(certainly_positive(0.0, 0.0));
  CHECK_FALSE(certainly_positive(-1.0, 1.0));
}
