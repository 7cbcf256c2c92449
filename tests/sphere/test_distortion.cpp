#include <Eigen/Dense>
#include <Eigen/SVD>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "sphparam/sphere/distortion.h"
#include "support/instruction_limit.h"
#include "support/test_meshes.h"

using namespace sphparam;
using Catch::Detail::Approx;

namespace {

constexpr double pi = std::numbers::pi;

/// A lumpy ellipsoid and a twisted, uneven one-to-one map of it.
struct Case {
  TriangleMesh mesh;
  SphereMap map;
};

Case lumpy_case(int level) {
  Case c{tests::icosphere(level), {}};
  c.map.points = c.mesh.positions;
  for (Eigen::Index v = 0; v < c.mesh.vertex_count(); ++v) {
    const Vector3 p = c.mesh.positions.row(v);
    const double lump = 1 + 0.2 * std::sin(3 * p.x() + 1) * std::cos(4 * p.y());
    c.mesh.positions.row(v) = Vector3(2.5 * p.x(), p.y(), 0.8 * p.z()) * lump;
    const double twist = 0.7 * p.z();
    const Vector3 q(std::cos(twist) * p.x() - std::sin(twist) * p.y(),
                    std::sin(twist) * p.x() + std::cos(twist) * p.y(), p.z() + 0.4);
    c.map.points.row(v) = q.normalized();
  }
  return c;
}

double angle_between(const Vector3& a, const Vector3& b) {
  return std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1.0, 1.0));
}

/// The area of a spherical triangle by Girard: Σ dihedral angles − π.
double girard(const Vector3& a, const Vector3& b, const Vector3& c) {
  const auto corner = [](const Vector3& p, const Vector3& q, const Vector3& r) {
    return angle_between(p.cross(q), p.cross(r));
  };
  return corner(a, b, c) + corner(b, c, a) + corner(c, a, b) - pi;
}

/// The two singular values of the linear map between triangles, from a frame and an SVD.
Eigen::Vector2d singular_values(const Eigen::Matrix3d& source, const Eigen::Matrix3d& image,
                                double scale) {
  const Vector3 s1 = scale * (source.col(1) - source.col(0)),
                s2 = scale * (source.col(2) - source.col(0));
  const Vector3 x = s1.normalized(), y = s1.cross(s2).cross(s1).normalized();
  Eigen::Matrix2d frame;
  frame << s1.dot(x), s2.dot(x), s1.dot(y), s2.dot(y);
  Eigen::Matrix<double, 3, 2> chords;
  chords << image.col(1) - image.col(0), image.col(2) - image.col(0);
  const Eigen::MatrixXd jacobian = chords * frame.inverse();
  return Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian).singularValues();
}

Eigen::Matrix3d corners(const Points& points, const Triangles& triangles, Eigen::Index f) {
  Eigen::Matrix3d m;
  for (int k = 0; k < 3; ++k) m.col(k) = points.row(triangles(f, k)).transpose();
  return m;
}

bool same_bits(const Distortion& a, const Distortion& b) {
  return a.area_ratio == b.area_ratio && a.angle_ratio == b.angle_ratio &&
         a.sigma_max == b.sigma_max && a.sigma_min == b.sigma_min && a.source_area == b.source_area;
}

}  // namespace

