#include "reports/compare_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

Json entry_json(const Entry& c) {
  Json stages = Json::array();
  for (const StageRecord& stage : c.stages) stages.push_back(stage_json(stage));
  return {{"name", c.name},
          {"source", c.source},
          {"seconds", c.seconds ? Json(*c.seconds) : Json()},
          {"iterations", c.iterations},
          {"statement", c.statement},
          {"has_map", c.has_map()},
          {"stages", stages},
          {"certificate", c.has_map() ? certificate_json(c.certificate) : Json()},
          {"distortion", distortion_json(c.figures)}};
}

}  // namespace

std::string to_json(const CompareReport& report) {
  Json maps = Json::array();
  for (const Entry& c : report.entries) maps.push_back(entry_json(c));
  return text_of({{"sphparam", version},
                  {"command", "compare"},
                  {"input", input_json(report.input)},
                  {"maps", maps},
                  {"notes", report.input.source.notes},
                  {"seconds", report.seconds}});
}

}  // namespace sphparam::cli
