#pragma once

#include <string>

#include "sphparam/io/mesh_reader.h"
#include "sphparam/mesh/triangle_mesh.h"

/// Reading from strings, for the tests of this room.
namespace sphparam::tests {

inline sphparam::MeshFile read(const std::string& bytes, const std::string& name = "mesh",
                               const sphparam::ReadOptions& options = {}) {
  return sphparam::read_mesh(bytes, name, options);
}

/// What reading complains about; empty when it does not.
inline std::string complaint(const std::string& bytes, const std::string& name = "mesh",
                             const sphparam::ReadOptions& options = {}) {
  try {
    read(bytes, name, options);
  } catch (const sphparam::ReadError& error) {
    return error.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

inline const std::vector<double>& values_of(const sphparam::Property* property) {
  static const std::vector<double> no_values;
  return property ? property->values : no_values;
}

/// One tetrahedron in each format.
inline const std::string tetrahedron_obj =
    "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
inline const std::string tetrahedron_off =
    "OFF\n4 4 6\n1 1 1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
inline const std::string tetrahedron_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "1 1 1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

}  // namespace sphparam::tests
