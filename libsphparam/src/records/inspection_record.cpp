#include "sphparam/records/inspection_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/attributes/corner_colours.h"
#include "io/inspected_source.h"
#include "mesh/cavities.h"
#include "number_text.h"
#include "place_text.h"
#include "records/body_record.h"
#include "records/json_parts.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/names.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

constexpr int figure_digits = 6;

/// "nx, ny, nz, texture coordinates per corner, 2 materials"
std::string attributes(const MeshFile& file) {
  std::vector<std::string> words;
  for (const Property& property : file.vertex_properties) words.push_back(property.name);
  for (const Property& property : file.face_properties)
    if (!is_corner_colour(property.name)) words.push_back(property.name + " per face");
  if (corner_colours(file)) words.push_back("colours per corner");
  if (file.corner_texcoords) words.push_back("texture coordinates per corner");
  if (file.corner_normals) words.push_back("normals per corner");
  if (file.second_texcoords) words.push_back("second texture coordinates");
  if (file.corner_tangents) words.push_back("tangents");
  if (!file.materials.empty()) {
    words.push_back(std::to_string(file.materials.size()) + " materials");
  }
  return words.empty() ? "none" : joined(words);
}

std::string box(const Vector3& lower, const Vector3& upper) {
  const double length = (upper - lower).maxCoeff();
  return "(" + place_text(lower, length) + ") to (" + place_text(upper, length) + ")";
}

/// "  label         value"
std::string line(const std::string& label, const std::string& value) {
  constexpr size_t column = 14;
  return "  " + label + std::string(column - std::min(label.size(), column - 1), ' ') + value +
         "\n";
}

std::string topology(const MeshInspection& mesh) {
  std::string text = "Euler characteristic " + std::to_string(mesh.euler_characteristic);
  if (mesh.genus >= 0) text += ", genus " + std::to_string(mesh.genus);
  if (mesh.boundary_loops) text += ", " + std::to_string(mesh.boundary_loops) + " boundary loops";
  return text;
}

/// "7, 6 of them cavities within the largest: volume 93.2, 0.307 % of it".
std::string components(const MeshSource& source) {
  std::string text = std::to_string(source.inspection.components);
  if (source.inspection.components < 2) return text;
  const Cavities cavities = find_cavities(source.file.mesh);
  if (cavities.lowest.empty()) return text;
  return text + ", " + std::to_string(cavities.lowest.size()) + " of them " +
         (cavities.lowest.size() == 1 ? "a cavity" : "cavities") + " within the largest: volume " +
         short_number(cavities.volume, figure_digits) + ", " + percent(cavities.share) + " of it";
}

/// Null where there are none.
Json cavities_json(const MeshSource& source) {
  if (source.inspection.components < 2) return nullptr;
  const Cavities cavities = find_cavities(source.file.mesh);
  if (cavities.lowest.empty()) return nullptr;
  return {
      {"count", cavities.lowest.size()}, {"volume", cavities.volume}, {"share", cavities.share}};
}

/// What fillers close of a mesh, and what is surface without them.
struct ClosedHoles {
  std::int64_t fillers = 0, holes = 0;
  double area = 0;  // of the surface
};

/// Nothing where there are no fillers.
std::optional<ClosedHoles> closed_holes(const MeshFile& file) {
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return std::nullopt;
  const MeshInspection surface = inspect_mesh(without_fillers(file).mesh);
  return ClosedHoles{std::ranges::count(fillers, 1), surface.boundary_loops, surface.area};
}

/// An STL names no vertices: its corners are put together by their coordinates as they are read.
bool is_soup(const MeshFile& file) { return file.format.starts_with("STL"); }

std::string welding(const MeshSource& source) {
  if (is_soup(source.file)) return "used: corners of the same coordinates are one vertex";
  return source.welded ? "used: the faces as indexed are not closed" : "not used";
}

