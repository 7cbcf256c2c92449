#pragma once

#include <array>
#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/energy/triangle_blocks.h"
#include "embedding/multigrid/block_matrix.h"

namespace sphparam {

/// The diagonal blocks of a Hessian: what each vertex resists with when it moves alone. Refers to
/// what it is given.
struct VertexStiffness {
  const std::vector<Block<2>>& diagonal;  // in units of
  const std::vector<float>& unit;         // radians
  const std::vector<char>& pinned;

  /// gᵀD⁻¹g: how far the vertex goes along g, times |g|, for a force g. A pinned one does not.
  double compliance(Vertex v, const std::array<double, 2>& g) const;
};

/// Triangles that would cut Newton steps short: light ones among slivers, whose resistance to being
/// folded is next to nothing in the quadratic model. A step is as long as the first of them lets
/// it, and moves nothing. Made stiffer they go along instead; as the gradient is left alone, a step
/// still goes downhill. At first it is only their area that may not change by much: a term
/// c ∇log|T| ∇log|T|ᵀ, of the metric of Dikin's ellipsoid (1967), inside which no area vanishes.
/// Those that block again, as they are drawn out and flattened, have all of their Hessian counted
/// several times too. For one step: were it for more, what a step promises would no longer tell how
/// much is left. Our own.
class StiffenedTriangles {
 public:
  /// Stiffens those that lose nine tenths of their determinant on the first half of a straight
  /// way, where each vertex moves by `motion`; the earlier, the more. False: all allow more than an
  /// eighth of the way, which is not worth a solution. `vertices`: by the Hessian of that motion.
  /// Same result for any number of threads. Cost: linear.
  bool stiffen(const TriangleBlocks& blocks, const std::vector<ImagePoint>& image,
               const std::vector<Vector3>& motion, const VertexStiffness& vertices, int threads);

  /// Adds to the Hessians, not the gradients, of a block's triangles.
  void apply(const TriangleBlocks& blocks, int block, const std::vector<ImagePoint>& image,
             TriangleTerms* terms) const;

 private:
  struct Stiffened {
    int pack, lane;          // of its block
    double of_area, of_all;  // c, and a factor
  };
  struct OfBlock {
    std::vector<Stiffened> triangles;  // by pack and lane
    double allowed = 1;                // by all of them: part of a step
  };

  static OfBlock blocking(const TriangleBlocks& blocks, int block,
                          const std::vector<ImagePoint>& image, const std::vector<Vector3>& motion,
                          const VertexStiffness& vertices);
  static void add(OfBlock&& more, OfBlock& to);

  std::vector<OfBlock> stiffened_;  // a list a block, or none at all
};

}  // namespace sphparam
