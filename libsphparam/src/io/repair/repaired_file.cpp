#include "io/repair/repaired_file.h"

#include "io/attributes/corner_colours.h"
#include "io/attributes/mixed_colour.h"
#include "io/attributes/patched_texture.h"
#include "io/attributes/turned_normals.h"
#include "io/attributes/weightiest_label.h"
#include "io/repair/mesh_part.h"
#include "mesh/repair/repair_kinds.h"
#include "sphparam/io/fillers.h"

// Every table is gathered by the ids that the repair returned. The ids of the file are a property
// like any other, added before where the file had none, so that they are gathered too.

namespace sphparam {
namespace {

constexpr const char* source_vertex = "source_vertex";
constexpr const char* source_face = "source_face";

/// Whole numbers may be labels: of colours alone there is something between two of them.
double mean_value(const Property& property, bool is_colour,
                  const std::vector<WeighedVertex>& vertices) {
  double total = 0, sum = 0;
  for (const auto& [v, weight] : vertices) {
    total += weight;
    sum += weight * property.values[v];
  }
  if (is_floating(property.type) && !is_colour) return sum / total;
  std::vector<std::pair<double, double>> weighed;
  for (const auto& [v, weight] : vertices) weighed.emplace_back(property.values[v], weight / total);
  return is_colour ? mixed_colour(property.name, property.type, weighed)
                   : weightiest_label(weighed);
}

void gather_vertices(Property& property, bool is_colour, const RepairedMesh& repaired) {
  std::vector<double> values;
  values.reserve(repaired.vertex_origin.size());
  for (const Vertex v : repaired.vertex_origin) values.push_back(v < 0 ? -1 : property.values[v]);
  for (const CreatedVertex& created : repaired.created) {
    if (property.name != source_vertex) {
      values[created.vertex] = mean_value(property, is_colour, created.mean_of);
    }
  }
  property.values = std::move(values);
}

void gather_faces(Property& property, const RepairedMesh& repaired) {
  std::vector<double> values;
  values.reserve(repaired.face_origin.size());
  for (std::size_t f = 0; f < repaired.face_origin.size(); ++f) {
    const Face neighbour = repaired.corner_origin[3 * f] / 3;
    const bool has_no_id = repaired.face_origin[f] < 0 && property.name == source_face;
    values.push_back(has_no_id ? -1 : property.values[neighbour]);
  }
  property.values = std::move(values);
}

template <class Table>
void gather_corners(std::optional<Table>& table, const RepairedMesh& repaired) {
  if (!table) return;
  const std::vector<int>& origin = repaired.corner_origin;
  Table gathered(static_cast<Eigen::Index>(origin.size()), table->cols());
  for (std::size_t i = 0; i < origin.size(); ++i) {
    gathered.row(static_cast<Eigen::Index>(i)) = table->row(origin[i]);
  }
  for (const auto& [corner, between] : repaired.blended)
    gathered.row(corner) =
        between.barycentric.transpose() * table->template middleRows<3>(3 * between.face);
  table = std::move(gathered);
}

/// What lies between unit vectors is one.
template <class Table>
void make_unit(std::optional<Table>& vectors, const RepairedMesh& repaired) {
  if (!vectors) return;
  for (const BlendedCorner& corner : repaired.blended)
    vectors->row(corner.corner).template head<3>().normalize();
}

const std::vector<std::string> of_vertices = {"s", "t"};

/// Back to the vertices where all corners of each agree.
void return_to_vertices(MeshFile& file) {
  Property s = *file.find_vertex_property("s"), t = *file.find_vertex_property("t");
  const Triangles& triangles = file.mesh.triangles;
  const CornerTexcoords& uv = *file.corner_texcoords;
  const auto is_there = [&](Vertex v) { return v >= 0 && v < file.mesh.vertex_count(); };
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const Vertex v = triangles.data()[i];
    if (!is_there(v)) continue;
    s.values[v] = uv(i, 0);
    t.values[v] = uv(i, 1);
  }
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const Vertex v = triangles.data()[i];
    if (!is_there(v)) continue;
    if (s.values[v] == uv(i, 0) && t.values[v] == uv(i, 1)) continue;
    remove_properties(file.vertex_properties, of_vertices);
    return;
  }
  file.corner_texcoords.reset();
  file.set_vertex_property(std::move(s));
  file.set_vertex_property(std::move(t));
}

/// Of the corners; 0 where a face names a vertex that is not there, which no repair keeps.
std::optional<CornerTexcoords> input_texcoords(const MeshFile& file) {
  if (file.corner_texcoords) return file.corner_texcoords;
  const Property *s = file.find_vertex_property("s"), *t = file.find_vertex_property("t");
  if (!s || !t) return std::nullopt;
  const Triangles& triangles = file.mesh.triangles;
  CornerTexcoords corners = CornerTexcoords::Zero(triangles.size(), 2);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const Vertex v = triangles.data()[i];
    if (v >= 0 && v < file.mesh.vertex_count()) corners.row(i) << s->values[v], t->values[v];
  }
  return corners;
}

