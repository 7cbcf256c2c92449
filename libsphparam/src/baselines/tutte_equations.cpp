#include "baselines/tutte_equations.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "baselines/tangent_basis.h"
#include "sphere/face_rays.h"

// F_i = B_iᵀ Σ_j w_ij (x_j − x_i), B_i two unit vectors of the tangent plane. F is minus the
// gradient of the Dirichlet energy, so its Jacobian is minus the Hessian H, which is symmetric:
//   H_ii = α_i I,  α_i = x_i · Σ_j w_ij x_j,  H_ij = −w_ij B_iᵀ B_j,  W_i = Σ_j |w_ij|.
// Conformal fields N (three rotations ω × x, three Möbius fields a − (a·x)x) change the energy
// hardly or not at all, and along them Newton steps run away. So steps d have Nᵀ M d = 0, M the
// areas of the stars on the sphere, and the equations solved are F = M N c for some c. (With forces
// like W instead of areas, protrusions that are small on the sphere are pulled over themselves.)
// The residual is the least norm of F − M N c, Σ |F_i|²/W_i: a vertex counts with the square of the
// step it is asked for.

namespace sphparam {
namespace {

constexpr double shift = 1e-9;          // of W_i, added to the diagonal: no pivot is 0
constexpr int check_every = 10;         // sweeps between two residuals
constexpr double shortest_step = 1e-3;  // of a Newton step
constexpr double longest_move = 0.5;    // radians a vertex may move in a step

using Fields = Eigen::Matrix<double, 3, 6>;  // conformal fields at a point

Fields conformal_fields(const Vector3& x) {
  Fields fields;
  for (int k = 0; k < 3; ++k) {
    fields.col(k) = Vector3::Unit(k).cross(x);
    fields.col(3 + k) = Vector3::Unit(k) - x[k] * x;
  }
  return fields;
}

SphereMap moved(const SphereMap& map, const VectorX& step, double share) {
  SphereMap next = map;
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    const Vector3 x = map.points.row(v);
    next.points.row(v) = moved_on_sphere(x, share * step.segment<2>(2 * v));
  }
  return next;
}

}  // namespace

TutteEquations::TutteEquations(const Topology& topology, const std::vector<double>& weights)
    : topology_(topology), weights_(weights), rings_(topology, weights) {
  for (Vertex i = 0; i < topology.vertex_count(); ++i) totals_.push_back(rings_.total(i));
}

/// A third of the area of the chord triangles at each vertex.
std::vector<double> TutteEquations::image_areas(const SphereMap& map) const {
  std::vector<double> areas(static_cast<size_t>(topology_.vertex_count()), 0);
  for (Face f = 0; f < topology_.face_count(); ++f) {
    const auto [a, b, c] = face_rays(topology_, map, f);
    const double third = (b - a).cross(c - a).norm() / 6;
    for (int k = 0; k < 3; ++k) areas[static_cast<size_t>(topology_.vertex(f, k))] += third;
  }
  return areas;
}

double TutteEquations::residual(const SphereMap& map) const {
  const std::vector<double> areas = image_areas(map);
  double sum = 0;
  Eigen::Matrix<double, 6, 1> along = Eigen::Matrix<double, 6, 1>::Zero();   // NᵀM W⁻¹ F
  Eigen::Matrix<double, 6, 6> metric = Eigen::Matrix<double, 6, 6>::Zero();  // NᵀM W⁻¹ M N
  for (Vertex i = 0; i < topology_.vertex_count(); ++i) {
    const Vector3 x = map.point(i), pull = rings_.pull(map.points, i);
    const double total = totals_[static_cast<size_t>(i)];
    const double area = areas[static_cast<size_t>(i)];
    sum += (pull - pull.dot(x) * x).squaredNorm() / total;
    const Fields fields = conformal_fields(x);
    along += area / total * fields.transpose() * pull;
    metric += area * area / total * fields.transpose() * fields;
  }
  // What is no number stays one, in this order: it solves nothing.
  return std::sqrt(std::max(sum - along.dot(metric.ldlt().solve(along)), 0.0));
}

