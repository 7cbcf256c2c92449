// The counts, a table of all files, then a section for each end that is not "maps", with pictures,
// reasons, and what to type.

#include <filesystem>

#include "io/shell_word.h"
#include "io/uri.h"
#include "number_text.h"
#include "report/page.h"
#include "sphparam/survey/survey.h"

namespace sphparam {
namespace {

constexpr char style[] =
    "h1,h3,p,li{overflow-wrap:anywhere}"
    "tbody tr>:first-child{white-space:normal;overflow-wrap:anywhere;min-width:9rem}";

struct Section {
  SurveyEnd end;
  const char* short_name;  // in the table
  const char* heading;
};

constexpr Section sections[] = {
    {SurveyEnd::Maps, "as it is", "Maps as it is"},
    {SurveyEnd::MapsMended, "after --repair", "Maps after --repair"},
    {SurveyEnd::MapsIfAsked, "if asked for more", "Maps after a repair that has to be asked for"},
    {SurveyEnd::CannotMap, "cannot", "Cannot be mapped"},
    {SurveyEnd::NotCertified, "not certified", "Its map is not one-to-one"},
    {SurveyEnd::Unreadable, "unreadable", "Cannot be read"},
    {SurveyEnd::Stopped, "stopped", "Was stopped"},
};

const Section& section_of(SurveyEnd end) {
  for (const Section& section : sections)
    if (section.end == end) return section;
  return sections[0];
}

bool was_read(const SurveyedMesh& mesh) { return !mesh.format.empty(); }

/// The first of the ways that are enough.
std::string needs(const SurveyedMesh& mesh) {
  for (const SurveyedWay& way : mesh.ways)
    if (way.certified) return way.options;
  return "";
}

PageTable table_of(const Survey& survey) {
  PageTable table{
      "All files",
      {"file", "maps", "needs", "triangles", "components", "boundaries", "genus", "format"},
      {}};
  for (const SurveyedMesh& mesh : survey.meshes) {
    const auto number = [&](long value) {
      return was_read(mesh) && value >= 0 ? std::to_string(value) : std::string("–");
    };
    table.rows.push_back({mesh.name, section_of(mesh.end).short_name, needs(mesh),
                          number(mesh.triangles), number(mesh.components), number(mesh.boundaries),
                          number(mesh.genus), mesh.format});
  }
  return table;
}

void add_list(Page& page, const char* what, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  page.paragraph(what);
  page.list(lines);
}

void add_pictures(Page& page, const SurveyedMesh& mesh) {
  std::vector<PageFigure> figures;
  for (const SurveyPicture& picture : mesh.pictures)
    figures.push_back(
        {data_uri("image/png", picture.png), mesh.name + ", " + picture.caption, picture.caption});
  if (!figures.empty()) page.figures(figures, 240);
}

std::string line_of(const SurveyedWay& way, const std::string& path) {
  const std::string command =
      "sphparam map " + shell_word(path) + " " + way.options + " -o mapped.sph.ply";
  const std::string outcome = way.certified ? "certified" : "not certified";
  return command + ": " + outcome + (way.told.empty() ? "" : "; " + way.told);
}

void add_mesh(Page& page, const SurveyedMesh& mesh, const std::string& folder) {
  page.subheading(mesh.name);
  add_pictures(page, mesh);
  add_list(page, "As it is:", mesh.defects);
  const bool mended = !mesh.ways.empty() && mesh.reasons.empty();
  add_list(page, mended ? "Repair does:" : "Repair would do, in vain:", mesh.repairs);
  add_list(page, was_read(mesh) ? "Why it is not mapped even so:" : "Why:", mesh.reasons);
  std::vector<std::string> ways;
  for (const SurveyedWay& way : mesh.ways)
    ways.push_back(line_of(way, (std::filesystem::path(folder) / mesh.name).string()));
  add_list(page, "Tried:", ways);
}

void add_section(Page& page, const Section& section, const Survey& survey) {
  if (section.end == SurveyEnd::Maps || survey.count(section.end) == 0) return;
  page.heading(section.heading);
  for (const SurveyedMesh& mesh : survey.meshes)
    if (mesh.end == section.end) add_mesh(page, mesh, survey.folder);
}

}  // namespace

std::string survey_page(const Survey& survey) {
  const auto all = static_cast<long>(survey.meshes.size());
  const long whole = survey.count(SurveyEnd::Maps), mended = survey.count(SurveyEnd::MapsMended);
  const long asked = survey.count(SurveyEnd::MapsIfAsked);
  Page page("Survey of " + survey.folder);
  page.add_style(style);
  page.verdict(std::to_string(whole + mended + asked) + " of " + counted(all, "file") +
                   " map onto the sphere: " + std::to_string(whole) + " as they are, " +
                   std::to_string(mended) + " after --repair, " + std::to_string(asked) +
                   " after more that has to be asked for",
               whole + mended + asked == all);
  std::vector<std::pair<std::string, std::string>> figures;
  for (const Section& section : sections)
    figures.emplace_back(section.short_name, std::to_string(survey.count(section.end)));
  page.key_figures(figures);
  page.table(table_of(survey));
  for (const Section& section : sections) add_section(page, section, survey);
  return page.html();
}

}  // namespace sphparam
