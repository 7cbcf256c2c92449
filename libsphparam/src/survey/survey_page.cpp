#include <nlohmann/json.hpp>

#include "io/uri.h"
#include "number_text.h"
#include "records/json_parts.h"
#include "report/page.h"
#include "sphparam/survey/survey.h"
#include "sphparam/version.h"

// The counts, a table of all files, then a section for each end that is not "maps", with the
// pictures and the reasons.

namespace sphparam {
namespace {

struct Section {
  SurveyEnd end;
  const char* short_name;  // in the table
  const char* heading;
};

constexpr Section sections[] = {
    {SurveyEnd::Maps, "maps", "Maps as it is"},
    {SurveyEnd::MapsMended, "after --repair", "Maps after --repair"},
    {SurveyEnd::MapsIfAsked, "if asked for more", "Maps after a repair that has to be asked for"},
    {SurveyEnd::CannotMap, "cannot", "Cannot be mapped"},
    {SurveyEnd::NotCertified, "not certified", "Its map is not one-to-one"},
    {SurveyEnd::Unreadable, "unreadable", "Cannot be read"},
};

const Section& section_of(SurveyEnd end) {
  for (const Section& section : sections)
    if (section.end == end) return section;
  return sections[0];
}

std::string genus(const MeshInspection& inspection) {
  return inspection.genus >= 0 ? std::to_string(inspection.genus) : "–";
}

PageTable table_of(const Survey& survey) {
  PageTable table{
      "All files", {"file", "end", "format", "triangles", "components", "boundaries", "genus"}, {}};
  for (const SurveyedMesh& mesh : survey.meshes) {
    const MeshInspection& found = mesh.inspection;
    table.rows.push_back({mesh.name, section_of(mesh.end).short_name, mesh.format,
                          std::to_string(found.faces), std::to_string(found.components),
                          std::to_string(found.boundary_loops), genus(found)});
  }
  return table;
}

void add_list(Page& page, const char* what, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  page.paragraph(what);
  page.list(lines);
}

void add_mesh(Page& page, const SurveyedMesh& mesh) {
  page.subheading(mesh.name);
  if (!mesh.picture.empty())
    page.figures({{data_uri("image/png", mesh.picture), "Defects of " + mesh.name,
                   "red: where the defects are"}},
                 200);
  add_list(page, "As it is:", mesh.defects);
  add_list(page, mesh.end == SurveyEnd::CannotMap ? "Repair would do:" : "Repaired:", mesh.repairs);
  add_list(page, "Why it cannot be mapped:", mesh.reasons);
  if (!mesh.advice.empty())
    page.paragraph("What to type: sphparam map " + mesh.name + " " + mesh.advice +
                   " -o mapped.sph.ply");
}

}  // namespace

std::string survey_page(const Survey& survey) {
  const auto all = static_cast<long>(survey.meshes.size());
  const long whole = survey.count(SurveyEnd::Maps), mended = survey.count(SurveyEnd::MapsMended);
  Page page("Survey of " + survey.folder);
  page.verdict(std::to_string(whole + mended) + " of " + counted(all, "file") +
                   " map onto the sphere: " + std::to_string(whole) + " as they are, " +
                   std::to_string(mended) + " after --repair",
               whole + mended == all);
  std::vector<std::pair<std::string, std::string>> figures;
  for (const Section& section : sections)
    figures.emplace_back(section.short_name, std::to_string(survey.count(section.end)));
  page.key_figures(figures);
  page.table(table_of(survey));
  for (const Section& section : sections) {
    if (section.end == SurveyEnd::Maps || survey.count(section.end) == 0) continue;
    page.heading(section.heading);
    for (const SurveyedMesh& mesh : survey.meshes)
      if (mesh.end == section.end) add_mesh(page, mesh);
  }
  return page.html();
}

std::string to_json(const Survey& survey, double seconds) {
  Json counts = Json::object(), meshes = Json::array();
  for (const Section& section : sections) counts[name_of(section.end)] = survey.count(section.end);
  for (const SurveyedMesh& mesh : survey.meshes) {
    meshes.push_back({{"name", mesh.name},
                      {"end", name_of(mesh.end)},
                      {"format", mesh.format},
                      {"inspection", inspection_json(mesh.inspection)},
                      {"defects", mesh.defects},
                      {"repairs", mesh.repairs},
                      {"reasons", mesh.reasons},
                      {"mends_with", mesh.advice.empty() ? Json() : Json(mesh.advice)}});
  }
  return text_of({{"sphparam", version},
                  {"command", "survey"},
                  {"folder", survey.folder},
                  {"counts", counts},
                  {"meshes", meshes},
                  {"seconds", seconds}});
}

}  // namespace sphparam
