#include "support/test_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace sphparam::tests {
namespace {

using Face3 = std::array<int, 3>;

TriangleMesh make_mesh(const std::vector<Vector3>& points, const std::vector<Face3>& faces) {
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (size_t i = 0; i < points.size(); ++i) {
    mesh.positions.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    mesh.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  }
  return mesh;
}

/// Connectivity of rings of `around` vertices between two end vertices: 0 is one end, then ring by
/// ring, then the other end. `up`: the first end is the one that rings run counter-clockwise about.
std::vector<Face3> ring_faces(int rings, int around) {
  const auto at = [&](int ring, int i) { return 1 + ring * around + i % around; };
  std::vector<Face3> faces;
  const int last = 1 + rings * around;
  for (int i = 0; i < around; ++i) {
    faces.push_back({0, at(0, i), at(0, i + 1)});
    for (int r = 0; r + 1 < rings; ++r) {
      faces.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
      faces.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
    }
    faces.push_back({last, at(rings - 1, i + 1), at(rings - 1, i)});
  }
  return faces;
}

}  // namespace

TriangleMesh tetrahedron() {
  return make_mesh({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

TriangleMesh octahedron() {
  return make_mesh(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  std::vector<Vector3> points{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                              {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                              {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  for (Vector3& point : points) point.normalize();
  return make_mesh(
      points, {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

TriangleMesh icosphere(int level) {
  TriangleMesh mesh = icosahedron();
  for (int l = 0; l < level; ++l) {
    std::vector<Vector3> points;
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
      points.emplace_back(mesh.positions.row(v));
    std::map<std::pair<int, int>, int> middle;
    const auto midpoint = [&](int a, int b) {
      const auto [place, fresh] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(points.size()));
      if (fresh) {
        points.push_back(
            (points[static_cast<size_t>(a)] + points[static_cast<size_t>(b)]).normalized());
      }
      return place->second;
    };
    std::vector<Face3> faces;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
      const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
      const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh = make_mesh(points, faces);
  }
  return mesh;
}

TriangleMesh uv_sphere(int meridians, int rings) {
  std::vector<Vector3> points{{0, 0, 1}};
  for (int r = 0; r < rings; ++r) {
    const double phi = std::numbers::pi * (r + 1) / (rings + 1);
    for (int i = 0; i < meridians; ++i) {
      const double theta = 2 * std::numbers::pi * i / meridians;
      points.emplace_back(std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi),
                          std::cos(phi));
    }
  }
  points.emplace_back(0, 0, -1);
  return make_mesh(points, ring_faces(rings, meridians));
}

TriangleMesh tube(int rings, int around) {
  std::vector<Vector3> points{{0, 0, 0.5 * rings}};
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < around; ++i) {
      const double theta = 2 * std::numbers::pi * i / around;
      points.emplace_back(std::cos(theta), std::sin(theta), 0.5 * (rings - 1) - r);
    }
  }
  points.emplace_back(0, 0, -0.5 * rings);
  return make_mesh(points, ring_faces(rings, around));
}

TriangleMesh random_sphere_mesh(int vertices, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](size_t n) { return static_cast<size_t>(random() % n); };
  std::vector<Face3> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (int v = 4; v < vertices; ++v) {
    Face3& face = faces[below(faces.size())];
    const auto [a, b, c] = face;
    face = {a, b, v};
    faces.push_back({b, c, v});
    faces.push_back({c, a, v});
  }
  // Flips: the edge a-b of faces (a, b, c) and (b, a, d) becomes c-d, unless c-d is there already.
  std::map<std::pair<int, int>, size_t> face_of;  // directed edge → face
  const auto enter = [&](size_t f) {
    for (size_t k = 0; k < 3; ++k) face_of[{faces[f][k], faces[f][(k + 1) % 3]}] = f;
  };
  for (size_t f = 0; f < faces.size(); ++f) enter(f);
  for (int i = 0; i < 3 * vertices; ++i) {
    const size_t f = below(faces.size()), k = below(3);
    const int a = faces[f][k], b = faces[f][(k + 1) % 3], c = faces[f][(k + 2) % 3];
    const size_t g = face_of.at({b, a});
    const int d = faces[g][0] + faces[g][1] + faces[g][2] - a - b;
    if (c == d || face_of.contains({c, d})) continue;
    face_of.erase({a, b});
    face_of.erase({b, a});
    faces[f] = {c, a, d};
    faces[g] = {d, b, c};
    enter(f);
    enter(g);
  }
  std::vector<Vector3> points;
  const auto uniform = [&] {
    return 2 * static_cast<double>(random()) / static_cast<double>(random.max()) - 1;
  };
  for (int v = 0; v < vertices; ++v) {
    Vector3 point;
    do {
      point = Vector3(uniform(), uniform(), uniform());
    } while (point.squaredNorm() > 1 || point.squaredNorm() < 0.01);
    points.push_back(point.normalized() * (1 + 0.1 * uniform()));
  }
  return make_mesh(points, faces);
}

TriangleMesh relabelled(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  const auto shuffled = [&](Eigen::Index count) {
    std::vector<int> order(static_cast<size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
  };
  const std::vector<int> name = shuffled(mesh.vertex_count()), place = shuffled(mesh.face_count());
  TriangleMesh result = mesh;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    result.positions.row(name[static_cast<size_t>(v)]) = mesh.positions.row(v);
  }
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const int turn = static_cast<int>(random() % 3);
    for (int k = 0; k < 3; ++k) {
      result.triangles(place[static_cast<size_t>(f)], k) =
          name[static_cast<size_t>(mesh.triangles(f, (k + turn) % 3))];
    }
  }
  return result;
}

TriangleMesh gathered_sphere() {
  TriangleMesh mesh = icosphere(5);
  const double cap = -0.5;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions(v, 2) > cap) mesh.positions.row(v) << 0, 0, 1;
  }
  return mesh;
}

Points wound_rays(int meridians, int rings, int turns) {
  Points rays = uv_sphere(meridians, rings).positions;
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < meridians; ++i) {
      const double phi = std::numbers::pi * (r + 1) / (rings + 1);
      const double theta = 2 * std::numbers::pi * i * turns / meridians;
      rays.row(1 + r * meridians + i) << std::cos(theta) * std::sin(phi),
          std::sin(theta) * std::sin(phi), std::cos(phi);
    }
  }
  return rays;
}

}  // namespace sphparam::tests
