#pragma once

#include <cstdint>
#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/energy/ring_slot.h"
#include "embedding/energy/triangle_packs.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// An order of the vertices, in patches of `TriangleBlocks::size` neighbours, each grown from the
/// rim of those before.
std::vector<Vertex> patch_order(const Topology& topology);

/// The triangles of a mesh, laid out by blocks of consecutive rows (vertices in a new order): each
/// block with the packs of all triangles that touch it, so that what is computed of a block stays
/// in the cache and blocks can be worked on side by side.
class TriangleBlocks {
 public:
  static constexpr int size = 256;          // rows
  static constexpr std::int64_t grain = 1;  // blocks that a thread takes at once

  TriangleBlocks() = default;

  /// Keeps nothing of what it is given. Row v is the vertex old_name[v], and `new_name` is the
  /// inverse; its neighbours have the entries start[v] … start[v + 1] − 1, in the order of
  /// `for_each_outgoing`. `pressed`: the triangles that feel the energy's pressure. Cost: linear.
  TriangleBlocks(const Topology& topology, const RestTriangles& source,
                 const std::vector<Vertex>& old_name, const std::vector<int>& new_name,
                 const std::vector<int>& start, const FillerMarks& pressed = {});

  int count() const { return static_cast<int>(blocks_.size()); }

  /// Packs of a block; the first are those of the triangles that count there.
  const TrianglePack* packs_of(int block) const {
    return &packs_[blocks_[static_cast<size_t>(block)].first_pack];
  }
  int pack_count(int block) const { return blocks_[static_cast<size_t>(block)].packs; }
  int pack_count() const { return static_cast<int>(packs_.size()); }  // of all blocks

  /// The triangle (row, neighbour, next neighbour) that begins with an entry of the row: its place
  /// among those of the row's block, and the corner that the row's vertex is.
  int triangle(int entry) const { return slots_[static_cast<size_t>(entry)] >> 2; }
  int corner(int entry) const { return slots_[static_cast<size_t>(entry)] & 3; }

  /// +∞ unless every orientation is certain to be positive.
  double energy(const std::vector<ImagePoint>& image, const DistortionEnergy& energy,
                int threads) const;

  /// How often the image covers the sphere, to some per cent: a whole number where every
  /// orientation is positive, and then the map is one-to-one if it is 1.
  double covering(const std::vector<ImagePoint>& image, int threads) const;

  /// The rest triangles of a row of entries first … last − 1, each seen from the row's vertex (as
  /// `rotated` turns them).
  void measure_ring(int row, int first, int last, int lane, RingSlot* slots) const;

 private:
  struct Block {
    size_t first_pack;
    int owned;  // triangles that count here, in the first packs; the others touch the block only
    int packs;
  };

  std::vector<Block> blocks_;
  std::vector<TrianglePack> packs_;
  std::vector<int> slots_;  // 4 · triangle(entry) + corner(entry)
};

}  // namespace sphparam
