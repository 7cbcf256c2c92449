#include "records/comparison_record.h"

#include <nlohmann/json.hpp>

#include "records/json_parts.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

Json entry_json(const Entry& c) {
  return {{"name", c.name},
          {"source", c.source},
          {"seconds", c.seconds ? Json(*c.seconds) : Json()},
          {"iterations", c.iterations},
          {"statement", c.statement},
          {"has_map", c.has_map()},
          {"stages", stages_json(c.stages)},
          {"certificate", c.has_map() ? certificate_json(c.certificate) : Json()},
          {"distortion", distortion_json(c.figures)}};
}

}  // namespace

std::string to_json(const ComparisonRecord& record) {
  Json maps = Json::array();
  for (const Entry& c : record.entries) maps.push_back(entry_json(c));
  return text_of({{"sphparam", version},
                  {"command", record.command},
                  {"input", input_json(record.source)},
                  {"maps", maps},
                  {"notes", record.source.notes},
                  {"seconds", record.seconds}});
}

}  // namespace sphparam
