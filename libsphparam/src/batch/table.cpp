// Whatever a step's report says in single values is a column, by the way to it, and so are short
// lists of real numbers; other lists have no place in a row. What runs took stands in the last
// columns: all others are the same for every run.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/each_item.h"
#include "batch/record.h"
#include "batch/tables.h"
#include "number_text.h"
#include "sphparam/batch/results.h"

namespace sphparam {

namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<std::pair<std::string, std::string>>;  // column, value

constexpr std::size_t most_numbers = 16;  // of a list that has columns

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_float()) return shortest(value.get<double>());
  return value.is_null() ? "" : value.dump();
}

/// Not figures: where things lie, and the version, which is said once.
bool is_no_figure(const std::string& key) {
  return key == "sphparam" || key == "command" || key == "outputs" || key == "file" ||
         key == "seconds" || key == "viewer" || key == "sidecar" || key == "textures";
}

/// "map", and "map2" of the second `map` of a pipeline.
std::string numbered(const std::string& name, std::map<std::string, int>& seen) {
  const int count = ++seen[name];
  return count == 1 ? name : name + std::to_string(count);
}

/// Which key says what an entry of a list is called: an image its map, a function its name.
const char* title_key(const Json& entry) {
  for (const char* const key : {"map", "name"})
    if (entry.is_object() && entry.contains(key) && entry[key].is_string()) return key;
  return nullptr;
}

void flatten_list(const Json& list, const std::string& name, Cells& cells);

void flatten(const Json& json, const std::string& name, Cells& cells) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items())
      if (!is_no_figure(key)) flatten(value, name + "." + key, cells);
  } else if (json.is_array()) {
    flatten_list(json, name, cells);
  } else if (!json.is_null()) {
    cells.emplace_back(name, text_of(json));
  }
}

/// Entries with names have columns by these; real numbers (axes, ranges, boxes) by their place,
/// where they are few. Whole numbers name vertices and faces, others in each row.
void flatten_list(const Json& list, const std::string& name, Cells& cells) {
  std::map<std::string, int> seen;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Json entry = list[i];
    if (const char* const key = title_key(entry)) {
      const std::string title = numbered(entry[key].get<std::string>(), seen);
      entry.erase(key);
      flatten(entry, name + "." + title, cells);
    } else if (list.size() <= most_numbers && (entry.is_number_float() || entry.is_array())) {
      flatten(entry, name + "." + std::to_string(i), cells);
    }
  }
}

Cells figures_of(const Json& record) {
  Cells cells;
  std::map<std::string, int> seen;
  for (const Json& step : record.value("steps", Json::array())) {
    const std::string prefix = numbered(step["command"].at(0).get<std::string>(), seen);
    if (step["report"].is_object()) flatten(step["report"], prefix, cells);
  }
  return cells;
}

const std::vector<std::string> first_columns = {"id",     "path",    "outcome", "code",    "step",
                                                "reason", "attempt", "repairs", "warnings"};
const std::vector<std::string> last_columns = {"seconds", "cpu_seconds", "peak_bytes",
                                               "ended",   "host",        "sphparam"};

struct Row {
  Cells cells;
  std::map<std::string, std::string> own;
};

Row row_of(const std::string& folder, const BatchItem& item) {
  Row row;
  row.own = {{"id", item.id}, {"path", item.path}, {"outcome", "open"}};
  const auto stored = record_about(folder, item);
  if (!stored) return row;
  const Json record = Json::parse(stored->bytes, nullptr, false);
  if (record.is_discarded()) throw ReadError(stored->path, "this is no whole record of a batch");
  for (const auto& columns : {first_columns, last_columns})
    for (const std::string& name : columns)
      if (name != "id" && name != "path" && record.contains(name))
        row.own[name] =
            record[name].is_array() ? std::to_string(record[name].size()) : text_of(record[name]);
  row.cells = figures_of(record);
  return row;
}

std::string line_of(const std::vector<std::string>& fields, char separator) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += separator;
    line += csv_field(fields[i]);
  }
  return line + "\r\n";
}

/// What the columns of the table that the batch was planned from are called here: "table." as often
/// before their names as it takes to be none of `taken`.
std::vector<std::string> names_of_planned(const BatchPlan& plan, std::set<std::string> taken) {
  std::vector<std::string> names;
  for (std::string name : plan.columns) {
    while (!taken.insert(name).second) name.insert(0, "table.");
    names.push_back(std::move(name));
  }
  return names;
}

std::set<std::string> names_of_ours(const std::vector<Row>& rows) {
  std::set<std::string> names(first_columns.begin(), first_columns.end());
  names.insert(last_columns.begin(), last_columns.end());
  for (const Row& row : rows)
    for (const auto& [name, value] : row.cells) names.insert(name);
  return names;
}

}  // namespace

std::string batch_table(const std::string& folder, const BatchPlan& plan, int threads,
                        char separator) {
  constexpr std::int64_t grain = 64;
  const std::vector<Row> rows = of_each_item(
      plan, grain, threads, [&](const BatchItem& item) { return row_of(folder, item); });
  std::vector<std::string> names = first_columns;
  const std::vector<std::string> planned = names_of_planned(plan, names_of_ours(rows));
  names.insert(names.end(), planned.begin(), planned.end());
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i) place[names[i]] = i;
  const auto column = [&](const std::string& name) {
    const auto [known, is_new] = place.emplace(name, names.size());
    if (is_new) names.push_back(name);
    return known->second;
  };
  for (const Row& row : rows)
    for (const auto& [name, value] : row.cells) column(name);
  for (const std::string& name : last_columns) column(name);
  std::string text = line_of(names, separator);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    std::vector<std::string> fields(names.size());
    std::ranges::copy(plan.items[i].values, fields.begin() + std::ssize(first_columns));
    for (const auto& [name, value] : row.own) fields[column(name)] = value;
    for (const auto& [name, value] : row.cells) fields[column(name)] = value;
    text += line_of(fields, separator);
  }
  return text;
}

}  // namespace sphparam
