#include "reports/info_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/repairing.h"
#include "console/paths.h"
#include "reports/wording.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

constexpr int figure_digits = 6;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// "nx, ny, nz, texture coordinates per corner, 2 materials"
std::string attributes(const MeshFile& file) {
  std::vector<std::string> words;
  for (const Property& property : file.vertex_properties) words.push_back(property.name);
  for (const Property& property : file.face_properties)
    words.push_back(property.name + " per face");
  if (file.corner_texcoords) words.push_back("texture coordinates per corner");
  if (file.corner_normals) words.push_back("normals per corner");
  if (!file.materials.empty()) {
    words.push_back(std::to_string(file.materials.size()) + " materials");
  }
  return words.empty() ? "none" : joined(words);
}

std::string point(const Vector3& p) {
  return "(" + short_number(p.x(), figure_digits) + ", " + short_number(p.y(), figure_digits) +
         ", " + short_number(p.z(), figure_digits) + ")";
}

/// "  label         value"
std::string line(const std::string& label, const std::string& value) {
  constexpr size_t column = 14;
  return "  " + label + std::string(column - std::min(label.size(), column - 1), ' ') + value +
         "\n";
}

std::string counted(long count, const std::string& what) {
  return std::to_string(count) + " " + what;
}

std::string topology(const MeshInspection& mesh) {
  std::string text = "Euler characteristic " + std::to_string(mesh.euler_characteristic);
  if (mesh.genus >= 0) text += ", genus " + std::to_string(mesh.genus);
  if (mesh.boundary_loops) text += ", " + counted(mesh.boundary_loops, "boundary loops");
  return text;
}

std::string figures(const MeshSource& source) {
  const MeshInspection& mesh = source.inspection;
  const MeshFile& file = source.file;
  const std::string triangulated =
      file.polygons ? ", " + counted(file.polygons, "polygons were triangulated") : "";
  return line("format", file.format) + line("vertices", std::to_string(mesh.vertices)) +
         line("triangles", std::to_string(mesh.faces) + triangulated) +
         line("edges", std::to_string(mesh.edges)) +
         line("components", std::to_string(mesh.components)) + line("topology", topology(mesh)) +
         line("bounding box", point(mesh.lower) + " to " + point(mesh.upper)) +
         line("area", short_number(mesh.area, figure_digits)) +
         line("volume", short_number(mesh.volume, figure_digits)) +
         line("attributes", attributes(file)) +
         line("welding", source.welded ? "used: the faces as indexed are not closed" : "not used");
}
/// What --repair would do; null for a mesh that needs none.
Json trial_json(const std::optional<RepairTrial>& trial) {
  if (!trial) return nullptr;
  Json remaining = Json::array();
  for (const MeshDefect& defect : trial->remaining) remaining.push_back(defect_json(defect));
  return {{"mends", trial->mends_unasked()},
          {"mends_with",
           trial->can_mend() ? Json("--repair" + further_options(trial->options)) : Json()},
          {"actions", repairs_json(trial->actions)},
          {"components", parts_json(trial->parts)},
          {"remaining", remaining}};
}

}  // namespace

std::string to_json(const InfoReport& report) {
  return text_of({{"sphparam", version},
                  {"command", "info"},
                  {"input", input_json(report.input)},
                  {"inspection", inspection_json(report.input.source.inspection)},
                  {"repair", trial_json(report.repair)},
                  {"welded", report.input.source.welded},
                  {"provenance", pairs_json(report.provenance)},
                  {"notes", report.input.source.notes},
                  {"seconds", report.seconds}});
}

std::string to_text(const InfoReport& report) {
  const MeshSource& source = report.input.source;
  std::string text = display_name(report.input.file) + "\n" + figures(source);
  for (const auto& [key, value] : report.provenance) text += line("map " + key, value);
  for (const std::string& note : source.notes) text += line("note", note);
  if (!source.inspection.defects.empty()) {
    text += "What is odd or wrong:\n" + defect_list(source.inspection.defects);
  }
  if (source.inspection.is_sphere()) return text + "A closed genus-0 mesh: it can be mapped.\n";
  return text + "This mesh cannot be mapped to a sphere as it is.\n" +
         words_of(*report.repair, source.path);
}

}  // namespace sphparam::cli
