#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "remesh/sphere_grid.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

enum class SampleMode {
  Point,  // the surface at the direction
  Cell,   // its mean over the cell, where the grid is coarser than the source
};

struct RemeshOptions {
  SampleMode sample = SampleMode::Point;
  /// What to carry besides positions: "all", "color", "normal", "uv", "material", or names of
  /// properties; none: nothing.
  std::vector<std::string> transfer = {"all"};
  int threads = 0;
  Progress progress = {};
};

/// A mesh on a grid. Its map are the directions of the grid.
struct Remeshed {
  MeshFile file;   // quads cut in two, as a reader of the file would
  Polygons faces;  // as they are in the grid
  SphereMap map;
  long averaged = 0;                                // vertices that are means over cells
  double locate_seconds = 0, transfer_seconds = 0;  // of positions
};

/// Resamples a mapped mesh: each vertex of the grid gets the point of the surface that the map
/// takes to its direction, and what the surface has there.
///
/// Floating numbers and colours are interpolated, normals made unit again, whole numbers are labels
/// and never mixed. Texture coordinates and normals of corners come from the side of a seam that
/// the face's middle lies on. Faces have the material and the properties of the source at their
/// middle. With `Cell`, texture coordinates and properties of faces are point samples all the same.
/// Requires: unit rays, certified one-to-one. Ensures: the same bytes for any number of threads; a
/// grid vertex in the direction of a source vertex gets that vertex's values, bit for bit.
/// Throws: std::invalid_argument for a name in `transfer` that the source has not; Cancelled.
Remeshed remesh(const MeshFile& source, const SphereMap& map, SphereGrid grid,
                const RemeshOptions& options = {});

}  // namespace sphparam
