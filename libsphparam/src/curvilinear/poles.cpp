#include "sphparam/curvilinear/poles.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "edge_graph.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"

// Farthest pair: the vertex a farthest from any one, b farthest from a, then c farthest from b; on
// a tree b and c would be the ends of its longest path, on a surface they nearly are.
// Moving a pole: breadth first from where it was wanted to the first vertices with chord-free links
// until two of them are apart.

namespace sphparam {
namespace {

// Bounds of the search for each pole, so that it stays linear.
constexpr size_t candidates = 64;  // chord-free vertices
constexpr size_t visited = 1024;   // vertices tested

std::vector<Vertex> sorted_link(const Topology& topology, Vertex v) {
  std::vector<Vertex> link;
  topology.for_each_outgoing(v, [&](Halfedge h) { link.push_back(topology.target(h)); });
  std::sort(link.begin(), link.end());
  return link;
}

bool contains(const std::vector<Vertex>& sorted, Vertex v) {
  return std::binary_search(sorted.begin(), sorted.end(), v);
}

/// Are a and b at least three edges apart?
bool apart(const Topology& topology, Vertex a, Vertex b) {
  const std::vector<Vertex> link = sorted_link(topology, a);
  if (a == b || contains(link, b)) return false;
  bool disjoint = true;
  topology.for_each_outgoing(
      b, [&](Halfedge h) { disjoint = disjoint && !contains(link, topology.target(h)); });
  return disjoint;
}

/// The vertices with chord-free links in the order of a breadth first search, found on demand.
class ChordFreeVertices {
 public:
  ChordFreeVertices(const Topology& topology, Vertex first)
      : topology_(topology), seen_(static_cast<size_t>(topology.vertex_count()), false) {
    visit(first);
  }

  /// The i-th, or -1.
  Vertex at(size_t i) {
    while (found_.size() <= i && next_ < std::min(queue_.size(), visited)) {
      const Vertex v = queue_[next_++];
      topology_.for_each_outgoing(v, [&](Halfedge h) { visit(topology_.target(h)); });
      if (link_is_chord_free(topology_, v)) found_.push_back(v);
    }
    return i < found_.size() ? found_[i] : -1;
  }

 private:
  void visit(Vertex v) {
    if (seen_[static_cast<size_t>(v)]) return;
    seen_[static_cast<size_t>(v)] = true;
    queue_.push_back(v);
  }

  const Topology& topology_;
  std::vector<bool> seen_;
  std::vector<Vertex> queue_, found_;
  size_t next_ = 0;
};

constexpr double plateau = 1e-4;  // of the mesh's extent: how far apart heights are one

/// The middle of the surface, by area; coordinates are scaled first, so that no sum overflows.
Vector3 middle_of(const TriangleMesh& mesh, double scale) {
  Vector3 sum = Vector3::Zero(), corners = Vector3::Zero();
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Vector3 {
      return scale * mesh.position(mesh.triangles(f, k));
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const double weight = doubled_area(a, b, c);
    sum += weight * (a + b + c) / 3;
    area += weight;
    corners += (a + b + c) / 3;
  }
  return area > 0 ? Vector3(sum / area)
                  : Vector3(corners / std::max<double>(1, static_cast<double>(mesh.face_count())));
}

}  // namespace

Vertex vertex_along(const TriangleMesh& mesh, const Vector3& direction,
                    const std::vector<Vertex>& left_out) {
  const double largest = mesh.positions.cwiseAbs().maxCoeff();
  const double scale = largest > 0 ? 1 / largest : 1;
  const Vector3 along = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  const Vector3 middle = middle_of(mesh, scale);
  const auto arm = [&](Vertex v) -> Vector3 { return scale * mesh.position(v) - middle; };
  const auto counts = [&](Vertex v) { return std::ranges::find(left_out, v) == left_out.end(); };
  double lowest = 0, highest = -std::numeric_limits<double>::infinity();
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const double height = arm(v).dot(along);
    lowest = std::min(lowest, height);
    if (counts(v)) highest = std::max(highest, height);
  }
  const double least = highest - plateau * (highest - lowest);
  Vertex found = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const double height = arm(v).dot(along);
    if (height < least || !counts(v)) continue;
    const double off = (arm(v) - height * along).squaredNorm();
    if (off < nearest) nearest = off, found = v;
  }
  return found;
}

Poles poles_along(const TriangleMesh& mesh, const Topology& topology, const Vector3& up) {
  const Vertex top = vertex_along(mesh, up);
  const Poles poles{top, vertex_along(mesh, -up, {top})};
  if (topology.find_halfedge(poles.north, poles.south) < 0) return poles;
  return nearest_usable_poles(topology, poles).value_or(poles);
}

Poles farthest_poles(const TriangleMesh& mesh, const Topology& topology) {
  const EdgeGraph graph(mesh, topology);
  const Vertex a = graph.shortest_paths(0).last;
  const Vertex b = graph.shortest_paths(a).last;
  return {graph.shortest_paths(b).last, b};
}

bool link_is_chord_free(const Topology& topology, Vertex v) {
  const std::vector<Vertex> link = sorted_link(topology, v);
  bool chord_free = true;
  topology.for_each_outgoing(v, [&](Halfedge spoke) {
    // Around u, v stands between u's two neighbours in the link; no other vertex may be in it.
    const Vertex u = topology.target(spoke);
    const Vertex before = topology.apex(topology.twin(spoke)), after = topology.apex(spoke);
    topology.for_each_outgoing(u, [&](Halfedge h) {
      const Vertex w = topology.target(h);
      if (w != before && w != after && contains(link, w)) chord_free = false;
    });
  });
  return chord_free;
}

bool poles_are_usable(const Topology& topology, Poles poles) {
  return apart(topology, poles.north, poles.south) && link_is_chord_free(topology, poles.north) &&
         link_is_chord_free(topology, poles.south);
}

std::optional<Poles> nearest_usable_poles(const Topology& topology, Poles wanted) {
  require_vertex("poles.north", wanted.north, topology.vertex_count());
  require_vertex("poles.south", wanted.south, topology.vertex_count());
  ChordFreeVertices north(topology, wanted.north), south(topology, wanted.south);
  // Pairs in the order of how far both poles have moved together.
  for (size_t moves = 0; moves < 2 * candidates - 1; ++moves) {
    const size_t first = moves < candidates ? 0 : moves - candidates + 1;
    for (size_t i = first; i <= moves && i < candidates; ++i) {
      const Vertex n = north.at(i), s = south.at(moves - i);
      if (n >= 0 && s >= 0 && apart(topology, n, s)) return Poles{n, s};
    }
  }
  return std::nullopt;
}

std::optional<Poles> choose_poles(const TriangleMesh& mesh, const Topology& topology) {
  return nearest_usable_poles(topology, farthest_poles(mesh, topology));
}

}  // namespace sphparam
