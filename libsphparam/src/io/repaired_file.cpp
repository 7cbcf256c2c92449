#include "io/repaired_file.h"

#include <cmath>
#include <set>

#include "io/attributes/weightiest_label.h"
#include "io/mesh_part.h"
#include "sphparam/io/fillers.h"

// Every table is gathered by the ids that the repair returned. The ids of the file are a property
// like any other, added before where the file had none, so that they are gathered too.

namespace sphparam {
namespace {

constexpr const char* source_vertex = "source_vertex";
constexpr const char* source_face = "source_face";

/// Whole numbers may be labels: of colours alone there is something between two of them.
double mean_value(const Property& property, const std::vector<Vertex>& vertices) {
  static const std::set<std::string> colours = {"red", "green", "blue", "alpha"};
  if (!is_floating(property.type) && !colours.contains(property.name)) {
    std::vector<std::pair<double, double>> labelled;
    for (const Vertex v : vertices) labelled.emplace_back(property.values[v], 1);
    return weightiest_label(labelled);
  }
  double sum = 0;
  for (const Vertex v : vertices) sum += property.values[v];
  const double mean = sum / static_cast<double>(vertices.size());
  return is_floating(property.type) ? mean : std::round(mean);
}

void gather_vertices(Property& property, const RepairedMesh& repaired) {
  std::vector<double> values;
  values.reserve(repaired.vertex_origin.size());
  for (const Vertex v : repaired.vertex_origin) values.push_back(v < 0 ? -1 : property.values[v]);
  for (const CreatedVertex& created : repaired.created) {
    if (property.name != source_vertex) {
      values[created.vertex] = mean_value(property, created.mean_of);
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
void gather_corners(std::optional<Table>& table, const std::vector<int>& corner_origin) {
  if (!table) return;
  Table gathered(static_cast<Eigen::Index>(corner_origin.size()), table->cols());
  for (std::size_t i = 0; i < corner_origin.size(); ++i) {
    gathered.row(static_cast<Eigen::Index>(i)) = table->row(corner_origin[i]);
  }
  table = std::move(gathered);
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
  for (Property& property : result.vertex_properties) gather_vertices(property, repaired);
  for (Property& property : result.face_properties) gather_faces(property, repaired);
  gather_corners(result.corner_texcoords, repaired.corner_origin);
  gather_corners(result.corner_normals, repaired.corner_origin);
  result.mesh = repaired.mesh;
  if (!repaired.fillers.empty()) mark_fillers(result, all_fillers(result, repaired));
  return result;
}

}  // namespace sphparam
