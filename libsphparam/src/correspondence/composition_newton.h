#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "correspondence/moving_surface.h"

namespace sphparam {

/// Projected Newton steps of all vertices at once on the energy of the composition.
class CompositionNewton {
 public:
  /// Borrows the surface. Cost: a symbolic factorisation.
  CompositionNewton(MovingSurface& surface, int threads);

  struct Step {
    double energy;  // after the step; before it, if nothing moved
    bool moved;
  };

  /// One step with line search: vertices whose triangles would lose their orientation go a shorter
  /// part of their way. Requires: a finite energy. Cost: a sparse factorisation.
  Step step(const ComposedEnergy& energy, double before);

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  struct FaceTerms {
    Eigen::Matrix<double, 6, 1> gradient;
    Matrix6 hessian;  // positive semidefinite
  };

  void make_pattern();
  FaceTerms face_terms(Face face, const ComposedEnergy& energy) const;
  void assemble(const ComposedEnergy& energy);
  void gather(Vertex v, const std::vector<FaceTerms>& terms);
  bool lengths_that_keep(std::vector<double>& lengths, std::vector<Place>& places) const;

  MovingSurface& surface_;
  int threads_;
  std::vector<Vertex> free_;
  std::vector<int> unknown_;             // of each vertex: its number among the free; -1: held
  Eigen::SparseMatrix<double> hessian_;  // lower triangle
  Eigen::VectorXd gradient_, way_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace sphparam
