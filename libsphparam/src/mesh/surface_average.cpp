#include "mesh/surface_average.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <utility>
#include <vector>

#include "sphparam/errors.h"

// L is the Laplacian with weights 2 A_e/|e|², A_e a third of the two triangles: cotangents where
// triangles are equilateral, positive always. Its columns sum to 0, so Σ A h = Σ m; A + ½s² L is
// an M-matrix, so h stays between the extremes of m/A.

namespace sphparam {
namespace {

constexpr int least_exponent = -1000;
constexpr double glue_share = 1e6;   // ½s²·weight of an edge without length, in mean areas
constexpr double tolerance = 1e-10;  // of the residual
constexpr int max_iterations = 20'000;

/// A + ½s² L.
Eigen::SparseMatrix<double, Eigen::RowMajor> averaging_matrix(const TriangleMesh& mesh,
                                                              const Topology& topology,
                                                              const VectorX& face_area,
                                                              const VectorX& area, double scale) {
  const Eigen::Index count = area.size();
  const double time = scale * scale / 2, glue = glue_share * area.mean();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(count + topology.halfedge_count()));
  for (Vertex v = 0; v < count; ++v) {
    double diagonal = area[v];
    topology.for_each_outgoing(v, [&](Halfedge h) {
      const double shared =
          (face_area[Topology::face(h)] + face_area[Topology::face(topology.twin(h))]) / 3;
      const double squared =
          (mesh.position(topology.target(h)) - mesh.position(topology.origin(h))).squaredNorm();
      const double weight = time * 2 * shared;
      const double w = weight < glue * squared ? weight / squared : glue;
      entries.emplace_back(v, topology.target(h), -w);
      diagonal += w;
    });
    entries.emplace_back(v, v, diagonal);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// For sizes that differ too much for iterations. Throws: SolveError.
Eigen::VectorXd solved_directly(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                                const Eigen::VectorXd& measure) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  Eigen::VectorXd density = factor.solve(measure);
  if (factor.info() != Eigen::Success || !density.allFinite())
    throw SolveError("an average over a distance on the surface was not found");
  return density;
}

}  // namespace

SurfaceAverage::SurfaceAverage(const TriangleMesh& mesh, const Topology& topology,
                               const VectorX& face_area, VectorX area, double scale)
    : area_(std::move(area)),
      unit_(std::ldexp(1.0, -std::max(std::ilogb(area_.mean()), least_exponent))),
      matrix_(unit_ * averaging_matrix(mesh, topology, face_area, area_, scale)) {
  solver_.setTolerance(tolerance);
  solver_.setMaxIterations(max_iterations);
  solver_.compute(matrix_);
}

VectorX SurfaceAverage::operator()(const VectorX& measure) const {
  const VectorX raw = measure.cwiseQuotient(area_) / unit_;
  const VectorX density = solver_.solveWithGuess(measure, raw);
  if (solver_.info() == Eigen::Success && density.allFinite()) return unit_ * density;
  return unit_ * solved_directly(matrix_, measure);
}

}  // namespace sphparam
