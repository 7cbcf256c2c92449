#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "embedding/energy/rest_floors.h"
#include "embedding/energy/ring_slot.h"
#include "mesh/mesh_hierarchy.h"

namespace sphparam {

/// Up to eight vertices of one colour (no two share an edge) and of similar valence.
struct RingPack {
  Vertex vertex[pack_width];  // −1: an empty lane
  int valence;                // largest of the lanes: number of slots
  size_t first_slot;
};

/// A level laid out for sweeps. Colour 0 holds the level's removed vertices, which are independent.
struct RingPacks {
  std::vector<RingPack> packs;  // colour by colour
  std::unique_ptr<RingSlot[]> slots;
  size_t room = 0;                // for so many slots
  std::vector<int> colour_start;  // #colours + 1, into `packs`
  int largest_valence = 0;

  int colours() const { return static_cast<int>(colour_start.size()) - 1; }
};

/// Packs of nothing with room for the rings of a mesh, most likely. Memory that no level has needed
/// yet is not touched.
RingPacks room_for_rings(std::int64_t halfedges);

/// Colours, sorts and packs the vertices of a level. `pinned`: vertices in no pack. `used`: packs
/// that nobody needs any more; their memory serves again.
RingPacks pack_rings(const HierarchyLevel& level, const RestFloors& floors, int threads,
                     const std::vector<Vertex>& pinned = {}, RingPacks used = {});

/// The same for any rings (as in HierarchyLevel). `measure(v, lane, slots)` fills in the numbers of
/// v's rest triangles, slot by slot, in that lane; called by several threads at once.
RingPacks pack_rings(const std::vector<int>& start, const std::vector<Vertex>& ring,
                     const std::function<void(Vertex v, int lane, RingSlot* slots)>& measure,
                     int threads, const std::vector<Vertex>& pinned);

}  // namespace sphparam
