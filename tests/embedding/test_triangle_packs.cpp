#include <Eigen/Eigenvalues>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "embedding/energy/triangle_packs.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("triangle packs: energy and gradient are those of the scalar formulas") {
  TriangleMesh mesh = icosphere(1);
  mesh.positions.col(2) *= 1.7;
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  std::vector<ImagePoint> points;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    points.push_back(image_point(Vector3(mesh.position(v) + Vector3(0.1, 0, 0.05)).normalized()));
  }
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const DistortionEnergy energy{.kind = kind, .lambda = 0.4};
    TrianglePack pack{};
    std::array<RestTriangle, pack_width> rounded;
    for (int lane = 0; lane < pack_width; ++lane) {
      const RestTriangle& s = source[static_cast<size_t>(lane)];
      fill_lane(s, {topology.vertex(lane, 0), topology.vertex(lane, 1), topology.vertex(lane, 2)},
                lane, pack);
      const double base = pack.inverse_base[lane], height = pack.inverse_height[lane];
      rounded[static_cast<size_t>(lane)] = {0.5 / (base * height), base, height, pack.foot[lane]};
      CHECK(rounded[static_cast<size_t>(lane)].area == Approx(s.area).epsilon(1e-6));
    }
    const auto exact_energy = [&](int lane) {
      ImageTriangle image;
      std::array<TangentFrame, 3> frames;
      for (int k = 0; k < 3; ++k) {
        const auto corner = static_cast<size_t>(k);
        image[corner] = points[static_cast<size_t>(topology.vertex(lane, k))].vector();
        frames[corner] = tangent_frame(image[corner]);
      }
      return triangle_energy(energy, rounded[static_cast<size_t>(lane)], image, frames);
    };
    TriangleTerms terms;
    differentiate_triangles(&pack, 1, points.data(), energy, Curvature::Projected, &terms);
    double sum = 0, first = 0;
    for (int lane = 0; lane < pack_width; ++lane) {
      const TriangleEnergy exact = exact_energy(lane);
      sum += exact.value;
      if (lane == 0) first = exact.value;
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
    differentiate_triangles(&pack, 1, points.data(), energy, Curvature::Exact, &terms);
    for (int lane = 0; lane < pack_width; ++lane) {
      const TriangleEnergy exact = exact_energy(lane);
      for (int k = 0; k < 3; ++k) {
        const int i = 2 * k, j = 2 * ((k + 1) % 3);
        for (int p = 0; p < 2; ++p) {
          CHECK(terms.gradient[k][p][lane] == Approx(exact.gradient[i + p]).margin(1e-12));
          for (int q = 0; q < 2; ++q) {
            CHECK(terms.diagonal[k][p + q][lane] ==
                  Approx(exact.hessian(i + p, i + q)).margin(1e-11));
            CHECK(terms.off[k][2 * p + q][lane] ==
                  Approx(exact.hessian(i + p, j + q)).margin(1e-11));
          }
        }
      }
    }
    CHECK(guarded_energy(&pack, pack_width, points.data(), energy) == Approx(sum).epsilon(1e-13));
    // Triangles beyond `count` are guarded, and not counted.
    CHECK(guarded_energy(&pack, 1, points.data(), energy) == Approx(first).epsilon(1e-13));
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
