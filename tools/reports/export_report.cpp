#include "reports/export_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/version.h"

namespace sphparam::cli {

void ExportReport::add_level(const ExportChart& chart, const ExportGeometry& geometry) {
  levels.push_back({.triangles = static_cast<long>(chart.chart.triangles.rows()),
                    .vertices = static_cast<long>(chart.chart.wedge_count()),
                    .splits = chart.chart.counts.splits(),
                    .chart_certified = chart.chart.certificate.one_to_one(),
                    .stored_certified = geometry.stored.one_to_one(),
                    .folded = geometry.stored.folded,
                    .around_pole = chart.chart.certificate.around_pole,
                    .sphere_folds = geometry.stored_sphere_folds});
}

std::string to_json(const ExportReport& report) {
  using Json = nlohmann::ordered_json;
  Json levels = Json::array(), outputs = Json::array();
  for (const ExportReport::Level& level : report.levels) {
    levels.push_back({{"triangles", level.triangles},
                      {"vertices", level.vertices},
                      {"splits", level.splits},
                      {"chart_certified", level.chart_certified},
                      {"certified_as_stored", level.stored_certified},
                      {"folded_as_stored", level.folded},
                      {"around_pole", level.around_pole}});
    if (level.sphere_folds >= 0) levels.back()["sphere_folds_as_stored"] = level.sphere_folds;
  }
  for (const auto& [path, bytes] : report.outputs)
    outputs.push_back({{"file", path}, {"bytes", bytes}});
  const Json json = {{"sphparam", version}, {"command", "export"}, {"input", report.input},
                     {"levels", levels},    {"outputs", outputs},  {"seconds", report.seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sphparam::cli
