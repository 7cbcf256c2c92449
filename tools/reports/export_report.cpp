#include "reports/export_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/version.h"

namespace sphparam::cli {

std::string to_json(const ExportReport& report) {
  using Json = nlohmann::ordered_json;
  Json levels = Json::array(), outputs = Json::array();
  for (const ChartFigures& chart : report.charts) {
    levels.push_back({{"triangles", chart.triangles},
                      {"vertices", chart.vertices},
                      {"splits", chart.splits},
                      {"chart_certified", chart.chart.one_to_one()},
                      {"certified_as_stored", chart.stored.one_to_one()},
                      {"folded_as_stored", chart.stored.folded},
                      {"around_pole", chart.chart.around_pole}});
    if (chart.sphere_folds >= 0) levels.back()["sphere_folds_as_stored"] = chart.sphere_folds;
  }
  for (const auto& [path, bytes] : report.outputs)
    outputs.push_back({{"file", path}, {"bytes", bytes}});
  const Json json = {{"sphparam", version}, {"command", "export"}, {"input", report.input},
                     {"levels", levels},    {"outputs", outputs},  {"seconds", report.seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sphparam::cli
