#pragma once

#include <algorithm>
#include <vector>

#include "sphparam/io/polygons.h"
#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

/// A control mesh: what a limit surface is made of.
struct ControlMesh {
  Polygons faces;
  std::vector<Points> points;  // one or more sets, each of a point a vertex
};

/// One step of Catmull's and Clark's subdivision: the same limit surface, of quads only, which are
/// its patches. Requires: a closed manifold. Throws: std::invalid_argument if it is none.
/// Source: Catmull and Clark (1978).
ControlMesh subdivide_to_quads(const ControlMesh& mesh);

/// Whether each face is a patch of the limit surface; where not, `subdivide_to_quads` makes it so.
/// Requires: faces the scheme takes.
bool faces_are_patches(const Polygons& faces, Scheme scheme);

/// The patches of a limit surface all of whose faces are patches: which lie beside which.
class PatchNet {
 public:
  /// Requires: triangles only or quads only. Throws: std::invalid_argument if not, or if they are
  /// no closed manifold. Cost: O(#corners log #corners).
  explicit PatchNet(const Polygons& faces);

  int degree() const { return degree_; }
  int patch_count() const { return static_cast<int>(across_.size()) / degree_; }
  /// Edge degree·patch + k runs from corner k of the patch to the next. The same edge as the patch
  /// beyond it has it, where it runs the other way.
  int across(int edge) const { return across_[static_cast<size_t>(edge)]; }

  /// How far a place is beyond the end of its patch, in parameters; 0 or less within.
  double beyond(const LimitPlace& place) const {
    const double before = std::max(-place.s, -place.t);
    if (degree_ == 3) return std::max(before, place.s + place.t - 1);
    return std::max(before, std::max(place.s, place.t) - 1);
  }
  /// A place beyond the end of its patch in the parameters of the patch there, as if the two were
  /// one flat piece. The edge farthest behind is crossed, one only. Requires: beyond(place) > 0.
  LimitPlace cross(const LimitPlace& place) const;

 private:
  int degree_;
  std::vector<int> across_;
};

/// The nearest place that is within its patch.
LimitPlace clamped(const LimitPlace& place, int degree);

/// A fine mesh of a limit surface: each patch cut into n² triangles, or n² quads.
struct Tessellation {
  Polygons faces;
  std::vector<LimitPlace> vertices;
};

constexpr int most_cuts = 1 << 14;  // of an edge

/// Vertices of the control mesh come first, with their numbers; then n − 1 on each edge, then those
/// within patches. Requires: as PatchNet; n ≥ 1. Ensures: a closed manifold, as the faces are.
/// Throws: std::invalid_argument for more corners than an index can number, or n > `most_cuts`.
Tessellation tessellate(const Polygons& faces, int vertex_count, int n);

}  // namespace sphparam
