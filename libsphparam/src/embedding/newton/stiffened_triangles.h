#pragma once

#include <array>
#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/energy/triangle_blocks.h"

namespace sphparam {

/// Triangles that would cut Newton steps short: light ones among slivers, whose resistance to being
/// folded is next to nothing in the quadratic model. A step is as long as the first of them lets
/// it, and moves nothing. Counted several times in the Hessian they go along instead; as the
/// gradient is left alone, a step still goes downhill. For one step: were it for more, what a step
/// promises would no longer tell how much is left. Our own.
class StiffenedTriangles {
 public:
  /// Stiffens those that lose nine tenths of their determinant on the first half of a straight
  /// way, where each vertex moves by `motion`; the earlier, the more. False: there are none, or
  /// more than a few: what blocks a whole limb is its way over the sphere, which no stiffness
  /// changes. Same result for any number of threads. Cost: linear.
  bool stiffen(const TriangleBlocks& blocks, const std::vector<ImagePoint>& image,
               const std::vector<Vector3>& motion, int threads);

  /// Multiplies the Hessians, not the gradients, of a block's triangles.
  void apply(const TriangleBlocks& blocks, int block, TriangleTerms* terms) const;

 private:
  using Factors = std::array<float, pack_width>;

  std::vector<Factors> factors_;  // of the triangles of all packs; empty: all are 1
};

}  // namespace sphparam
