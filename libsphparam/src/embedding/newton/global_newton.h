#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "embedding/energy/triangle_blocks.h"
#include "embedding/multigrid/multigrid.h"
#include "embedding/newton/conjugate_gradients.h"
#include "embedding/newton/stiffened_triangles.h"
#include "embedding/sweeps/ring_packs.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// A whole mesh laid out for Newton steps on its energy: vertices renamed so that neighbours are
/// near in memory, cut into blocks; each block with the triangles that touch it.
///
/// Memory, bytes a triangle: 80 always, of which 40 for the rest triangles and 16 for the image;
/// in a step 120 for the Hessian, 110 for the multigrid, 40 for the solver's vectors; in sweeps 55
/// for the rings instead of the Hessian and the vectors; on other than large meshes the rings stay.
class GlobalNewton {
 public:
  /// Keeps nothing of what it is given. Requires: every determinant certain to be positive.
  /// `pressed`: the triangles that feel the energy's pressure, which then must never be 0: their
  /// marks are signs of numbers that energies without a pressure take as they are. Cost: linear.
  GlobalNewton(const Topology& topology, const RestTriangles& source,
               const std::vector<ImagePoint>& image, const std::vector<Vertex>& pinned, int threads,
               const FillerMarks& pressed = {});

  /// `ask` is called between the parts of all that follows, at least once in a pass over the mesh,
  /// and may throw; then the image is lost.
  void ask_with(std::function<void()> ask) { ask_ = std::move(ask); }

  struct Step {
    double energy = 0;     // after the step; before it, if nothing moved
    int iterations = 0;    // of the linear solver
    double length = 0;     // of the step, in Newton steps; 0: nothing moved. Stiffened triangles
                           // shorten it by what the model then promises less
    double decrement = 0;  // ½ gᵀH⁻¹g as far as the system was solved: what the quadratic model
                           // promised
    bool complete = false;                       // the system was solved as far as was asked
    Curvature curvature = Curvature::Projected;  // by which it was made
  };

  /// Is there a vertex that is not pinned?
  bool can_move() const;
  /// Is the sphere covered no more than once? Requires: a finite energy. Cost: a pass.
  bool covers_once() const;

  /// One Newton step, the system solved as long as iterations bring `least_share` (see
  /// `solve_by_conjugate_gradients`), with line search; solved anew, up to six times, where
  /// triangles would cut the step short (stiffened_triangles.h); by projected Hessians there, and
  /// where the exact ones lead nowhere. No orientation is lost, decided by the guard, and
  /// the sphere is not covered twice.
  Step step(const DistortionEnergy& energy, double least_share,
            Curvature curvature = Curvature::Projected);

  /// Guarded relaxation of every vertex, so many times: smooths what a step has creased.
  void sweep(const DistortionEnergy& energy, int sweeps);

  /// Carries the whole map by a Möbius transformation that lowers the energy (see
  /// mobius_recentring.h), unless a vertex is pinned. Towards λ = 0 the energy hardly feels them,
  /// and projected Hessians are far too stiff for them. Returns the energy.
  double recentre(const DistortionEnergy& energy);

  /// +∞ unless every orientation is certain to be positive.
  double energy(const DistortionEnergy& energy) const {
    return blocks_.energy(image_, energy, threads_);
  }
  void write_to(std::vector<ImagePoint>& image) const;

 private:
  using Image = std::vector<ImagePoint>;

  void measure_units();
  void make_pattern(const Topology& topology, const std::vector<int>& new_name);
  bool assemble(const DistortionEnergy& energy, Curvature curvature);
  void gather_row(int row, const TriangleTerms* terms);
  bool is_large() const;
  void make_room() const;
  LinearSolution solve(const DistortionEnergy& energy, double least_share, Curvature curvature);
  LinearSolution direction(const DistortionEnergy& energy, double least_share, Step& made);
  std::vector<Vector3> motion(const Unknowns& direction) const;
  RingPacks pack_rings_of_all() const;
  void move(const Unknowns& direction, double length, Image& image) const;
  /// Doubles a step, up to `most`, while that lowers the energy that it comes to.
  void lengthen(const DistortionEnergy& energy, const Unknowns& direction, double most,
                double& length, double& after, Image& candidate) const;
  double longest(const Unknowns& direction) const;

  int threads_;
  std::function<void()> ask_ = [] {};
  std::vector<Vertex> old_name_;
  Image image_;
  std::vector<char> pinned_;
  std::vector<float> unit_;  // of the vertex's tangent coordinates: a power of two near its edges
  BlockMatrix<2> hessian_;   // in these units; entries only in a step
  Unknowns downhill_;        // − the gradient; only in a step
  SweepOrder order_;
  std::optional<RingPacks> rings_;  // of sweeps; on large meshes only in one
  TriangleBlocks blocks_;
  StiffenedTriangles stiffened_;
  std::optional<Multigrid> multigrid_;
};

}  // namespace sphparam
