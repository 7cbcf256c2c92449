#include "middle_poles.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "mesh/rings.h"
#include "mesh/union_find.h"

namespace sphparam {
namespace {

constexpr double plateau = 1e-4;  // of the mesh's extent: how far apart heights are one

size_t at(int i) { return static_cast<size_t>(i); }

/// Where the vertices are, at a size whose squares doubles have, and how high.
struct Heights {
  Heights(const TriangleMesh& mesh, const Vector3& up) {
    const double largest = mesh.positions.cwiseAbs().maxCoeff();
    places = largest > 0 ? Points(mesh.positions / largest) : mesh.positions;
    of_vertices = places * (up / up.cwiseAbs().maxCoeff()).normalized();
    slack = plateau * (of_vertices.maxCoeff() - of_vertices.minCoeff());
  }
  Vector3 place(Vertex v) const { return places.row(v); }

  Points places;
  VectorX of_vertices;
  double slack;
};

/// The faces that are as high as a vertex and hang together with it over corners.
std::vector<Face> flat_faces(const TriangleMesh& mesh, const Heights& heights, Vertex top) {
  const auto is_level = [&](Vertex v) {
    return std::abs(heights.of_vertices[v] - heights.of_vertices[top]) <= heights.slack;
  };
  UnionFind pieces(at(mesh.vertex_count()));
  std::vector<Face> faces;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vertex a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
    if (!is_level(a) || !is_level(b) || !is_level(c)) continue;
    pieces.unite(a, b);
    pieces.unite(b, c);
    faces.push_back(f);
  }
  std::erase_if(faces,
                [&](Face f) { return pieces.find(mesh.triangles(f, 0)) != pieces.find(top); });
  return faces;
}

/// The middle by area; nothing where they have none.
std::optional<Vector3> middle_of(const TriangleMesh& mesh, const Heights& heights,
                                 const std::vector<Face>& faces) {
  Vector3 sum = Vector3::Zero();
  double area = 0;
  for (const Face f : faces) {
    const Vector3 a = heights.place(mesh.triangles(f, 0)), b = heights.place(mesh.triangles(f, 1)),
                  c = heights.place(mesh.triangles(f, 2));
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * (a + b + c) / 3;
    area += weight;
  }
  if (!(area > 0)) return std::nullopt;
  return Vector3(sum / area);
}

Vertex middle_of_flat(const TriangleMesh& mesh, const Topology& topology, const Heights& heights,
                      Vertex top) {
  const std::vector<Face> faces = flat_faces(mesh, heights, top);
  const std::optional<Vector3> middle = middle_of(mesh, heights, faces);
  if (!middle) return top;
  const auto off = [&](Vertex v) { return (heights.place(v) - *middle).norm(); };
  const std::vector<Vertex> vertices = vertices_of(topology, faces);
  const Vertex inmost = *std::ranges::min_element(vertices, {}, off);
  return off(inmost) < off(top) - heights.slack ? inmost : top;
}

/// The fillers that hang together over edges with those at a vertex, ascending.
std::vector<Face> fillers_at(const Topology& topology, const FillerMarks& fillers, Vertex v) {
  std::vector<char> seen(fillers.size());
  std::vector<Face> found;
  const auto visit = [&](Face f) {
    if (fillers.empty() || !fillers[at(f)] || seen[at(f)]) return;
    seen[at(f)] = true;
    found.push_back(f);
  };
  topology.for_each_outgoing(v, [&](Halfedge h) { visit(Topology::face(h)); });
  for (size_t next = 0; next < found.size(); ++next)
    for (int k = 0; k < 3; ++k) visit(Topology::face(topology.twin(3 * found[next] + k)));
  std::ranges::sort(found);
  return found;
}

bool is_on_rim(const Topology& topology, const FillerMarks& fillers, Vertex v) {
  bool surface = false;
  topology.for_each_outgoing(
      v, [&](Halfedge h) { surface = surface || !fillers[at(Topology::face(h))]; });
  return surface;
}

/// Of what closes one hole the vertex that is most edges away from the rim: the one that is given,
/// where none is farther, else the one of the lowest index.
Vertex middle_of_fillers(const Topology& topology, const FillerMarks& fillers, Vertex given) {
  const std::vector<Vertex> vertices = vertices_of(topology, fillers_at(topology, fillers, given));
  std::vector<int> depths(at(topology.vertex_count()), -1);
  std::vector<Vertex> queue;
  const auto reach = [&](Vertex v, int depth) {
    if (depths[at(v)] >= 0 || !std::ranges::binary_search(vertices, v)) return;
    depths[at(v)] = depth;
    queue.push_back(v);
  };
  for (const Vertex v : vertices)
    if (is_on_rim(topology, fillers, v)) reach(v, 0);
  for (size_t next = 0; next < queue.size(); ++next) {
    const Vertex v = queue[next];
    topology.for_each_outgoing(v,
                               [&](Halfedge h) { reach(topology.target(h), depths[at(v)] + 1); });
  }
  Vertex inmost = given;
  for (const Vertex v : vertices)
    if (depths[at(v)] > depths[at(inmost)]) inmost = v;
  return inmost;
}

bool is_at_filler(const Topology& topology, const FillerMarks& fillers, Vertex v) {
  return !fillers_at(topology, fillers, v).empty();
}

}  // namespace

bool poles_share_filler(const Topology& topology, const FillerMarks& fillers, Poles poles) {
  const std::vector<Face> of_north = fillers_at(topology, fillers, poles.north),
                          of_south = fillers_at(topology, fillers, poles.south);
  return std::ranges::any_of(of_north,
                             [&](Face f) { return std::ranges::binary_search(of_south, f); });
}

Poles middle_poles(const TriangleMesh& mesh, const Topology& topology, const Vector3& up,
                   const FillerMarks& fillers, Poles poles) {
  const Heights heights(mesh, up);
  const bool apart = !poles_share_filler(topology, fillers, poles);
  const auto middle = [&](Vertex v) {
    if (!is_at_filler(topology, fillers, v)) return middle_of_flat(mesh, topology, heights, v);
    return apart ? middle_of_fillers(topology, fillers, v) : v;
  };
  const Poles moved{middle(poles.north), middle(poles.south)};
  const bool usable =
      moved.north != moved.south && topology.find_halfedge(moved.north, moved.south) < 0;
  return usable ? moved : poles;
}

}  // namespace sphparam
