#include "sphparam/records/data_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

/// The finite numbers of a column.
struct Range {
  double least = 0, greatest = 0;
  long missing = 0;
  bool is_empty = true;

  explicit Range(const DataColumn& column) {
    for (const double value : column.values) {
      if (!std::isfinite(value)) {
        ++missing;
        continue;
      }
      least = is_empty ? value : std::min(least, value);
      greatest = is_empty ? value : std::max(greatest, value);
      is_empty = false;
    }
  }
};

std::string line(const std::string& label, const std::string& value) {
  constexpr std::size_t column = 14;
  return "  " + label + std::string(column - std::min(label.size(), column - 1), ' ') + value +
         "\n";
}

std::string kind_of(const VertexData& data) {
  switch (data.kind) {
    case DataKind::Labels:
      return "labels";
    case DataKind::TimeSeries:
      return "a time series";
    default:
      return "measured";
  }
}

/// "2 of 36 labels of the table"; keys without a line are told.
std::string labels_in(const VertexData& data, const DataColumn& column) {
  const std::set<double> used(column.values.begin(), column.values.end());
  const auto is_used = [&](const Label& label) { return used.contains(label.key); };
  const auto named = std::ranges::count_if(data.labels, is_used);
  const auto unnamed = std::ssize(used) - named;
  return std::to_string(named) + " of " + counted(std::ssize(data.labels), "label") +
         (unnamed > 0 ? ", " + counted(unnamed, "key") + " without a name" : "");
}

std::string about(const VertexData& data, const DataColumn& column) {
  if (data.kind == DataKind::Labels) return labels_in(data, column);
  const Range range(column);
  if (range.is_empty) return "no finite numbers";
  return short_number(range.least, 6) + " to " + short_number(range.greatest, 6) +
         (range.missing > 0 ? ", " + std::to_string(range.missing) + " missing" : "");
}

Json column_json(const VertexData& data, std::size_t k) {
  const DataColumn& column = data.columns[k];
  const Range range(column);
  return {{"name", title_of_column(data, k)},
          {"intent", column.intent},
          {"least", range.is_empty ? Json() : Json(range.least)},
          {"greatest", range.is_empty ? Json() : Json(range.greatest)},
          {"missing", range.missing}};
}

Json labels_json(const VertexData& data) {
  Json labels = Json::array();
  for (const Label& label : data.labels)
    labels.push_back({{"key", label.key},
                      {"name", label.name},
                      {"colour", label.colour ? Json(*label.colour) : Json()}});
  return labels;
}

}  // namespace

std::string to_json(const DataRecord& record) {
  const VertexData& data = record.data;
  Json columns = Json::array();
  for (std::size_t k = 0; k < data.columns.size(); ++k) columns.push_back(column_json(data, k));
  return text_of({{"sphparam", version},
                  {"command", "info"},
                  {"data",
                   {{"file", record.path},
                    {"format", data.format},
                    {"kind", kind_of(data)},
                    {"vertices", data.vertex_count()},
                    {"triangles", data.triangles},
                    {"structure", data.structure},
                    {"columns", columns},
                    {"labels", labels_json(data)}}},
                  {"notes", data.notes},
                  {"seconds", record.seconds}});
}

std::string to_text(const DataRecord& record) {
  constexpr std::size_t most_columns = 24;
  const VertexData& data = record.data;
  const std::string name = display_name(record.path);
  const auto columns = data.columns.size();
  std::string text = name + "\n" + line("format", data.format) + line("holds", kind_of(data)) +
                     line("vertices", std::to_string(data.vertex_count()));
  if (data.triangles > 0) text += line("triangles", std::to_string(data.triangles));
  if (!data.structure.empty()) text += line("structure", data.structure);
  text += line("columns", std::to_string(columns));
  for (std::size_t k = 0; k < std::min(columns, most_columns); ++k)
    text += "    " + title_of_column(data, k) + ": " + about(data, data.columns[k]) + "\n";
  if (columns > most_columns)
    text += "    and " + std::to_string(columns - most_columns) + " others\n";
  for (const std::string& note : data.notes) text += line("note", note);
  return text +
         "Numbers a vertex, no mesh: map, remesh, repair, bake, render and report take them beside "
         "their surface, as --data " +
         name + "\n";
}

}  // namespace sphparam