TutteSolution TutteEquations::sweep(SphereMap map, int max_sweeps, const Progress& progress) const {
  TutteSolution best{std::move(map)};
  best.first_residual = residual(best.map);
  if (best.first_residual == 0) best.residual = 0;
  TutteSolution now = best;
  while (now.sweeps < max_sweeps && best.residual > 0) {
    report(progress, "Gauss–Seidel", double(now.sweeps) / max_sweeps);
    const int count = std::min(check_every, max_sweeps - now.sweeps);
    for (int k = 0; k < count; ++k) {
      for (Vertex i = 0; i < topology_.vertex_count(); ++i) {
        const Vector3 x = now.map.point(i);
        const Vector3 mean = x + rings_.pull(now.map.points, i) / totals_[static_cast<size_t>(i)];
        if (mean.squaredNorm() > 0) now.map.points.row(i) = mean.normalized();
      }
    }
    now.sweeps += count;
    now.residual = residual(now.map) / best.first_residual;
    if (!(now.residual < best.residual)) break;
    best = now;
  }
  return best;
}

VectorX TutteEquations::newton_step(VertexSystem& system, const SphereMap& map) const {
  const size_t n = static_cast<size_t>(topology_.vertex_count());
  std::vector<double> diagonal(4 * n, 0);
  std::vector<double> off_diagonal(4 * static_cast<size_t>(topology_.halfedge_count()));
  Eigen::MatrixXd sides(2 * topology_.vertex_count(), 7);  // F, M N
  const std::vector<double> areas = image_areas(map);
  for (Vertex i = 0; i < topology_.vertex_count(); ++i) {
    const Vector3 x = map.point(i), pull = rings_.pull(map.points, i);
    const double total = totals_[static_cast<size_t>(i)];
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(x);
    sides.block<2, 1>(2 * i, 0) = basis.transpose() * pull;
    sides.block<2, 6>(2 * i, 1) =
        areas[static_cast<size_t>(i)] * basis.transpose() * conformal_fields(x);
    double alpha = x.dot(pull);
    topology_.for_each_outgoing(i, [&](Halfedge h) {
      alpha += weights_[static_cast<size_t>(h)];
      const Eigen::Matrix2d block = -weights_[static_cast<size_t>(h)] * basis.transpose() *
                                    tangent_basis(map.point(topology_.target(h)));
      double* out = off_diagonal.data() + 4 * static_cast<size_t>(h);
      out[0] = block(0, 0), out[1] = block(0, 1), out[2] = block(1, 0), out[3] = block(1, 1);
    });
    diagonal[4 * static_cast<size_t>(i)] = diagonal[4 * static_cast<size_t>(i) + 3] =
        alpha + shift * total;
  }
  system.factorise(diagonal, off_diagonal);
  const Eigen::MatrixXd solved = system.solve(sides);
  // d = H⁻¹(F − M N c) with Nᵀ M d = 0.
  const Eigen::Matrix<double, 6, 7> projected = sides.rightCols<6>().transpose() * solved;
  const Eigen::Matrix<double, 6, 1> c =
      projected.rightCols<6>().fullPivLu().solve(projected.col(0));
  return solved.col(0) - solved.rightCols<6>() * c;
}

TutteSolution TutteEquations::newton(TutteSolution now, int max_steps, double tolerance,
                                     const Progress& progress) const {
  VertexSystem system(topology_, 2);
  while (now.steps < max_steps && now.residual > tolerance) {
    report(progress, "Newton", double(now.steps) / max_steps);
    const VectorX step = newton_step(system, now.map);
    double longest = 0;
    for (Eigen::Index i = 0; i < step.size(); i += 2) {
      longest = std::max(longest, step.segment<2>(i).norm());
    }
    double share = longest > longest_move ? longest_move / longest : 1;
    const double shortest = shortest_step * share;
    SphereMap next;
    double value = now.residual;
    for (; share >= shortest; share /= 2) {
      next = moved(now.map, step, share);
      value = residual(next) / now.first_residual;
      if (value < now.residual) break;
    }
    if (!(value < now.residual)) break;
    now.map = std::move(next);
    now.residual = value;
    ++now.steps;
  }
  return now;
}

}  // namespace sphparam