std::string filler_line(const std::optional<ClosedHoles>& closed) {
  if (!closed) return "";
  return line("fillers", counted(closed->fillers, "triangle", "triangles") + ", closing " +
                             counted(closed->holes, "hole", "holes") + "; no surface");
}

/// "3 pairs of 4 triangles, the first 3 and 4 at (1, 2, 3)"
std::string crossings_text(const SelfCrossings& crossings, double length) {
  if (crossings.none()) return "none: no triangle passes through another or lies over it";
  if (crossings.pairs == 0)
    return "none found, and not all were looked for: too many boxes overlap";
  return (crossings.all ? "" : "at least ") + counted(crossings.pairs, "pair", "pairs") + " of " +
         counted(crossings.faces, "triangle", "triangles") + ", the first " +
         std::to_string(crossings.first[0]) + " and " + std::to_string(crossings.first[1]) +
         " at (" + place_text(crossings.place, length) + ")";
}

/// Why the volume of several parts counts what they share twice; empty: it does not, or nobody
/// looked.
std::string shared_by_parts(const InspectionRecord& record) {
  if (record.source.inspection.components < 2) return "";
  if (record.crossings && record.crossings->pairs > 0) return "triangles of it cross";
  const auto within =
      static_cast<long>(find_cavities(record.source.file.mesh).lowest_of_solids.size());
  if (within == 0) return "";
  return counted(within, "part lies", "parts lie") +
         " within the largest, with faces that look out as well";
}

std::string shared_line(const InspectionRecord& record) {
  const std::string why = shared_by_parts(record);
  if (why.empty()) return "";
  return line("counted twice", "what parts share, in volume, centroid and inertia: " + why +
                                   "; `sphparam wrap` makes one body of them");
}

std::string crossings_line(const InspectionRecord& record) {
  if (!record.crossings) return line("crossings", "not looked for");
  const MeshInspection& mesh = record.source.inspection;
  return line("crossings", crossings_text(*record.crossings, (mesh.upper - mesh.lower).maxCoeff()));
}

std::string figures(const MeshSource& source, const std::optional<ClosedHoles>& closed) {
  const MeshInspection& mesh = source.inspection;
  const MeshFile& file = source.file;
  const std::string triangulated =
      file.polygons ? ", " + std::to_string(file.polygons) + " polygons were triangulated" : "";
  return line("format", file.format) + line("vertices", std::to_string(mesh.vertices)) +
         line("triangles", std::to_string(mesh.faces) + triangulated) +
         line("edges", std::to_string(mesh.edges)) + line("components", components(source)) +
         line("topology", topology(mesh)) + line("bounding box", box(mesh.lower, mesh.upper)) +
         filler_line(closed) +
         line("area", short_number(closed ? closed->area : mesh.area, figure_digits)) +
         (has_volume(mesh) ? line("volume", short_number(mesh.volume, figure_digits) +
                                                (closed ? ", fillers included" : ""))
                           : "") +
         line("attributes", attributes(file)) + line("welding", welding(source));
}

/// How the map that a file has came about; nothing where it has none.
Provenance provenance_in(const MeshFile& file) {
  return has_map(file) ? read_provenance(file) : Provenance{};
}

/// Null for a mesh without fillers.
Json closed_json(const std::optional<ClosedHoles>& closed) {
  if (!closed) return nullptr;
  return {{"triangles", closed->fillers}, {"holes", closed->holes}};
}

/// What --repair would do; null for a mesh that needs none.
Json trial_json(const MeshSource& source, const std::optional<RepairTrial>& trial) {
  if (!trial) return nullptr;
  Json remaining = Json::array();
  for (const MeshDefect& defect : trial->remaining) remaining.push_back(defect_json(defect));
  return {{"mends", mends_unasked(source, *trial)},
          {"mends_with", trial->can_mend() ? Json(options_line(trial->options)) : Json()},
          {"actions", repairs_json(trial->actions)},
          {"handles", handles_json(trial->handles)},
          {"components", parts_json(trial->parts)},
          {"remaining", remaining}};
}

