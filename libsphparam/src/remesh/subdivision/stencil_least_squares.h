#pragma once

#include "remesh/subdivision/limit_stencils.h"
#include "sphparam/io/polygons.h"
#include "sphparam/progress.h"

namespace sphparam {

/// Finds the control points C that minimise
///
///   Σᵢ wᵢ (τ |xᵢ − qᵢ|² + (1 − τ) (nᵢ · (xᵢ − qᵢ))²)  +  Σᵥ aᵥ |Cᵥ − mean of v's neighbours|²
///
/// over the points xᵢ of all patches (point k of patch p is row m·p + k), given targets qᵢ, weights
/// wᵢ and directions nᵢ. The second sum is for control points that the samples hardly see: aᵥ is
/// what vertex v lacks of 1/1000 of the mean weight of a control point, and 0 for all others.
///
/// By conjugate gradients, 3×3 blocks of the diagonal as preconditioner, and without a matrix: the
/// stencils of polynomial patches are one small table, which stays in the cache. Splines of one
/// degree are a basis that is well conditioned at every level, so that the number of steps is not
/// bound to the number of control points.
/// Ensures: the same bytes for any number of threads.
class StencilLeastSquares {
 public:
  /// Requires: finite weights ≥ 0, one a point, not all 0; `faces` those of the stencils, which
  /// outlive this.
  StencilLeastSquares(const LimitStencils& stencils, const Polygons& faces, VectorX weights,
                      int threads);

  /// From now on distances along `normals` (unit, a row a point) count in full, others by
  /// `tangential`, τ in (0, 1]. Before the first call τ is 1.
  void set_metric(Points normals, double tangential);

  /// The point of each sample. Cost: 2·12·m flops and coordinate a patch.
  Points evaluate(const Points& control) const;

  /// Control points that the second sum holds.
  int thin_count() const { return static_cast<int>(thin_.size()); }

  struct Outcome {
    int steps = 0;
    double reduction = 0;  // of the residual, in the preconditioner's norm
  };
  /// Moves `control` to the minimum, until the residual is `reduction` of what it was.
  /// Throws: SolveError where that needs more than `most_steps`; Cancelled.
  Outcome minimise(const Points& targets, Points& control, double reduction,
                   const Progress& progress) const;

  static constexpr int most_steps = 5000;

 private:
  struct ThinVertex {
    int vertex;
    double weight;
  };

  void list_entries();
  void list_neighbours(const Polygons& faces);
  void list_thin_vertices();
  /// Calls visit(patch, weights in its points) for all patches that depend on v.
  template <class Visit>
  void for_each_entry(int v, const Visit& visit) const;
  void make_preconditioner();
  Eigen::Matrix3d diagonal_block(int v) const;
  /// G y at a patch's points.
  Eigen::MatrixX3d in_metric(int patch, Eigen::MatrixX3d y) const;
  /// Wᵀ G y, where `at_samples(patch)` gives y: m × 3.
  template <class AtSamples>
  Points gather(const AtSamples& at_samples) const;
  Eigen::MatrixX3d at_patch(int patch, const Points& control) const;
  Points apply(const Points& control) const;
  Vector3 umbrella(int vertex, const Points& control) const;
  void add_fairness(const Points& control, double factor, Points& sum) const;
  Points precondition(const Points& residual) const;

  const LimitStencils& stencils_;
  VectorX weights_;
  int threads_;
  Points normals_;
  double tangential_ = 1;
  std::vector<std::int64_t> entry_starts_, entries_;  // of each vertex, in the patches' lists
  std::vector<int> patch_of_;                         // of each entry
  std::vector<int> neighbour_starts_, neighbours_;
  std::vector<ThinVertex> thin_;
  std::vector<Eigen::Matrix3d> inverse_blocks_;
};

}  // namespace sphparam