TEST_CASE("distortion: every figure agrees with a naive computation that shares no formula") {
  const Case c = lumpy_case(3);
  const Distortion d = measure_distortion(c.mesh, c.map);
  double total = 0;
  std::vector<double> area;
  for (Eigen::Index f = 0; f < c.mesh.face_count(); ++f) {
    const Eigen::Matrix3d s = corners(c.mesh.positions, c.mesh.triangles, f);
    area.push_back(0.5 * (s.col(1) - s.col(0)).cross(s.col(2) - s.col(0)).norm());
    total += area.back();
  }
  double ln_area = 0, ln_angle = 0, log2_area = 0, dirichlet = 0, conformal = 0, stretch = 0;
  double linf = 0, within = 0;
  for (Eigen::Index f = 0; f < c.mesh.face_count(); ++f) {
    const Eigen::Matrix3d s = corners(c.mesh.positions, c.mesh.triangles, f);
    const Eigen::Matrix3d q = corners(c.map.points, c.mesh.triangles, f);
    const double share = area[static_cast<size_t>(f)] / total;
    const double ratio = girard(q.col(0), q.col(1), q.col(2)) / (4 * pi * share);
    CHECK(d.source_area[f] == Approx(share).epsilon(1e-12));
    CHECK(d.area_ratio[f] == Approx(ratio).epsilon(1e-6));
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double angle = angle_between(q.col(i) - q.col(k), q.col(j) - q.col(k)) /
                           angle_between(s.col(i) - s.col(k), s.col(j) - s.col(k));
      CHECK(d.angle_ratio(f, k) == Approx(angle).epsilon(1e-9));
      ln_angle += std::abs(std::log(angle));
    }
    const Eigen::Vector2d sigma = singular_values(s, q, std::sqrt(4 * pi / total));
    CHECK(d.sigma_max[f] == Approx(sigma[0]).epsilon(1e-9));
    CHECK(d.sigma_min[f] == Approx(sigma[1]).epsilon(1e-9));
    ln_area += std::abs(std::log(ratio));
    log2_area += share * std::abs(std::log2(ratio));
    within += ratio >= 0.5 && ratio <= 2;
    const double squeeze = std::pow(sigma[0], -2) + std::pow(sigma[1], -2);
    dirichlet += share * (sigma.squaredNorm() + squeeze);
    conformal += share * sigma[0] / sigma[1];
    stretch += share * squeeze / 2;
    linf = std::max(linf, 1 / sigma[1]);
  }
  const auto faces = static_cast<double>(c.mesh.face_count());
  const DistortionSummary s = summarise(d);
  CHECK(s.mean_abs_ln_area == Approx(ln_area / faces).epsilon(1e-6));
  CHECK(s.mean_abs_ln_angle == Approx(ln_angle / (3 * faces)).epsilon(1e-9));
  CHECK(s.area_within_two == Approx(within / faces).epsilon(1e-12));
  CHECK(s.weighted_abs_log2_area == Approx(log2_area).epsilon(1e-6));
  CHECK(s.symmetric_dirichlet == Approx(dirichlet).epsilon(1e-9));
  CHECK(s.quasi_conformal_mean == Approx(conformal).epsilon(1e-9));
  CHECK(s.stretch_l2 == Approx(std::sqrt(stretch)).epsilon(1e-9));
  CHECK(s.stretch_linf == Approx(linf).epsilon(1e-9));
}

TEST_CASE("distortion: platonic solids on their own sphere have ratios 1 and no angle change") {
  for (const TriangleMesh& mesh :
       {tests::tetrahedron(), tests::octahedron(), tests::icosahedron()}) {
    const SphereMap map = normalised(mesh.positions);
    const Distortion d = measure_distortion(mesh, map);
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
      CHECK(d.area_ratio[f] == Approx(1).epsilon(1e-12));
      for (int k = 0; k < 3; ++k) CHECK(d.angle_ratio(f, k) == Approx(1).epsilon(1e-12));
      CHECK(d.sigma_max[f] == Approx(d.sigma_min[f]).epsilon(1e-7));
    }
    // The chord triangles are similar to the source: σ² = k, the chord area over 4π; so 2k + 2/k.
    const Eigen::Matrix3d q = corners(map.points, mesh.triangles, 0);
    const double k = 0.5 * (q.col(1) - q.col(0)).cross(q.col(2) - q.col(0)).norm() *
                     static_cast<double>(mesh.face_count()) / (4 * pi);
    CHECK(summarise(d).symmetric_dirichlet == Approx(2 * k + 2 / k).epsilon(1e-12));
    CHECK(summarise(d).quasi_conformal_max == Approx(1).epsilon(1e-7));
  }
}

TEST_CASE("distortion: a fine sphere on itself tends to isometry, symmetric Dirichlet 4") {
  double previous = 1;
  for (int level = 1; level <= 5; ++level) {
    const TriangleMesh mesh = tests::icosphere(level);
    const DistortionSummary s = summarise(measure_distortion(mesh, SphereMap{mesh.positions}));
    const double excess = s.symmetric_dirichlet - 4;
    CHECK(excess >= 0);
    CHECK(excess < previous / 8);  // the chord error is quadratic in edges, its energy quartic
    previous = excess;
  }
}

TEST_CASE("distortion: turning the sphere or the source changes nothing") {
  Case c = lumpy_case(3);
  const Distortion before = measure_distortion(c.mesh, c.map);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  c.map.points = (c.map.points * turn).eval();
  c.mesh.positions = (c.mesh.positions * turn.transpose()).eval();
  const Distortion after = measure_distortion(c.mesh, c.map);
  CHECK((before.area_ratio - after.area_ratio).cwiseAbs().maxCoeff() < 1e-10);
  CHECK((before.angle_ratio - after.angle_ratio).cwiseAbs().maxCoeff() < 1e-11);
  CHECK((before.sigma_min - after.sigma_min).cwiseAbs().maxCoeff() < 1e-11);
}

