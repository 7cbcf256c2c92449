#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "embedding/multigrid/multigrid.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/topology.h"

namespace sphparam::tests {

/// The elastic network of a sphere mesh: Σ over edges of (δ|x_i − x_j|)², in tangent coordinates,
/// plus a weak foundation. It does not feel turns but for the foundation, as the real one.
struct Network {
  BlockMatrix<2> matrix;
  std::vector<ImagePoint> points;
  std::vector<float> units;
  SweepOrder order;

  explicit Network(const TriangleMesh& mesh, double foundation = 1e-6) {
    const Topology topology(mesh);
    const int n = topology.vertex_count();
    matrix.start.push_back(0);
    for (Vertex v = 0; v < n; ++v) {
      const Vector3 x = mesh.position(v).normalized();
      points.push_back(image_point(x));
      const TangentFrame frame = tangent_frame(x);
      Eigen::Matrix2d diagonal = foundation * Eigen::Matrix2d::Identity();
      topology.for_each_outgoing(v, [&](Halfedge h) {
        const Vector3 y = mesh.position(topology.target(h)).normalized(), e = (y - x).normalized();
        const TangentFrame other = tangent_frame(y);
        const Eigen::Vector2d a(e.dot(frame.u), e.dot(frame.v)), b(e.dot(other.u), e.dot(other.v));
        diagonal += a * a.transpose();
        matrix.column.push_back(topology.target(h));
        matrix.off.push_back(block(-a * b.transpose()));
      });
      matrix.start.push_back(static_cast<int>(matrix.column.size()));
      matrix.diagonal.push_back(block(diagonal));
    }
    const double area = 4 * std::numbers::pi / n;
    units.assign(points.size(), static_cast<float>(std::sqrt(area)));
    order = order_sweeps(matrix.start, matrix.column, 64);
  }

  static Block<2> block(const Eigen::Matrix2d& a) {
    const Eigen::Matrix2f f = a.cast<float>();
    return {{f(0, 0), f(0, 1), f(1, 0), f(1, 1)}};
  }

  Multigrid multigrid() const { return {matrix, order, points.data(), units.data(), {}, 1}; }
  size_t size() const { return 2 * points.size(); }

  Eigen::VectorXd times(const Unknowns& x) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(x.size()));
    for (int r = 0; r < matrix.rows(); ++r) {
      const auto add = [&](int c, const Block<2>& b) {
        for (int i = 0; i < 2; ++i) {
          for (int j = 0; j < 2; ++j) y[2 * r + i] += b(i, j) * x[static_cast<size_t>(2 * c + j)];
        }
      };
      add(r, matrix.diagonal[static_cast<size_t>(r)]);
      for (int e = matrix.start[static_cast<size_t>(r)];
           e < matrix.start[static_cast<size_t>(r) + 1]; ++e) {
        add(matrix.column[static_cast<size_t>(e)], matrix.off[static_cast<size_t>(e)]);
      }
    }
    return y;
  }
};

inline Unknowns random_vector(size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  Unknowns x(size);
  for (double& v : x) v = static_cast<double>(generator() % 2001) / 1000 - 1;
  return x;
}

inline double dot(const Unknowns& a, const Unknowns& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace sphparam::tests
