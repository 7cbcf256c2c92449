#include "sphparam/correspondence/matched_files.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/attributes/corner_colours.h"
#include "io/attributes/mixed_colour.h"
#include "io/attributes/other_coordinates.h"
#include "io/attributes/texture_pages.h"
#include "io/attributes/weightiest_label.h"
#include "io/data_comments.h"
#include "io/match_targets.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {
namespace {

using std::string_view_literals::operator""sv;

/// Of the shape, of the map, of the file, or of another match: they mean nothing elsewhere.
constexpr std::array not_carried = {"nx"sv,          "ny"sv,       "nz"sv,
                                    "sx"sv,          "sy"sv,       "sz"sv,
                                    "theta"sv,       "phi"sv,      "source_vertex"sv,
                                    "target_face"sv, "target_0"sv, "target_1"sv,
                                    "target_2"sv};
const std::vector<std::string> targets(match_targets.begin(), match_targets.end());

bool is_among(const auto& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// What the corners about a point have, by their weights.
std::array<std::pair<double, double>, 3> weighed(const TriangleMesh& mesh,
                                                 const std::vector<double>& values,
                                                 const SurfacePoint& point) {
  std::array<std::pair<double, double>, 3> corners;
  for (int k = 0; k < 3; ++k)
    corners[static_cast<size_t>(k)] = {values[static_cast<size_t>(mesh.triangles(point.face, k))],
                                       point.barycentric[k]};
  return corners;
}

Property carried(const TriangleMesh& mesh, const Property& property, bool is_colour,
                 const std::vector<SurfacePoint>& points) {
  Property result{property.name, property.type, {}};
  if (is_floating(property.type) && !is_colour) {
    result.values = values_at(mesh, property.values, points);
    return result;
  }
  for (const SurfacePoint& point : points) {
    auto corners = weighed(mesh, property.values, point);
    result.values.push_back(is_colour ? mixed_colour(property.name, property.type, corners)
                                      : weightiest_label(corners));
  }
  return result;
}

/// Without its map and what an earlier match says of it.
MeshFile without_correspondence(const MeshFile& mapped) {
  MeshFile file = without_map(mapped);
  remove_properties(file.vertex_properties, targets);
  return file;
}

/// What a surface looks like, which that of the other one replaces as a whole.
bool is_look(const std::string& name) { return is_colour_name(name) || name == "s" || name == "t"; }

/// "I_a" of "I", "flow_a_0" of "flow_0", a column of a vector.
std::string own_name(const std::string& name) {
  const size_t digits = name.find_last_not_of("0123456789") + 1;
  const bool is_column = digits > 1 && digits < name.size() && name[digits - 1] == '_';
  const size_t end = is_column ? digits - 1 : name.size();
  return name.substr(0, end) + "_a" + name.substr(end);
}

/// Numbers that both have under one name: the file's own get another, and another again where that
/// is taken.
void keep_own_values(MeshFile& file, const MeshFile& other) {
  const auto is_taken = [&](const std::string& name) {
    return file.find_vertex_property(name) || other.find_vertex_property(name);
  };
  for (const std::string& own : names_of_values(file)) {
    if (is_look(own) || !other.find_vertex_property(own)) continue;
    std::string name = own;
    while (is_taken(name)) name = own_name(name);
    rename_vertex_property(file, own, name);
  }
}

/// Corners 0, 1, 2 of each triangle become 0, 2, 1.
template <class Rows>
void turn_round(Rows& corners) {
  for (Eigen::Index row = 0; row < corners.rows(); row += 3)
    corners.row(row + 1).swap(corners.row(row + 2));
}

void reflect(MeshFile& file) {
  file.mesh.positions.col(0) *= -1;
  file.mesh.triangles.col(1).swap(file.mesh.triangles.col(2));
  for (Property& property : file.vertex_properties)
    if (property.name == "nx")
      for (double& value : property.values) value = -value;
  if (file.corner_texcoords) turn_round(*file.corner_texcoords);
  if (file.corner_normals) {
    turn_round(*file.corner_normals);
    file.corner_normals->col(0) *= -1;
  }
  if (file.second_texcoords) turn_round(*file.second_texcoords);
  if (auto colours = corner_colours(file)) {
    turn_round(*colours);
    set_corner_colours(file, *colours);
  }
  if (file.corner_tangents) {
    turn_round(*file.corner_tangents);
    file.corner_tangents->col(0) *= -1;
    file.corner_tangents->col(3) *= -1;  // the bitangent is w · N × T
  }
  take_volume(file, {});  // it has no mirror image
}

/// Whether faces that stay have the corners that they had, in their order.
bool keeps_corners(RepairKind kind) {
  using enum RepairKind;
  constexpr std::array kinds = {NonFiniteFaceRemoved, NonFiniteVertexDropped,
                                InvalidFaceRemoved,   DuplicateFaceRemoved,
                                VertexWelded,         EdgeSplit,
                                VertexSplit,          ComponentDropped,
                                HoleFilled,           HoleKept,
                                UnusedVertexDropped};
  return std::ranges::count(kinds, kind) > 0;
}

}  // namespace

MappedMesh with_targets(const SurfaceMap& map, int threads, const std::vector<long>& numbers) {
  const MappedMesh& from = map.from();
  const std::vector<SurfacePoint> points = map.forth(threads);
  MeshFile file = from.file();
  Property face{"target_face", ScalarType::Int32, {}};
  std::array<Property, 3> weights;
  for (size_t k = 0; k < 3; ++k)
    weights[k] = {"target_" + std::to_string(k), ScalarType::Float64, {}};
  for (const SurfacePoint& point : points) {
    const auto row = static_cast<size_t>(point.face);
    face.values.push_back(static_cast<double>(numbers.empty() ? point.face : numbers[row]));
    for (size_t k = 0; k < 3; ++k)
      weights[k].values.push_back(point.barycentric[static_cast<Eigen::Index>(k)]);
  }
  file.set_vertex_property(std::move(face));
  for (Property& weight : weights) file.set_vertex_property(std::move(weight));
  return MappedMesh({.file = std::move(file),
                     .map = from.map(),
                     .provenance = from.provenance(),
                     .topology = from.topology(),
                     .polygons = from.polygons(),
                     .notes = from.notes(),
                     .mapped_here = from.mapped_here(),
                     .name = from.name()},
                    threads);
}

std::optional<std::vector<long>> rows_in_file(const MeshSource& source) {
  if (source.file.polygons > 0) return std::nullopt;
  if (source.repairs.empty()) return std::vector<long>{};
  if (std::ranges::count(source.notes, other_numbers_note) > 0 ||
      !std::ranges::all_of(source.repairs, keeps_corners, &RepairAction::kind))
    return std::nullopt;
  const FileNumbers numbers(source.file);
  std::vector<long> rows;
  for (Face face = 0; face < source.file.mesh.face_count(); ++face)
    rows.push_back(numbers.face_number(face));
  return rows;
}

MeshFile in_other_shape(const SurfaceMap& map, int threads) {
  MeshFile file = without_correspondence(map.from().file());
  move_into(file, map.to().file(), map.from_on_to(threads).positions);
  return file;
}

std::vector<std::string> names_of_values(const MeshFile& file) {
  std::vector<std::string> names;
  for (const Property& property : file.vertex_properties)
    if (!is_among(not_carried, property.name)) names.push_back(property.name);
  return names;
}

MeshFile with_other_values(const SurfaceMap& map, int threads) {
  MeshFile file = without_correspondence(map.from().file());
  keep_own_values(file, map.to().file());
  const std::vector<SurfacePoint> points = map.forth(threads);
  const std::vector<Property>& others = map.to().file().vertex_properties;
  for (const Property& property : others) {
    if (is_among(not_carried, property.name)) continue;
    file.set_vertex_property(
        carried(map.to().mesh(), property, is_of_colour(property, others), points));
  }
  tell_data_of(file, map.to().file());
  if (map.to().file().find_vertex_property("red")) remove_textures(file);
  return file;
}

MappedMesh mirror_image(const MappedMesh& mapped, int threads) {
  MeshFile file = mapped.file();
  reflect(file);
  SphereMap map = mapped.map();
  map.points.col(0) *= -1;
  return MappedMesh({.file = std::move(file),
                     .map = std::move(map),
                     .provenance = mapped.provenance(),
                     .notes = mapped.notes(),
                     .mapped_here = mapped.mapped_here(),
                     .name = mapped.name()},
                    threads);
}

}  // namespace sphparam
