#include "sphparam/chart/chart_failure.h"

#include "number_text.h"
#include "sphparam/errors.h"

namespace sphparam {

namespace {

constexpr double rounding = 0x1p-23;  // of a turn: what vertices move by when they settle, at least

}  // namespace

std::string moved_vertices(const ChartCounts& counts, const ChartCertificate& certificate,
                           long vertices) {
  const double moved = counts.nudged_vertices, by = certificate.max_shift;
  if (moved == 0 || by <= rounding || !certificate.one_to_one()) return "";
  return "where triangles are thinner than (u, v) can tell, " +
         percent(moved / static_cast<double>(vertices)) +
         " of its vertices moved there, by up to " + short_number(by) + " of a turn";
}

std::string moved_vertices(const SphericalChart& chart) {
  return moved_vertices(chart.counts, chart.certificate, chart.points.rows());
}

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