/// Texture coordinates go corner by corner, for a vertex may have several now.
void gather_texcoords(MeshFile& result, const MeshFile& file, const RepairedMesh& repaired) {
  std::optional<CornerTexcoords> input = input_texcoords(file);
  if (!input) return;
  const bool by_vertex = !file.corner_texcoords;
  result.corner_texcoords = *input;
  if (by_vertex) result.corner_texcoord_type = file.find_vertex_property("s")->type;
  gather_corners(result.corner_texcoords, repaired);
  texture_patches(result, file, *input, repaired);
  if (by_vertex) return_to_vertices(result);
}

/// The second ones, by the same rules.
void gather_second_texcoords(MeshFile& result, const MeshFile& file, const RepairedMesh& repaired) {
  if (!file.second_texcoords) return;
  gather_corners(result.second_texcoords, repaired);
  result.corner_texcoords.swap(result.second_texcoords);
  texture_patches(result, file, *file.second_texcoords, repaired);
  result.corner_texcoords.swap(result.second_texcoords);
}

/// By corner: its vertex in the input where that was welded onto another one; else −1.
std::vector<Vertex> welded_vertices(const MeshFile& file, const RepairedMesh& repaired) {
  std::vector<Vertex> welded(repaired.corner_origin.size(), -1);
  std::vector<char> is_gone(static_cast<std::size_t>(file.mesh.vertex_count()), 1);
  for (const Vertex v : repaired.vertex_origin)
    if (v >= 0) is_gone[v] = 0;
  for (std::size_t i = 0; i < welded.size(); ++i) {
    const Vertex v = file.mesh.triangles.data()[repaired.corner_origin[i]];
    const bool is_there = v >= 0 && v < file.mesh.vertex_count();
    if (repaired.face_origin[i / 3] >= 0 && is_there && is_gone[v]) welded[i] = v;
  }
  for (const BlendedCorner& corner : repaired.blended) welded[corner.corner] = -1;
  return welded;
}

/// As exact copies do (welding.h), where a vertex was welded onto one of another colour.
void keep_colours_of_welded(MeshFile& result, const MeshFile& file, const RepairedMesh& repaired) {
  const bool welds = count_of(repaired.actions, RepairKind::VertexWelded) > 0;
  for (const char* name : {"red", "green", "blue"})
    if (!welds || !file.find_vertex_property(name)) return;
  const std::vector<Vertex> welded = welded_vertices(file, repaired);
  CornerColours colours = CornerColours::Zero(result.mesh.triangles.size(), 4);
  bool differ = false;
  Eigen::Index channel = 0;
  for (const char* name : {"red", "green", "blue", "alpha"}) {
    const Property *before = file.find_vertex_property(name),
                   *now = result.find_vertex_property(name);
    for (Eigen::Index i = 0; before && i < colours.rows(); ++i) {
      const double shown = now->values[result.mesh.triangles.data()[i]];
      const Vertex own = welded[i];
      colours(i, channel) = own < 0 ? shown : before->values[own];
      differ = differ || (own >= 0 && before->values[own] != shown);
    }
    ++channel;
  }
  if (differ) set_corner_colours(result, colours);
}

void gather_corner_colours(MeshFile& result, const MeshFile& file, const RepairedMesh& repaired) {
  std::optional<CornerColours> colours = corner_colours(file);
  if (!colours) return keep_colours_of_welded(result, file, repaired);
  gather_corners(colours, repaired);
  set_corner_colours(result, *colours);
}

/// Those of before, and those of this repair. What closes a handle is surface.
FillerMarks all_fillers(const MeshFile& gathered, const RepairedMesh& repaired) {
  FillerMarks fillers = fillers_of(gathered);
  if (fillers.empty()) return repaired.fillers;
  for (std::size_t f = 0; f < fillers.size(); ++f) {
    if (repaired.face_origin[f] < 0) fillers[f] = repaired.fillers[f];
  }
  return fillers;
}

}  // namespace

MeshFile repaired_file(const MeshFile& file, const RepairedMesh& repaired) {
  if (repaired.actions.empty()) return file;
  MeshFile result = with_numbers(file);
  // Whatever type the file gave them: it must hold −1.
  for (auto* properties : {&result.vertex_properties, &result.face_properties}) {
    for (Property& property : *properties) {
      if (property.name == source_vertex || property.name == source_face) {
        property.type = ScalarType::Int32;
      }
    }
  }
  for (Property& property : result.vertex_properties)
    gather_vertices(property, is_of_colour(property, result.vertex_properties), repaired);
  make_created_normals_unit(result, repaired);
  for (Property& property : result.face_properties) gather_faces(property, repaired);
  gather_corners(result.corner_normals, repaired);
  make_unit(result.corner_normals, repaired);
  result.mesh = repaired.mesh;
  gather_texcoords(result, file, repaired);
  gather_second_texcoords(result, file, repaired);
  gather_corner_colours(result, file, repaired);
  gather_corners(result.corner_tangents, repaired);
  make_unit(result.corner_tangents, repaired);
  turn_normals(result, repaired);
  if (!repaired.fillers.empty()) mark_fillers(result, all_fillers(result, repaired));
  return result;
}

}  // namespace sphparam
