#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

#include "embedding/multigrid.h"
#include "embedding/triangle_packs.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// The elastic network of a sphere mesh: Σ over edges of (δ|x_i − x_j|)², in tangent coordinates,
/// plus a weak foundation. It does not feel turns but for the foundation, as the real one.
struct Network {
  BlockMatrix<2> matrix;
  std::vector<ImagePoint> points;
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
        matrix.off.push_back({{-a[0] * b[0], -a[0] * b[1], -a[1] * b[0], -a[1] * b[1]}});
      });
      matrix.start.push_back(static_cast<int>(matrix.column.size()));
      matrix.diagonal.push_back({{diagonal(0, 0), diagonal(0, 1), diagonal(1, 0), diagonal(1, 1)}});
    }
    order = order_sweeps(matrix.start, matrix.column, 64);
  }

  Multigrid multigrid() const { return {matrix, order, points.data(), {}, 1}; }
  size_t size() const { return 2 * points.size(); }

  Eigen::VectorXd times(const std::vector<double>& x) const {
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

std::vector<double> random_vector(size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> x(size);
  for (double& v : x) v = static_cast<double>(generator() % 2001) / 1000 - 1;
  return x;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

TEST_CASE("multigrid: a V-cycle is symmetric and positive definite") {
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  REQUIRE(multigrid.levels() >= 2);
  const std::vector<double> a = random_vector(network.size(), 1),
                            b = random_vector(network.size(), 2);
  std::vector<double> ma(a.size()), mb(b.size());
  multigrid.apply(a, ma);
  multigrid.apply(b, mb);
  CHECK(dot(a, mb) == Approx(dot(b, ma)).epsilon(1e-9));
  CHECK(dot(a, ma) > 0);
  CHECK(dot(b, mb) > 0);
}

TEST_CASE(
    "multigrid: conjugate gradients solve to the tolerance, in about as many iterations at "
    "any size") {
  int before = 0;
  for (const int level : {3, 4, 5}) {
    const Network network(icosphere(level));
    Multigrid multigrid = network.multigrid();
    const std::vector<double> b = random_vector(network.size(), 3);
    const LinearSolution s =
        solve_by_conjugate_gradients(network.matrix, multigrid, b, 1e-9, 200, 1);
    const Eigen::Map<const Eigen::VectorXd> rhs(b.data(), static_cast<Eigen::Index>(b.size()));
    CHECK((network.times(s.x) - rhs).norm() < 1e-6 * rhs.norm());
    CHECK(s.iterations < 60);
    if (before > 0) CHECK(s.iterations < 2 * before);
    before = s.iterations;
  }
}

TEST_CASE("multigrid: turns of the whole sphere are solved on the coarsest level") {
  // Only the foundation resists a turn: without the rotations among the modes this takes hundreds.
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  std::vector<double> turn;
  for (const ImagePoint& p : network.points) {
    const Vector3 velocity = Vector3(0.3, -0.5, 0.8).cross(p.vector());
    const TangentFrame frame = tangent_frame(p.vector());
    turn.push_back(velocity.dot(frame.u));
    turn.push_back(velocity.dot(frame.v));
  }
  const LinearSolution s =
      solve_by_conjugate_gradients(network.matrix, multigrid, turn, 1e-2, 50, 1);
  CHECK(s.iterations <= 5);
  CHECK(dot(s.x, turn) == Approx(1e6 * dot(turn, turn)).epsilon(0.2));
}

TEST_CASE("multigrid: pinned rows do not move, the same bits for any number of threads") {
  Network network(icosphere(5));
  std::vector<char> pinned(network.points.size(), 0);
  pinned[7] = pinned[100] = 1;
  BlockMatrix<2>& a = network.matrix;
  for (int r = 0; r < a.rows(); ++r) {
    const auto row = static_cast<size_t>(r);
    for (int e = a.start[row]; e < a.start[row + 1]; ++e) {
      if (pinned[row] || pinned[static_cast<size_t>(a.column[static_cast<size_t>(e)])]) {
        a.off[static_cast<size_t>(e)] = {};
      }
    }
    if (pinned[row]) a.diagonal[row] = {{1, 0, 0, 1}};
  }
  std::vector<double> b = random_vector(network.size(), 4);
  for (const size_t v : {7u, 100u}) b[2 * v] = b[2 * v + 1] = 0;
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    Multigrid multigrid(a, network.order, network.points.data(), pinned, threads);
    const LinearSolution s = solve_by_conjugate_gradients(a, multigrid, b, 1e-3, 20, threads);
    CHECK(s.x[14] == 0);
    CHECK(s.x[201] == 0);
    if (first.empty()) first = s.x;
    CHECK(s.x == first);
  }
}

TEST_CASE("order_sweeps: every block once, no two of a colour share an entry") {
  const Network network(icosphere(4));
  const SweepOrder& order = network.order;
  std::vector<int> seen(order.first_row.size() - 1, 0), colour_of(seen.size());
  for (size_t c = 0; c + 1 < order.colour_start.size(); ++c) {
    for (int k = order.colour_start[c]; k < order.colour_start[c + 1]; ++k) {
      const auto block = static_cast<size_t>(order.blocks[static_cast<size_t>(k)]);
      ++seen[block];
      colour_of[block] = static_cast<int>(c);
    }
  }
  CHECK(seen == std::vector<int>(seen.size(), 1));
  for (int r = 0; r < network.matrix.rows(); ++r) {
    for (int e = network.matrix.start[static_cast<size_t>(r)];
         e < network.matrix.start[static_cast<size_t>(r) + 1]; ++e) {
      const auto other = static_cast<size_t>(network.matrix.column[static_cast<size_t>(e)] / 64);
      const auto own = static_cast<size_t>(r / 64);
      if (other != own && colour_of[other] == colour_of[own]) FAIL("blocks of a colour touch");
    }
  }
}

TEST_CASE("triangle packs: energy and gradient are those of the scalar formulas") {
  TriangleMesh mesh = icosphere(1);
  mesh.positions.col(2) *= 1.7;
  const Topology topology(mesh);
  const SourceTriangles source = measure_source(mesh);
  std::vector<ImagePoint> points;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    points.push_back(image_point(Vector3(mesh.position(v) + Vector3(0.1, 0, 0.05)).normalized()));
  }
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const DistortionEnergy energy{.kind = kind, .lambda = 0.4};
    TrianglePack pack{};
    pack.filled = pack_width;
    for (int lane = 0; lane < pack_width; ++lane) {
      const SourceTriangle& s = source[static_cast<size_t>(lane)];
      pack.inverse_base[lane] = s.inverse_base;
      pack.inverse_height[lane] = s.inverse_height;
      pack.foot[lane] = s.foot;
      pack.area[lane] = s.area;
      for (int k = 0; k < 3; ++k) pack.corner[k][lane] = topology.vertex(lane, k);
    }
    TriangleTerms terms;
    differentiate_triangles(&pack, 1, points.data(), energy, &terms);
    double sum = 0;
    for (int lane = 0; lane < pack_width; ++lane) {
      ImageTriangle image;
      std::array<TangentFrame, 3> frames;
      for (int k = 0; k < 3; ++k) {
        const auto corner = static_cast<size_t>(k);
        image[corner] = points[static_cast<size_t>(topology.vertex(lane, k))].vector();
        frames[corner] = tangent_frame(image[corner]);
      }
      const TriangleEnergy exact =
          triangle_energy(energy, source[static_cast<size_t>(lane)], image, frames);
      sum += exact.value;
      Eigen::Matrix<double, 6, 6> hessian;
      for (int k = 0; k < 3; ++k) {
        const int i = 2 * k, j = 2 * ((k + 1) % 3);
        for (int p = 0; p < 2; ++p) {
          CHECK(terms.gradient[k][p][lane] == Approx(exact.gradient[i + p]).margin(1e-12));
          for (int q = 0; q < 2; ++q) {
            hessian(i + p, i + q) = terms.diagonal[k][p + q][lane];
            hessian(i + p, j + q) = hessian(j + q, i + p) = terms.off[k][2 * p + q][lane];
          }
        }
      }
      // Positive semidefinite, of rank at most four; equal to the exact one in shape directions
      // where that is positive is what makes Newton converge: see test_optimise.cpp.
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(hessian);
      CHECK(eigen.eigenvalues()[0] > -1e-12 * eigen.eigenvalues()[5]);
      CHECK(eigen.eigenvalues()[1] < 1e-12 * eigen.eigenvalues()[5]);
    }
    CHECK(guarded_energy(&pack, 1, points.data(), energy) == Approx(sum).epsilon(1e-13));
  }
}

TEST_CASE("triangle packs: a triangle that is not certain to be positive costs infinity") {
  TrianglePack pack{};
  pack.filled = 1;
  for (int lane = 0; lane < pack_width; ++lane) {
    pack.inverse_base[lane] = pack.inverse_height[lane] = pack.area[lane] = 1;
    for (int k = 0; k < 3; ++k) pack.corner[k][lane] = k;
  }
  const Vector3 x(0, 0, 1), y = Vector3(1e-3, 0, 1).normalized();
  for (const double offset : {1e-6, -1e-6, 0.0, 1e-19}) {
    const Vector3 z = Vector3(5e-4, offset, 1).normalized();
    const std::vector<ImagePoint> points{image_point(x), image_point(y), image_point(z)};
    CHECK(std::isfinite(guarded_energy(&pack, 1, points.data(), {})) == (offset == 1e-6));
  }
}
