#include "correspondence/surface_roads.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace sphparam {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

SurfaceRoads::SurfaceRoads(const TriangleMesh& mesh, const Topology& topology)
    : mesh_(mesh), start_{0} {
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    topology.for_each_outgoing(v, [&](Halfedge h) {
      const Vertex w = topology.origin(topology.next(h));
      ways_.push_back({w, (mesh_.position(w) - mesh_.position(v)).norm()});
      add_crossing(topology, v, topology.next(h));
    });
    start_.push_back(ways_.size());
  }
}

/// From a vertex over the edge opposite to it to the corner beyond, where the unfolded way crosses
/// the edge.
void SurfaceRoads::add_crossing(const Topology& topology, Vertex from, Halfedge edge) {
  const Vertex a = topology.origin(edge), b = topology.origin(topology.next(edge));
  const Vertex beyond = topology.apex(topology.twin(edge));
  const Vector3 x = mesh_.position(from), y = mesh_.position(beyond), p = mesh_.position(a);
  const Vector3 side = mesh_.position(b) - p, along = side.normalized();
  const double x0 = (x - p).dot(along), y0 = (y - p).dot(along);
  const double height = ((x - p) - x0 * along).norm() + ((y - p) - y0 * along).norm();
  const double crossing = x0 + (y0 - x0) * ((x - p) - x0 * along).norm() / height;
  if (!(crossing > 0 && crossing < side.norm())) return;
  ways_.push_back({beyond, std::sqrt((y0 - x0) * (y0 - x0) + height * height)});
}

std::vector<double> SurfaceRoads::distances(Vertex from, std::vector<Vertex> until) const {
  std::vector<double> result(start_.size() - 1, std::numeric_limits<double>::infinity());
  std::vector<char> done(result.size(), 0);
  using Entry = std::pair<double, Vertex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  result[at(from)] = 0;
  queue.push({0, from});
  const bool all = until.empty();
  while (!queue.empty() && (all || !until.empty())) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (std::exchange(done[at(v)], 1)) continue;
    std::erase(until, v);
    for (size_t i = start_[at(v)]; i < start_[at(v) + 1]; ++i) {
      const double through = distance + ways_[i].length;
      double& other = result[at(ways_[i].to)];
      if (through < other) queue.push({other = through, ways_[i].to});
    }
  }
  return result;
}

double SurfaceRoads::distance(Vertex from, const SurfacePoint& to) const {
  std::vector<Vertex> corners;
  Vector3 point = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    corners.push_back(mesh_.triangles(to.face, k));
    point += to.barycentric[k] * mesh_.position(corners.back());
  }
  const std::vector<double> reached = distances(from, corners);
  double least = std::numeric_limits<double>::infinity();
  for (const Vertex v : corners)
    least = std::min(least, reached[at(v)] + (mesh_.position(v) - point).norm());
  return least;
}

}  // namespace sphparam
