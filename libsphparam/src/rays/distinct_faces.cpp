// Vertices get the number of the first one at their place; triangles are then told apart by three
// numbers.

#include "rays/distinct_faces.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace sphparam {

namespace {

bool has_edge_of_no_length(const TriangleMesh& mesh) {
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vertex a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
      if (mesh.positions.row(a) == mesh.positions.row(b)) return true;
    }
  }
  return false;
}

/// Of each vertex, the first one at its place.
std::vector<Vertex> first_in_place(const TriangleMesh& mesh) {
  const auto place = [&](Vertex v) {
    return std::array{mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)};
  };
  std::vector<Vertex> order(static_cast<size_t>(mesh.vertex_count())), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Vertex a, Vertex b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && place(order[i]) == place(order[i - 1]);
    first[static_cast<size_t>(order[i])] =
        again ? first[static_cast<size_t>(order[i - 1])] : order[i];
  }
  return first;
}

}  // namespace

std::vector<Face> distinct_faces(const TriangleMesh& mesh) {
  std::vector<Face> faces(static_cast<size_t>(mesh.face_count()));
  std::iota(faces.begin(), faces.end(), 0);
  if (!has_edge_of_no_length(mesh)) return faces;
  const std::vector<Vertex> first = first_in_place(mesh);
  const auto places = [&](Face f) {
    std::array<Vertex, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<size_t>(k)] = first[static_cast<size_t>(mesh.triangles(f, k))];
    }
    return corners;
  };
  std::sort(faces.begin(), faces.end(),
            [&](Face a, Face b) { return places(a) != places(b) ? places(a) < places(b) : a < b; });
  const auto same = [&](Face a, Face b) { return places(a) == places(b); };
  faces.erase(std::unique(faces.begin(), faces.end(), same), faces.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace sphparam
