#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

#include "folded_maps.h"
#include "sphparam/embedding/distortion_energy.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const std::vector<DistortionEnergy> energies{
    {.lambda = 1},
    {.lambda = 1e-3},
    {.kind = EnergyKind::SymmetricDirichlet},
    {.lambda = 2, .epsilon = 0.3},
    {.kind = EnergyKind::SymmetricDirichlet, .epsilon = 0.3},
};

double random_number(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1;
}

Vector3 random_vector(std::mt19937& random) {
  return {random_number(random), random_number(random), random_number(random)};
}

TriangleMesh one_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  TriangleMesh mesh;
  mesh.positions.resize(3, 3);
  mesh.positions << a.transpose(), b.transpose(), c.transpose();
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  return mesh;
}

struct Sample {
  RestTriangle source;
  ImageTriangle image;
  std::array<TangentFrame, 3> frames;

  ImageTriangle moved(const Eigen::Matrix<double, 6, 1>& tau) const {
    ImageTriangle result;
    for (size_t k = 0; k < 3; ++k) {
      const Eigen::Index i = 2 * static_cast<Eigen::Index>(k);
      result[k] = frames[k].at(image[k], tau[i], tau[i + 1]);
    }
    return result;
  }
};

/// A random rest triangle and a random, positive image of moderate shape.
Sample random_sample(std::mt19937& random) {
  for (;;) {
    Sample sample;
    const TriangleMesh mesh =
        one_triangle(random_vector(random), random_vector(random), random_vector(random));
    sample.source = scaled(measure_source(mesh)[0], 0.05);
    const Vector3 centre = random_vector(random);
    for (size_t k = 0; k < 3; ++k) {
      sample.image[k] = (centre.normalized() + 0.4 * random_vector(random)).normalized();
      sample.frames[k] = tangent_frame(sample.image[k]);
    }
    const auto [d, s] = distortion(sample.source, sample.image);
    if (s > 0.1 && d < 20) return sample;
  }
}

}  // namespace

