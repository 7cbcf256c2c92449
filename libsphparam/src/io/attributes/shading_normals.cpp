#include "io/attributes/shading_normals.h"

#include <cmath>
#include <optional>

#include "mesh/vertex_normals.h"
#include "sphparam/io/fillers.h"

// A vertex whose own normal is missing, zero or not finite takes that of its faces.

namespace sphparam {
namespace {

std::optional<Points> own_normals(const MeshFile& file) {
  if (file.corner_normals) {
    Points sums = Points::Zero(file.mesh.vertex_count(), 3);
    for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f) {
      for (int k = 0; k < 3; ++k)
        sums.row(file.mesh.triangles(f, k)) += file.corner_normals->row(3 * f + k);
    }
    return sums;
  }
  Points normals(file.mesh.vertex_count(), 3);
  int axis = 0;
  for (const char* name : {"nx", "ny", "nz"}) {
    const Property* property = file.find_vertex_property(name);
    if (!property) return std::nullopt;
    normals.col(axis++) = Eigen::Map<const VectorX>(property->values.data(), normals.rows());
  }
  return normals;
}

/// Of the faces about a vertex, those that are surface; of all where none is.
Points normals_of_faces(const MeshFile& file) {
  const FillerMarks fillers = fillers_of(file);
  Points normals = vertex_normals(file.mesh);
  if (fillers.empty()) return normals;
  const TriangleMesh surface = surface_of(file.mesh, fillers);
  const Points of_surface = vertex_normals(surface);
  for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
    const Vertex v = surface.triangles.data()[i];
    normals.row(v) = of_surface.row(v);
  }
  return normals;
}

}  // namespace

Points shading_normals(const MeshFile& file) {
  const std::optional<Points> own = own_normals(file);
  Points normals = normals_of_faces(file);
  if (!own) return normals;
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = own->row(v).stableNorm();
    if (length > 0 && std::isfinite(length)) normals.row(v) = own->row(v) / length;
  }
  return normals;
}

std::optional<CornerNormals> corner_shading_normals(const MeshFile& file,
                                                    const Points& of_vertices) {
  if (!file.corner_normals) return std::nullopt;
  CornerNormals corners = *file.corner_normals;
  for (Eigen::Index corner = 0; corner < corners.rows(); ++corner) {
    const double length = corners.row(corner).stableNorm();
    if (length > 0 && std::isfinite(length)) {
      corners.row(corner) /= length;
    } else {
      corners.row(corner) = of_vertices.row(file.mesh.triangles.data()[corner]);
    }
  }
  return corners;
}

}  // namespace sphparam
