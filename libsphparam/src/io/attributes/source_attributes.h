#pragma once

#include <optional>

#include "io/attributes/appearance.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// #V×3 colours of the vertices in linear light, which a mesh has in sRGB; nothing where there
/// are none.
std::optional<Points> linear_colours(const MeshFile& file);

/// What the corners of a mesh are coloured with: by its vertices, or corner by corner where the
/// copies of a vertex had several colours.
struct CornerLight {
  RowTable<double, 4> rows;  // linear red, green, blue, and alpha, 1 where none is said
  bool of_corners = false;

  Eigen::Index row(const Triangles& triangles, Face f, int k) const {
    return of_corners ? Eigen::Index{3} * f + k : triangles(f, k);
  }
  bool has_alpha() const { return rows.rows() > 0 && rows.col(3).minCoeff() < 1; }
};

/// Nothing where the vertices have no colours.
std::optional<CornerLight> corner_light(const MeshFile& file);

}  // namespace sphparam
