#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "elementary.h"
#include "support/instruction_limit.h"

// The law is the bits: they are written down here, from one machine, and hold on all. How near they
// are to the exact values is measured against long double where that has more digits.

using namespace sphparam;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr int many = 400'000;

/// Numbers that are the same everywhere, unlike those of the standard's distributions.
class Numbers {
 public:
  double between(double least, double greatest) {
    return least + (greatest - least) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  /// Of either sign, all powers of two from 2^least to 2^greatest alike.
  double of_any_size(int least, int greatest) {
    const double x = std::ldexp(between(1, 2), static_cast<int>(between(least, greatest)));
    return random_() % 2 == 0 ? x : -x;
  }

 private:
  std::mt19937_64 random_{17};
};

/// In units of the last place that a double of the exact value's size has.
double error_in_ulp(double found, long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  const long double ulp =
      std::ldexp(1.0L, std::max(exponent, std::numeric_limits<double>::min_exponent) - 53);
  return static_cast<double>(std::abs(found - exact) / ulp);
}

using Function = double (*)(double);
using LongFunction = long double (*)(long double);
using Function2 = double (*)(double, double);
using LongFunction2 = long double (*)(long double, long double);
using Argument = std::function<double(Numbers&)>;

double greatest_error(Function function, LongFunction exact, const Argument& argument) {
  Numbers numbers;
  double worst = 0;
  for (int i = 0; i < many; ++i) {
    const double x = argument(numbers), error = error_in_ulp(function(x), exact(x));
    if (!(error <= worst)) worst = error;  // NaN too
  }
  return worst;
}

double greatest_error(Function2 function, LongFunction2 exact, const Argument& first,
                      const Argument& second) {
  Numbers numbers;
  double worst = 0;
  for (int i = 0; i < many; ++i) {
    const double a = first(numbers), b = second(numbers);
    const double error = error_in_ulp(function(a, b), exact(a, b));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

constexpr bool long_double_is_longer = std::numeric_limits<long double>::digits >= 64;

std::uint64_t mixed(std::uint64_t hash, double value) {
  return (hash ^ std::bit_cast<std::uint64_t>(value)) * 1'099'511'628'211U;  // FNV
}

}  // namespace

TEST_CASE("elementary: the bits are those that are written here, on any machine") {
  namespace e = elementary;
  Numbers numbers;
  std::array<std::uint64_t, 11> hashes{};
  for (int i = 0; i < many; ++i) {
    const double angle = numbers.between(-7, 7), any = numbers.of_any_size(-1070, 1020),
                 other = numbers.of_any_size(-3, 3), positive = std::abs(any);
    const std::array<double, 11> values{e::sin(i % 2 == 0 ? angle : any),
                                        e::cos(i % 2 == 0 ? angle : any),
                                        e::tan(i % 2 == 0 ? angle : any),
                                        e::acos(angle / 7),
                                        e::atan(other),
                                        e::atan2(angle, i % 2 == 0 ? other : any),
                                        e::exp(100 * angle),
                                        e::log(i % 2 == 0 ? std::abs(angle) : positive),
                                        e::log2(positive),
                                        e::pow(std::abs(other), angle),
                                        e::hypot(angle, i % 2 == 0 ? other : any)};
    for (size_t k = 0; k < values.size(); ++k) hashes[k] = mixed(hashes[k], values[k]);
  }
  CHECK(hashes ==
        std::array<std::uint64_t, 11>{0xbadb687593c5efa2, 0x1564a40210d02c84, 0xacd6fabe37832701,
                                      0x6b483eb932f97620, 0x976aa142bb750f19, 0x8409a2b93e0a53ae,
                                      0xc7012ce79fc09541, 0x004f92457f653653, 0x8e7a7bb2b67825cc,
                                      0xbca9e3d2119779c1, 0xa92d3f2610df77e9});
}

TEST_CASE("elementary: errors are what the header says") {
  if (!long_double_is_longer) {
    WARN("skipped: long double is no longer than double");
    return;
  }
  namespace e = elementary;
  const Argument turn = [](Numbers& n) { return n.between(-7, 7); };
  const Argument any = [](Numbers& n) { return n.of_any_size(-60, 1023); };
  const Argument middling = [](Numbers& n) { return n.of_any_size(-4, 4); };
  const Argument extreme = [](Numbers& n) { return n.of_any_size(-500, 500); };
  const Argument positive = [](Numbers& n) { return std::abs(n.of_any_size(-1074, 1023)); };
  const Argument near_one = [](Numbers& n) { return n.between(0.4, 2.5); };
  // Next to multiples of π/2, where most is lost.
  const Argument near_quarter = [](Numbers& n) {
    return std::nearbyint(n.between(1, 6e5)) * (std::numbers::pi / 2) *
           (1 + n.between(-4e-16, 4e-16));
  };
  for (const Argument& angle : {turn, any, middling, near_quarter}) {
    CHECK(greatest_error(e::sin, std::sin, angle) < 0.8);
    CHECK(greatest_error(e::cos, std::cos, angle) < 0.8);
    CHECK(greatest_error(e::tan, std::tan, angle) < 1);
  }
  CHECK(greatest_error(e::acos, std::acos, [](Numbers& n) { return n.between(-1, 1); }) < 1.1);
  for (const Argument& x : {turn, any, middling}) {
    CHECK(greatest_error(e::atan, std::atan, x) < 0.52);
  }
  CHECK(greatest_error(e::exp, std::exp, [](Numbers& n) { return n.between(-708, 709); }) < 0.65);
  CHECK(greatest_error(e::exp, std::exp, [](Numbers& n) { return n.between(-1, 1); }) < 0.65);
  for (const Argument& x : {positive, near_one}) {
    CHECK(greatest_error(e::log, std::log, x) < 0.55);
    CHECK(greatest_error(e::log2, std::log2, x) < 0.55);
  }
  for (const Argument& x : {turn, middling, extreme}) {
    CHECK(greatest_error(e::atan2, std::atan2, x, middling) < 0.52);
    CHECK(greatest_error(e::atan2, std::atan2, middling, x) < 0.52);
    CHECK(greatest_error(e::hypot, std::hypot, x, middling) < 0.52);
  }
  for (const auto& [reach, error] : {std::pair(5, 0.7), std::pair(20, 1.4), std::pair(700, 40.0)}) {
    Numbers numbers;
    for (int i = 0; i < many; ++i) {
      const double x = numbers.between(0.71, 1.41), y = numbers.between(-reach, reach) / e::log(x);
      REQUIRE(error_in_ulp(e::pow(x, y), std::pow(static_cast<long double>(x), y)) < error);
    }
  }
}

TEST_CASE("elementary: odd, even, and exact where the exact value is a double") {
  namespace e = elementary;
  Numbers numbers;
  for (int i = 0; i < 10'000; ++i) {
    const double x = numbers.of_any_size(-30, 30), y = numbers.of_any_size(-30, 30);
    REQUIRE(e::sin(-x) == -e::sin(x));
    REQUIRE(e::cos(-x) == e::cos(x));
    REQUIRE(e::tan(-x) == -e::tan(x));
    REQUIRE(e::atan(-x) == -e::atan(x));
    REQUIRE(e::atan2(-y, x) == -e::atan2(y, x));
    REQUIRE(e::hypot(x, y) == e::hypot(-y, x));
    REQUIRE(e::hypot(x, 0) == std::abs(x));
    REQUIRE(e::pow(std::abs(x), 1) == std::abs(x));
  }
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    REQUIRE(e::log2(std::ldexp(1.0, exponent)) == exponent);
  }
  CHECK(e::hypot(3, 4) == 5);
  CHECK(e::pow(3, 4) == 81);
  CHECK(e::atan2(1, 1) == std::numbers::pi / 4);
  CHECK(e::acos(-1) == std::numbers::pi);
  CHECK(e::acos(0) == std::numbers::pi / 2);
  CHECK(e::exp(1) == std::numbers::e);
}

TEST_CASE("elementary: zeros, infinities and what is no number, as the C standard has them") {
  namespace e = elementary;
  for (const Function f : {e::sin, e::tan, e::atan}) {
    CHECK((f(0.0) == 0 && !std::signbit(f(0.0))));
    CHECK((f(-0.0) == 0 && std::signbit(f(-0.0))));
  }
  for (const Function f : {e::sin, e::cos, e::tan}) {
    CHECK(std::isnan(f(infinity)));
    CHECK(std::isnan(f(-infinity)));
  }
  for (const Function f : {e::sin, e::cos, e::tan, e::acos, e::atan, e::exp, e::log, e::log2}) {
    CHECK(std::isnan(f(no_number)));
  }
  CHECK(std::isnan(e::acos(1.5)));
  CHECK((e::exp(infinity) == infinity && e::exp(-infinity) == 0 && e::exp(0) == 1));
  CHECK((e::exp(710) == infinity && e::exp(-746) == 0 && e::exp(-744.5) > 0));
  for (const Function f : std::initializer_list<Function>{e::log, e::log2}) {
    CHECK((f(0) == -infinity && f(infinity) == infinity && f(1) == 0 && std::isnan(f(-1))));
  }
  const std::array<double, 9> places{0.0,   -0.0,     1.0,       -1.0,     1e-310,
                                     1e308, infinity, -infinity, no_number};
  for (const double a : places) {
    for (const double b : places) {
      INFO(a << ' ' << b);
      const double expected = std::atan2(a, b), found = e::atan2(a, b);
      CHECK(std::isnan(found) == std::isnan(expected));
      if (!std::isnan(expected)) {
        CHECK(found == expected);
        CHECK(std::signbit(found) == std::signbit(expected));
      }
      const double length = std::hypot(a, b);
      CHECK((std::isnan(length) ? std::isnan(e::hypot(a, b)) : e::hypot(a, b) == length));
      if (!(a >= 0) || std::signbit(a)) continue;
      const double power = std::pow(a, b);
      CHECK((std::isnan(power) ? std::isnan(e::pow(a, b)) : e::pow(a, b) == Approx(power)));
    }
  }
}

TEST_CASE("elementary: of many at once the bits are those of one by one, by any instructions") {
  Numbers numbers;
  std::vector<double> y, x;
  const std::array<double, 8> special{0.0,       -0.0,      infinity, -infinity,
                                      no_number, 0x1p-1074, 0x1p1023, 1.0};
  for (const double a : special) {
    for (const double b : special) y.push_back(a), x.push_back(b);
  }
  // Zeros of both signs beside what lanes take, a whole vector of the widest at a time.
  for (const auto& [a, b] : {std::pair(0.0, 1.0),
                             {-0.0, 1.0},
                             {0.0, -1.0},
                             {-0.0, -1.0},
                             {1.0, 0.0},
                             {1.0, -0.0},
                             {-1.0, 0.0},
                             {-1.0, -0.0}})
    y.insert(y.end(), 8, a), x.insert(x.end(), 8, b);
  for (int i = 0; i < many; ++i) {
    const bool usual = i % 4 != 0;
    y.push_back(usual ? numbers.between(-2, 2) : numbers.of_any_size(-1060, 1020));
    x.push_back(usual ? numbers.between(-2, 2) : numbers.of_any_size(-1060, 1020));
  }
  y.resize(y.size() - 3), x.resize(y.size());  // a last part that fills no lanes
  std::vector<double> angles(y.size()), logs(y.size()), binary(y.size());
  const auto alike = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
  };
  for (const InstructionSet set :
       {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
    const tests::InstructionLimit limit(set);
    elementary::atan2(y, x, angles);
    elementary::log(x, logs);
    elementary::log2(x, binary);
    size_t different = 0;
    for (size_t i = 0; i < y.size(); ++i) {
      different += !alike(angles[i], elementary::atan2(y[i], x[i]));
      different += !alike(logs[i], elementary::log(x[i]));
      different += !alike(binary[i], elementary::log2(x[i]));
    }
    CHECK(different == 0);
  }
}
