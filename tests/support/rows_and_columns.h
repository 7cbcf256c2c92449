#pragma once

#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// Rows from pole to pole, all of `columns` + 1 vertices, as trigonometry gives them: the rows at
/// the poles and the last column lie on others but for rounding.
inline TriangleMesh rows_and_columns(int rows, int columns) {
  constexpr double pi = 3.141592653589793;
  TriangleMesh mesh{Points(rows * (columns + 1), 3), Triangles(2 * (rows - 1) * columns, 3)};
  for (int i = 0, v = 0; i < rows; ++i)
    for (int j = 0; j <= columns; ++j, ++v) {
      const double phi = pi * i / (rows - 1), theta = 2 * pi * j / columns;
      mesh.positions.row(v) << std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi),
          std::cos(phi);
    }
  Face f = 0;
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Vertex a = i * (columns + 1) + j, b = a + columns + 1;
      mesh.triangles.row(f++) << a, b, b + 1;
      mesh.triangles.row(f++) << a, b + 1, a + 1;
    }
  return mesh;
}

}  // namespace sphparam::tests