TEST_CASE("distortion: the size of the source is divided out, exactly for powers of two") {
  Case c = lumpy_case(2);
  const Distortion before = measure_distortion(c.mesh, c.map);
  for (const double scale : {0x1p-600, 0x1p-3, 0x1p900}) {
    TriangleMesh scaled = c.mesh;
    scaled.positions *= scale;
    CHECK(same_bits(before, measure_distortion(scaled, c.map)));
  }
}

TEST_CASE("distortion: the same bits for 1, 2 and 4 threads, by any instructions") {
  const Case c = lumpy_case(5);
  const Distortion one = measure_distortion(c.mesh, c.map, 1);
  CHECK(same_bits(one, measure_distortion(c.mesh, c.map, 2)));
  CHECK(same_bits(one, measure_distortion(c.mesh, c.map, 4)));
  for (const InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2}) {
    const tests::InstructionLimit limit(set);
    CHECK(same_bits(one, measure_distortion(c.mesh, c.map)));
  }
}

TEST_CASE("distortion: of a one-to-one map the shares of source and image each sum to one") {
  const Case c = lumpy_case(4);
  const Distortion d = measure_distortion(c.mesh, c.map);
  CHECK(d.source_area.sum() == Approx(1).epsilon(1e-12));
  CHECK(d.source_area.dot(d.area_ratio) == Approx(1).epsilon(1e-12));
}

TEST_CASE("distortion: planted growth of some source triangles is found, and only that") {
  TriangleMesh mesh = tests::octahedron();
  const SphereMap map = normalised(mesh.positions);
  // Raise one vertex along its axis: its four triangles grow by the same factor, the others stay.
  mesh.positions.row(mesh.triangles(0, 0)) *= 2;
  const double grown = std::sqrt(4 * 2 + 1.0) / std::sqrt(3.0);
  const double mean = (4 * grown + 4) / 8;
  const Distortion d = measure_distortion(mesh, map);
  for (Eigen::Index f = 0; f < 8; ++f) {
    const bool touched = (mesh.triangles.row(f).array() == mesh.triangles(0, 0)).any();
    CHECK(d.area_ratio[f] == Approx(mean / (touched ? grown : 1)).epsilon(1e-12));
  }
}

TEST_CASE("summarise: percentiles are ranks of the sorted ratios") {
  Distortion d;
  const int n = 1001;
  d.area_ratio.resize(n);
  for (int i = 0; i < n; ++i) d.area_ratio[i] = 1 + (i * 376) % n;  // 1 … 1001, shuffled
  d.angle_ratio.setOnes(n, 3);
  d.sigma_max.setOnes(n);
  d.sigma_min.setOnes(n);
  d.source_area.setConstant(n, 1.0 / n);
  d.angle_ratio(5, 1) = 0.25;
  const DistortionSummary s = summarise(d);
  CHECK(s.area_ratio_min == 1);
  CHECK(s.area_ratio_p01 == 11);
  CHECK(s.area_ratio_p50 == 501);
  CHECK(s.area_ratio_p99 == 991);
  CHECK(s.area_ratio_max == 1001);
  CHECK(s.angle_ratio_max == 4);  // a quarter is as bad as four times
  CHECK(s.area_within_two == Approx(2.0 / n));
  CHECK(s.symmetric_dirichlet == Approx(4));
  CHECK(s.mean_abs_ln_angle == Approx(std::log(4) / (3 * n)));
}

TEST_CASE("summarise_distortion: every figure is that of the tables, to the bit") {
  const auto [mesh, map] = lumpy_case(5);  // more than what a thread takes at a time
  for (const int threads : {1, 3}) {
    const DistortionSummary from_tables =
        summarise(measure_distortion(mesh, map, threads), threads);
    const DistortionSummary at_once = summarise_distortion(mesh, map, threads);
    static_assert(sizeof(DistortionSummary) == 17 * sizeof(double));  // no gaps to compare
    CHECK(std::memcmp(&from_tables, &at_once, sizeof at_once) == 0);
    CHECK(at_once.mean_abs_ln_area > 0.01);
  }
  CHECK(summarise_distortion({}, {}).symmetric_dirichlet == 4);
}

