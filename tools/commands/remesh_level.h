#pragma once

#include <optional>

#include "arguments/remesh_arguments.h"
#include "remesh/remesh.h"
#include "remesh/subdivision_fit.h"

namespace sphparam::cli {

/// A mesh on a grid, and the surface fitted where one is wanted: its control mesh is the mesh.
struct RemeshLevel {
  RemeshArguments arguments;  // its own
  Remeshed mesh;
  std::optional<SubdivisionFit> fit = {};
  double rms = 0, max = 0;  // from the source, both ways; of the limit surface where one is fitted
};

/// What a level shows and is measured by: of its limit surface, where one is fitted, a fine mesh;
/// else its triangles.
TriangleMesh shown_mesh(const RemeshLevel& level);

}  // namespace sphparam::cli
