#include "sphparam/records/told.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "records/json_parts.h"

namespace sphparam {

namespace {

/// People are told of which file, "egg.obj: inside out"; a record of one file says it once.
bool is_said(const Json& said, const std::string& line) {
  return std::ranges::any_of(said, [&](const Json& own) {
    return own == line || (own.is_string() && line.ends_with(": " + own.get<std::string>()));
  });
}

void add(Json& record, const char* key, const std::vector<std::string>& lines) {
  Json& said = record[key];
  if (!said.is_array()) said = Json::array();
  for (const std::string& line : lines)
    if (!is_said(said, line)) said.push_back(line);
}

}  // namespace

std::string with_told(const std::string& record, const Told& told) {
  Json json = Json::parse(record);
  add(json, "warnings", told.warnings);
  add(json, "notes", told.notes);
  add(json, "losses", told.losses);
  return text_of(json);
}

}  // namespace sphparam
