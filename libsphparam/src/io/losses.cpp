#include "sphparam/io/losses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "io/attributes/corner_colours.h"
#include "io/attributes/texture_pages.h"
#include "io/attributes/whole_vector.h"
#include "io/formats/lossless_type.h"
#include "mesh/flat_face.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"

namespace sphparam {
namespace {

constexpr std::string_view prefix = "not carried: ";

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether what was read has the attribute, be it at vertices or at corners; colours may have been
/// rounded to bytes or from them.
bool is_carried(const Property& property, const std::vector<Property>& written,
                const std::vector<Property>& read, const MeshFile& file) {
  const bool is_whole = is_of_whole_vector(property.name, written);
  if (is_whole && is_one_of(property.name, {"s", "t"}) && file.corner_texcoords) return true;
  if (is_whole && is_one_of(property.name, {"nx", "ny", "nz"}) && file.corner_normals) return true;
  const auto found = std::find_if(read.begin(), read.end(), [&](const Property& candidate) {
    return candidate.name == property.name;
  });
  if (found == read.end()) return false;
  return (is_whole && is_one_of(property.name, {"red", "green", "blue", "alpha"})) ||
         found->values == property.values;
}

/// The names of those that are gone; `renamed` counts those that are there under another name.
std::vector<std::string> gone(const std::vector<Property>& written,
                              const std::vector<Property>& read, const MeshFile& file,
                              std::vector<std::string>& renamed) {
  std::vector<std::string> names;
  for (const Property& property : written) {
    if (is_one_of(property.name, {"sx", "sy", "sz", "theta", "phi", "source_face"})) continue;
    if (is_corner_colour(property.name)) continue;
    if (is_carried(property, written, read, file)) continue;
    const bool elsewhere = std::any_of(read.begin(), read.end(), [&](const Property& candidate) {
      return candidate.values == property.values;
    });
    (elsewhere ? renamed : names).push_back(property.name);
  }
  return names;
}

/// Triangles that had area before they were rounded.
std::int64_t flattened(const TriangleMesh& written, const TriangleMesh& read) {
  const auto is_flat_in = [](const TriangleMesh& mesh, Face f) {
    return has_no_area(mesh.position(mesh.triangles(f, 0)), mesh.position(mesh.triangles(f, 1)),
                       mesh.position(mesh.triangles(f, 2)));
  };
  std::int64_t count = 0;
  if (read.triangles != written.triangles) return count;
  for (Face f = 0; f < written.face_count(); ++f)
    count += is_flat_in(read, f) && !is_flat_in(written, f);
  return count;
}

void compare_positions(const MeshFile& written, const MeshFile& read,
                       std::vector<std::string>& losses) {
  const Points &before = written.mesh.positions, &after = read.mesh.positions;
  if (before.rows() != after.rows() || before == after) return;
  long moved = 0;
  for (Eigen::Index v = 0; v < before.rows(); ++v) moved += before.row(v) != after.row(v);
  add_loss(losses, "the last digits of " + std::to_string(moved) + " of " +
                       counted(before.rows(), "vertex", "vertices") +
                       ": coordinates there have 32 bits");
  const auto flat = flattened(written.mesh, read.mesh);
  if (flat > 0)
    add_loss(losses, "the area of " + std::to_string(flat) + " of " +
                         counted(written.mesh.face_count(), "triangle") +
                         ": with coordinates of 32 bits they have none");
}

/// Labels that were read as measures: the format has no whole numbers so large.
std::vector<std::string> no_labels_now(const std::vector<Property>& written,
                                       const std::vector<Property>& read) {
  std::vector<std::string> names;
  for (const Property& property : written)
    for (const Property& now : read)
      if (property.type == ScalarType::Int64 && now.name == property.name && is_floating(now.type))
        names.push_back(property.name);
  return names;
}

/// The name of a face's material; empty for none.
std::string_view material_of(const MeshFile& file, const Property& materials, std::size_t face) {
  const double id = materials.values[face];
  const bool is_one = id >= 0 && id < static_cast<double>(file.materials.size());
  if (!is_one) return {};
  return file.materials[static_cast<std::size_t>(id)];
}

/// By their names: formats number them anew.
bool have_same_materials(const MeshFile& written, const MeshFile& read) {
  const Property* const before = written.find_face_property("material");
  const Property* const after = read.find_face_property("material");
  if (!before || !after || before->values.size() != after->values.size()) return false;
  for (std::size_t f = 0; f < before->values.size(); ++f)
    if (material_of(written, *before, f) != material_of(read, *after, f)) return false;
  return true;
}

void compare_properties(const MeshFile& written, const MeshFile& read,
                        std::vector<std::string>& losses) {
  const auto tell = [&](const std::vector<std::string>& names, const std::string& whose) {
    if (!names.empty()) add_loss(losses, enumerated(names) + " of " + whose);
  };
  std::vector<std::string> renamed;
  tell(gone(written.vertex_properties, read.vertex_properties, read, renamed), "vertices");
  std::vector<std::string> of_faces =
      gone(written.face_properties, read.face_properties, read, renamed);
  if (have_same_materials(written, read)) std::erase(of_faces, "material");
  tell(of_faces, "faces");
  tell(renamed, "properties whose numbers are kept without their names");
}

/// Colours from 0 to 1 that are no 255th, by more than texts of four digits are off, where they are
/// bytes now.
void compare_colours(const MeshFile& written, const MeshFile& read,
                     std::vector<std::string>& losses) {
  constexpr double brightest = 255, off_in_text = 0.02;
  const auto count = static_cast<std::size_t>(written.mesh.vertex_count());
  if (read.mesh.vertex_count() != written.mesh.vertex_count()) return;
  std::vector<char> changed(count, 0);
  for (const char* channel : {"red", "green", "blue", "alpha"}) {
    const Property* const before = written.find_vertex_property(channel);
    const Property* const after = read.find_vertex_property(channel);
    if (!before || !after || !is_floating(before->type) || is_floating(after->type)) continue;
    for (std::size_t v = 0; v < count; ++v)
      changed[v] |= std::abs(brightest * before->values[v] - after->values[v]) > off_in_text;
  }
  const auto all = std::ranges::count(changed, 1);
  if (all > 0)
    add_loss(losses, "the last digits of " + std::to_string(all) + " of " +
                         counted(std::ssize(changed), "colour") +
                         " of vertices: they are bytes there, the nearest of 255 steps");
}

void compare_labels(const MeshFile& written, const MeshFile& read,
                    std::vector<std::string>& losses) {
  for (const auto properties : {&MeshFile::vertex_properties, &MeshFile::face_properties}) {
    const std::vector<std::string> names = no_labels_now(written.*properties, read.*properties);
    if (!names.empty()) add_loss(losses, words_of_lost_labels(names));
  }
}

/// What corners have, which vertices may have instead.
void compare_corners(const MeshFile& written, const MeshFile& read,
                     std::vector<std::string>& losses) {
  const auto tell = [&](bool is_lost, const char* what) {
    if (is_lost) add_loss(losses, what);
  };
  tell(written.corner_texcoords && !read.corner_texcoords && !read.find_vertex_property("s"),
       "texture coordinates of corners");
  tell(written.corner_normals && !read.corner_normals && !read.find_vertex_property("nx"),
       "normals of corners");
  tell(written.second_texcoords && !read.second_texcoords, "second texture coordinates");
  tell(corner_colours(written) && !corner_colours(read), "more than one colour of a vertex");
  tell(written.corner_tangents && !read.corner_tangents, "tangents");
}

/// A PLY file names the images of its texture by its comments; they were there when it was read.
bool still_names_pages(const MeshFile& read) {
  return read.format.starts_with("PLY") && has_texture_pages(read);
}

/// Of an OBJ that was read without its folder.
bool still_names_library(const MeshFile& read) {
  return std::ranges::any_of(read.notes, [](const std::string& note) {
    return note.find("colours and textures of ") != std::string::npos;
  });
}

void compare_materials(const MeshFile& written, const MeshFile& read,
                       std::vector<std::string>& losses) {
  if (written.materials.size() > read.materials.size())
    add_loss(losses, counted(std::ssize(written.materials), "material"));
  if (!written.base_colours.empty() && read.base_colours.empty() && !still_names_pages(read) &&
      !still_names_library(read))
    add_loss(losses, "colours and textures of materials");
}

void compare_comments(const MeshFile& written, const MeshFile& read,
                      std::vector<std::string>& losses) {
  const auto lines = [](const MeshFile& file) {
    return std::ranges::count_if(file.comments, [](const std::string& line) {
      return !line.starts_with("sphparam ") && !says_vertices_of_file(line);
    });
  };
  if (const long missing = lines(written) - lines(read); missing > 0)
    add_loss(losses, counted(missing, "comment"));
}

}  // namespace

void add_loss(std::vector<std::string>& notes, const std::string& what) {
  notes.push_back(std::string(prefix) + one_line(what));
}

std::vector<std::string> losses_among(const std::vector<std::string>& notes) {
  std::vector<std::string> losses;
  std::copy_if(notes.begin(), notes.end(), std::back_inserter(losses),
               [](const std::string& note) { return note.starts_with(prefix); });
  return losses;
}

std::vector<std::string> losses_of_writing(const MeshFile& written, const MeshFile& read) {
  std::vector<std::string> losses;
  compare_positions(written, read, losses);
  compare_properties(written, read, losses);
  compare_colours(written, read, losses);
  compare_labels(written, read, losses);
  compare_corners(written, read, losses);
  compare_materials(written, read, losses);
  compare_comments(written, read, losses);
  return losses;
}

void add_polygon_loss(std::vector<std::string>& notes, const MeshFile& file) {
  if (file.polygons == 0) return;
  add_loss(notes, counted(file.polygons, "face of more than three corners, which is",
                          "faces of more than three corners, which are") +
                      " cut into triangles");
}

void add_sampling_losses(std::vector<std::string>& notes, const MeshFile& source) {
  if (!source.base_colours.empty()) add_loss(notes, "colours and textures of materials");
  if (source.second_texcoords) add_loss(notes, "second texture coordinates");
  if (corner_colours(source)) add_loss(notes, "more than one colour of a vertex");
  if (source.corner_tangents) add_loss(notes, "tangents");
}

void add_face_colour_loss(std::vector<std::string>& notes, const MeshFile& file) {
  const Property* const red = file.find_face_property("red");
  const Property* const green = file.find_face_property("green");
  const Property* const blue = file.find_face_property("blue");
  if (!red || !green || !blue) return;
  std::set<std::array<double, 3>> colours;
  for (std::size_t f = 0; f < red->values.size(); ++f)
    colours.insert({red->values[f], green->values[f], blue->values[f]});
  add_loss(notes, counted(std::ssize(colours), "colour") +
                      " of faces into images: those of vertices and of materials are");
}

std::string enumerated(const std::vector<std::string>& words) {
  constexpr std::size_t most_listed = 8;
  const std::size_t listed = words.size() > most_listed ? most_listed - 1 : words.size();
  std::string text;
  for (std::size_t i = 0; i < listed; ++i) {
    const bool last = i + 1 == words.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + words[i];
  }
  if (listed < words.size()) text += " and " + std::to_string(words.size() - listed) + " others";
  return text;
}

}  // namespace sphparam