TEST_CASE("distortion: degenerate triangles, of the source or of the image, never give NaN") {
  TriangleMesh mesh = tests::icosphere(2);
  SphereMap map = normalised(mesh.positions);
  const TriangleMesh round = mesh;
  mesh.positions.row(mesh.triangles(7, 0)) = mesh.positions.row(mesh.triangles(7, 1)).eval();
  const DistortionSummary source = summarise(measure_distortion(mesh, map));
  for (const double figure : {source.mean_abs_ln_area, source.mean_abs_ln_angle,
                              source.symmetric_dirichlet, source.stretch_l2}) {
    CHECK(std::isfinite(figure));
  }
  map.points.row(mesh.triangles(7, 0)) = map.points.row(mesh.triangles(7, 1)).eval();
  const DistortionSummary image = summarise(measure_distortion(round, map));
  CHECK(source.flat_images == 0);
  CHECK(source.flat_faces == 2);
  CHECK(image.flat_faces == 0);
  CHECK(image.flat_images == 2);  // both that have the edge
  CHECK(std::isfinite(image.mean_abs_ln_angle));
  CHECK(image.angle_ratio_max == std::numeric_limits<double>::infinity());
  CHECK(image.symmetric_dirichlet == std::numeric_limits<double>::infinity());
  CHECK_FALSE(std::isnan(image.stretch_l2));
  CHECK_FALSE(std::isnan(image.quasi_conformal_mean));
  mesh.positions.setConstant(3);  // no area at all
  const Distortion none = measure_distortion(mesh, map);
  CHECK(none.area_ratio.allFinite());
  CHECK(none.source_area.isZero(0));
  CHECK(summarise(none).flat_faces == mesh.face_count());
  CHECK(std::isinf(summarise(none).symmetric_dirichlet));  // not 4: nothing is kept
}

TEST_CASE("distortion: faces without area are in no figure, and thin ones are") {
  auto [mesh, map] = lumpy_case(3);
  const Vertex moved = mesh.triangles(40, 0), onto = mesh.triangles(40, 1);
  mesh.positions.row(moved) = mesh.positions.row(onto).eval();
  // The same figures without them: the triangles that are left are no closed mesh, but measured.
  std::vector<Eigen::Index> with_area;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.triangles.row(f).array();
    if (!((corners == moved).any() && (corners == onto).any())) with_area.push_back(f);
  }
  TriangleMesh rest = mesh;
  rest.triangles = mesh.triangles(with_area, Eigen::all).eval();
  const DistortionSummary all = summarise_distortion(mesh, map);
  DistortionSummary expected = summarise_distortion(rest, map);
  CHECK(expected.flat_faces == 0);
  CHECK(all.flat_faces == 2);
  CHECK(all.symmetric_dirichlet == Approx(expected.symmetric_dirichlet).epsilon(1e-12));
  CHECK(all.symmetric_dirichlet < 100);
  CHECK(all.mean_abs_ln_area == Approx(expected.mean_abs_ln_area).epsilon(1e-12));
  CHECK(all.mean_abs_ln_angle == Approx(expected.mean_abs_ln_angle).epsilon(1e-12));
  CHECK(all.area_within_two == Approx(expected.area_within_two).epsilon(1e-12));
  CHECK(all.area_ratio_p99 == Approx(expected.area_ratio_p99).epsilon(1e-12));
  CHECK(all.area_ratio_max == Approx(expected.area_ratio_max).epsilon(1e-12));
  CHECK(all.quasi_conformal_max == Approx(expected.quasi_conformal_max).epsilon(1e-12));
  CHECK(all.stretch_linf == Approx(expected.stretch_linf).epsilon(1e-12));
  CHECK(all.stretch_l2 == Approx(expected.stretch_l2).epsilon(1e-12));
  const Distortion d = measure_distortion(mesh, map);
  CHECK((d.source_area.array() == 0).count() == 2);
  CHECK(d.source_area.sum() == Approx(1).epsilon(1e-12));
  // A little apart they are thin, and count.
  mesh.positions.row(moved) += 1e-9 * Vector3(1, 2, 3).transpose();
  const DistortionSummary thin = summarise_distortion(mesh, map);
  CHECK(thin.flat_faces == 0);
  CHECK(thin.area_ratio_max > 1e6);
}

TEST_CASE("distortion: a map of another number of rays is refused") {
  const TriangleMesh mesh = tests::icosphere(1);
  CHECK_THROWS_AS(measure_distortion(mesh, {}), std::invalid_argument);
  CHECK_THROWS_AS(summarise_distortion(mesh, {}), std::invalid_argument);
}
