#include "reports/map_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/io/file_numbers.h"
#include "sphparam/names.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

/// Vertices go by their numbers in the file.
Json vertex_json(const std::optional<Vertex>& vertex, const FileNumbers& numbers) {
  return vertex ? Json(numbers.number(*vertex)) : Json();
}

Json poles_json(const std::optional<Poles>& poles, const FileNumbers& numbers) {
  if (!poles) return nullptr;
  return {{"north", numbers.number(poles->north)}, {"south", numbers.number(poles->south)}};
}

/// The options as given: numbers of the file already.
Json wanted_poles(const ParameterizeOptions& options) {
  if (!options.poles) return options.automatic_poles ? "auto" : "none";
  return {{"north", options.poles->north}, {"south", options.poles->south}};
}

Json pins_json(const MapReport& report) {
  const FileNumbers numbers(report.input.source.file);
  const std::vector<double>& residuals = report.result.pin_residuals;
  Json result = Json::array();
  for (size_t i = 0; i < report.pins.size(); ++i) {
    const Landmark& pin = report.pins[i];
    result.push_back({{"vertex", numbers.number(pin.vertex)},
                      {"theta", pin.coordinates.theta},
                      {"phi", pin.coordinates.phi},
                      {"residual", i < residuals.size() ? Json(residuals[i]) : Json()}});
  }
  return result;
}

Json pole_residuals_json(const std::vector<double>& residuals) {
  if (residuals.empty()) return nullptr;
  return {{"north", residuals[0]}, {"south", residuals[1]}};
}

/// The λ that the map is minimised for, where one is.
Json lambda_json(const MapReport& report) {
  const ParameterizeOptions& options = report.options;
  const bool minimises = !report.account && options.method != Method::Paper &&
                         options.energy.kind == EnergyKind::AngleAndArea;
  if (!minimises) return nullptr;
  return report.result.balance ? report.result.balance->lambda : options.energy.lambda;
}

Json balance_json(const std::optional<BalanceRecord>& balance) {
  if (!balance) return nullptr;
  return {{"lambda", balance->lambda},
          {"mean_abs_log2_area", balance->area_error},
          {"moved", balance->moved}};
}

Json options_json(const MapReport& report) {
  const ParameterizeOptions& options = report.options;
  if (report.account) {
    return {{"method", report.method},
            {"repair", report.repairs_wanted},
            {"repair_map", options.repair_paper}};
  }
  Json result = {{"method", report.method},
                 {"poles", wanted_poles(options)},
                 {"meridian", options.meridian ? Json(*options.meridian) : Json()},
                 {"lambda", options.energy.lambda},
                 {"repair", report.repairs_wanted},
                 {"repair_map", options.repair_paper}};
  if (options.method == Method::Progressive) {
    result["balance"] = name_of(options.balance);
    result["quality"] = name_of(options.quality);
    result["energy"] = name_of(options.energy.kind);
  }
  if (options.method == Method::Paper) {
    const PaperSettings& paper = options.paper;
    result["weights"] = name_of(paper.weights);
    result["epsilon"] = paper.epsilon;
    result["iterations"] = paper.iterations;
    result["rings"] = paper.rings;
    result["sweeps"] = paper.sweeps;
  }
  return result;
}

const char* name_of(BaselineEnd end) {
  switch (end) {
    case BaselineEnd::Converged:
      return "converged";
    case BaselineEnd::IterationLimit:
      return "iteration-limit";
    case BaselineEnd::Stalled:
      return "stalled";
    case BaselineEnd::NoResult:
      return "no-result";
  }
  return "";
}

/// Of a method of others; null for ours.
Json account_json(const std::optional<BaselineAccount>& account) {
  if (!account) return nullptr;
  return {{"source", account->citation},
          {"end", name_of(account->end)},
          {"iterations", account->iterations},
          {"statement", account->statement}};
}

}  // namespace

std::string to_json(const MapReport& report) {
  Json stages = Json::array();
  for (const StageRecord& stage : report.result.stages) stages.push_back(stage_json(stage));
  const FileNumbers numbers(report.input.source.file);
  return text_of({{"sphparam", version},
                  {"command", "map"},
                  {"input", input_json(report.input)},
                  {"inspection", inspection_json(report.input.source.inspection)},
                  {"repairs", repairs_json(report.input.source.repairs)},
                  {"components", parts_json(report.input.source.parts)},
                  {"options", options_json(report)},
                  {"account", account_json(report.account)},
                  {"stages", stages},
                  {"made_by", report.result.made_by},
                  {"poles", poles_json(report.result.poles, numbers)},
                  {"meridian", vertex_json(report.result.meridian, numbers)},
                  {"pole_residuals", pole_residuals_json(report.pole_residuals)},
                  {"pins", pins_json(report)},
                  {"lambda", lambda_json(report)},
                  {"balance", balance_json(report.result.balance)},
                  {"energy_cost", report.result.pole_cost},
                  {"certificate", certificate_json(report.certificate)},
                  {"distortion", distortion_json(report.distortion)},
                  {"chart", chart_json(report.chart)},
                  {"outputs", pairs_json(report.outputs)},
                  {"warnings", report.result.warnings},
                  {"notes", report.input.source.notes},
                  {"seconds", report.seconds}});
}

}  // namespace sphparam::cli
