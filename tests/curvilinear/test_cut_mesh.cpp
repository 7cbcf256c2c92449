#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "curvilinear/cut_sphere.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// The corners of a face of the disk.
std::array<int, 3> wedges_of(const CutSphere& s, Face f) {
  return {static_cast<int>(s.cut.wedge(s.topology, 3 * f)),
          static_cast<int>(s.cut.wedge(s.topology, 3 * f + 1)),
          static_cast<int>(s.cut.wedge(s.topology, 3 * f + 2))};
}

}  // namespace

TEST_CASE("cut_mesh: a cut sphere is a disk") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    std::set<int> vertices;
    std::set<std::pair<int, int>> edges;
    int faces = 0;
    for (Face f = 0; f < s.topology.face_count(); ++f) {
      if (s.cut.removed(f)) continue;
      ++faces;
      const auto w = wedges_of(s, f);
      for (size_t k = 0; k < 3; ++k) {
        vertices.insert(w[k]);
        CHECK(edges.insert({w[k], w[(k + 1) % 3]}).second);  // oriented: every edge at most once
      }
    }
    int boundary = 0;
    std::set<int> boundary_vertices;
    for (const auto& [a, b] : edges) {
      if (edges.contains({b, a})) continue;
      ++boundary;
      boundary_vertices.insert(a);
    }
    const int all_edges = (static_cast<int>(edges.size()) + boundary) / 2;
    CHECK(static_cast<int>(vertices.size()) - all_edges + faces == 1);
    // One boundary loop without a pinch: two links and two banks, which share the four corners.
    const auto inner = static_cast<int>(s.cut.date_line().path.size()) - 2;
    CHECK(static_cast<int>(boundary_vertices.size()) == boundary);
    CHECK(boundary ==
          s.topology.valence(s.poles.north) + s.topology.valence(s.poles.south) + 2 * (inner - 1));
  }
}

TEST_CASE("cut_mesh: gluing the cut restores the mesh without its poles") {
  const CutSphere s(icosphere(3));
  std::set<int> turned;
  for (Face f = 0; f < s.topology.face_count(); ++f) {
    const bool at_pole = (s.mesh.triangles.row(f).array() == s.poles.north).any() ||
                         (s.mesh.triangles.row(f).array() == s.poles.south).any();
    CHECK(s.cut.removed(f) == at_pole);
    for (int k = 0; k < 3; ++k) {
      const Wedge w = s.cut.wedge(s.topology, 3 * f + k);
      CHECK(s.cut.vertex(w) == s.mesh.triangles(f, k));
      CHECK(s.cut.turn(w) == s.cut.turn(3 * f + k));
      if (s.cut.turn(w) == 1) turned.insert(s.cut.vertex(w));
    }
  }
  const std::vector<Vertex>& path = s.cut.date_line().path;
  CHECK(turned == std::set<int>(path.begin() + 1, path.end() - 1));
}

TEST_CASE("cut_mesh: jumps are the same from both sides and sum to a turn around a pole") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    std::set<Halfedge> listed;
    for (const Jump& jump : s.cut.jumps()) {
      CHECK(listed.insert(jump.halfedge).second);
      CHECK(jump.value == s.cut.jump(jump.halfedge));
    }
    for (Halfedge h = 0; h < s.topology.halfedge_count(); ++h) {
      if (s.cut.is_pole(s.topology.origin(h)) || s.cut.is_pole(s.topology.target(h))) continue;
      CHECK(s.cut.jump(h) == -s.cut.jump(s.topology.twin(h)));
      CHECK(listed.contains(h) == (s.cut.jump(h) != 0));
    }
    // Eastward around the north pole θ gains one turn: without jumps it would come back unchanged.
    const std::vector<Vertex>& link = s.cut.north_link();
    double sum = 0;
    for (size_t i = 0; i < link.size(); ++i) {
      sum += s.cut.jump(s.topology.find_halfedge(link[i], link[(i + 1) % link.size()]));
    }
    CHECK(sum == 2 * std::numbers::pi);
  }
}

TEST_CASE("cut_mesh: the links run eastward from the date line") {
  const CutSphere s(uv_sphere(12, 7));
  const double north_z = s.mesh.positions(s.poles.north, 2);
  for (const auto* link : {&s.cut.north_link(), &s.cut.south_link()}) {
    REQUIRE(link->size() == 12);
    for (size_t i = 0; i < link->size(); ++i) {
      const Vector3 a = s.mesh.position((*link)[i]), b = s.mesh.position((*link)[(i + 1) % 12]);
      CHECK((a.x() * b.y() - a.y() * b.x()) * north_z > 0);
    }
  }
  CHECK(s.cut.north_link().front() == s.cut.date_line().path[1]);
  CHECK(s.cut.south_link().front() == s.cut.date_line().path.end()[-2]);
}
