// The counts, a table of all files, then a section for each end that is not "maps", with pictures,
// reasons, and what to type.

#include <algorithm>
#include <filesystem>
#include <set>

#include "free_name.h"
#include "io/shell_word.h"
#include "io/uri.h"
#include "number_text.h"
#include "report/page.h"
#include "sphparam/io/paths.h"
#include "sphparam/survey/survey.h"

namespace sphparam {
namespace {

constexpr char style[] =
    "h1,h3,p,li{overflow-wrap:anywhere}"
    "tbody tr>:first-child{white-space:normal;overflow-wrap:anywhere;min-width:9rem}"
    "tr>:nth-child(3){white-space:normal;overflow-wrap:anywhere;min-width:8rem;text-align:left}"
    "@media(max-width:30rem){tbody tr>:first-child{min-width:5rem}"
    "tr>:nth-child(2),tr>:nth-child(3){white-space:normal;min-width:5rem}}";

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

/// The way that keeps most of those that are enough, and what it keeps where that is not all.
std::string needs(const SurveyedMesh& mesh) {
  const SurveyedWay* const way = mesh.best_way();
  if (!way) return "";
  return way->options +
         (way->drops_much() ? ", which keeps " + percent(way->area_share) + " of the area" : "");
}

std::string id_of(std::size_t mesh) { return "file-" + std::to_string(mesh + 1); }

/// A name of its own for the map of each file: that of the file, with its folders.
std::vector<std::string> names_of_maps(const Survey& survey) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const SurveyedMesh& mesh : survey.meshes) {
    const std::filesystem::path folder = std::filesystem::path(mesh.name).parent_path();
    std::string stem = (folder / stem_of(mesh.name)).string();
    std::ranges::replace(stem, '/', '_');
    const std::string name =
        free_name(stem, [&](const std::string& one) { return taken.contains(one); });
    taken.insert(name);
    names.push_back(name + ".sph.ply");
  }
  return names;
}

PageTable table_of(const Survey& survey) {
  PageTable table{
      "All files",
      {"file", "maps", "needs", "triangles", "components", "boundaries", "genus", "format"},
      {},
      {}};
  for (const SurveyedMesh& mesh : survey.meshes) {
    const auto number = [&](long value) {
      return was_read(mesh) && value >= 0 ? std::to_string(value) : std::string("–");
    };
    table.rows.push_back({mesh.name, section_of(mesh.end).short_name, needs(mesh),
                          number(mesh.triangles), number(mesh.components), number(mesh.boundaries),
                          number(mesh.genus), mesh.format});
    const bool has_card = mesh.end != SurveyEnd::Maps;
    table.links.push_back(has_card ? id_of(table.links.size()) : "");
  }
  return table;
}

void add_list(Page& page, const std::string& what, const std::vector<std::string>& lines) {
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

std::string line_of(const SurveyedWay& way, const std::string& path, const std::string& map) {
  const std::string command =
      "sphparam map " + shell_file(path) + " " + way.options + " -o " + shell_file(map);
  const std::string outcome = way.certified ? "certified" : "not certified";
  return command + ": " + outcome + (way.told.empty() ? "" : "; " + way.told);
}

/// The best way first, then as they were tried.
std::vector<SurveyedWay> sorted_ways(const SurveyedMesh& mesh) {
  std::vector<SurveyedWay> ways = mesh.ways;
  if (const SurveyedWay* const best = mesh.best_way())
    std::rotate(ways.begin(), ways.begin() + (best - mesh.ways.data()),
                ways.begin() + (best - mesh.ways.data()) + 1);
  return ways;
}

/// Whether what maps is not all of it in one.
bool is_better_wrapped(const SurveyedMesh& mesh) {
  const auto drops_much = [](const SurveyedWay& way) { return way.certified && way.drops_much(); };
  const bool is_broken = was_read(mesh) && !mesh.defects.empty();
  return is_broken &&
         (mesh.end == SurveyEnd::CannotMap || std::ranges::any_of(mesh.ways, drops_much));
}

std::string name_of_wrap(const std::string& map) {
  return map.substr(0, map.size() - std::string(".sph.ply").size()) + "_wrap.ply";
}

void add_mesh(Page& page, const Survey& survey, std::size_t k, const std::string& map) {
  const SurveyedMesh& mesh = survey.meshes[k];
  page.subheading(mesh.name, id_of(k));
  add_pictures(page, mesh);
  add_list(page, "As it is:", mesh.defects);
  add_list(page, "Odd, and in no map's way:", mesh.oddities);
  const bool mended = !mesh.ways.empty() && mesh.reasons.empty();
  const std::string repair = mesh.ways.empty() ? "Repair" : mesh.ways.front().options;
  add_list(page, repair + (mended ? " does:" : " would do, in vain:"), mesh.repairs);
  add_list(page, was_read(mesh) ? "Why it is not mapped even so:" : "Why:", mesh.reasons);
  std::vector<std::string> ways;
  const std::string path = (std::filesystem::path(survey.folder) / mesh.name).string();
  for (const SurveyedWay& way : sorted_ways(mesh)) ways.push_back(line_of(way, path, map));
  add_list(page, "Tried:", ways);
  if (is_better_wrapped(mesh))
    add_list(page, "Not tried, one closed surface about all of it:",
             {"sphparam wrap " + shell_file(path) + " -o " + shell_file(name_of_wrap(map))});
}

void add_section(Page& page, const Section& section, const Survey& survey,
                 const std::vector<std::string>& maps) {
  if (section.end == SurveyEnd::Maps || survey.count(section.end) == 0) return;
  page.heading(section.heading);
  for (std::size_t k = 0; k < survey.meshes.size(); ++k)
    if (survey.meshes[k].end == section.end) add_mesh(page, survey, k, maps[k]);
}

/// Of what maps as it is, which has no section.
void add_oddities(Page& page, const Survey& survey) {
  std::vector<std::string> lines;
  for (const SurveyedMesh& mesh : survey.meshes)
    for (const std::string& oddity : mesh.oddities)
      if (mesh.end == SurveyEnd::Maps) lines.push_back(mesh.name + ": " + oddity);
  if (lines.empty()) return;
  page.heading("Map as they are, and are odd");
  page.list(lines);
}

}  // namespace

std::string survey_page(const Survey& survey) {
  const auto all = static_cast<long>(survey.meshes.size());
  const long whole = survey.count(SurveyEnd::Maps), mended = survey.count(SurveyEnd::MapsMended);
  const long asked = survey.count(SurveyEnd::MapsIfAsked);
  const long in_part = std::ranges::count_if(survey.meshes, [](const SurveyedMesh& mesh) {
    const SurveyedWay* const way = mesh.best_way();
    return way && way->drops_much();
  });
  Page page("Survey of " + survey.folder);
  page.add_style(style);
  page.verdict(std::to_string(whole + mended + asked) + " of " + counted(all, "file") +
                   " map onto the sphere: " + std::to_string(whole) + " as they are, " +
                   std::to_string(mended) + " after --repair, " + std::to_string(asked) +
                   " after more that has to be asked for" +
                   (in_part > 0 ? ", " + std::to_string(in_part) + " of these only in part" : ""),
               whole + mended + asked == all);
  std::vector<std::pair<std::string, std::string>> figures;
  for (const Section& section : sections)
    figures.emplace_back(section.short_name, std::to_string(survey.count(section.end)));
  page.key_figures(figures);
  page.table(table_of(survey));
  const std::vector<std::string> maps = names_of_maps(survey);
  for (const Section& section : sections) add_section(page, section, survey, maps);
  add_oddities(page, survey);
  return page.html();
}

}  // namespace sphparam
