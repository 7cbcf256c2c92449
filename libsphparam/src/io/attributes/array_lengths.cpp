#include "io/attributes/array_lengths.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sphparam {
namespace {

void require_count(const std::string& what, Eigen::Index found, Eigen::Index wanted,
                   const char* elements) {
  if (found == wanted) return;
  throw std::invalid_argument(what + " has " + std::to_string(found) + " values for " +
                              std::to_string(wanted) + " " + elements);
}

void require_values(const char* kind, const std::vector<Property>& properties, Eigen::Index count,
                    const char* elements) {
  for (const Property& property : properties)
    require_count(std::string(kind) + " property '" + property.name + "'",
                  std::ssize(property.values), count, elements);
}

template <class Table>
void require_corners(const char* what, const std::optional<Table>& table, Eigen::Index faces) {
  if (table) require_count(what, table->rows(), 3 * faces, "corners");
}

/// Whether something is said of materials.
bool require_of_each(const char* what, Eigen::Index found, const MeshFile& file) {
  if (found > 0) require_count(what, found, std::ssize(file.materials), "materials");
  return found > 0;
}

/// −1 is none; NaN is no number of one.
void require_materials_there(const MeshFile& file) {
  const Property* const material = file.find_face_property("material");
  if (!material) return;
  const auto count = static_cast<double>(file.materials.size());
  for (const double id : material->values)
    if (!(id >= -1 && id < count))
      throw std::invalid_argument("face property 'material' names one that is not there");
}

}  // namespace

void require_array_lengths(const MeshFile& file) {
  const Eigen::Index faces = file.mesh.face_count();
  require_values("vertex", file.vertex_properties, file.mesh.vertex_count(), "vertices");
  require_values("face", file.face_properties, faces, "faces");
  require_corners("corner_texcoords", file.corner_texcoords, faces);
  require_corners("corner_normals", file.corner_normals, faces);
  require_corners("second_texcoords", file.second_texcoords, faces);
  require_corners("corner_tangents", file.corner_tangents, faces);
  const bool coloured = require_of_each("base_colours", std::ssize(file.base_colours), file);
  const bool described = require_of_each("channels", std::ssize(file.channels), file);
  if (coloured || described) require_materials_there(file);
}

void require_places(const TriangleMesh& mesh) {
  const Triangles& triangles = mesh.triangles;
  if (triangles.size() > 0 &&
      (triangles.minCoeff() < 0 || triangles.maxCoeff() >= mesh.vertex_count()))
    throw std::invalid_argument("a triangle names a vertex that is not there");
  if (!mesh.positions.allFinite())
    throw std::invalid_argument("a coordinate is not a finite number");
}

void require_polygons_of(const TriangleMesh& mesh, const Polygons& polygons) {
  const auto fail = [](const char* what) {
    throw std::invalid_argument(std::string("polygons: ") + what);
  };
  const std::vector<int>& starts = polygons.starts;
  if (starts.empty() || starts.front() != 0 || starts.back() != std::ssize(polygons.corners))
    fail("they do not begin and end with their corners");
  std::int64_t triangles = 0;
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    if (polygons.degree(p) < 3) fail("one has fewer than three corners");
    triangles += polygons.degree(p) - 2;
  }
  const auto is_there = [&](int v) { return v >= 0 && v < mesh.vertex_count(); };
  if (!std::ranges::all_of(polygons.corners, is_there))
    fail("one names a vertex that is not there");
  if (triangles != mesh.face_count()) fail("they are not cut into the triangles of the mesh");
}

}  // namespace sphparam
