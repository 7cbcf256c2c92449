#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// The triangles around a set of free vertices, copied out of the mesh, and projected Newton steps
/// on their energy. Everything that is not free stays fixed.
class NewtonPatch {
 public:
  /// Requires: distinct free vertices. Cost: O(n log n) in the size of the patch, not of the mesh.
  NewtonPatch(const Topology& topology, const RestTriangles& source, const Points& points,
              std::vector<Vertex> free);

  struct Step {
    double energy;     // after the step; before it, if nothing moved
    double decrement;  // gᵀH⁻¹g: twice the gain that the quadratic model promised
    bool moved;
  };

  /// One step with line search. With ε = 0 every orientation stays positive, decided exactly.
  /// Requires: E finite.
  Step step(const DistortionEnergy& energy);

  double energy(const DistortionEnergy& energy) const { return energy_of(energy, points_); }
  /// Triangles whose determinant is not positive, decided exactly.
  int folds() const;
  /// s of every triangle.
  std::vector<double> stretches() const;
  /// Makes the source as large as the image, so that a patch that is far too small or too large
  /// as a whole is not torn by that.
  void fit_source_area();

  int free_count() const { return static_cast<int>(free_.size()); }
  int face_count() const { return static_cast<int>(triangles_.size()); }
  void write_to(Points& points) const;
  /// Of the free vertices and of those of their triangles that are fixed.
  const Points& positions() const { return points_; }
  void set_positions(const Points& positions) { points_ = positions; }

 private:
  using Frames = std::vector<TangentFrame>;
  using Corners = std::array<int, 3>;

  ImageTriangle image(const Corners& t, const Points& points) const {
    return {points.row(t[0]), points.row(t[1]), points.row(t[2])};
  }
  double energy_of(const DistortionEnergy& energy, const Points& points) const;
  bool positive(const Points& points) const;
  void make_pattern();
  void assemble(const DistortionEnergy& energy, const Frames& frames);
  void scatter(const Corners& corners, const Corners& blocks,
               const decltype(TriangleEnergy::hessian)& hessian);
  VectorX newton_direction();
  Points moved(const VectorX& direction, double t, const Frames& frames) const;

  std::vector<Vertex> free_;             // in the mesh; local vertices 0 … free_count()−1
  Points points_;                        // of the local vertices, free ones first
  std::vector<Corners> triangles_;       // local vertices
  RestTriangles source_;                 // of the local triangles
  Eigen::SparseMatrix<double> hessian_;  // lower triangle
  std::vector<Corners> blocks_;  // per edge k → k+1 of a triangle: its block's first entry
  VectorX gradient_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace sphparam
