#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "sphparam/chart/spherical_chart.h"

/// The independent judge: rational areas in (u, v), of the wedges alone. Shares no code with the
/// chart, its certificate or their predicates.
namespace sphparam::tests {

using Rational = boost::multiprecision::cpp_rational;

struct ExactArea {
  Rational sum = 0;
  int not_positive = 0;
};

inline Rational exact_area_of_piece(const SphericalChart& chart, Face f) {
  std::vector<Rational> u, v;
  int rim = -1;
  for (int k = 0; k < 3; ++k) {
    u.emplace_back(chart.uv(chart.wedges(f, k), 0));
    v.emplace_back(chart.uv(chart.wedges(f, k), 1));
    if (v.back() == 0 || v.back() == 1) rim = k;
  }
  // The shoelace formula of the piece; v points south, so counter-clockwise is negative.
  if (rim >= 0) {
    const auto a = static_cast<size_t>((rim + 1) % 3), b = static_cast<size_t>((rim + 2) % 3);
    const Rational edge = v[static_cast<size_t>(rim)];
    u = {u[a], u[b], u[b], u[a]};
    v = {v[a], v[b], edge, edge};
  }
  Rational twice = 0;
  for (size_t i = 0; i < u.size(); ++i) {
    const size_t j = (i + 1) % u.size();
    twice += u[j] * v[i] - u[i] * v[j];
  }
  return twice / 2;
}

inline ExactArea exact_area(const SphericalChart& chart) {
  ExactArea result;
  for (Face f = 0; f < static_cast<Face>(chart.wedges.rows()); ++f) {
    const Rational area = exact_area_of_piece(chart, f);
    result.sum += area;
    result.not_positive += area <= 0;
  }
  return result;
}

/// How many pieces are not positive: in extended precision, and exactly where that cannot tell.
inline long count_folds(const SphericalChart& chart) {
  long folds = 0;
  for (Face f = 0; f < static_cast<Face>(chart.wedges.rows()); ++f) {
    long double u[3], v[3];
    bool rim = false;
    for (int k = 0; k < 3; ++k) {
      u[k] = chart.uv(chart.wedges(f, k), 0);
      v[k] = chart.uv(chart.wedges(f, k), 1);
      rim |= v[k] == 0 || v[k] == 1;
    }
    const long double left = (v[1] - v[0]) * (u[2] - u[0]), right = (u[1] - u[0]) * (v[2] - v[0]);
    const long double area = left - right, unsure = 1e-15L * (std::abs(left) + std::abs(right));
    if (rim || std::abs(area) <= unsure) {
      folds += exact_area_of_piece(chart, f) <= 0;
    } else {
      folds += area < 0;
    }
  }
  return folds;
}

}  // namespace sphparam::tests
