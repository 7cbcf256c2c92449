#pragma once

#include <cstdint>
#include <string>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/self_crossings.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How the flat faces of a resampled surface lie in space, of which the proof of its map says
/// nothing: that is of the map.
struct FacesInSpace {
  SelfCrossings crossings;         // of its triangles
  std::int64_t turned_over = 0;    // triangles that look the other way
  std::int64_t faces = 0;          // that cross another or are turned over
  std::int64_t concave_quads = 0;  // a corner of them has a negative Jacobian
  double area_share = 0;           // of `faces`; 0 where there is no area
  std::int64_t source_pairs = 0;   // of faces of the surface itself that cross; counted only where
                                   // the new ones do

  bool all_well() const { return crossings.none() && faces == 0 && concave_quads == 0; }
};

/// Looks for triangles of a mesh on a grid that cross one another in space, or that are turned over
/// against the surface it was made of: whose normal is more than a right angle from that of the
/// source's triangle at the direction of their middle, and from the mean of the triangles about
/// them, weighted by area. A fold that rounding keeps from crossing, as in a wall that lies across
/// all axes, is seen by that alone. Of quads the triangles are those of `made.mesh()`, cut as
/// `triangulate` does; who cuts them otherwise, or computes on quads, looks at the concave ones: at
/// a corner of them the product of both sides points away from that of the diagonals. Fillers are
/// not looked at. `most_looks` as in SelfCrossingOptions.
///
/// Requires: polygons of `made`, where it has them, of three or four corners, as grids have.
///
/// Ensures: the same for any number of threads. Throws: Cancelled. Cost: about 2 µs a triangle.
FacesInSpace faces_in_space(const MappedMesh& source, const MappedMesh& made,
                            const SelfCrossingOptions& options = {});

/// A line for people, with what helps; empty where all is well.
std::string warning_of(const FacesInSpace& found, const MappedMesh& source, const MappedMesh& made);

}  // namespace sphparam
