#include "measure/border.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace sphparam {

namespace {

/// Of each vertex, one that stands for all in its place.
std::vector<Vertex> places_of(const TriangleMesh& mesh) {
  std::vector<Vertex> order(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](Vertex v) {
    const Vector3 x = mesh.position(v);
    return std::array{x[0], x[1], x[2]};
  };
  std::ranges::sort(order, [&](Vertex a, Vertex b) {
    const auto one = place(a), other = place(b);
    return one != other ? one < other : a < b;
  });
  std::vector<Vertex> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    result[static_cast<std::size_t>(order[i])] =
        same ? result[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return result;
}

struct Edge {
  Vertex low, high;
  Face face;
  int opposite;  // corner of the face

  auto ends() const { return std::array{low, high}; }
};

constexpr unsigned edge_bit(int k) { return 1U << k; }
constexpr unsigned corner_bit(int k) { return 8U << k; }

}  // namespace

Border::Border(const TriangleMesh& mesh) : of_face_(static_cast<std::size_t>(mesh.face_count())) {
  const std::vector<Vertex> places = places_of(mesh);
  const auto corner = [&](Face f, int k) {
    return places[static_cast<std::size_t>(mesh.triangles(f, k % 3))];
  };
  std::vector<Edge> edges;
  edges.reserve(3 * of_face_.size());
  for (Face f = 0; f < mesh.face_count(); ++f) {
    if (corner(f, 0) == corner(f, 1) || corner(f, 1) == corner(f, 2) ||
        corner(f, 2) == corner(f, 0))
      continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({corner(f, k + 1), corner(f, k + 2)});
      edges.push_back({low, high, f, k});
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  std::vector<char> ends(places.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto same = [&](std::size_t j) { return edges[j].ends() == edges[i].ends(); };
    if ((i > 0 && same(i - 1)) || (i + 1 < edges.size() && same(i + 1))) continue;
    of_face_[static_cast<std::size_t>(edges[i].face)] |= edge_bit(edges[i].opposite);
    for (const Vertex v : edges[i].ends()) ends[static_cast<std::size_t>(v)] = 1;
  }
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      if (ends[static_cast<std::size_t>(corner(f, k))])
        of_face_[static_cast<std::size_t>(f)] |= corner_bit(k);
}

bool Border::holds(const SurfacePoint& point) const {
  const unsigned marks = of_face_[static_cast<std::size_t>(point.face)];
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const bool at_corner = point.barycentric[next] == 0 && point.barycentric[last] == 0;
    if (at_corner && (marks & corner_bit(k))) return true;
    if (point.barycentric[k] == 0 && (marks & edge_bit(k))) return true;
  }
  return false;
}

}  // namespace sphparam
