#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sphparam/errors.h"
#include "sphparam/sphere/spherical_harmonics.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;

Points random_directions(int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Points points(count, 3);
  for (int i = 0; i < count; ++i) {
    points.row(i) = Vector3(normal(random), normal(random), normal(random)).normalized();
  }
  return points;
}

Functions random_coefficients(int degree, int functions, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Functions c((degree + 1) * (degree + 1), functions);
  for (Eigen::Index i = 0; i < c.size(); ++i) c.data()[i] = uniform(random);
  return c;
}

Functions basis(int degree) {
  const int n = (degree + 1) * (degree + 1);
  return Functions::Identity(n, n);
}

SphereMap map_of(const TriangleMesh& sphere) { return {sphere.positions}; }

/// A sphere whose vertices are denser on one side: carried by a Möbius transformation.
SphereMap uneven(const TriangleMesh& sphere) {
  const Vector3 a(0.2, -0.1, 0.3);
  SphereMap map = map_of(sphere);
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    const Vector3 x = map.points.row(v);
    map.points.row(v) =
        ((1 - a.squaredNorm()) * x + 2 * (1 + a.dot(x)) * a).normalized().transpose();
  }
  return map;
}

}  // namespace

TEST_CASE("spherical_harmonics: x, y and z are the first harmonics, without a phase") {
  const Points d = random_directions(50, 1);
  const Functions y = synthesise(basis(1), d);
  const double scale = std::sqrt(3 / (4 * pi));
  CHECK((y.col(harmonic_index(0, 0)).array() - std::sqrt(1 / (4 * pi))).abs().maxCoeff() < 1e-15);
  CHECK((y.col(harmonic_index(1, 1)) - scale * d.col(0)).cwiseAbs().maxCoeff() < 1e-15);
  CHECK((y.col(harmonic_index(1, -1)) - scale * d.col(1)).cwiseAbs().maxCoeff() < 1e-15);
  CHECK((y.col(harmonic_index(1, 0)) - scale * d.col(2)).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("spherical_harmonics: closed forms of degrees 2 and 3") {
  const Points d = random_directions(50, 2);
  const Functions v = synthesise(basis(3), d);
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    const double x = d(i, 0), y = d(i, 1), z = d(i, 2);
    CHECK(v(i, harmonic_index(2, 0)) ==
          Approx(std::sqrt(5 / (16 * pi)) * (3 * z * z - 1)).margin(1e-14));
    CHECK(v(i, harmonic_index(2, 1)) == Approx(std::sqrt(15 / (4 * pi)) * x * z).margin(1e-14));
    CHECK(v(i, harmonic_index(2, -2)) == Approx(std::sqrt(15 / (4 * pi)) * x * y).margin(1e-14));
    CHECK(v(i, harmonic_index(3, 3)) ==
          Approx(std::sqrt(35 / (32 * pi)) * x * (x * x - 3 * y * y)).margin(1e-14));
    CHECK(v(i, harmonic_index(3, -3)) ==
          Approx(std::sqrt(35 / (32 * pi)) * y * (3 * x * x - y * y)).margin(1e-14));
  }
}

TEST_CASE("spherical_harmonics: orthonormal under the quadrature of their degree") {
  const int degree = 14;
  const QuadratureGrid grid = quadrature_grid(degree);
  CHECK(grid.weights.sum() == Approx(4 * pi).epsilon(1e-14));
  const Functions gram =
      analyse(degree, grid.directions, grid.weights, synthesise(basis(degree), grid.directions));
  CHECK((gram - basis(degree)).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("spherical_harmonics: squares of a degree sum to (2l + 1)/4π, up to degree 400") {
  Points d = random_directions(6, 3);
  d.row(0) << 0, 0, 1;
  d.row(1) << 0, 0, -1;
  d.row(2) = Vector3(1e-5, 2e-7, 1).normalized();
  // The transpose turns one value 1 at a direction into all Y there.
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    const Functions y = analyse(400, d.row(i), Eigen::VectorXd::Ones(1), Functions::Ones(1, 1));
    const Functions power = power_per_degree(y);
    for (int l = 0; l <= 400; ++l) {
      INFO("direction " << i << ", degree " << l);
      REQUIRE(power(l, 0) == Approx((2 * l + 1) / (4 * pi)).epsilon(1e-10));
    }
  }
}

TEST_CASE("spherical_harmonics: analysis is the transpose of synthesis") {
  const Points d = random_directions(777, 4);
  const Functions c = random_coefficients(9, 2, 5), f = random_coefficients(27, 1, 6);
  Functions values(777, 2);
  for (Eigen::Index i = 0; i < 777; ++i) values.row(i) << f(i, 0), f(i + 7, 0);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(777);
  const double there = synthesise(c, d).cwiseProduct(values).sum();
  const double back = analyse(9, d, ones, values).cwiseProduct(c).sum();
  CHECK(there == Approx(back).epsilon(1e-12));
}

TEST_CASE("spherical_harmonics: least squares find what is a harmonic at the vertices") {
  const TriangleMesh sphere = icosphere(4);
  const Topology topology(sphere);
  const SphereMap map = uneven(sphere);
  const Functions wanted = random_coefficients(12, 3, 7);
  const Functions values = synthesise(wanted, map.points);
  const HarmonicFit fit = fit_harmonics(topology, map, values, {.degree = 12});
  CHECK((fit.coefficients - wanted).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(fit.rms.maxCoeff() < 1e-9);
  const HarmonicFit projected =
      fit_harmonics(topology, map, values, {.degree = 12, .least_squares = false});
  CHECK(projected.iterations == 0);
  CHECK(projected.rms.maxCoeff() > 1e-6);  // a piecewise linear function is no harmonic
}

TEST_CASE("spherical_harmonics: what vertices leave open stays near the integral, and is told") {
  // Every 15° in longitude and latitude, as files in float32 have it: degree 11 is the last that
  // they decide.
  TriangleMesh sphere = uv_sphere(24, 11);
  sphere.positions = sphere.positions.cast<float>().cast<double>();
  sphere.positions.rowwise().normalize();
  const Topology topology(sphere);
  const SphereMap map = map_of(sphere);
  Functions known = random_coefficients(20, 2, 4);
  for (int l = 0; l <= 20; ++l)
    known.middleRows(harmonic_index(l, -l), 2 * l + 1) /= (l + 1.0) * (l + 1);
  const Functions values = synthesise(known, map.points);
  const Functions truth = power_per_degree(known);
  for (const int degree : {12, 13, 14, 15, 16}) {
    INFO(degree);
    const HarmonicFit fit = fit_harmonics(topology, map, values, {.degree = degree});
    const Functions power = power_per_degree(fit.coefficients);
    CHECK_FALSE(fit.converged);
    CHECK(fit.decided_degree == 11);
    for (int l = 0; l <= degree; ++l) {
      CHECK((power.row(l).array() < 8 * truth.row(l).array()).all());
    }
  }
  const HarmonicFit fit = fit_harmonics(topology, map, values, {.degree = 11});
  CHECK(fit.converged);
  CHECK_FALSE(fit.decided_degree);
}

TEST_CASE("spherical_harmonics: what vertices decide is found up to rounding, to the last degree") {
  const TriangleMesh sphere = uv_sphere(24, 11);
  const Functions wanted = random_coefficients(11, 1, 4);
  const HarmonicFit fit = fit_harmonics(Topology(sphere), map_of(sphere),
                                        synthesise(wanted, sphere.positions), {.degree = 11});
  CHECK((fit.coefficients - wanted).cwiseAbs().maxCoeff() < 1e-11);
  CHECK(fit.converged);
  const HarmonicFit stopped =
      fit_harmonics(Topology(sphere), map_of(sphere), synthesise(wanted, sphere.positions),
                    {.degree = 11, .most_iterations = 3});
  CHECK(stopped.iterations == 3);
  CHECK_FALSE(stopped.converged);
  CHECK(stopped.decided_degree.value() < 11);
}

TEST_CASE("spherical_harmonics: what has no harmonic of a degree is settled there, not open") {
  const TriangleMesh sphere = icosphere(3);
  Functions wanted = Functions::Zero(36, 2);
  wanted(harmonic_index(5, -4), 0) = 1;  // odd about planes of the icosahedron's symmetry
  wanted(harmonic_index(1, 0), 1) = 1;
  for (const int degree : {0, 1, 2, 4, 5}) {
    INFO(degree);
    const HarmonicFit fit = fit_harmonics(Topology(sphere), map_of(sphere),
                                          synthesise(wanted, sphere.positions), {.degree = degree});
    CHECK(fit.converged);
    CHECK_FALSE(fit.decided_degree);
    CHECK(fit.iterations < 20);
    const auto rows = fit.coefficients.rows();
    CHECK((fit.coefficients - wanted.topRows(rows)).cwiseAbs().maxCoeff() < 1e-11);
  }
}

TEST_CASE("spherical_harmonics: more coefficients than vertices leave something open") {
  const TriangleMesh sphere = icosphere(2);
  const HarmonicFit fit =
      fit_harmonics(Topology(sphere), map_of(sphere), sphere.positions, {.degree = 20});
  CHECK(fit.decided_degree.value() <= 11);
  CHECK(fit.decided_degree.value() >= 8);
  const HarmonicFit decided = fit_harmonics(Topology(sphere), map_of(sphere), sphere.positions,
                                            {.degree = *fit.decided_degree});
  CHECK_FALSE(decided.decided_change);
  const auto x = [](const HarmonicFit& of) { return of.coefficients(harmonic_index(1, 1), 0); };
  CHECK(fit.decided_change.value() ==
        Approx(std::abs(x(fit) - x(decided)) / std::abs(x(decided))).epsilon(1e-3));
}

TEST_CASE("spherical_harmonics: a function is integrated as it is between the vertices") {
  // The distance from the centre of an octahedron's flat sides.
  const TriangleMesh sphere = octahedron();
  const Topology topology(sphere);
  const auto plate = [&](const SurfacePoint& point) {
    Vector3 place = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      place += point.barycentric[k] * sphere.position(topology.vertex(point.face, k));
    return VectorX(VectorX::Constant(1, place.norm()));
  };
  const Functions ones = Functions::Ones(6, 1);
  const HarmonicFit flat = fit_harmonics(topology, map_of(sphere), ones,
                                         {.degree = 0, .least_squares = false, .between = plate});
  // The mean of 1 / (|x| + |y| + |z|) over the sphere.
  CHECK(flat.coefficients(0, 0) / std::sqrt(4 * pi) == Approx(0.6742134655).epsilon(1e-5));
  const HarmonicFit round =
      fit_harmonics(topology, map_of(sphere), ones, {.degree = 0, .least_squares = false});
  CHECK(round.coefficients(0, 0) == Approx(std::sqrt(4 * pi)).epsilon(1e-12));
}

TEST_CASE("spherical_harmonics: an integral has the same coefficients whatever the degree") {
  const TriangleMesh sphere = icosphere(3);
  const Topology topology(sphere);
  const SphereMap map = uneven(sphere);
  Functions values(sphere.vertex_count(), 2);
  for (Eigen::Index v = 0; v < values.rows(); ++v) {
    const Vector3 x = map.points.row(v).transpose();  // 17 long and 5 wide, and a constant
    values.row(v) << 1 / Vector3(x.x() / 17, x.y() / 5, x.z() / 5).norm(), 3;
  }
  const HarmonicFit fine =
      fit_harmonics(topology, map, values, {.degree = 60, .least_squares = false});
  const double size = fine.coefficients.bottomRows(fine.coefficients.rows() - 1).norm();
  for (const int degree : {0, 2, 9}) {
    const HarmonicFit fit =
        fit_harmonics(topology, map, values, {.degree = degree, .least_squares = false});
    INFO(degree << ": " << fit.quadrature_degree);
    CHECK((fit.coefficients - fine.coefficients.topRows(fit.coefficients.rows())).norm() <
          3 * settled_quadrature * size);
    CHECK(fit.quadrature_degree > 50);
    CHECK(fit.quadrature_change.value() <= settled_quadrature);
  }
  CHECK(fit_harmonics(topology, map, values, {.degree = 2}).quadrature_degree == 0);
}

TEST_CASE("spherical_harmonics: an ellipsoid has its semi-axes and nothing else") {
  const TriangleMesh sphere = icosphere(4);
  Eigen::Matrix3d stretch = Eigen::Vector3d(3, 2, 0.5).asDiagonal();
  stretch = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix() * stretch;
  const Functions positions = sphere.positions * stretch.transpose();
  const HarmonicFit fit =
      fit_harmonics(Topology(sphere), map_of(sphere), positions, {.degree = 20});
  const Vector3 axes = first_order_ellipsoid(fit.coefficients);
  CHECK((axes - Vector3(3, 2, 0.5)).cwiseAbs().maxCoeff() < 1e-9);
  Functions rest = fit.coefficients;
  rest.middleRows(1, 3).setZero();
  CHECK(rest.cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("spherical_harmonics: what is left falls with the degree, and a constant is Y_00") {
  const TriangleMesh sphere = icosphere(4);
  const Topology topology(sphere);
  const SphereMap map = uneven(sphere);
  Functions values(topology.vertex_count(), 2);
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    values.row(v) << std::exp(3 * map.point(v).x()) * std::abs(map.point(v).y()), 5;
  }
  double last = 1e300;
  for (const int degree : {0, 2, 5, 10}) {
    const HarmonicFit fit = fit_harmonics(topology, map, values, {.degree = degree});
    CHECK(fit.rms[0] < last);
    last = fit.rms[0];
    CHECK(fit.rms[1] < 1e-10);
    CHECK(fit.coefficients(0, 1) == Approx(5 * std::sqrt(4 * pi)).epsilon(1e-10));
  }
}

TEST_CASE("spherical_harmonics: functions do not feel each other, however many there are") {
  const Points d = random_directions(150, 6);
  const Functions coefficients = random_coefficients(12, 7, 8);
  const Functions together = synthesise(coefficients, d);
  const Functions back = analyse(12, d, Eigen::VectorXd::Ones(150), together);
  for (Eigen::Index k = 0; k < 7; ++k) {
    const Functions alone = synthesise(coefficients.col(k), d);
    CHECK(alone == together.col(k));
    CHECK(analyse(12, d, Eigen::VectorXd::Ones(150), alone) == back.col(k));
  }
}

TEST_CASE("spherical_harmonics: functions of any size have the same fit, to the bit") {
  const TriangleMesh sphere = icosphere(3);
  const Topology topology(sphere);
  const SphereMap map = uneven(sphere);
  for (const bool least_squares : {true, false}) {
    const HarmonicFitOptions options{.degree = 6, .least_squares = least_squares};
    const HarmonicFit plain = fit_harmonics(topology, map, sphere.positions, options);
    for (const double size : {0x1p-700, 0x1p700}) {
      const HarmonicFit sized = fit_harmonics(topology, map, sphere.positions * size, options);
      CHECK(sized.coefficients == plain.coefficients * size);
      CHECK(sized.rms == plain.rms * size);
    }
  }
}

TEST_CASE("spherical_harmonics: known coefficients of degree 200 come back") {
  const QuadratureGrid grid = quadrature_grid(200);
  const Functions known = random_coefficients(200, 1, 9);
  const Functions found =
      analyse(200, grid.directions, grid.weights, synthesise(known, grid.directions));
  CHECK((found - known).cwiseAbs().maxCoeff() < 1e-11);
}

TEST_CASE("spherical_harmonics: the same bits for any number of threads") {
  const Points d = random_directions(9000, 8);
  const Functions c = random_coefficients(10, 2, 9);
  const Functions values = synthesise(c, d, 1);
  CHECK(synthesise(c, d, 3) == values);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(9000);
  CHECK(analyse(10, d, ones, values, 1) == analyse(10, d, ones, values, 4));
}

TEST_CASE("spherical_harmonics: sizes that do not fit are refused, and work can be cancelled") {
  const TriangleMesh sphere = icosphere(1);
  const Topology topology(sphere);
  CHECK_THROWS_AS(synthesise(Functions::Zero(5, 1), sphere.positions), std::invalid_argument);
  CHECK_THROWS_AS(quadrature_grid(-1), std::invalid_argument);
  CHECK_THROWS_AS(fit_harmonics(topology, map_of(sphere), Functions::Zero(3, 1), {}),
                  std::invalid_argument);
  CHECK_THROWS_AS(fit_harmonics(topology, map_of(sphere), Functions::Zero(42, 1), {.degree = 1001}),
                  std::invalid_argument);
  Functions values = Functions::Ones(42, 2);
  values(7, 1) = std::nan("");
  CHECK_THROWS_WITH(fit_harmonics(topology, map_of(sphere), values, {}),
                    "spherical harmonics: the value of function 1 at vertex 7 is no finite number");
  CHECK_THROWS_AS(fit_harmonics(topology, map_of(sphere), Functions::Ones(42, 1),
                                {.progress = [](std::string_view, double) { return false; }}),
                  Cancelled);
}

TEST_CASE("spherical_harmonics: directions that are not of unit length are refused, by number") {
  const Functions coefficients = Functions::Ones(4, 1);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(42);
  for (const double bad : {2.0, 0.0, 1 + 1e-5, std::nan("")}) {
    Points directions = icosphere(1).positions;
    directions.row(7) *= bad;
    CHECK_THROWS_WITH(synthesise(coefficients, directions),
                      "spherical harmonics: direction 7 is not of unit length");
    CHECK_THROWS_AS(analyse(1, directions, ones, Functions::Ones(42, 1)), std::invalid_argument);
  }
  const Points rounded = icosphere(1).positions.cast<float>().cast<double>();
  CHECK_NOTHROW(synthesise(coefficients, rounded));
  CHECK_THROWS_AS(first_order_ellipsoid(Functions::Ones(4, 2)), std::invalid_argument);
  CHECK_THROWS_AS(first_order_ellipsoid(Functions::Ones(1, 3)), std::invalid_argument);
}
