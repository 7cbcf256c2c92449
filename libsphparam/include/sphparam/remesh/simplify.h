#pragma once

#include <span>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

struct SimplifyOptions {
  int threads = 0;  // of the proofs; 0: all cores
  Progress progress = {};
};

/// Coarser meshes of a mesh on its own sphere, one a number of triangles that it may have: edges
/// are collapsed, those first that change the surface and where an image lies on it least. Vertices
/// are some of the mesh's, with their points on the sphere, their numbers and colours, so that an
/// image lies at them as it does on the mesh; comments, name and provenance stay, normals, texture
/// coordinates and numbers of faces do not. Fillers stay fillers, and their rims where they are,
/// until a hole has three edges, which may close. Vertices at the poles stay.
///
/// No collapse folds a triangle of the map, by exact signs, nor, as long as others are left, turns
/// one over in space or makes a needle of it; a surface may yet cross itself (`faces_in_space`).
/// Each is nested in the one before. Where no edge can go any more there are more triangles than
/// wanted; what is no coarser than the one before is left out, and all after it, but for numbers
/// that are not below what the mesh has, which are passed over.
///
/// Source: quadrics of Garland and Heckbert, "Simplifying surfaces with color and texture using
/// quadric error metrics", 1998, of places and points on the sphere; our own are the exact signs.
/// Requires: numbers that fall. Ensures: every map is certified; the same for any number of
/// threads. Throws: std::invalid_argument where they do not fall or are below 4; Cancelled. Cost:
/// O(#F log #F), one thread.
std::vector<MappedMesh> simplified_meshes(const MappedMesh& source, std::span<const long> triangles,
                                          const SimplifyOptions& options = {});

/// A quarter of the triangles for each level of the level before, `count` times, down to the 20 of
/// an icosahedron; fewer where that is reached.
std::vector<long> quarters(long triangles, int count);

}  // namespace sphparam
