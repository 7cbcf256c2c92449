#include "sphparam/chart/chart_failure.h"

#include "sphparam/errors.h"

namespace sphparam {

std::string split_limit_reached(const SphericalChart& chart) {
  return "its " + std::to_string(chart.counts.folded_faces) +
         " folds in (u, v) take more than the " + std::to_string(chart.counts.fold_splits) +
         " splits that are made at most";
}

std::string chart_failure(const SphericalChart& chart) {
  if (chart.counts.at_limit) return "its map is one-to-one, but " + split_limit_reached(chart);
  return "its map is one-to-one, but thinner in (u, v) than doubles can tell: " +
         std::to_string(chart.certificate.folded.size()) + " triangles fold there";
}

void require_one_to_one(const SphericalChart& chart, const std::string& name) {
  if (!chart.certificate.one_to_one()) throw NotCertifiedError(name + ": " + chart_failure(chart));
}

}  // namespace sphparam
