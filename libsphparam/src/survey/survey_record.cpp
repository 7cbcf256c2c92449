#include "survey/survey_record.h"

#include <nlohmann/json.hpp>

#include "io/files/base64.h"
#include "records/json_parts.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

constexpr SurveyEnd ends[] = {SurveyEnd::Maps,      SurveyEnd::MapsMended,   SurveyEnd::MapsIfAsked,
                              SurveyEnd::CannotMap, SurveyEnd::NotCertified, SurveyEnd::Unreadable,
                              SurveyEnd::Stopped};

Json json_of(const SurveyedMesh& mesh) {
  Json ways = Json::array();
  for (const SurveyedWay& way : mesh.ways)
    ways.push_back({{"options", way.options},
                    {"certified", way.certified},
                    {"told", way.told},
                    {"area_share", way.area_share}});
  const SurveyedWay* const best = mesh.best_way();
  return {{"name", mesh.name},
          {"end", name_of(mesh.end)},
          {"format", mesh.format},
          {"vertices", mesh.vertices},
          {"triangles", mesh.triangles},
          {"components", mesh.components},
          {"boundaries", mesh.boundaries},
          {"genus", mesh.genus < 0 ? Json() : Json(mesh.genus)},
          {"defects", mesh.defects},
          {"oddities", mesh.oddities},
          {"ways", ways},
          {"needs", best ? Json(best->options) : Json()},
          {"repairs", mesh.repairs},
          {"reasons", mesh.reasons}};
}

SurveyEnd end_named(const std::string& name) {
  for (const SurveyEnd end : ends)
    if (name_of(end) == name) return end;
  throw std::invalid_argument(name);
}

std::string decoded(const std::string& text) {
  std::string bytes;
  Base64Reader reader(text);
  while (reader.read(1, bytes)) {
  }
  return bytes;
}

SurveyedMesh mesh_of(const Json& json) {
  SurveyedMesh mesh;
  mesh.name = json.at("name");
  mesh.end = end_named(json.at("end"));
  mesh.format = json.at("format");
  mesh.vertices = json.at("vertices");
  mesh.triangles = json.at("triangles");
  mesh.components = json.at("components");
  mesh.boundaries = json.at("boundaries");
  mesh.genus = json.at("genus").is_null() ? -1 : json.at("genus").get<long>();
  json.at("defects").get_to(mesh.defects);
  json.at("oddities").get_to(mesh.oddities);
  for (const Json& way : json.at("ways"))
    mesh.ways.push_back(
        {way.at("options"), way.at("certified"), way.at("told"), way.at("area_share")});
  json.at("repairs").get_to(mesh.repairs);
  json.at("reasons").get_to(mesh.reasons);
  for (const Json& picture : json.at("pictures"))
    mesh.pictures.push_back({picture.at("caption"), decoded(picture.at("png"))});
  return mesh;
}

}  // namespace

std::string record_of(const SurveyedMesh& mesh) {
  Json json = json_of(mesh);
  Json pictures = Json::array();
  for (const SurveyPicture& picture : mesh.pictures)
    pictures.push_back({{"caption", picture.caption}, {"png", to_base64(picture.png)}});
  json["pictures"] = pictures;
  return text_of(json);
}

std::optional<SurveyedMesh> surveyed_of(std::string_view record) try {
  return mesh_of(Json::parse(record));
} catch (const Json::exception&) {
  return std::nullopt;
} catch (const std::invalid_argument&) {  // an end that this program does not know
  return std::nullopt;
}

std::string to_json(const Survey& survey, double seconds) {
  Json counts = Json::object(), meshes = Json::array();
  for (const SurveyEnd end : ends) counts[name_of(end)] = survey.count(end);
  for (const SurveyedMesh& mesh : survey.meshes) meshes.push_back(json_of(mesh));
  return text_of({{"sphparam", version},
                  {"command", "survey"},
                  {"folder", survey.folder},
                  {"counts", counts},
                  {"meshes", meshes},
                  {"seconds", seconds}});
}

}  // namespace sphparam
