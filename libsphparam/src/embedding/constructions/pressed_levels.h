#pragma once

#include <vector>

#include "embedding/newton/pressed_fillers.h"
#include "embedding/sweeps/ring_packs.h"
#include "mesh/mesh_hierarchy.h"

namespace sphparam {

/// Fillers on all levels of a hierarchy: searching for the pressure that they need is cheap on
/// coarse levels, and on finer ones it is about the same. A level's triangle is a filler where a
/// vertex of it has no surface on the mesh itself. Our own.
class PressedLevels {
 public:
  struct Options {
    FillerMarks fillers;  // of the mesh; empty: nothing is done at all
    double most = 1;      // of the sphere
    OptimiseOptions optimise = {};
  };
  /// Keeps nothing of the mesh. Cost: linear.
  PressedLevels(const Topology& topology, const MeshHierarchy& hierarchy, Options options);

  /// Is a level of so many vertices to be pressed? Those are at every fourfold count.
  bool due(size_t level, int vertices) const;
  /// Presses a level's map. `pinned` stay. Throws: Cancelled.
  SphereMap pressed(size_t level, const TriangleMesh& mesh, const SphereMap& map,
                    const std::vector<Vertex>& pinned);

  /// What the last level that was pressed has needed; 0: nothing, all is as without fillers.
  double pressure() const { return pressure_; }
  /// Marks what feels the pressure in the packs of a level, and gives areas the sizes to aim at.
  void mark(size_t level, RingPacks& packs) const;

 private:
  FillerMarks fillers_of(size_t level, const Topology& topology) const;

  Options options_;
  std::vector<std::vector<char>> inside_;  // per level and vertex: all its triangles are fillers
  int next_;                               // vertices of the next level to be pressed, at least
  double pressure_ = 0;
};

}  // namespace sphparam
