#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <vector>

#include "correspondence/moving_surface.h"

namespace sphparam {

/// Projected Newton steps of all vertices at once on the energy of the composition.
class CompositionNewton {
 public:
  /// Borrows the surface. Cost: a symbolic factorisation where there are few vertices, else linear.
  CompositionNewton(MovingSurface& surface, int threads);

  struct Step {
    double energy;  // after the step; before it, if nothing moved
    bool moved;
  };

  /// One step with line search: vertices whose triangles would lose their orientation go a shorter
  /// part of their way. Requires: a finite energy. Cost: a sparse factorisation, or at most
  /// 60 iterations.
  Step step(const ComposedEnergy& energy, double before);

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  struct FaceTerms {
    Eigen::Matrix<double, 6, 1> gradient;
    Matrix6 hessian;  // positive semidefinite
  };

  using ConjugateGradients = Eigen::ConjugateGradient<
      Eigen::SparseMatrix<double>, Eigen::Lower,
      Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>;

  void make_pattern();
  bool is_direct() const;
  bool solve();
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
