#pragma once

#include <optional>
#include <string>
#include <utility>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What the colours of numbers are over.
struct ColourScale {
  bool diverges = false;  // blue to red about 0 whatever the numbers are
  /// Else as the numbers are. From blue by white to red where it is as far from 0 both ways.
  std::optional<std::pair<double, double>> range = {};
};

/// A mesh file with a number for each vertex, as the property `name` and as colours (red green
/// blue) from 0 to the largest; where some are less than 0, blue to red about 0, as far both ways.
/// Properties of these names are replaced, and textures left out, which would be seen instead.
/// `about`: what the numbers are; where it is given, a comment says so, and what the colours mean.
/// Requires: a finite number a vertex; a range that ascends. Cost: linear.
MeshFile with_coloured_values(MeshFile file, const std::string& name, const VectorX& values,
                              const std::string& about = "", const ColourScale& scale = {});

/// A mesh file whose vertices are coloured by a property of theirs, as pictures of it are
/// (`DrawingOptions::scalar` and `range`), labels by their table; other colours and textures are
/// left out. Adds a comment that says the range. Requires: vertices have it. Cost: linear.
MeshFile with_scalar_colours(MeshFile file, const std::string& name,
                             const std::optional<std::pair<double, double>>& range = {});

}  // namespace sphparam
