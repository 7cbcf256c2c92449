#include "elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "lanes.h"

// One method for all: an argument is brought near 0 without loss, as the sum of two doubles; there
// the Taylor series beyond its first term is so small beside that term that doubles will do for it;
// the first term is added last.
//
// Sine and cosine: r = x − n·π/2, |r| ≤ π/4; n·π/2 is subtracted in parts whose products with n are
// exact.
//
// Arctangent of q: atan q = atan c + atan t, where c is the multiple of 1/8 nearest to q, and
// t = (q − c)/(1 + q c).
//
// Logarithm: x = 2ᵉ m, and ln m = 2 artanh s, s = (m − 1)/(m + 1): the arctangent's series, with
// other signs.
//
// Exponential: eˣ = 2ⁿ eʳ, where r = x − n·ln 2, |r| ≤ ln 2 / 2.
//
// Of the C library, only functions that have no rounding are called: frexp, ldexp, nearbyint, and
// √, which IEEE 754 defines. Contraction to fused multiply-adds is off (the project's CMakeLists).

namespace sphparam::elementary {
namespace {

/// high + low, where |low| is at most half a unit in the last place of `high`. One number, or
/// several lanes of them.
template <class Number>
struct SumOf {
  Number high, low;

  SPHPARAM_INLINE Number value() const { return high + low; }
};
using Sum = SumOf<double>;

/// Exact where |a| ≥ |b| or a is 0.
template <class Number>
SPHPARAM_INLINE SumOf<Number> ordered_sum(Number a, Number b) {
  const Number high = a + b;
  return {high, b - (high - a)};
}

/// Exact.
template <class Number>
SPHPARAM_INLINE SumOf<Number> sum(Number a, Number b) {
  const Number high = a + b, of_b = high - a;
  return {high, (a - (high - of_b)) + (b - of_b)};
}

/// The upper 26 bits of a, and the rest. Requires: |a| < 2⁹⁹⁶.
template <class Number>
SPHPARAM_INLINE SumOf<Number> halves(Number a) {
  const Number shifted = 0x1.0000002p27 * a;
  const Number high = shifted - (shifted - a);
  return {high, a - high};
}

/// Exact but for underflow.
template <class Number>
SPHPARAM_INLINE SumOf<Number> product(Number a, Number b) {
  const SumOf<Number> x = halves(a), y = halves(b);
  const Number high = a * b;
  return {high, ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

/// Exact where `few` has at most 26 bits.
template <class Number>
SPHPARAM_INLINE SumOf<Number> product_with_few(Number few, Number b) {
  const SumOf<Number> y = halves(b);
  const Number high = few * b;
  return {high, (few * y.high - high) + few * y.low};
}

template <class Number>
SPHPARAM_INLINE SumOf<Number> operator-(SumOf<Number> a) {
  return {-a.high, -a.low};
}

template <class Number>
SPHPARAM_INLINE SumOf<Number> operator+(SumOf<Number> a, SumOf<Number> b) {
  const SumOf<Number> high = sum(a.high, b.high);
  return ordered_sum(high.high, high.low + (a.low + b.low));
}

template <class Number>
SPHPARAM_INLINE SumOf<Number> operator-(SumOf<Number> a, SumOf<Number> b) {
  return a + -b;
}

template <class Number>
SPHPARAM_INLINE SumOf<Number> operator*(SumOf<Number> a, SumOf<Number> b) {
  const SumOf<Number> high = product(a.high, b.high);
  return ordered_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

template <class Number>
SPHPARAM_INLINE SumOf<Number> operator/(SumOf<Number> a, SumOf<Number> b) {
  const Number inverse = 1.0 / b.high, high = a.high * inverse;
  const SumOf<Number> back = product(high, b.high);  // what is left of a corrects both roundings
  return ordered_sum(high, (((a.high - back.high) - back.low) + (a.low - high * b.low)) * inverse);
}

template <int W>
SPHPARAM_INLINE SumOf<Lanes<W>> select(LaneMask<W> m, const SumOf<Lanes<W>>& a,
                                       const SumOf<Lanes<W>>& b) {
  return {select(m, a.high, b.high), select(m, a.low, b.low)};
}

/// Requires: a > 0.
Sum root(Sum a) {
  const double high = std::sqrt(a.high);
  const Sum back = product(high, high);
  return ordered_sum(high, (((a.high - back.high) - back.low) + a.low) / (2 * high));
}

/// c₀ + c₁ x + c₂ x² + …
template <size_t n, class Number>
SPHPARAM_INLINE Number polynomial(const std::array<double, n>& c, const Number& x) {
  Number value = c[n - 1];
  for (size_t i = n - 1; i-- > 0;) value = Number(c[i]) + x * value;
  return value;
}

/// 1/first!, sign/(first + step)!, 1/(first + 2 step)!, …
template <size_t n>
constexpr std::array<double, n> inverse_factorials(int first, int step, double sign) {
  std::array<double, n> result{};
  double factorial = 1;  // exact to 20!: its odd part has fewer than 53 bits
  for (int i = 2; i <= first; ++i) factorial *= i;
  double turn = 1;
  for (size_t k = 0; k < n; ++k) {
    result[k] = turn / factorial;
    const int at = first + static_cast<int>(k) * step;
    for (int i = at + 1; i <= at + step; ++i) factorial *= i;
    turn *= sign;
  }
  return result;
}

/// 1/3, sign/5, 1/7, …
template <size_t n>
constexpr std::array<double, n> inverse_odds(double sign) {
  std::array<double, n> result{};
  double turn = 1;
  for (size_t k = 0; k < n; ++k) {
    result[k] = turn / static_cast<double>(2 * k + 3);
    turn *= sign;
  }
  return result;
}

constexpr Sum pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Sum half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// An angle less n quarters of a turn, |rest| ≤ π/4 up to rounding.
struct Reduced {
  unsigned quarters;  // n modulo 4
  Sum rest;
};

/// π/2 = Σ parts, 33 bits each but the last: products with n < 2²⁰ are exact.
Reduced reduce_small(double x) {
  constexpr std::array<double, 4> parts{0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                        0x1.b839a252049c1p-104};
  constexpr double quarters_per_radian = 0x1.45f306dc9c883p-1;
  const double n = std::nearbyint(x * quarters_per_radian);
  const Sum second = sum(x - n * parts[0], -n * parts[1]);
  const Sum third = sum(second.high, -n * parts[2]);
  const Sum rest = ordered_sum(third.high, (second.low + third.low) - n * parts[3]);
  return {static_cast<unsigned>(static_cast<std::int64_t>(n)) & 3U, rest};
}

/// 64 zeros, then the binary digits of 1/2π, 32 a word.
constexpr std::array<std::uint32_t, 42> inverse_turn{
    0,          0,          0x28be60db, 0x9391054a, 0x7f09d5f4, 0x7d4d3770, 0x36d8a566,
    0x4f10e410, 0x7f9458ea, 0xf7aef158, 0x6dc91b8e, 0x909374b8, 0x01924bba, 0x82746487,
    0x3f877ac7, 0x2c4a69cf, 0xba208d7d, 0x4baed121, 0x3a671c09, 0xad17df90, 0x4e64758e,
    0x60d4ce7d, 0x272117e2, 0xef7e4a0e, 0xc7fe25ff, 0xf7816603, 0xfbcbc462, 0xd6829b47,
    0xdb4d9fb3, 0xc9f2c26d, 0xd3d18fd9, 0xa797fa8b, 0x5d49eeb1, 0xfaf97c5e, 0xcf41ce7d,
    0xe294a4ba, 0x9afed7ec, 0x47e35742, 0x1580cc11, 0xbf1edaea, 0xfc33ef08, 0x26bd0d87};

using Fraction = std::array<std::uint32_t, 7>;  // of a turn, binary digits from the first down

/// The digits of 2ᵉ/2π after the point. Requires: −64 ≤ e ≤ 971.
Fraction digits_of_inverse_turn(int e) {
  const auto word = static_cast<size_t>((e + 64) / 32);
  const int shift = (e + 64) % 32;
  Fraction result{};
  for (size_t i = 0; i < result.size(); ++i) {
    const std::uint64_t pair =
        std::uint64_t{inverse_turn[word + i]} << 32 |
        (word + i + 1 < inverse_turn.size() ? inverse_turn[word + i + 1] : 0);
    result[i] = static_cast<std::uint32_t>(pair >> (32 - shift));
  }
  return result;
}

/// What is left of m·fraction beyond whole turns.
Fraction times(const Fraction& fraction, std::uint64_t m) {
  Fraction result{};
  for (size_t half = 0; half < 2; ++half) {
    const std::uint64_t factor = half == 0 ? m & 0xffffffff : m >> 32;
    std::uint64_t carry = 0;
    for (size_t i = fraction.size(); i-- > half;) {
      const std::uint64_t digit = factor * fraction[i] + result[i - half] + carry;
      result[i - half] = static_cast<std::uint32_t>(digit);
      carry = digit >> 32;
    }
  }
  return result;
}

/// Payne and Hanek, "Radian reduction for trigonometric functions" (1983): x = m·2ᵉ, and of
/// m·2ᵉ/2π only the digits after the point matter, 224 − 53 of which are right.
Reduced reduce_large(double x) {
  int exponent = 0;
  const auto m = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  Fraction turns = times(digits_of_inverse_turn(exponent - 53), m);
  turns[0] += 0x20000000;  // an eighth: to the nearest quarter
  const unsigned quarters = turns[0] >> 30;
  Sum rest{0, 0};
  for (size_t i = turns.size(); i-- > 1;) {
    rest = rest + Sum{std::ldexp(turns[i], -32 * static_cast<int>(i + 1)), 0};
  }
  rest = rest + Sum{std::ldexp(static_cast<double>(turns[0] & 0x3fffffff) - 0x20000000, -32), 0};
  rest = rest * Sum{2 * pi.high, 2 * pi.low};
  return x < 0 ? Reduced{-quarters & 3U, -rest} : Reduced{quarters, rest};
}

Reduced reduce(double x) { return std::abs(x) < 0x1p20 ? reduce_small(x) : reduce_large(x); }

/// r − r³/3! + r⁵/5! − …; |r| ≤ π/4: what is left out is below 2⁻⁶² of r.
Sum sine_series(Sum r) {
  static constexpr auto c = inverse_factorials<8>(3, 2, -1);
  const double square = r.high * r.high;
  return ordered_sum(r.high, r.low * (1 - square / 2) - r.high * square * polynomial(c, square));
}

/// 1 − r²/2! + r⁴/4! − …; the first two terms exactly.
Sum cosine_series(Sum r) {
  static constexpr auto c = inverse_factorials<8>(4, 2, -1);
  const Sum square = product(r.high, r.high);
  const Sum begin = ordered_sum(1.0, -square.high / 2);
  return ordered_sum(begin.high, begin.low - square.low / 2 - r.high * r.low +
                                     square.high * square.high * polynomial(c, square.high));
}

/// sin of the angle plus `more` quarters.
Sum sine(const Reduced& angle, unsigned more) {
  const unsigned quarters = (angle.quarters + more) & 3U;
  const Sum value = quarters % 2 == 0 ? sine_series(angle.rest) : cosine_series(angle.rest);
  return quarters < 2 ? value : -value;
}

bool is_nan_or_infinite(double x) { return !(std::abs(x) <= std::numeric_limits<double>::max()); }

/// atan(k/8).
constexpr std::array<Sum, 9> arc_tangents{{{0, 0},
                                           {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                           {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                           {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                           {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                           {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                           {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                           {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                           {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};

/// c, the multiple of 1/8 nearest to a ratio, and atan c.
template <class Number>
struct Eighth {
  Number c;
  SumOf<Number> angle;
};

Eighth<double> nearest_eighth(double ratio) {
  const int k = static_cast<int>(8 * ratio + 0.5);
  return {k / 8.0, arc_tangents[static_cast<size_t>(k)]};
}

template <int W>
SPHPARAM_INLINE Eighth<Lanes<W>> nearest_eighth(const Lanes<W>& ratio) {
  Eighth<Lanes<W>> result{0.0, {0.0, 0.0}};
  for (int i = 0; i < W; ++i) {
    const int k = static_cast<int>(8 * ratio[i] + 0.5);
    result.c.v[i] = k;
    result.angle.high.v[i] = arc_tangents[static_cast<size_t>(k)].high;
    result.angle.low.v[i] = arc_tangents[static_cast<size_t>(k)].low;
  }
  result.c = result.c / 8.0;
  return result;
}

/// atan(a/b) for a/b, 0 ≤ a ≤ b. |t| ≤ 1/16: what the series leaves out is below 2⁻⁶⁸ of t.
template <class Number>
SPHPARAM_INLINE SumOf<Number> arc_tangent(const Number& a, const Number& b, const Number& ratio) {
  static constexpr auto series = inverse_odds<7>(-1);
  const Eighth<Number> begin = nearest_eighth(ratio);
  const SumOf<Number> top = SumOf<Number>{a, 0.0} - product_with_few(begin.c, b);
  const SumOf<Number> t = top / (SumOf<Number>{b, 0.0} + product_with_few(begin.c, a));
  const Number square = t.high * t.high;
  const SumOf<Number> first = sum(begin.angle.high, t.high);
  return ordered_sum(first.high, first.low + (begin.angle.low + t.low -
                                              t.high * square * polynomial(series, square)));
}

constexpr double negligible = 0x1p-40;  // a ratio: its square, beside 1

Sum arc_tangent(double a, double b) {
  const double ratio = a / b;
  return ratio < negligible ? Sum{ratio, 0} : arc_tangent(a, b, ratio);
}

// Products of halves neither overflow nor vanish.
constexpr double least_plain = 0x1p-900, greatest_plain = 0x1p900;

/// Needs nothing but arithmetic: finite, not both 0, and of usual sizes.
template <int W>
SPHPARAM_INLINE bool are_plain(const Lanes<W>& y, const Lanes<W>& x) {
  const Lanes<W> a = magnitude(y), b = magnitude(x), greater = larger(a, b);
  const LaneMask<W> plain =
      (greater > least_plain) & (greater < greatest_plain) & (a == a) & (b == b);
  return !(~plain).any();
}

/// Requires: plain ones.
template <int W>
SPHPARAM_INLINE Lanes<W> atan2_of_plain(const Lanes<W>& y, const Lanes<W>& x) {
  using Sums = SumOf<Lanes<W>>;
  const auto all = [](const Sum& a) SPHPARAM_INLINED { return Sums{a.high, a.low}; };
  const Lanes<W> of_y = magnitude(y), of_x = magnitude(x);
  const LaneMask<W> steep = of_y > of_x;
  const Lanes<W> a = select(steep, of_x, of_y), b = select(steep, of_y, of_x), ratio = a / b;
  Sums angle = select(ratio < negligible, Sums{ratio, 0.0}, arc_tangent(a, b, ratio));
  angle = select(steep, all(half_pi) - angle, angle);
  angle = select(sign_bit(x), all(pi) - angle, angle);
  const Lanes<W> value = angle.value();
  return select(sign_bit(y), -value, value);
}

/// ln m, √½ ≤ m < √2. |s| < 0.172: what the series leaves out is below 2⁻⁶⁴ of s.
template <class Number>
SPHPARAM_INLINE SumOf<Number> log_near_one(const Number& m) {
  static constexpr auto series = inverse_odds<11>(1);
  const Number beyond = m - 1.0;
  const SumOf<Number> s = SumOf<Number>{beyond, 0.0} / sum(Number(2.0), beyond);
  const Number square = s.high * s.high;
  return ordered_sum(2.0 * s.high, 2.0 * (s.low + s.high * square * polynomial(series, square)));
}

constexpr double sqrt_half = 0x1.6a09e667f3bcdp-1;

/// x = 2ᵉ m, √½ ≤ m < √2. Requires: x > 0, finite.
std::pair<double, int> split(double x) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);
  return m < sqrt_half ? std::pair(2 * m, exponent - 1) : std::pair(m, exponent);
}

/// ln 2; products of the first part with integers below 2¹¹ are exact.
constexpr Sum log_of_two{0x1.62e42fefa38p-1, 0x1.ef35793c7673p-45};

/// ln (2ᵉ m).
template <class Number>
SPHPARAM_INLINE SumOf<Number> log_of(const Number& m, const Number& e) {
  const SumOf<Number> rest = log_near_one(m);
  const SumOf<Number> first = sum(e * log_of_two.high, rest.high);
  return ordered_sum(first.high, first.low + (rest.low + e * log_of_two.low));
}

/// Requires: x > 0, finite.
Sum log_sum(double x) {
  const auto [m, e] = split(x);
  return log_of<double>(m, e);
}

template <int W>
struct SplitLanes {
  Lanes<W> m, e;
};

/// As `split`. Requires: normal numbers > 0.
template <int W>
SPHPARAM_INLINE SplitLanes<W> split_lanes(const Lanes<W>& x) {
  using Bits = typename LaneMask<W>::Vector;
  constexpr long long mantissa = 0x000fffffffffffff, one_half = 0x3fe0000000000000;
  constexpr long long to_double = 0x4338000000000000;  // the bits of 3·2⁵¹, to which e is added
  Bits bits;
  __builtin_memcpy(&bits, &x.v, sizeof bits);
  const Bits m_bits = (bits & mantissa) | one_half;
  Lanes<W> m, e;
  __builtin_memcpy(&m.v, &m_bits, sizeof m_bits);
  const LaneMask<W> low = m < sqrt_half;
  const Bits e_bits = (bits >> 52) - 1022 + low.v + to_double;  // one less where low
  __builtin_memcpy(&e.v, &e_bits, sizeof e_bits);
  return {select(low, 2.0 * m, m), e - 0x1.8p52};
}

/// log2 (2ᵉ m).
template <class Number>
SPHPARAM_INLINE SumOf<Number> log2_of(const Number& m, const Number& e) {
  constexpr Sum per_log{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
  return SumOf<Number>{e, 0.0} + log_near_one(m) * SumOf<Number>{per_log.high, per_log.low};
}

/// Logarithms of many: those of normal numbers > 0 side by side by `of(m, e)`, others by `alone`.
template <class Of>
SPHPARAM_INLINE void logs_of(std::span<const double> x, std::span<double> logs,
                             double (*alone)(double), const Of& of) {
  constexpr double least = std::numeric_limits<double>::min(),
                   infinite = std::numeric_limits<double>::infinity();
  size_t i = 0;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (; i + W <= logs.size(); i += W) {
      const Lanes<W> numbers = load<W>(&x[i]);
      if (!(~(numbers > least) | ~(numbers < infinite)).any()) {
        const SplitLanes<W> parts = split_lanes(numbers);
        store(of(parts.m, parts.e).value(), &logs[i]);
      } else {
        for (size_t k = i; k < i + W; ++k) logs[k] = alone(x[k]);
      }
    }
  });
  for (; i < logs.size(); ++i) logs[i] = alone(x[i]);
}

/// log, log2 where the argument is not positive and finite.
double log_of_special(double x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  return x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
}

/// Requires: |x| < 1000. |r| ≤ ln 2 / 2: what the series leaves out is below 2⁻⁶².
double exp_sum(Sum x) {
  static constexpr auto series = inverse_factorials<13>(2, 1, 1);
  const double n = std::nearbyint(x.high * 0x1.71547652b82fep+0);
  const Sum rest = sum(x.high - n * log_of_two.high, -n * log_of_two.low);
  const Sum r = ordered_sum(rest.high, rest.low + x.low);
  const Sum first = ordered_sum(1.0, r.high);
  const double more = r.low + r.low * r.high + r.high * r.high * polynomial(series, r.high);
  return std::ldexp(first.high + (first.low + more), static_cast<int>(n));
}

constexpr double beyond_exp = 800;  // e^±that is infinite, or 0

}  // namespace

double sin(double x) {
  if (x == 0 || is_nan_or_infinite(x)) return x == 0 ? x : x - x;
  return sine(reduce(x), 0).value();
}

double cos(double x) { return is_nan_or_infinite(x) ? x - x : sine(reduce(x), 1).value(); }

double tan(double x) {
  if (x == 0 || is_nan_or_infinite(x)) return x == 0 ? x : x - x;
  const Reduced angle = reduce(x);
  return (sine(angle, 0) / sine(angle, 1)).value();
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  if (std::abs(x) == 1) return x > 0 ? 0 : pi.high;
  return atan2(root(sum(1.0, -x) * sum(1.0, x)).value(), x);
}

double atan(double x) { return atan2(x, 1); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  double a = std::abs(y), b = std::abs(x);
  if (a == 0 && b == 0) b = 1;
  if (is_nan_or_infinite(a) || is_nan_or_infinite(b)) {  // as if the finite one were 0
    a = is_nan_or_infinite(a) ? 1 : 0;
    b = is_nan_or_infinite(b) ? 1 : 0;
  }
  const bool steep = a > b;
  if (steep) std::swap(a, b);
  if (!(b > least_plain && b < greatest_plain)) {
    const double scale = b < 1 ? 0x1p170 : 0x1p-170;
    a *= scale;
    b *= scale;
  }
  Sum angle = arc_tangent(a, b);
  if (steep) angle = half_pi - angle;
  if (std::signbit(x)) angle = pi - angle;
  return std::copysign(angle.value(), y);
}

void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angles) {
  size_t i = 0;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (; i + W <= angles.size(); i += W) {
      const Lanes<W> up = load<W>(&y[i]), along = load<W>(&x[i]);
      if (are_plain(up, along)) {
        store(atan2_of_plain(up, along), &angles[i]);
      } else {
        for (size_t k = i; k < i + W; ++k) angles[k] = atan2(y[k], x[k]);
      }
    }
  });
  for (; i < angles.size(); ++i) angles[i] = atan2(y[i], x[i]);
}

double exp(double x) {
  if (std::isnan(x)) return x;
  if (std::abs(x) > beyond_exp) return x > 0 ? std::numeric_limits<double>::infinity() : 0;
  return exp_sum({x, 0});
}

double log(double x) {
  if (!(x > 0) || is_nan_or_infinite(x)) return log_of_special(x);
  return log_sum(x).value();
}

void log(std::span<const double> x, std::span<double> logs) {
  logs_of(x, logs, log, [](const auto& m, const auto& e) SPHPARAM_INLINED { return log_of(m, e); });
}

double log2(double x) {
  if (!(x > 0) || is_nan_or_infinite(x)) return log_of_special(x);
  const auto [m, e] = split(x);
  return log2_of<double>(m, e).value();
}

void log2(std::span<const double> x, std::span<double> logs) {
  logs_of(x, logs, log2,
          [](const auto& m, const auto& e) SPHPARAM_INLINED { return log2_of(m, e); });
}

double pow(double x, double y) {
  if (x == 1 || y == 0) return 1;
  if (!(x >= 0) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0 || is_nan_or_infinite(x)) {
    return (x == 0) == (y > 0) ? 0 : std::numeric_limits<double>::infinity();
  }
  const Sum log = log_sum(x);
  if (!(std::abs(y * log.high) < beyond_exp)) {
    return (y > 0) == (log.high > 0) ? std::numeric_limits<double>::infinity() : 0;
  }
  return exp_sum(Sum{y, 0} * log);
}

double hypot(double x, double y) {
  if (is_nan_or_infinite(x) || is_nan_or_infinite(y)) {
    const bool infinite = std::isinf(x) || std::isinf(y);
    return infinite ? std::numeric_limits<double>::infinity() : x + y;
  }
  double a = std::max(std::abs(x), std::abs(y)), b = std::min(std::abs(x), std::abs(y));
  if (b == 0) return a;
  const int exponent = a > 0x1p-400 && a < 0x1p400 ? 0 : std::ilogb(a);
  if (exponent != 0) {
    a = std::ldexp(a, -exponent);
    b = std::ldexp(b, -exponent);
  }
  return std::ldexp(root(product(a, a) + product(b, b)).value(), exponent);
}

}  // namespace sphparam::elementary
