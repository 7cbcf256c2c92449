#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sphparam {

/// One figure of many shapes.
struct Distribution {
  std::vector<std::size_t> items;  // that have the figure
  std::vector<double> values;      // theirs, positive
  double lower_quartile = 0, median = 0, upper_quartile = 0;
  double outlier_from = 0;  // beyond the upper quartile by 1.5 distances of the quartiles, of ln
};

/// Figures that are not finite or not positive count as missing.
Distribution distribution_of(const std::vector<std::optional<double>>& values);

/// How far out, in distances of the quartiles of ln beyond the upper one; at most 0: not at all.
double outlyingness(const Distribution& distribution, double value);

/// As SVG: logarithmic bars, quartiles marked, outliers as marks of their own that are links to
/// #ID. `names`: of the items.
std::string distribution_plot(const Distribution& distribution, const std::string& title,
                              const std::vector<std::string>& names);

}  // namespace sphparam
