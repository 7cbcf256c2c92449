// Does with Eigen what the library does with it too: multiplies, factorises, decomposes. A program
// that does has templates of its own by the names of the library's, and of two by one name a linker
// keeps one. It is enough to link it: it works once, before main.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/Sparse>
#include <cstdlib>

namespace {

constexpr int size = 40;

/// Symmetric, positive definite: 4 on the diagonal, −1 beside it.
Eigen::MatrixXd chain() {
  Eigen::MatrixXd matrix = 4 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 1; i < size; ++i) matrix(i, i - 1) = matrix(i - 1, i) = -1;
  return matrix;
}

bool solves_sparse(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b) {
  const Eigen::SparseMatrix<double> columns = matrix.sparseView();
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = columns;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> lower(columns);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper,
                              Eigen::NaturalOrdering<int>>
      upper(columns);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(columns);
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>,
                           Eigen::Lower | Eigen::Upper>
      gradients(rows);
  const auto right = [&](const Eigen::VectorXd& x) { return (matrix * x).isApprox(b, 1e-6); };
  return right(lower.solve(b)) && right(upper.solve(b)) && right(lu.solve(b)) &&
         right(gradients.solve(b));
}

bool decomposes(const Eigen::Matrix3d& small) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(small, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(small);
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(small);
  const Eigen::Matrix3d q = qr.householderQ();
  return (svd.matrixU() * svd.singularValues().asDiagonal() * svd.matrixV().transpose())
             .isApprox(small) &&
         (small * eigen.eigenvectors())
             .isApprox(eigen.eigenvectors() * eigen.eigenvalues().asDiagonal()) &&
         (q * q.transpose()).isApprox(Eigen::Matrix3d::Identity());
}

bool uses_eigen() {
  const Eigen::MatrixXd matrix = chain();
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(size);
  const Eigen::MatrixXd square = matrix * matrix;
  return solves_sparse(matrix, b) && decomposes(matrix.topLeftCorner<3, 3>()) &&
         (square * square.llt().solve(b)).isApprox(b, 1e-6) &&
         (square * square.ldlt().solve(b)).isApprox(b, 1e-6);
}

const bool used = uses_eigen() || (std::abort(), false);

}  // namespace
