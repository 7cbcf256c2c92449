#pragma once

#include <optional>
#include <vector>

#include "correspondence/coarse_to_fine.h"
#include "correspondence/target_surface.h"
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

/// Whether half of the vertices are within a tenth of that diagonal of the other mesh: it is about
/// the same place.
bool is_there(const NearPlaces& near, double diagonal);

/// Trusted vertices as far from one another as so many can be, none of which is among the far ones:
/// the first is farthest from the middle of the mesh, each next one from all before.
std::vector<Vertex> spread_anchors(const TriangleMesh& mesh, const NearPlaces& near, int most);

/// The map of least distortion that a few such anchors lead to, held at their places to begin with
/// and then let go; nothing where none is found. `options`: of which the landmarks are replaced.
/// Ensures: the same bits for any number of threads. Cost: that of `CoarseToFine`.
std::optional<SphereMap> anchored_map(const MappedMesh& mesh, const TargetSurface& target,
                                      const NearPlaces& near, ComposedOptions options);

}  // namespace sphparam
