#pragma once

#include "sphparam/io/fillers.h"
#include "support/mapped.h"

namespace sphparam::tests {

/// A shape on the vertices of a sphere, whose triangles above z = 0.6 there are fillers of a kept
/// hole: vertices that these alone use are `cap` times as far from the centre.
inline MappedMesh capped(TriangleMesh shape, const Points& sphere, double cap) {
  FillerMarks fillers;
  std::vector<char> is_surface(static_cast<size_t>(shape.vertex_count()), 0);
  for (Face f = 0; f < shape.face_count(); ++f) {
    double z = 0;
    for (int k = 0; k < 3; ++k) z += sphere(shape.triangles(f, k), 2) / 3;
    fillers.push_back(z > 0.6);
    if (z > 0.6) continue;
    for (int k = 0; k < 3; ++k) is_surface[static_cast<size_t>(shape.triangles(f, k))] = 1;
  }
  for (Vertex v = 0; v < shape.vertex_count(); ++v)
    if (!is_surface[static_cast<size_t>(v)]) shape.positions.row(v) *= cap;
  MeshFile file;
  file.mesh = std::move(shape);
  mark_fillers(file, fillers);
  return mapped(std::move(file), {sphere});
}

}  // namespace sphparam::tests
