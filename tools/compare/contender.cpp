#include "compare/contender.h"

#include <utility>

#include "report/svg.h"
#include "sphparam/stopwatch.h"

namespace sphparam::tools {

namespace {

void measure(Contender& contender, const TriangleMesh& mesh, int threads) {
  if (!contender.has_map() || !contender.certificate.unusable_points.empty()) return;
  contender.distortion = measure_distortion(mesh, contender.map, threads);
  contender.figures = summarise(*contender.distortion, threads);
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

std::string counted(long count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

std::vector<std::string> table_row(const Contender& c) {
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
  for (const double figure : {c.figures->mean_abs_ln_angle, c.figures->mean_abs_ln_area,
                              c.figures->weighted_abs_log2_area, c.figures->symmetric_dirichlet}) {
    row.push_back(significant(figure));
  }
  return row;
}

}  // namespace

Contender run_contender(AnyMethod method, const TriangleMesh& mesh,
                        const ParameterizeOptions& options) {
  const MethodInfo& info = info_of(method);
  const Stopwatch stopwatch;
  MethodRun run = run_method(method, mesh, require_sphere(mesh), options);
  Contender contender = {.name = info.name, .source = info.citation};
  contender.seconds = stopwatch.seconds();
  contender.iterations = run.account ? run.account->iterations : 0;
  contender.statement = run.account ? run.account->statement : joined(run.result.warnings);
  contender.map = std::move(run.result.map);
  contender.certificate = std::move(run.result.certificate);
  contender.stages = std::move(run.result.stages);
  measure(contender, mesh, options.threads);
  return contender;
}

Contender given_contender(std::string name, std::string source, const TriangleMesh& mesh,
                          const SphereMap& map, int threads) {
  Contender contender = {.name = std::move(name), .source = std::move(source)};
  contender.certificate = certify(Topology(mesh), map, threads);
  const bool usable = contender.certificate.unusable_points.empty();
  contender.map = usable ? normalised(map.points) : map;
  measure(contender, mesh, threads);
  return contender;
}

std::string short_verdict(const Contender& contender) {
  const Certificate& c = contender.certificate;
  if (!contender.has_map()) return "no map";
  if (c.bijective()) return "one-to-one";
  if (!c.unusable_points.empty()) return counted(std::ssize(c.unusable_points), "unusable point");
  if (c.fold_count() > 0) return counted(c.fold_count(), "fold");
  return "degree " + std::to_string(c.degree);
}

PageTable contender_table(const std::vector<Contender>& contenders) {
  PageTable table = {
      .caption =
          "Time is wall time. Folds are triangles whose exact determinant is not positive; "
          "certified is a map that is proved one-to-one. Angle and area: means of |ln "
          "(result / input)| over all angles and triangles, as in the paper's charts; the "
          "last two are weighted by area, and the last is 4 for an isometry.",
      .header = {"method", "seconds", "folds", "degree", "certified", "mean |ln angle|",
                 "mean |ln area|", "weighted |log2 area|", "symmetric Dirichlet"},
      .rows = {}};
  for (const Contender& contender : contenders) table.rows.push_back(table_row(contender));
  return table;
}

}  // namespace sphparam::tools