TEST_CASE("distortion_energy: the derivatives of f are those of f") {
  constexpr double h = 1e-5;
  for (const DistortionEnergy& energy : energies) {
    for (const double d : {0.7, 1.0, 9.0}) {
      for (const double s : {0.3, 1.0, 4.0, -0.2, 0.0}) {
        if (s <= 0 && energy.epsilon == 0) continue;
        const EnergyDerivatives f = differentiate(energy, d, s);
        const EnergyDerivatives above = differentiate(energy, d, s + h);
        const EnergyDerivatives below = differentiate(energy, d, s - h);
        const double f_d = (differentiate(energy, d + h, s).f - differentiate(energy, d - h, s).f);
        CHECK(f.f == energy_density(energy, d, s));
        CHECK(f.f_d == Approx(f_d / (2 * h)).epsilon(1e-6));
        CHECK(f.f_s == Approx((above.f - below.f) / (2 * h)).epsilon(1e-6).margin(1e-7));
        CHECK(f.f_ss == Approx((above.f_s - below.f_s) / (2 * h)).epsilon(1e-6).margin(1e-7));
        CHECK(f.f_ds == Approx((above.f_d - below.f_d) / (2 * h)).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("distortion_energy: a triangle's gradient and Hessian are those of its energy") {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    Sample sample = random_sample(random);
    const DistortionEnergy& energy = energies[static_cast<size_t>(i) % energies.size()];
    if (energy.epsilon > 0 && i % 2 == 0) {  // the regularised energy on folds, too
      std::swap(sample.image[0], sample.image[1]);
      std::swap(sample.frames[0], sample.frames[1]);
    }
    const TriangleEnergy exact =
        triangle_energy(energy, sample.source, sample.image, sample.frames);
    CHECK((exact.hessian - exact.hessian.transpose()).norm() < 1e-14 * exact.hessian.norm());
    const auto value = [&](const Eigen::Matrix<double, 6, 1>& tau) {
      const auto [d, s] = distortion(sample.source, sample.moved(tau));
      return sample.source.area * energy_density(energy, d, s);
    };
    constexpr double h = 2e-4;
    Eigen::Matrix<double, 6, 1> gradient;
    Eigen::Matrix<double, 6, 6> hessian;
    for (int a = 0; a < 6; ++a) {
      const Eigen::Matrix<double, 6, 1> ea = h * Eigen::Matrix<double, 6, 1>::Unit(a);
      // Fourth order: the energy bends sharply near a fold.
      gradient[a] = (8 * (value(ea) - value(-ea)) - value(2 * ea) + value(-2 * ea)) / (12 * h);
      for (int b = 0; b < 6; ++b) {
        const Eigen::Matrix<double, 6, 1> eb = h * Eigen::Matrix<double, 6, 1>::Unit(b);
        hessian(a, b) =
            (value(ea + eb) - value(ea - eb) - value(eb - ea) + value(-ea - eb)) / (4 * h * h);
      }
    }
    CHECK(exact.value == Approx(value(Eigen::Matrix<double, 6, 1>::Zero())));
    CHECK((exact.gradient - gradient).norm() < 1e-5 * exact.gradient.norm() + 1e-8);
    CHECK((exact.hessian - hessian).norm() < 1e-3 * exact.hessian.norm());
  }
}

TEST_CASE("distortion_energy: d is the cotangent energy over 4A, s the determinant over 2A") {
  std::mt19937 random(11);
  for (int i = 0; i < 100; ++i) {
    const std::array<Vector3, 3> v{random_vector(random), random_vector(random),
                                   random_vector(random)};
    const RestTriangle source = measure_source(one_triangle(v[0], v[1], v[2]))[0];
    const ImageTriangle x{random_vector(random), random_vector(random), random_vector(random)};
    double sum = 0;  // Σ c_k |e_k|² with the cotangent of the source's angle k
    for (size_t k = 0; k < 3; ++k) {
      const Vector3 a = v[(k + 1) % 3] - v[k], b = v[(k + 2) % 3] - v[k];
      sum += a.dot(b) / a.cross(b).norm() * (x[(k + 1) % 3] - x[(k + 2) % 3]).squaredNorm();
    }
    const auto [d, s] = distortion(source, x);
    CHECK(source.area == Approx(4 * std::numbers::pi));
    CHECK(d == Approx(sum / (4 * source.area)));
    CHECK(s == Approx(x[0].dot(x[1].cross(x[2])) / (2 * source.area)).margin(1e-14));
  }
}

TEST_CASE("distortion_energy: renumbering the corners changes nothing") {
  std::mt19937 random(13);
  for (int i = 0; i < 100; ++i) {
    const Sample sample = random_sample(random);
    const auto [d, s] = distortion(sample.source, sample.image);
    for (int k = 1; k < 3; ++k) {
      const size_t n = static_cast<size_t>(k);
      const RestTriangle other = rotated(sample.source, k);
      const auto [d2, s2] = distortion(
          other, {sample.image[n], sample.image[(n + 1) % 3], sample.image[(n + 2) % 3]});
      CHECK(other.area == sample.source.area);
      CHECK(d2 == Approx(d));
      CHECK(s2 == Approx(s));
    }
    const auto [d3, s3] = distortion(scaled(sample.source, 4), sample.image);
    CHECK(d3 == Approx(d / 4));
    CHECK(s3 == Approx(s / 4));
  }
}

TEST_CASE("distortion_energy: frames are right-handed and orthonormal everywhere") {
  std::mt19937 random(17);
  std::vector<Vector3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 1, -0.0}};
  for (int i = 0; i < 1000; ++i) directions.push_back(random_vector(random).normalized());
  for (int i = 1; i < 300; i += 30) {
    directions.push_back(Vector3(std::pow(10.0, -i), 0, -1).normalized());
  }
  for (const Vector3& x : directions) {
    const TangentFrame frame = tangent_frame(x);
    Eigen::Matrix3d m;
    m << frame.u, frame.v, x;
    CHECK((m.transpose() * m - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(m.determinant() > 0);
  }
}

TEST_CASE("distortion_energy: a fold or a flat triangle costs +inf, with epsilon a finite price") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  SphereMap map{mesh.positions};
  CHECK(std::isfinite(distortion_energy(topology, source, map, {})));
  const Vertex v = 20, w = topology.target(topology.outgoing(v));
  SphereMap flat = map, folded = map;
  flat.points.row(v) = flat.points.row(w);
  folded.points.row(v) = -folded.points.row(v);
  for (const SphereMap& bad : {flat, folded}) {
    for (DistortionEnergy energy : energies) {
      CHECK(std::isfinite(distortion_energy(topology, source, bad, energy)) ==
            (energy.epsilon > 0));
      energy.epsilon = 1e-3;
      CHECK(distortion_energy(topology, source, bad, energy) > 100);
    }
  }
}

TEST_CASE(
    "distortion_energy: an isometry of a fine sphere costs little more than 4 pi (1 + lambda)") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map{mesh.positions};
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const double least = 4 * std::numbers::pi * (1 + lambda);
    const double isometry = distortion_energy(topology, source, map, {.lambda = lambda});
    CHECK(isometry > 0.999 * least);
    CHECK(isometry < 1.005 * least);
    CHECK(distortion_energy(topology, source, with_noise(map, 0.01, 1), {.lambda = lambda}) >
          1.001 * isometry);
  }
  const DistortionEnergy dirichlet{.kind = EnergyKind::SymmetricDirichlet};
  CHECK(distortion_energy(topology, source, map, dirichlet) ==
        Approx(2 * 4 * std::numbers::pi).epsilon(0.005));
}

TEST_CASE(
    "distortion_energy: rotating the sphere changes nothing, nor do scale and place of the "
    "source") {
  TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const SphereMap map = with_noise({mesh.positions}, 0.02, 3);
  mesh.positions.col(0) *= 1.7;
  const double energy = distortion_energy(topology, measure_source(mesh), map, {});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vector3(1, 2, -2).normalized()).matrix();
  const SphereMap turned{map.points * turn.transpose()};
  CHECK(distortion_energy(topology, measure_source(mesh), turned, {}) == Approx(energy));
  for (const double scale : {1e-300, 1e-3, 1e300}) {
    TriangleMesh other = mesh;
    other.positions *= scale;
    CHECK(distortion_energy(topology, measure_source(other), map, {}) == Approx(energy));
  }
  mesh.positions.rowwise() += Eigen::RowVector3d(1e3, -1e3, 5e3);
  CHECK(distortion_energy(topology, measure_source(mesh), map, {}) == Approx(energy).epsilon(1e-9));
}

