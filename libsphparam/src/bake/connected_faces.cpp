#include "bake/connected_faces.h"

#include <map>
#include <vector>

#include "io/polygons/welding.h"
#include "mesh/union_find.h"

namespace sphparam {

std::vector<int> parts_of_faces(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  const Triangles triangles = weld_exact(file).file.mesh.triangles;
  UnionFind places(static_cast<size_t>(mesh.vertex_count()));
  for (const auto& f : triangles.rowwise())
    for (int k = 1; k < 3; ++k) places.unite(f[0], f[k]);
  std::map<int, int> numbers;
  std::vector<int> parts;
  for (const auto& f : triangles.rowwise())
    parts.push_back(
        numbers.try_emplace(places.find(f[0]), static_cast<int>(numbers.size())).first->second);
  return parts;
}

}  // namespace sphparam
