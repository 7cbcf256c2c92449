#include "gltf/level.h"

#include <algorithm>

#include "io/attributes/hard_edges.h"
#include "number_text.h"
#include "sphparam/chart/chart_failure.h"

namespace sphparam {

ExportChartOptions chart_options(const ExportOptions& options) {
  return {.convention = options.convention,
          .refine_poles = options.refine_poles,
          .keep_topology = options.keep_topology,
          .upward_v = options.upward_v,
          .threads = options.threads,
          .progress = options.progress};
}

ExportChart chart_of_level(const MappedMesh& mapped, const ExportOptions& options) {
  ExportChartOptions how = chart_options(options);
  how.made = mapped.chart();
  ExportChart chart = export_chart(mapped.mesh(), mapped.topology(), mapped.map(), how);
  if (!options.keep_topology) require_one_to_one(chart.chart, mapped.name());
  if (options.shape == ShapeKind::Mesh)
    chart.wedge_normals = split_at_hard_edges(chart.chart, mapped.file(), options.threads);
  return chart;
}

namespace {

/// ": 3 17 40 …": the first of them.
std::string listed(const std::vector<Face>& faces) {
  constexpr size_t most_listed = 10;
  std::string line = ":";
  for (size_t i = 0; i < std::min(faces.size(), most_listed); ++i)
    line += " " + std::to_string(faces[i]);
  return line + (faces.size() > most_listed ? " …" : "");
}

void sort_and_merge(std::vector<Face>& faces) {
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

/// What is wrong where nothing folds.
std::string torn_line(const ChartCertificate& stored) {
  std::vector<Face> faces;
  for (const Halfedge h : stored.torn) faces.push_back(h / 3);
  sort_and_merge(faces);
  return "not one-to-one in (u, v) as stored, " +
         counted(static_cast<long>(stored.torn.size()), "edge", "edges") + " torn" +
         (faces.empty() ? "" : ", of triangles" + listed(faces));
}

}  // namespace

void warn_of_folds(const std::string& name, const ChartFigures& figures, bool topology_is_kept,
                   std::vector<std::string>& warnings) {
  const ChartCertificate& stored = figures.stored;
  std::vector<Face> wrong = stored.folded;
  wrong.insert(wrong.end(), stored.around_pole.begin(), stored.around_pole.end());
  sort_and_merge(wrong);
  if (wrong.empty() && !stored.one_to_one()) warnings.push_back(name + ": " + torn_line(stored));
  if (wrong.empty()) return;
  const std::string line = std::to_string(wrong.size()) + " of " +
                           std::to_string(figures.triangles) + " triangles fold in (u, v)" +
                           (topology_is_kept ? ", as no vertex may be added"
                                             : " as stored, being smaller than its rounding");
  warnings.push_back(name + ": " + line + listed(wrong));
}

void warn_of_moves(const std::string& name, const ExportChart& chart,
                   std::vector<std::string>& warnings) {
  const std::string moved = moved_vertices(chart.chart);
  if (!moved.empty()) warnings.push_back(name + ": " + moved);
}

ChartFigures figures_of(const ExportChart& chart) {
  return {.triangles = static_cast<long>(chart.chart.triangles.rows()),
          .vertices = static_cast<long>(chart.chart.wedge_count()),
          .splits = chart.chart.counts.splits(),
          .chart = chart.chart.certificate,
          .stored = {}};
}

}  // namespace sphparam
