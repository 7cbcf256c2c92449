#include "io/repair/mesh_part.h"

#include <numeric>
#include <optional>
#include <utility>

#include "sphparam/io/file_numbers.h"

// Every table is gathered by the numbers of what stays.

namespace sphparam {

namespace {

std::vector<Vertex> used_vertices(const MeshFile& file, const std::vector<Face>& faces) {
  std::vector<char> used(static_cast<std::size_t>(file.mesh.vertex_count()), 0);
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) used[file.mesh.triangles(f, k)] = 1;
  }
  std::vector<Vertex> vertices;
  for (Vertex v = 0; v < static_cast<Vertex>(used.size()); ++v) {
    if (used[v]) vertices.push_back(v);
  }
  return vertices;
}

void gather(std::vector<Property>& properties, const std::vector<int>& kept) {
  for (Property& property : properties) {
    std::vector<double> values;
    values.reserve(kept.size());
    for (const int i : kept) values.push_back(property.values[i]);
    property.values = std::move(values);
  }
}

template <class Table>
void gather_corners(std::optional<Table>& table, const std::vector<Face>& faces) {
  if (!table) return;
  Table gathered(static_cast<Eigen::Index>(3 * faces.size()), table->cols());
  Eigen::Index row = 0;
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) gathered.row(row++) = table->row(3 * f + k);
  }
  table = std::move(gathered);
}

TriangleMesh gathered(const TriangleMesh& mesh, const std::vector<Face>& faces,
                      const std::vector<Vertex>& vertices) {
  std::vector<Vertex> name(static_cast<std::size_t>(mesh.vertex_count()), -1);
  TriangleMesh result{Points(std::ssize(vertices), 3), Triangles(std::ssize(faces), 3)};
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    result.positions.row(i) = mesh.positions.row(vertices[i]);
    name[vertices[i]] = i;
  }
  for (int i = 0; i < static_cast<int>(faces.size()); ++i) {
    for (int k = 0; k < 3; ++k) result.triangles(i, k) = name[mesh.triangles(faces[i], k)];
  }
  return result;
}

Property numbers(const std::string& name, Eigen::Index count) {
  Property property{name, ScalarType::Int32, std::vector<double>(static_cast<std::size_t>(count))};
  std::iota(property.values.begin(), property.values.end(), 0.0);
  return property;
}

}  // namespace

MeshFile part_of(const MeshFile& file, const std::vector<Face>& faces) {
  const std::vector<Vertex> vertices = used_vertices(file, faces);
  MeshFile part = file;
  part.mesh = gathered(file.mesh, faces, vertices);
  gather(part.vertex_properties, vertices);
  gather(part.face_properties, faces);
  gather_corners(part.corner_texcoords, faces);
  gather_corners(part.corner_normals, faces);
  gather_corners(part.second_texcoords, faces);
  gather_corners(part.corner_tangents, faces);
  return part;
}

MeshFile with_numbers(MeshFile file) {
  if (!file.find_vertex_property("source_vertex")) {
    file.set_vertex_property(numbers("source_vertex", file.mesh.vertex_count()));
    keep_vertices_of_file(file, file.mesh.vertex_count());
  }
  if (!file.find_face_property("source_face")) {
    file.set_face_property(numbers("source_face", file.mesh.face_count()));
  }
  return file;
}

}  // namespace sphparam
