#include "sphparam/chart/chart_report.h"

#include "sphparam/chart/chart_failure.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

namespace {

std::string failures(const ChartCertificate& certificate) {
  std::string text;
  const auto count = [&](size_t number, const char* what) {
    if (number > 0) text.append(", ").append(std::to_string(number)).append(what);
  };
  count(certificate.folded.size(), " folded");
  count(certificate.torn.size(), " torn edges");
  count(certificate.outside.size(), " wedges outside");
  count(certificate.malformed.size(), " malformed");
  count(certificate.around_pole.size(), " around a pole");
  return text;
}

ChartReport figures_of(const SphericalChart& chart) {
  if (chart.counts.at_limit) return {.not_made = split_limit_reached(chart)};
  return {.counts = chart.counts,
          .certificate = chart.certificate,
          .vertices = chart.points.rows(),
          .triangles = chart.triangles.rows(),
          .wedges = chart.wedge_count()};
}

}  // namespace

std::optional<ChartReport> report_chart(const TriangleMesh& mesh, const SphereMap& map, int threads,
                                        const Progress& progress, int splits_a_vertex) {
  const Topology topology(mesh, threads);
  const SphereMap unit = normalised(map.points);
  if (!certify(topology, unit, threads).bijective()) return std::nullopt;
  return figures_of(spherical_chart(mesh, topology, unit, threads, progress, splits_a_vertex));
}

std::string chart_line(const std::optional<ChartReport>& chart) {
  if (!chart) return "chart: none, the map is not one-to-one with rays of unit length";
  if (!chart->not_made.empty()) return "chart: not made: " + chart->not_made;
  const ChartCounts& counts = chart->counts;
  const bool certified = chart->certificate.one_to_one();
  const std::string moved = moved_vertices(counts, chart->certificate, chart->vertices);
  return "chart: " + std::string(certified ? "certified" : "not one-to-one") +
         (certified ? "" : failures(chart->certificate)) + ", " + std::to_string(counts.splits()) +
         " splits (" + std::to_string(counts.pole_splits) + " at ±z, " +
         std::to_string(counts.meridian_splits) + " along the meridian, " +
         std::to_string(counts.fold_splits) + " of " + std::to_string(counts.folded_faces) +
         " folds), " + std::to_string(chart->triangles) + " triangles, " +
         std::to_string(chart->wedges) + " wedges" + (moved.empty() ? "" : "; " + moved);
}

}  // namespace sphparam
