// Cube by cube, its six tetrahedra by a table: each has one corner at the origin, then goes along
// the axes in one order. Vertices are numbered point by point, along the edges that leave it
// upwards, so that two layers of points know all that a layer of cubes needs.

#include "wrap/level_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

namespace sphparam {

namespace {

constexpr double least_share = 0.05;  // of an edge, between a vertex and a point of the lattice

/// An edge of a cube: from one of its corners in a direction. Corners are numbered as directions
/// are.
struct CubeEdge {
  int corner, direction;
};
using CubeTriangle = std::array<CubeEdge, 3>;

CubeEdge edge_between(int a, int b) { return {std::min(a, b), a ^ b}; }  // one is within the other

int determinant(const std::array<int, 4>& t) {
  std::array<std::array<int, 3>, 3> m{};
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis)
      m[row][axis] = (t[row + 1] >> axis & 1) - (t[0] >> axis & 1);
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Of a tetrahedron between its corners that are solid and those that are not.
void add_triangles(std::array<int, 4> t, int mask, std::vector<CubeTriangle>& out) {
  const auto middle =
      std::stable_partition(t.begin(), t.end(), [mask](int c) { return mask >> c & 1; });
  const auto inside = middle - t.begin();
  if (inside == 0 || inside == 4) return;
  if (determinant(t) < 0) inside >= 2 ? std::swap(t[0], t[1]) : std::swap(t[2], t[3]);
  const auto edge = [&t](int i, int j) { return edge_between(t[i], t[j]); };
  if (inside == 1) {
    out.push_back({edge(0, 1), edge(0, 2), edge(0, 3)});
  } else if (inside == 3) {
    out.push_back({edge(0, 3), edge(1, 3), edge(2, 3)});
  } else {
    out.push_back({edge(0, 2), edge(0, 3), edge(1, 3)});
    out.push_back({edge(0, 2), edge(1, 3), edge(1, 2)});
  }
}

std::array<std::vector<CubeTriangle>, 256> triangle_table() {
  std::array<std::vector<CubeTriangle>, 256> table;
  for (int mask = 0; mask < 256; ++mask) {
    std::array<int, 3> axes = {1, 2, 4};
    do {
      add_triangles({0, axes[0], axes[0] | axes[1], 7}, mask, table[mask]);
    } while (std::ranges::next_permutation(axes).found);
  }
  return table;
}

class Mesher {
 public:
  Mesher(const Lattice& lattice, const std::vector<float>& field, const Solid& solid)
      : lattice_(lattice), field_(field), solid_(solid) {
    for (int d = 1; d < 8; ++d) stride_[d] = lattice.stride(d);
    for (Layer& layer : layers_) layer.resize(static_cast<size_t>(lattice.stride(4)));
  }

  TriangleMesh mesh() {
    number_vertices(0);
    for (int z = 0; z + 1 < lattice_.points[2]; ++z) {
      if (z + 2 < lattice_.points[2]) number_vertices(z + 1);
      add_layer(z);
    }
    TriangleMesh mesh{Points(static_cast<Eigen::Index>(positions_.size()), 3),
                      Triangles(static_cast<Eigen::Index>(triangles_.size()), 3)};
    for (size_t v = 0; v < positions_.size(); ++v) mesh.positions.row(v) = positions_[v];
    for (size_t f = 0; f < triangles_.size(); ++f)
      mesh.triangles.row(f) << triangles_[f][0], triangles_[f][1], triangles_[f][2];
    return mesh;
  }

 private:
  struct Leaving {
    Vertex first = -1;  // on the edges that leave a point upwards
    int edges = 0;      // which: bit 0 for direction 1
  };
  using Layer = std::vector<Leaving>;

  void number_vertices(int z) {
    Layer& layer = layers_[z & 1];
    for (int y = 0; y + 1 < lattice_.points[1]; ++y) {
      for (int x = 0; x + 1 < lattice_.points[0]; ++x) {
        Leaving& leaving = layer[static_cast<size_t>(lattice_.index(x, y, 0))];
        leaving = {static_cast<Vertex>(positions_.size()), 0};
        const std::int64_t p = lattice_.index(x, y, z);
        for (int d = 1; d < 8; ++d) {
          if (solid_[static_cast<size_t>(p)] == solid_[static_cast<size_t>(p + stride_[d])])
            continue;
          leaving.edges |= 1 << (d - 1);
          positions_.push_back(lattice_.position(x, y, z) + crossing(p, d));
        }
      }
    }
  }

  Vector3 crossing(std::int64_t p, int direction) const {
    const double here = field_[static_cast<size_t>(p)];
    const double there = field_[static_cast<size_t>(p + stride_[direction])];
    const bool inside = solid_[static_cast<size_t>(p)] != 0;
    const bool crosses = inside ? here <= 0 && there > 0 : here > 0 && there <= 0;
    const double share =
        crosses ? std::clamp(here / (here - there), least_share, 1 - least_share) : 0.5;
    return share * lattice_.voxel * Vector3(direction & 1, direction >> 1 & 1, direction >> 2 & 1);
  }

  void add_layer(int z) {
    static const std::array<std::vector<CubeTriangle>, 256> table = triangle_table();
    for (int y = 0; y + 1 < lattice_.points[1]; ++y) {
      for (int x = 0; x + 1 < lattice_.points[0]; ++x) {
        const std::int64_t p = lattice_.index(x, y, z);
        int mask = 0;
        for (int c = 0; c < 8; ++c)
          mask |= solid_[static_cast<size_t>(p + (c ? stride_[c] : 0))] << c;
        for (const CubeTriangle& triangle : table[mask]) add(triangle, x, y, z);
      }
    }
    if (triangles_.size() > std::numeric_limits<int>::max() / 3)
      throw std::length_error("the surface has more triangles than can be numbered");
  }

  void add(const CubeTriangle& triangle, int x, int y, int z) {
    std::array<Vertex, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto [corner, direction] = triangle[k];
      const Leaving& leaving =
          layers_[(z + (corner >> 2)) & 1]
                 [static_cast<size_t>(lattice_.index(x + (corner & 1), y + (corner >> 1 & 1), 0))];
      const auto before = static_cast<unsigned>(leaving.edges & ((1 << (direction - 1)) - 1));
      corners[k] = leaving.first + std::popcount(before);
    }
    triangles_.push_back(corners);
  }

  const Lattice& lattice_;
  const std::vector<float>& field_;
  const Solid& solid_;
  std::array<std::int64_t, 8> stride_{};
  std::array<Layer, 2> layers_;
  std::vector<Vector3> positions_;
  std::vector<std::array<Vertex, 3>> triangles_;
};

}  // namespace

TriangleMesh level_surface(const Lattice& lattice, const std::vector<float>& field,
                           const Solid& solid) {
  return Mesher(lattice, field, solid).mesh();
}

}  // namespace sphparam
