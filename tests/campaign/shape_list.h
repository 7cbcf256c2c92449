#pragma once

#include <algorithm>
#include <istream>
#include <limits>
#include <ostream>
#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::campaign {

/// A shape of a list that every build maps, on whatever machine: numbers are text, and read back to
/// the bit.
struct ListedShape {
  std::string name;  // without blanks
  TriangleMesh mesh;
};

inline void write_shape(std::ostream& out, const ListedShape& shape) {
  const TriangleMesh& mesh = shape.mesh;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << shape.name << ' ' << mesh.vertex_count() << ' ' << mesh.face_count() << '\n';
  for (const double x : mesh.positions.reshaped<Eigen::RowMajor>()) out << x << '\n';
  for (const int v : mesh.triangles.reshaped<Eigen::RowMajor>()) out << v << '\n';
}

/// False: there are no more.
inline bool read_shape(std::istream& in, ListedShape& shape) {
  Eigen::Index vertices = 0, faces = 0;
  if (!(in >> shape.name >> vertices >> faces)) return false;
  shape.mesh.positions.resize(vertices, 3);
  shape.mesh.triangles.resize(faces, 3);
  for (double& x : shape.mesh.positions.reshaped<Eigen::RowMajor>()) in >> x;
  for (int& v : shape.mesh.triangles.reshaped<Eigen::RowMajor>()) in >> v;
  return bool(in);
}

}  // namespace sphparam::campaign
