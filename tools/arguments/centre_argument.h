#pragma once

#include <optional>
#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::cli {

/// What --centre says: a point, or that of the mesh which is yet to be read.
struct CentreArgument {
  std::optional<Vector3> point = {};
  bool is_centroid = false;

  bool is_given() const { return point || is_centroid; }
  /// Of what a closed mesh encloses, where that is asked for.
  std::optional<Vector3> of(const TriangleMesh& mesh) const;
};

/// How it is typed: "X,Y,Z|centroid"; and what is said of all else.
extern const char centre_pattern[], wanted_centre[];

/// Returns false for what is neither three numbers nor "centroid".
bool read_centre(const std::string& text, CentreArgument& centre);

}  // namespace sphparam::cli
