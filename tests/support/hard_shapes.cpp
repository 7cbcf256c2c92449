#include "support/hard_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

namespace sphparam::tests {
namespace {

size_t at_index(int i) { return static_cast<size_t>(i); }

/// Replaces the star of v by a prism over its link: `rings` copies of it, v at the tip.
void grow_bristle(TriangleMesh& mesh, Vertex v, double aspect, int rings) {
  const Topology topology(mesh);
  std::vector<Vertex> link;
  Vector3 foot = Vector3::Zero();
  topology.for_each_outgoing(v, [&](Halfedge h) {
    link.push_back(topology.target(h));
    foot += mesh.position(link.back());
  });
  const int k = static_cast<int>(link.size());
  foot /= k;
  double radius = 0;
  for (const Vertex w : link) radius += (mesh.position(w) - foot).norm() / k;
  const Vector3 step = foot.normalized() * (2 * radius * aspect / rings);
  const auto first = static_cast<Vertex>(mesh.vertex_count());
  const auto corner = [&](int ring, int i) {
    return ring < 0 ? link[at_index(i % k)] : first + ring * k + i % k;
  };
  mesh.positions.conservativeResize(mesh.vertex_count() + rings * k, 3);
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < k; ++i) {
      mesh.positions.row(corner(r, i)) = mesh.position(link[at_index(i)]) + (r + 1) * step;
    }
  }
  mesh.positions.row(v) = foot + rings * step;
  Eigen::Index row = mesh.face_count();
  mesh.triangles.conservativeResize(row + 2 * rings * k, 3);
  int i = 0;
  topology.for_each_outgoing(v, [&](Halfedge h) {
    mesh.triangles.row(Topology::face(h)) << v, corner(rings - 1, i), corner(rings - 1, i + 1);
    for (int r = 0; r < rings; ++r) {
      mesh.triangles.row(row++) << corner(r - 1, i), corner(r - 1, i + 1), corner(r, i);
      mesh.triangles.row(row++) << corner(r - 1, i + 1), corner(r, i + 1), corner(r, i);
    }
    ++i;
  });
}

}  // namespace

TriangleMesh with_slivers(const TriangleMesh& mesh, double share, double at, unsigned seed,
                          const std::function<bool(const Vector3&)>& inside) {
  const Topology topology(mesh);
  std::vector<Halfedge> edges;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    if (topology.origin(h) < topology.target(h)) edges.push_back(h);
  }
  std::mt19937 random(seed);
  for (size_t i = edges.size(); i > 1; --i) std::swap(edges[i - 1], edges[random() % i]);
  const auto wanted = static_cast<size_t>(share * static_cast<double>(edges.size()));
  std::vector<char> taken(at_index(topology.face_count()), 0);
  std::vector<Halfedge> split;
  for (const Halfedge h : edges) {
    if (split.size() == wanted) break;
    char& left = taken[at_index(Topology::face(h))];
    char& right = taken[at_index(Topology::face(topology.twin(h)))];
    if (left || right) continue;
    if (inside &&
        !(inside(mesh.position(topology.origin(h))) && inside(mesh.position(topology.target(h))))) {
      continue;
    }
    left = right = 1;
    split.push_back(h);
  }
  TriangleMesh result = mesh;
  auto middle = static_cast<Vertex>(mesh.vertex_count());
  auto row = static_cast<Face>(mesh.face_count());
  result.positions.conservativeResize(middle + std::ssize(split), 3);
  result.triangles.conservativeResize(row + 2 * std::ssize(split), 3);
  for (const Halfedge h : split) {
    const Vertex a = topology.origin(h), b = topology.target(h);
    result.positions.row(middle) = (1 - at) * mesh.position(a) + at * mesh.position(b);
    for (const Halfedge side : {h, topology.twin(h)}) {
      const Vertex from = topology.origin(side), to = topology.target(side);
      const Vertex apex = topology.apex(side);
      result.triangles.row(Topology::face(side)) << from, middle, apex;
      result.triangles.row(row++) << middle, to, apex;
    }
    ++middle;
  }
  return result;
}

TriangleMesh body_of_revolution(const std::vector<ProfilePoint>& profile, int around) {
  const int rings = static_cast<int>(profile.size());
  TriangleMesh mesh = uv_sphere(around, rings);  // for its triangles
  for (int r = 0; r < rings; ++r) {
    const auto [z, radius] = profile[at_index(r)];
    for (int i = 0; i < around; ++i) {
      const double theta = 2 * std::numbers::pi * i / around;
      mesh.positions.row(1 + r * around + i) << radius * std::cos(theta), radius * std::sin(theta),
          z;
    }
  }
  mesh.positions.row(0) << 0, 0, profile.front().z + profile.front().radius;
  mesh.positions.row(mesh.vertex_count() - 1) << 0, 0, profile.back().z - profile.back().radius;
  return mesh;
}

TriangleMesh dumbbell(double aspect, double rod_radius, int around) {
  const double edge = 2 * std::numbers::pi / around, half = aspect * rod_radius;
  std::vector<ProfilePoint> top;
  const double end = std::numbers::pi - std::asin(rod_radius);
  const int parallels = around / 2 + 1;
  for (int i = 1; i <= parallels; ++i) {
    const double phi = end * i / parallels;
    top.push_back({half + 1 + std::cos(phi), std::sin(phi)});
  }
  // Rings of the rod get nearer as it narrows, then stay as far apart as its edges are long.
  double z = top.back().z;
  for (double step = edge; z - step > 0;) {
    step = std::max(rod_radius * edge, step / 2);
    z -= step;
    if (z > 0) top.push_back({z, rod_radius});
  }
  std::vector<ProfilePoint> profile = top;
  for (auto point = top.rbegin(); point != top.rend(); ++point) {
    profile.push_back({-point->z, point->radius});
  }
  return body_of_revolution(profile, around);
}

TriangleMesh brush(int ball_level, int count, double aspect, int rings) {
  TriangleMesh mesh = icosphere(ball_level);
  const auto vertices = static_cast<Vertex>(mesh.vertex_count());
  std::vector<char> used(at_index(vertices), 0);
  const Topology ball(mesh);
  for (int i = 0, grown = 0; i < vertices && grown < count; ++i) {
    const auto v = static_cast<Vertex>(1LL * i * 7919 % vertices);
    bool free = !used[at_index(v)];
    ball.for_each_outgoing(v, [&](Halfedge h) { free &= !used[at_index(ball.target(h))]; });
    if (!free) continue;
    used[at_index(v)] = 1;
    ball.for_each_outgoing(v, [&](Halfedge h) { used[at_index(ball.target(h))] = 1; });
    grow_bristle(mesh, v, aspect, rings);
    ++grown;
  }
  return mesh;
}

}  // namespace sphparam::tests
