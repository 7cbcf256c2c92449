#include "compare/entry.h"

#include <utility>

#include "number_text.h"
#include "report/svg.h"
#include "sphparam/io/fillers.h"
#include "sphparam/stopwatch.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

void measure(Entry& entry, const TriangleMesh& mesh, int threads) {
  if (!entry.has_map() || !entry.certificate.unusable_points.empty()) return;
  entry.distortion = measure_distortion(mesh, entry.map, threads);
  entry.figures = summarise(*entry.distortion, threads);
}

std::string grouped_count(long count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

std::vector<std::string> table_row(const Entry& c) {
  std::vector<std::string> row = {c.name, c.seconds ? significant(*c.seconds) : "–"};
  if (!c.has_map()) {
    row.insert(row.end(), {"–", "–", "no map", "–", "–", "–", "–"});
    return row;
  }
  const bool folded = c.certificate.fold_count() > 0;  // the degree is counted without folds only
  row.push_back(grouped(c.certificate.fold_count()));
  row.push_back(folded ? "–" : std::to_string(c.certificate.degree));
  row.push_back(c.certificate.bijective() ? "yes" : "no");
  if (!c.figures) {
    row.insert(row.end(), 4, "–");
    return row;
  }
  row.push_back(significant(c.figures->mean_abs_ln_angle) + flat_images_words(*c.figures));
  for (const double figure : {c.figures->mean_abs_ln_area, c.figures->weighted_abs_log2_area,
                              c.figures->symmetric_dirichlet}) {
    row.push_back(significant(figure));
  }
  return row;
}

}  // namespace

Entry entry_of_method(AnyMethod method, const TriangleMesh& mesh,
                      const ParameterizeOptions& options) {
  const MethodInfo& info = info_of(method);
  const Stopwatch stopwatch;
  MethodRun run = run_method(method, mesh, require_sphere(mesh, options.threads), options);
  Entry entry = {.name = info.name, .source = info.citation};
  entry.seconds = stopwatch.seconds();
  entry.iterations = run.account ? run.account->iterations : 0;
  entry.statement = run.account ? run.account->statement : joined(run.result.warnings, "; ");
  entry.map = std::move(run.result.map);
  entry.certificate = std::move(run.result.certificate);
  entry.stages = std::move(run.result.stages);
  measure(entry, mesh, options.threads);
  return entry;
}

Entry entry_of_map(std::string name, std::string source, const TriangleMesh& mesh,
                   const SphereMap& map, int threads) {
  Entry entry = {.name = std::move(name), .source = std::move(source)};
  entry.certificate = certify(Topology(mesh, threads), map, threads);
  const bool usable = entry.certificate.unusable_points.empty();
  entry.map = usable ? normalised(map.points) : map;
  measure(entry, mesh, threads);
  return entry;
}

void measure_surface(Entry& entry, const MeshFile& file, int threads) {
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty() || !entry.distortion) return;
  entry.distortion = measure_distortion(surface_of(file.mesh, fillers), entry.map, threads);
  entry.figures = summarise(*entry.distortion, threads);
}

std::string short_verdict(const Entry& entry) {
  const Certificate& c = entry.certificate;
  if (!entry.has_map()) return "no map";
  if (c.bijective()) return "one-to-one";
  if (!c.unusable_points.empty())
    return grouped_count(std::ssize(c.unusable_points), "unusable point");
  if (c.fold_count() > 0) return grouped_count(c.fold_count(), "fold");
  return "degree " + std::to_string(c.degree);
}

PageTable comparison_table(const std::vector<Entry>& entries) {
  PageTable table = {
      .caption =
          "Time is wall time. Folds are triangles whose exact determinant is not positive; "
          "certified is a map that is proved one-to-one. Angle and area: means of |ln "
          "(result / input)| over all angles and triangles, as in the paper's charts; the "
          "last two are weighted by area, and the last is 4 for an isometry.",
      .header = {"method", "seconds", "folds", "degree", "certified", "mean |ln angle|",
                 "mean |ln area|", "weighted |log2 area|", "symmetric Dirichlet"},
      .rows = {}};
  for (const Entry& entry : entries) table.rows.push_back(table_row(entry));
  return table;
}

}  // namespace sphparam
