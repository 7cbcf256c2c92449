#pragma once

#include <string>

#include "sphparam/io/mesh_source.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Vertices that lie exactly on others and are apart by their numbers alone, as repair leaves them:
/// the sheets of an edge that was split, the rims of a loop that a handle was cut along.
struct SharedPlaces {
  long vertices = 0;  // whose place an earlier one has, bit for bit
  long edges = 0;     // with more than two faces where all of a place are made one
};
/// Of the used vertices. Cost: O(#V), expected, and a sort of the edges.
SharedPlaces shared_places(const TriangleMesh& mesh);

/// "54 vertices lie exactly on others"; "27 edges with more than two faces then", of whoever makes
/// those of a place one. Requires: there are some.
std::string words_of(const SharedPlaces& shared);
std::string words_when_welded(const SharedPlaces& shared);

/// "54 vertices lie exactly on others …": what a format that keeps no numbers of vertices makes of
/// the mesh as it was mended, and what to type; empty where repairs split nothing, or nothing that
/// is there still.
std::string shared_places_line(const MeshSource& mended);

}  // namespace sphparam
