#include "mesh_io/connectivity.h"

#include <algorithm>
#include <array>

namespace sphparam::tools {

namespace {

/// A triangle with its smallest vertex first, so that rotations compare equal and mirrors do not.
std::array<int, 3> canonical(const Triangles& triangles, Face f) {
  std::array<int, 3> t = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::string words(const std::array<int, 3>& t) {
  return std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]);
}

}  // namespace

std::string connectivity_difference(const TriangleMesh& source, const TriangleMesh& sphere) {
  const auto count = [](const char* what, Eigen::Index a, Eigen::Index b) {
    return "the source has " + std::to_string(a) + " " + what + ", the sphere " + std::to_string(b);
  };
  if (source.vertex_count() != sphere.vertex_count()) {
    return count("vertices", source.vertex_count(), sphere.vertex_count());
  }
  if (source.face_count() != sphere.face_count()) {
    return count("triangles", source.face_count(), sphere.face_count());
  }
  for (Face f = 0; f < source.face_count(); ++f) {
    const auto a = canonical(source.triangles, f), b = canonical(sphere.triangles, f);
    if (a != b) {
      return "triangle " + std::to_string(f) + " has vertices " + words(a) + " in the source, " +
             words(b) + " in the sphere";
    }
  }
  return "";
}

}  // namespace sphparam::tools
