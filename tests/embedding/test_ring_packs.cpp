#include <catch2/catch.hpp>
#include <cstring>
#include <utility>

#include "embedding/sweeps/ring_packs.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

MeshHierarchy complete_hierarchy(const TriangleMesh& mesh) {
  MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh), 1);
  for (size_t l = hierarchy.size() - 1; l-- > 0;) {
    complete_positions(hierarchy[l], hierarchy[l + 1], 1);
  }
  return hierarchy;
}

RingPacks packs_of(const HierarchyLevel& level, RingPacks used = {}) {
  return pack_rings(level, 1e-9, 1, {}, std::move(used));
}

size_t slots_used(const RingPacks& packs) {
  return packs.packs.back().first_slot + static_cast<size_t>(packs.packs.back().valence);
}

void require_same(const RingPacks& a, const RingPacks& b) {
  REQUIRE(a.colour_start == b.colour_start);
  REQUIRE(a.largest_valence == b.largest_valence);
  REQUIRE(a.packs.size() == b.packs.size());
  for (size_t p = 0; p < a.packs.size(); ++p) {
    REQUIRE(a.packs[p].valence == b.packs[p].valence);
    REQUIRE(a.packs[p].first_slot == b.packs[p].first_slot);
    REQUIRE(std::memcmp(a.packs[p].vertex, b.packs[p].vertex, sizeof a.packs[p].vertex) == 0);
  }
  REQUIRE(std::memcmp(a.slots.get(), b.slots.get(), slots_used(a) * sizeof(RingSlot)) == 0);
}

}  // namespace

TEST_CASE("ring packs: in used memory, whether too small, just enough or too large, as in fresh") {
  const MeshHierarchy hierarchy = complete_hierarchy(random_sphere_mesh(2000, 4));
  const RingPacks fresh = packs_of(hierarchy[1]);
  for (const size_t l : {2, 1, 0}) {
    RingPacks used = packs_of(hierarchy[l]);
    const size_t room = used.room;
    CHECK((room < fresh.room) == (l > 1));
    CHECK((room > fresh.room) == (l < 1));
    const RingSlot* memory = used.slots.get();
    const RingPacks packs = packs_of(hierarchy[1], std::move(used));
    require_same(packs, fresh);
    if (l <= 1) CHECK(packs.slots.get() == memory);
    CHECK(packs.room >= slots_used(packs));
  }
}

TEST_CASE("ring packs: packs that were moved from have no memory left to use, and get new") {
  const MeshHierarchy hierarchy = complete_hierarchy(icosphere(2));
  RingPacks used = room_for_rings(100'000);
  const RingPacks taken = std::move(used);
  require_same(packs_of(hierarchy[0], std::move(used)), packs_of(hierarchy[0]));
}

TEST_CASE("ring packs: long rings are packed with rings about as long") {
  // Hubs of 70 and 200 leaves in turn; each leaf knows its hub.
  constexpr int hubs = 16;
  std::vector<int> start = {0};
  std::vector<Vertex> ring, leaf_of;
  for (int hub = 0; hub < hubs; ++hub) {
    for (int i = 0; i < (hub % 2 == 0 ? 70 : 200); ++i) {
      ring.push_back(hubs + static_cast<Vertex>(leaf_of.size()));
      leaf_of.push_back(hub);
    }
    start.push_back(static_cast<int>(ring.size()));
  }
  for (const Vertex hub : leaf_of) {
    ring.push_back(hub);
    start.push_back(static_cast<int>(ring.size()));
  }
  const RingPacks packs = pack_rings(start, ring, [](Vertex, int, RingSlot*) {}, 1, {});
  int of_hubs = 0;
  for (const RingPack& pack : packs.packs) {
    if (pack.vertex[0] < hubs) of_hubs += pack.valence;
  }
  CHECK(of_hubs == 70 + 200);
}

TEST_CASE("ring packs: within a colour, packs go from region to region") {
  const MeshHierarchy hierarchy = complete_hierarchy(relabelled(icosphere(5), 3));
  const RingPacks packs = packs_of(hierarchy[0]);
  REQUIRE(hierarchy[0].vertex_count() > 4 * 2048);
  for (int c = 0; c < packs.colours(); ++c) {
    int region = 0;
    const auto first = static_cast<size_t>(packs.colour_start[static_cast<size_t>(c)]);
    const auto last = static_cast<size_t>(packs.colour_start[static_cast<size_t>(c) + 1]);
    for (size_t p = first; p < last; ++p) {
      for (const Vertex v : packs.packs[p].vertex) {
        if (v < 0) continue;
        CHECK(v / 2048 >= region);
        region = v / 2048;
      }
    }
  }
  const double used = 8.0 * static_cast<double>(slots_used(packs));
  CHECK(used < (1 + 1.0 / 16) * static_cast<double>(hierarchy[0].ring.size()));  // as reserved
}