/// Null where it is no matter of defects.
Json defects_json(const std::vector<MeshDefect>& defects) {
  if (defects.empty()) return nullptr;
  Json all = Json::array();
  for (const MeshDefect& defect : defects) all.push_back(defect_json(defect));
  return {{"mappable", false}, {"defects", all}};
}

}  // namespace

SelfCrossings crossings_of(const MeshFile& file, int threads, const Progress& progress) {
  const SelfCrossingOptions options{
      .most_looks = usual_looks, .threads = threads, .progress = progress};
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return find_self_crossings(file.mesh, options);
  if (std::ranges::count(fillers, 0) == 0) return {};  // no surface
  return find_self_crossings(surface_in_place(file.mesh, fillers), options);
}

std::string to_json(const RefusalRecord& record) {
  return text_of({{"sphparam", version},
                  {"command", record.command},
                  {"input", record.file.empty() ? Json() : Json{{"file", record.file}}},
                  {"error", {{"code", record.code}, {"message", record.message}}},
                  {"inspection", defects_json(record.defects)},
                  {"repairs", repairs_json(record.repairs)}});
}

std::string to_json(const InspectionRecord& record) {
  const std::optional<ClosedHoles> closed = closed_holes(record.source.file);
  Json inspection = inspection_json(record.source.inspection);
  if (closed) inspection["area"] = closed->area;
  const auto body = enclosed_body(record.source.file.mesh, record.source.inspection);
  if (record.source.inspection.is_sphere()) inspection["mappable"] = is_mappable(record.source);
  return text_of({{"sphparam", version},
                  {"command", "info"},
                  {"input", input_json(record.source)},
                  {"inspection", inspection},
                  {"crossings", record.crossings ? crossings_json(*record.crossings) : Json()},
                  {"fillers", closed_json(closed)},
                  {"cavities", cavities_json(record.source)},
                  {"repair", trial_json(record.source, record.repair)},
                  {"welded", record.source.welded || is_soup(record.source.file)},
                  {"provenance", pairs_json(provenance_in(record.source.file))},
                  {"body", body_json(body)},
                  {"counted_twice", body && !shared_by_parts(record).empty()},
                  {"notes", record.source.notes},
                  {"seconds", record.seconds}});
}

std::string to_text(const InspectionRecord& record) {
  const MeshSource& source = record.source;
  const std::optional<ClosedHoles> closed = closed_holes(source.file);
  std::string text =
      display_name(source.path) + "\n" + figures(source, closed) + crossings_line(record);
  const Vector3 sides = source.inspection.upper - source.inspection.lower;
  const auto body = enclosed_body(source.file.mesh, source.inspection);
  for (const auto& [label, value] : body_lines(body, sides.maxCoeff())) text += line(label, value);
  if (body) text += shared_line(record);
  for (const auto& [key, value] : provenance_in(source.file)) text += line("map " + key, value);
  for (const std::string& note : source.notes) text += line("note", note);
  if (!source.inspection.defects.empty()) {
    text += "What is odd or wrong:\n" + defect_list(source.inspection.defects);
  }
  if (source.inspection.is_sphere() && !is_mappable(source))
    return text + "A closed genus-0 mesh without area: it has no shape that could be mapped.\n";
  if (source.inspection.is_sphere()) {
    return text + (closed ? "With its fillers a closed genus-0 mesh" : "A closed genus-0 mesh") +
           ": it can be mapped.\n" +
           (has_defect(source.inspection, DefectKind::InsideOut)
                ? "Its faces point inwards: --repair=orientation turns them.\n"
                : "");
  }
  text += "This mesh cannot be mapped to a sphere as it is.\n";
  return record.repair ? text + repair_advice(*record.repair, source.path, "", record.parts) : text;
}

}  // namespace sphparam
