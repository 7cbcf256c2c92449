#include "render/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "elementary.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

/// Piecewise linear through equally spaced colours.
template <size_t N>
Rgb interpolate(const std::array<std::array<float, 3>, N>& table, double t) {
  if (std::isnan(t)) t = 0;
  const double place = std::clamp(t, 0.0, 1.0) * (N - 1);
  const size_t i = std::min(static_cast<size_t>(place), N - 2);
  const auto share = static_cast<float>(place - static_cast<double>(i));
  const Rgb a(table[i].data()), b(table[i + 1].data());
  return a + share * (b - a);
}

}  // namespace

Rgb to_linear(const Rgb& srgb) {
  return srgb.unaryExpr([](float c) { return SrgbCurves::get().to_linear(c); });
}

Rgb to_srgb(const Rgb& linear) {
  return linear.unaryExpr([](float c) { return SrgbCurves::get().to_srgb(c); });
}

Rgb viridis(double t) {
  // Nine colours of matplotlib's table (van der Walt and Smith 2015, CC0).
  constexpr std::array<std::array<float, 3>, 9> table{{{0.267F, 0.005F, 0.329F},
                                                       {0.279F, 0.175F, 0.483F},
                                                       {0.230F, 0.322F, 0.546F},
                                                       {0.173F, 0.449F, 0.558F},
                                                       {0.128F, 0.567F, 0.551F},
                                                       {0.158F, 0.684F, 0.502F},
                                                       {0.369F, 0.789F, 0.383F},
                                                       {0.678F, 0.864F, 0.190F},
                                                       {0.993F, 0.906F, 0.144F}}};
  return interpolate(table, t);
}

Rgb diverging(double t) {
  // ColorBrewer's RdBu turned round (Brewer 2003), its middle a little brighter.
  constexpr std::array<std::array<float, 3>, 9> table{{{0.080F, 0.270F, 0.530F},
                                                       {0.263F, 0.576F, 0.765F},
                                                       {0.573F, 0.773F, 0.871F},
                                                       {0.820F, 0.898F, 0.941F},
                                                       {0.970F, 0.970F, 0.965F},
                                                       {0.992F, 0.859F, 0.780F},
                                                       {0.957F, 0.647F, 0.510F},
                                                       {0.839F, 0.376F, 0.302F},
                                                       {0.640F, 0.060F, 0.150F}}};
  return interpolate(table, (t + 1) / 2);
}

std::vector<Rgb> ratio_colours(const VectorX& ratios, double reach) {
  std::vector<Rgb> colours;
  colours.reserve(static_cast<size_t>(ratios.size()));
  for (const double ratio : ratios)
    colours.push_back(diverging(elementary::log(ratio) / elementary::log(reach)));
  return colours;
}

std::vector<Rgb> value_colours(const VectorX& values, double low, double high) {
  std::vector<Rgb> colours;
  colours.reserve(static_cast<size_t>(values.size()));
  for (const double value : values) colours.push_back(viridis((value - low) / (high - low)));
  return colours;
}

}  // namespace sphparam
