#pragma once

#include <vector>

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Where the vertices of a mesh are nearest to another one, which has a map.
struct NearPlaces {
  Points directions;          // of the other's map there; unit
  std::vector<double> away;   // the distances
  std::vector<char> trusted;  // it faces the same way there
};

/// Ensures: the same bits for any number of threads. Cost: some µs a vertex.
NearPlaces near_places(const MappedMesh& mesh, const MappedMesh& other, int threads);

/// Trusted vertices as far from one another as so many can be, none of which is among the far ones:
/// the first is farthest from the middle of the mesh, each next one from all before.
std::vector<Vertex> spread_anchors(const TriangleMesh& mesh, const NearPlaces& near, int most);

}  // namespace sphparam
