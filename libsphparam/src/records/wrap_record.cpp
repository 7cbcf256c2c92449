#include "sphparam/records/wrap_record.h"

#include <nlohmann/json.hpp>

#include "mesh/box.h"
#include "number_text.h"
#include "place_text.h"
#include "records/json_parts.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

constexpr int figure_digits = 6;

double outside_share(const Wrap& wrap) {
  return static_cast<double>(wrap.outside) / static_cast<double>(wrap.soup_vertices);
}

/// "lattice of 131 × 97 × 85 points, voxel 0.0156, at distance 0.0312, drawn in to 0.001".
std::string lattice_line(const Wrap& wrap) {
  std::string text = "lattice of " + std::to_string(wrap.lattice[0]);
  for (int axis = 1; axis < 3; ++axis) text += " × " + std::to_string(wrap.lattice[axis]);
  return text + " points, voxel " + short_number(wrap.voxel) + ", at distance " +
         short_number(wrap.distance) +
         (wrap.gap < wrap.distance ? ", drawn in to " + short_number(wrap.gap) : "");
}

std::string parts_line(const Wrap& wrap) {
  const std::string parts = std::to_string(wrap.parts) + " parts are apart at this distance: ";
  if (wrap.kept_share == 1) return parts + "joined by bridges a voxel thick";
  return parts + "the largest is kept, " + percent(wrap.kept_share) + " of their volume";
}

std::string handles_line(const Wrap& wrap) {
  return counted(wrap.handles, "handle") + " filled by walls a voxel thick";
}

std::string distance_line(const Wrap& wrap) {
  const OneSidedDistance& off = wrap.apart.forth;
  return "the wrap is " + short_number(off.mean) + " from the soup in the mean, from " +
         short_number(off.min) + " to " + short_number(off.max);
}

std::string size_line(const Wrap& wrap) {
  return "the wrap encloses " + short_number(wrap.volume, figure_digits) + ", its area is " +
         short_number(wrap.area, figure_digits) + ", that of the soup " +
         short_number(wrap.soup_area, figure_digits) +
         (wrap.skin ? ": a skin about open sheets" : "");
}

std::string skin_warning(const Wrap& wrap, double closing_distance) {
  return "the wrap encloses no more than a skin about open sheets, " +
         short_number(wrap.volume, figure_digits) +
         " in all: the soup is open in places that are wider than twice the distance, " +
         short_number(wrap.distance) + "; about --distance " + shortest(closing_distance) +
         " closes them, and what is within becomes solid";
}

/// Empty: nothing.
std::string left_behind(const MeshFile& soup) {
  std::vector<std::string> kinds;
  const auto add = [&kinds](size_t count, std::string_view one, std::string_view many) {
    if (count > 0) kinds.push_back(counted(static_cast<long>(count), one, many));
  };
  add(soup.vertex_properties.size(), "property of vertices", "properties of vertices");
  add(soup.face_properties.size(), "property of faces", "properties of faces");
  if (soup.corner_texcoords) kinds.push_back("texture coordinates");
  if (soup.corner_normals) kinds.push_back("normals of corners");
  add(soup.materials.size(), "material", "materials");
  return kinds.empty() ? "" : "stays with the soup: " + joined(kinds);
}

Json soup_json(const WrapRecord& record) {
  return {{"file", record.input},
          {"format", record.soup.format},
          {"vertices", record.soup.mesh.vertex_count()},
          {"triangles", record.soup.mesh.face_count()},
          {"notes", record.soup.notes}};
}

Json distances_json(const OneSidedDistance& off) {
  return {{"mean", off.mean},
          {"RMS", off.rms},
          {"min", off.min},
          {"max", off.max},
          {"max_bound", off.max_bound},
          {"farthest", vector_json(off.farthest)}};
}

}  // namespace

std::optional<SelfCrossings> crossings_of(const Wrap& wrap, int threads) {
  if (wrap.lattice_faces == wrap.mesh.face_count() && wrap.gap >= wrap.distance) return {};
  return find_self_crossings(wrap.mesh, {.most_looks = usual_looks, .threads = threads});
}

std::string crossings_warning(const SelfCrossings& found, const Wrap& wrap) {
  return std::to_string(found.faces) + " of " +
         counted(wrap.mesh.face_count(), "triangle", "triangles") + " of the wrap cross others (" +
         counted(found.pairs, "pair", "pairs") + ", the first at (" +
         place_text(found.place, longest_side(wrap.mesh)) +
         ")): with all triangles of the lattice (--faces 0) and no --gap none do";
}

std::vector<std::string> warnings_of(const WrapRecord& record) {
  std::vector<std::string> warnings;
  if (record.crossings && record.crossings->pairs > 0)
    warnings.push_back(crossings_warning(*record.crossings, record.wrap));
  if (record.closing_distance > 0)
    warnings.push_back(skin_warning(record.wrap, record.closing_distance));
  return warnings;
}

std::string to_json(const WrapRecord& record) {
  const Wrap& wrap = record.wrap;
  return text_of(
      {{"sphparam", version},
       {"command", "wrap"},
       {"input", soup_json(record)},
       {"voxel", wrap.voxel},
       {"distance", wrap.distance},
       {"gap", wrap.gap},
       {"lattice", wrap.lattice},
       {"parts", wrap.parts},
       {"kept_share", wrap.kept_share},
       {"insides", wrap.insides},
       {"cavities", wrap.cavities},
       {"skin", wrap.skin},
       {"closing_distance", record.closing_distance > 0 ? Json(record.closing_distance) : Json()},
       {"handles", wrap.handles},
       {"added_share", wrap.added_share},
       {"lattice_triangles", wrap.lattice_faces},
       {"soup_vertices", wrap.soup_vertices},
       {"outside", wrap.outside},
       {"outside_share", outside_share(wrap)},
       {"vertices", wrap.mesh.vertex_count()},
       {"triangles", wrap.mesh.face_count()},
       {"volume", wrap.volume},
       {"area", wrap.area},
       {"soup_area", wrap.soup_area},
       {"from_soup", distances_json(wrap.apart.forth)},
       {"soup_to_wrap_max", wrap.apart.back.max},
       {"crossings", record.crossings ? crossings_json(*record.crossings) : Json()},
       {"warnings", warnings_of(record)},
       {"outputs", pairs_json(record.outputs)},
       {"seconds", record.seconds}});
}

std::vector<std::string> to_lines(const WrapRecord& record) {
  const Wrap& wrap = record.wrap;
  std::vector<std::string> lines = {lattice_line(wrap)};
  if (wrap.parts > 1) lines.push_back(parts_line(wrap));
  if (wrap.handles > 0) lines.push_back(handles_line(wrap));
  if (wrap.added_share > 0)
    lines.push_back("walls and bridges are " + percent(wrap.added_share) + " of its volume");
  if (wrap.cavities > 0)
    lines.push_back(counted(wrap.cavities, "cavity is", "cavities are") + " filled");
  if (wrap.lattice_faces > wrap.mesh.face_count())
    lines.push_back(counted(wrap.lattice_faces, "triangle") + " of the lattice became " +
                    std::to_string(wrap.mesh.face_count()));
  lines.push_back(std::to_string(wrap.outside) + " of " + std::to_string(wrap.soup_vertices) +
                  " vertices are outside (" + percent(outside_share(wrap)) + ")");
  lines.push_back(distance_line(wrap));
  lines.push_back(size_line(wrap));
  if (const std::string left = left_behind(record.soup); !left.empty()) lines.push_back(left);
  return lines;
}

}  // namespace sphparam
