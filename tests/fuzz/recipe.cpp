#include "recipe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

// A flip swaps the edge between face f's corners 0 and 1 for the other diagonal of its two faces,
// unless that edge is there already: then the result would be no simplicial sphere.

namespace sphparam::tests {
namespace {

using Corners = std::array<int, 3>;

void split(std::vector<Corners>& faces, std::size_t f, int vertex) {
  const auto [a, b, c] = faces[f];
  faces[f] = {a, b, vertex};
  faces.push_back({b, c, vertex});
  faces.push_back({c, a, vertex});
}

bool has_edge(const std::vector<Corners>& faces, int a, int b) {
  return std::any_of(faces.begin(), faces.end(), [=](const Corners& face) {
    return std::count(face.begin(), face.end(), a) + std::count(face.begin(), face.end(), b) == 2;
  });
}

void flip(std::vector<Corners>& faces, std::size_t f, unsigned corner) {
  std::rotate(faces[f].begin(), faces[f].begin() + corner, faces[f].end());
  const auto [a, b, c] = faces[f];
  for (Corners& other : faces) {
    for (int turn = 0; turn < 3; ++turn) {
      std::rotate(other.begin(), other.begin() + 1, other.end());
      const int d = other[2];
      if (other[0] != b || other[1] != a) continue;
      if (has_edge(faces, c, d)) return;
      other = {d, c, a};
      faces[f] = {c, d, b};
      return;
    }
  }
}

}  // namespace

unsigned Recipe::byte() {
  if (bytes_.empty()) return 0;
  const unsigned value = bytes_.front();
  bytes_ = bytes_.subspan(1);
  return value;
}

double Recipe::coordinate(unsigned style) {
  const double value = static_cast<double>(byte()) - 128;
  switch (style) {
    case 0:
      return std::round(value / 48);  // many coincide, many triangles are flat
    case 1:
      return value;
    case 2:
      return std::ldexp(value, static_cast<int>(byte()) * 8 - 1070);
    default:
      return 1e9 + value * 1e-3;
  }
}

TriangleMesh Recipe::sphere_mesh() {
  std::vector<Corners> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  int vertices = 4;
  const unsigned style = byte() % 4;
  for (unsigned steps = byte() % 192; steps > 0; --steps) {
    const unsigned step = byte();
    const std::size_t face = (step / 4 * 5 + byte()) % faces.size();
    if (step % 4 == 3 && vertices < 67)
      split(faces, face, vertices++);
    else
      flip(faces, face, step % 4 % 3);
  }
  TriangleMesh mesh{Points(vertices, 3), Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(static_cast<Eigen::Index>(f), k) = faces[f][k];
  mesh.positions = places(vertices, style);
  return mesh;
}

Points Recipe::places(Eigen::Index vertices, unsigned style) {
  Points made(vertices, 3);
  for (Eigen::Index i = 0; i < made.size(); ++i) made.data()[i] = coordinate(style);
  return made;
}

Triangles Recipe::loose_triangles(int vertices) {
  Triangles made(1 + byte() % 48, 3);
  for (Eigen::Index f = 0; f < made.rows(); ++f) {
    const int a = static_cast<int>(byte()) % vertices;
    const int b = (a + 1 + static_cast<int>(byte()) % (vertices - 1)) % vertices;
    int c = static_cast<int>(byte()) % vertices;
    while (c == a || c == b) c = (c + 1) % vertices;
    made.row(f) << a, b, c;
  }
  return made;
}

void Recipe::hurt(TriangleMesh& mesh) {
  for (unsigned times = byte() % 8; times > 0; --times) {
    const Eigen::Index f = byte() % mesh.face_count();
    const unsigned how = byte();
    const int other = static_cast<int>(how / 4) % static_cast<int>(mesh.vertex_count());
    if (how % 4 == 0) std::swap(mesh.triangles(f, 0), mesh.triangles(f, 1));
    if (how % 4 == 1 && (mesh.triangles.row(f).array() != other).all())
      mesh.triangles(f, 2) = other;
    if (how % 4 < 2 || mesh.face_count() == 1) continue;
    mesh.triangles.row(f) = mesh.triangles.row(mesh.face_count() - 1).eval();
    mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  }
}

TriangleMesh Recipe::soup() {
  const unsigned what = byte();
  if (what % 2 == 0) {
    TriangleMesh mesh = sphere_mesh();
    hurt(mesh);
    return mesh;
  }
  const int vertices = 3 + static_cast<int>(what / 2) % 14;
  Triangles triangles = loose_triangles(vertices);
  return {places(vertices, byte() % 4), std::move(triangles)};
}

}  // namespace sphparam::tests
