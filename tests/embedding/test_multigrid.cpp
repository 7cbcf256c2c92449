#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
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

Unknowns random_vector(size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  Unknowns x(size);
  for (float& v : x) v = static_cast<float>(generator() % 2001) / 1000 - 1;
  return x;
}

double dot(const Unknowns& a, const Unknowns& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

}  // namespace

TEST_CASE("multigrid: a V-cycle is symmetric and positive definite") {
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  REQUIRE(multigrid.levels() >= 2);
  const Unknowns a = random_vector(network.size(), 1), b = random_vector(network.size(), 2);
  Unknowns ma(a.size()), mb(b.size()), room(a.size());
  multigrid.apply(a, ma, room);
  multigrid.apply(b, mb, room);
  CHECK(dot(a, mb) == Approx(dot(b, ma)).epsilon(1e-4));
  CHECK(dot(a, ma) > 0);
  CHECK(dot(b, mb) > 0);
}

TEST_CASE(
    "multigrid: conjugate gradients solve to the tolerance, in about as many iterations at "
    "any size") {
  int before = 0;
  for (const int level : {3, 4, 5}) {
    const Network network(icosphere(level), 1e-3);  // turns 1e6 times too large would drown floats
    Multigrid multigrid = network.multigrid();
    const Unknowns b = random_vector(network.size(), 3);
    const LinearSolution s =
        solve_by_conjugate_gradients(network.matrix, multigrid, b, 1e-5, 200, 1);
    const Eigen::VectorXd rhs =
        Eigen::Map<const Eigen::VectorXf>(b.data(), static_cast<Eigen::Index>(b.size()))
            .cast<double>();
    CHECK((network.times(s.x) - rhs).norm() < 1e-3 * rhs.norm());
    CHECK(s.gain == Approx(dot(b, s.x)).epsilon(1e-3));
    CHECK(s.iterations < 60);
    if (before > 0) CHECK(s.iterations < 2 * before);
    before = s.iterations;
  }
}

TEST_CASE("multigrid: turns of the whole sphere are solved on the coarsest level") {
  // Only the foundation resists a turn: without the rotations among the modes this takes hundreds.
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  Unknowns turn;
  for (const ImagePoint& p : network.points) {
    const Vector3 velocity = Vector3(0.3, -0.5, 0.8).cross(p.vector());
    const TangentFrame frame = tangent_frame(p.vector());
    turn.push_back(static_cast<float>(velocity.dot(frame.u)));
    turn.push_back(static_cast<float>(velocity.dot(frame.v)));
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
  Unknowns b = random_vector(network.size(), 4);
  for (const size_t v : {7u, 100u}) b[2 * v] = b[2 * v + 1] = 0;
  Unknowns first;
  for (const int threads : {1, 2, 3}) {
    Multigrid multigrid(a, network.order, network.points.data(), network.units.data(), pinned,
                        threads);
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
    std::array<SourceTriangle, pack_width> rounded;
    for (int lane = 0; lane < pack_width; ++lane) {
      const SourceTriangle& s = source[static_cast<size_t>(lane)];
      fill_lane(s, {topology.vertex(lane, 0), topology.vertex(lane, 1), topology.vertex(lane, 2)},
                lane, pack);
      const double base = pack.inverse_base[lane], height = pack.inverse_height[lane];
      rounded[static_cast<size_t>(lane)] = {0.5 / (base * height), base, height, pack.foot[lane]};
      CHECK(rounded[static_cast<size_t>(lane)].area == Approx(s.area).epsilon(1e-6));
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
          triangle_energy(energy, rounded[static_cast<size_t>(lane)], image, frames);
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
      // Positive semidefinite, of rank at most four, up to the rounding of floats; equal to the
      // exact one in shape directions where that is positive is what makes Newton converge: see
      // test_optimise.cpp.
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(hessian);
      CHECK(eigen.eigenvalues()[0] > -1e-6 * eigen.eigenvalues()[5]);
      CHECK(eigen.eigenvalues()[1] < 1e-6 * eigen.eigenvalues()[5]);
    }
    CHECK(guarded_energy(&pack, pack_width, points.data(), energy) == Approx(sum).epsilon(1e-13));
    CHECK(guarded_energy(&pack, 1, points.data(), energy) < sum);
  }
}

TEST_CASE("triangle packs: a triangle that is not certain to be positive costs infinity") {
  TrianglePack pack{};
  for (int lane = 0; lane < pack_width; ++lane) fill_lane({0.5, 1, 1, 0.5}, {0, 1, 2}, lane, pack);
  const Vector3 x(0, 0, 1), y = Vector3(1e-3, 0, 1).normalized();
  for (const double offset : {1e-6, -1e-6, 0.0, 1e-19}) {
    const Vector3 z = Vector3(5e-4, offset, 1).normalized();
    const std::vector<ImagePoint> points{image_point(x), image_point(y), image_point(z)};
    CHECK(std::isfinite(guarded_energy(&pack, 1, points.data(), {})) == (offset == 1e-6));
  }
}
