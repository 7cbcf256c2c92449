#include "correspondence/extremities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "correspondence/surface_roads.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/parallel.h"

// Sources spread by farthest points, each with the area nearest to it, stand for the surface's
// points. Vertices then come in the order of their mean distance, the farthest first, each joining
// the parts of its neighbours that came before it: where two parts meet, the maximum of the lesser
// one has its prominence.

namespace sphparam {
namespace {

constexpr int sources = 100;
constexpr double least_prominence = 0.08;  // of √area

size_t at(int i) { return static_cast<size_t>(i); }

/// Mean distance of each vertex from the surface's points, of √area.
Eigen::VectorXd mean_distances(const TriangleMesh& mesh, const Topology& topology,
                               const SurfaceRoads& roads) {
  const Eigen::VectorXd areas = vertex_areas(mesh);
  const int count = std::min(sources, topology.vertex_count());
  std::vector<std::vector<double>> from;
  std::vector<double> least(at(topology.vertex_count()), std::numeric_limits<double>::infinity());
  std::vector<int> nearest(least.size(), 0);
  Vertex next = 0;
  for (int i = 0; i < count; ++i) {
    from.push_back(roads.distances(next));
    for (size_t v = 0; v < least.size(); ++v) {
      if (!(from.back()[v] < least[v])) continue;
      least[v] = from.back()[v];
      nearest[v] = i;
    }
    next = static_cast<Vertex>(std::ranges::max_element(least) - least.begin());
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) weights[nearest[at(v)]] += areas[v];
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(mesh.vertex_count());
  for (int i = 0; i < count; ++i)
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) mean[v] += weights[i] * from[at(i)][at(v)];
  const double area = areas.sum();
  return mean / (area * std::sqrt(area));
}

/// Parts of the vertices that have come so far, each with its farthest vertex.
class Parts {
 public:
  explicit Parts(int vertices) : parent_(at(vertices), -1) {}

  bool has(Vertex v) const { return parent_[at(v)] >= 0; }
  void begin(Vertex v) { parent_[at(v)] = v; }
  Vertex farthest(Vertex v) {
    while (parent_[at(v)] != v) v = parent_[at(v)] = parent_[at(parent_[at(v)])];
    return v;
  }
  void join(Vertex lesser, Vertex greater) { parent_[at(lesser)] = greater; }

 private:
  std::vector<Vertex> parent_;
};

/// Of every maximum; 0 of other vertices.
Eigen::VectorXd prominences(const Topology& topology, const Eigen::VectorXd& height) {
  std::vector<Vertex> order(at(topology.vertex_count()));
  std::iota(order.begin(), order.end(), 0);
  const auto is_higher = [&](Vertex a, Vertex b) {
    return height[a] > height[b] || (height[a] == height[b] && a < b);
  };
  std::ranges::sort(order, is_higher);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(topology.vertex_count());
  Parts parts(topology.vertex_count());
  for (const Vertex v : order) {
    parts.begin(v);
    topology.for_each_outgoing(v, [&](Halfedge h) {
      const Vertex w = topology.target(h);
      if (!parts.has(w)) return;
      Vertex lesser = parts.farthest(v), greater = parts.farthest(w);
      if (lesser == greater) return;
      if (is_higher(lesser, greater)) std::swap(lesser, greater);
      result[lesser] = height[lesser] - height[v];
      parts.join(lesser, greater);
    });
  }
  result[order.front()] = height[order.front()] - height[order.back()];
  return result;
}

}  // namespace

Extremities find_extremities(const TriangleMesh& mesh, const Topology& topology, int most,
                             int threads) {
  const SurfaceRoads roads(mesh, topology);
  const Eigen::VectorXd height = mean_distances(mesh, topology, roads);
  const Eigen::VectorXd prominence = prominences(topology, height);
  Extremities ends;
  for (Vertex v = 0; v < topology.vertex_count(); ++v)
    if (prominence[v] >= least_prominence) ends.vertices.push_back(v);
  std::ranges::stable_sort(ends.vertices,
                           [&](Vertex a, Vertex b) { return prominence[a] > prominence[b]; });
  if (std::ssize(ends.vertices) > most) ends.vertices.resize(at(most));
  const Eigen::Index count = std::ssize(ends.vertices);
  ends.farness = height(ends.vertices);
  ends.prominence = prominence(ends.vertices);
  ends.distances.resize(count, count);
  const double unit = std::sqrt(vertex_areas(mesh).sum());
  parallel_for(count, 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto i = first; i < last; ++i) {
      const std::vector<double> from = roads.distances(ends.vertices[static_cast<size_t>(i)]);
      for (Eigen::Index j = 0; j < count; ++j)
        ends.distances(i, j) = from[at(ends.vertices[static_cast<size_t>(j)])] / unit;
    }
  });
  return ends;
}

}  // namespace sphparam
