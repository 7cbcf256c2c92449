#pragma once

#include <utility>

#include "sphparam/io/mapped_mesh.h"

namespace sphparam::tests {

/// A mesh with a map that is at hand, certified.
inline MappedMesh mapped(MeshFile file, SphereMap map) {
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

inline MappedMesh mapped(const TriangleMesh& mesh, SphereMap map) {
  MeshFile file;
  file.mesh = mesh;
  return mapped(std::move(file), std::move(map));
}

}  // namespace sphparam::tests
