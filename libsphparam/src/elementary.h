#pragma once

#include <span>

/// Sine, logarithm and their kin, of the same bits on every machine.
///
/// The C library computes them with whatever instructions the processor has: two machines, or one
/// machine with a switch set, may differ in the last bit. These are made of + − × ÷ √ on doubles
/// alone, each of which IEEE 754 rounds in one way only. Everything that a file may depend on uses
/// them: a test reads the sources.
///
/// Errors are in ulp, units in the last place of the exact result, for results that are no smaller
/// than the least normal double; measured over millions of arguments, see
/// tests/library/test_elementary.cpp. Special values (zeros and their signs, infinities, NaN) are
/// those of the C standard's functions of the same names.
/// Ensures: the same bits for any machine and compiler that keeps to IEEE doubles.
/// Cost: 10 to 40 ns. Our own; the sums of two doubles: Dekker, "A floating-point technique for
/// extending the available precision" (1971).
namespace sphparam::elementary {

// Of angles in radians, of any size. 0.8 ulp, the tangent 1; odd and even to the last bit.
double sin(double x);
double cos(double x);
double tan(double x);

/// In [0, π]; NaN outside of [−1, 1]. 1.1 ulp.
double acos(double x);
/// 0.52 ulp; odd to the last bit.
double atan(double x);
/// The angle of (x, y), in [−π, π]. 0.52 ulp; odd in y to the last bit.
double atan2(double y, double x);
/// Of many, to the same bits. Requires: as many of each. Cost: a third of one by one, or less.
void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angles);

/// 0.65 ulp.
double exp(double x);
/// 0.55 ulp.
double log(double x);
/// Of many, to the same bits. Requires: as many of each. Cost: a third of one by one, or less.
void log(std::span<const double> x, std::span<double> logs);
/// 0.55 ulp; exact at powers of two.
double log2(double x);
/// Of many, to the same bits. Requires: as many of each. Cost: a third of one by one, or less.
void log2(std::span<const double> x, std::span<double> logs);
/// x^y for x ≥ 0; NaN where x < 0. 0.7 ulp for results from e^−5 to e^5, 1.4 to e^±20, 40 anywhere.
double pow(double x, double y);

/// √(x² + y²) without overflow on the way. 0.52 ulp; exact where x or y is 0.
double hypot(double x, double y);

}  // namespace sphparam::elementary
