#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "number_text.h"

namespace sphparam {

/// Why a mesh is without these: "2 of its 4 numbers (50 %) are not finite, and a mesh keeps none of
/// these"; empty where all are finite.
inline std::string non_finite_words(const std::vector<double>& values) {
  const auto odd = std::ranges::count_if(values, [](double x) { return !std::isfinite(x); });
  if (odd == 0) return "";
  const auto share = static_cast<double>(odd) / static_cast<double>(values.size());
  return std::to_string(odd) + " of its " + std::to_string(values.size()) + " numbers (" +
         percent(share) + ") are not finite, and a mesh keeps none of these";
}

}  // namespace sphparam