TEST_CASE("distortion_energy: degenerate rest triangles have finite constants and a floor") {
  const Vector3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  const std::vector<std::array<Vector3, 3>> shapes{{o, o, o},
                                                   {o, o, x},
                                                   {o, x, o},
                                                   {x, o, o},
                                                   {o, x, 3 * x},
                                                   {o, 1e-200 * x, y},
                                                   {o, x, 0.5 * x + 1e-12 * y},
                                                   {o, 1e-9 * x, 1e-9 * x + y}};
  for (const auto& shape : shapes) {
    // Beside a triangle of ordinary size.
    TriangleMesh mesh;
    mesh.positions.resize(6, 3);
    mesh.positions << shape[0].transpose(), shape[1].transpose(), shape[2].transpose(),
        o.transpose(), x.transpose(), y.transpose();
    mesh.triangles.resize(2, 3);
    mesh.triangles << 0, 1, 2, 3, 4, 5;
    const RestTriangle thin = measure_source(mesh)[0];
    CHECK(thin.area >= 0.99e-9 * 2 * std::numbers::pi);
    for (int k = 0; k < 3; ++k) {
      const RestTriangle t = rotated(thin, k);
      for (const double entry : {t.area, t.inverse_base, t.inverse_height}) {
        CHECK(std::isfinite(entry));
        CHECK(entry > 0);
      }
      CHECK(std::isfinite(t.foot));
      CHECK(2 * t.area * t.inverse_base * t.inverse_height == Approx(1).epsilon(1e-6));
    }
  }
  const RestTriangle nothing = measure_source(one_triangle(x, x, x))[0];
  CHECK(nothing.inverse_height / nothing.inverse_base == Approx(2 / std::numbers::sqrt3));
}

TEST_CASE("distortion_energy: the same bits for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(5);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = with_noise({mesh.positions}, 1e-3, 5);
  const double one = distortion_energy(topology, source, map, {}, 1);
  CHECK(distortion_energy(topology, source, map, {}, 2) == one);
  CHECK(distortion_energy(topology, source, map, {}, 4) == one);
}
