#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/rings.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("Rings around a vertex are counted by edges") {
  const Topology topology(icosphere(3));
  const Vertex start = 5;
  std::vector<Vertex> ring = {start};
  topology.for_each_outgoing(start, [&](Halfedge h) { ring.push_back(topology.target(h)); });
  std::ranges::sort(ring);
  CHECK(rings_around(topology, {start}, 0) == std::vector<Vertex>{start});
  CHECK(rings_around(topology, {start, start}, 1) == ring);
  CHECK(rings_around(topology, {start}, 2) == rings_around(topology, ring, 1));
  CHECK(std::ssize(rings_around(topology, {start}, 1000)) == topology.vertex_count());
}

TEST_CASE("Vertices of faces are named once, in order") {
  const Topology topology(icosphere(0));
  const Halfedge h = 0;
  const Face across = Topology::face(topology.twin(h));
  const std::vector<Vertex> vertices = vertices_of(topology, {0, across, 0});
  CHECK(vertices.size() == 4);
  CHECK(std::ranges::is_sorted(vertices));
}
