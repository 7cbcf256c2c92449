#include "sphparam/io/connectivity.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sphparam {

namespace {

/// A triangle with its smallest vertex first, so that rotations compare equal and mirrors do not.
std::array<int, 3> canonical(const Triangles& triangles, Face f) {
  std::array<int, 3> t = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The triangles from `first` to before the result are one polygon of the file, or one triangle.
Face end_of_polygon(const MeshFile& file, Face first) {
  const Property* const polygon =
      file.polygons > 0 ? file.find_face_property("source_face") : nullptr;
  Face last = first + 1;
  while (polygon && last < file.mesh.face_count() &&
         polygon->values[last] == polygon->values[first])
    ++last;
  return last;
}

/// The edges around some triangles: those that no other of them has the other way, in order.
std::vector<std::array<int, 2>> outline(const Triangles& triangles, Face first, Face last) {
  std::vector<std::array<int, 2>> edges, around;
  for (Face f = first; f < last; ++f)
    for (int k = 0; k < 3; ++k) edges.push_back({triangles(f, k), triangles(f, (k + 1) % 3)});
  std::sort(edges.begin(), edges.end());
  for (const auto& [a, b] : edges)
    if (!std::binary_search(edges.begin(), edges.end(), std::array{b, a})) around.push_back({a, b});
  return around;
}

bool same_triangles(const MeshFile& source, const MeshFile& sphere, Face first, Face last) {
  for (Face f = first; f < last; ++f)
    if (canonical(source.mesh.triangles, f) != canonical(sphere.mesh.triangles, f)) return false;
  return true;
}

std::string words(const std::array<int, 3>& t) {
  return std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]);
}

}  // namespace

std::string connectivity_difference(const MeshFile& source_file, const MeshFile& sphere_file) {
  const TriangleMesh &source = source_file.mesh, &sphere = sphere_file.mesh;
  const auto count = [](const char* what, Eigen::Index a, Eigen::Index b) {
    return "the source has " + std::to_string(a) + " " + what + ", the sphere " + std::to_string(b);
  };
  if (source.vertex_count() != sphere.vertex_count()) {
    return count("vertices", source.vertex_count(), sphere.vertex_count());
  }
  if (source.face_count() != sphere.face_count()) {
    return count("triangles", source.face_count(), sphere.face_count());
  }
  for (Face f = 0, last = 0; f < source.face_count(); ++f) {
    if (f == last) last = end_of_polygon(sphere_file, f);
    const auto a = canonical(source.triangles, f), b = canonical(sphere.triangles, f);
    if (a == b) continue;
    if (outline(source.triangles, f, last) == outline(sphere.triangles, f, last)) {
      f = last - 1;
    } else {
      return "triangle " + std::to_string(f) + " has vertices " + words(a) + " in the source, " +
             words(b) + " in the sphere";
    }
  }
  return "";
}

long cut_otherwise(const MeshFile& source, const MeshFile& sphere) {
  long count = 0;
  for (Face f = 0, last = 0; f < sphere.mesh.face_count(); f = last) {
    last = end_of_polygon(sphere, f);
    count += !same_triangles(source, sphere, f, last);
  }
  return count;
}

}  // namespace sphparam
