#include "sphparam/records/export_record.h"

#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/error_words.h"
#include "records/json_parts.h"
#include "sphparam/version.h"

namespace sphparam {

std::string to_json(const ExportRecord& record) {
  Json levels = Json::array(), outputs = Json::array();
  for (const ChartFigures& chart : record.charts) {
    levels.push_back({{"triangles", chart.triangles},
                      {"vertices", chart.vertices},
                      {"splits", chart.splits},
                      {"chart_certified", chart.chart.one_to_one()},
                      {"certified_as_stored", chart.stored.one_to_one()},
                      {"folded_as_stored", chart.stored.folded},
                      {"torn_as_stored", chart.stored.torn},
                      {"around_pole", chart.chart.around_pole}});
    const std::size_t level = levels.size() - 1;
    if (level > 0 && level <= record.distances.size() && record.distances[level - 1]) {
      levels.back()["rms"] = record.distances[level - 1]->rms;
      levels.back()["max"] = record.distances[level - 1]->max;
    }
    if (level > 0 && level <= record.in_space.size())
      levels.back()["in_space"] = in_space_json(record.in_space[level - 1]);
    if (chart.sphere_folds >= 0) levels.back()["sphere_folds_as_stored"] = chart.sphere_folds;
  }
  for (const auto& [path, bytes] : record.outputs)
    outputs.push_back({{"file", path}, {"bytes", bytes}});
  return text_of({{"sphparam", version},
                  {"command", "export"},
                  {"input", record.input},
                  {"levels", levels},
                  {"lods_wanted", record.lods_wanted},
                  {"lods", record.lods},
                  {"outputs", outputs},
                  {"textures", textures_json(record.textures)},
                  {"seconds", record.seconds}});
}

std::vector<std::string> warnings_of(const ExportRecord& record) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < record.in_space.size(); ++i) {
    const FacesInSpace& found = record.in_space[i];
    const std::string level = "level " + std::to_string(i + 1) + ": ";
    if (found.faces > 0)
      warnings.push_back(
          level + counted(found.faces, "triangle") + ", " + percent(found.area_share) +
          " of the area, cross others in space or lie inverted; of the mesh itself " +
          counted(found.source_pairs, "pair crosses", "pairs cross") +
          ": what is proved is the map");
    else if (!found.crossings.none())
      warnings.push_back(level +
                         "too many triangles are near one another to say whether any cross");
  }
  return warnings;
}

std::vector<std::string> level_lines(const ExportRecord& record) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < record.distances.size(); ++i) {
    if (!record.distances[i]) continue;
    const auto& [rms, max] = *record.distances[i];
    lines.push_back("level " + std::to_string(i + 1) + ", " +
                    counted(record.charts.at(i + 1).triangles, "triangle") + ": " +
                    error_words(rms, max, record.diagonal) + ", both ways");
  }
  return lines;
}

}  // namespace sphparam
