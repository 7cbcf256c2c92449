#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "sphparam/measure/alignment.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

/// A body that no turn brings onto itself, nor a mirror: a lump on an ellipsoid.
TriangleMesh lumpy() {
  TriangleMesh mesh = icosphere(4);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double lump = std::exp(-8 * (x - Vector3(0.8, 0.5, 0.33).normalized()).squaredNorm());
    mesh.positions.row(v) = (1 + 0.4 * lump) * x.cwiseProduct(Vector3(1.5, 1.1, 0.8));
  }
  return mesh;
}

Similarity turn_of(double degrees, const Vector3& axis, const Vector3& shift, double scale = 1) {
  const double angle = degrees * std::acos(-1.0) / 180;
  return {scale, Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), shift};
}

TriangleMesh moved(TriangleMesh mesh, const Similarity& motion) {
  mesh.positions = sphparam::moved(std::move(mesh.positions), motion);
  return mesh;
}

/// How far the alignment leaves the vertices of a moved mesh from where they were.
double farthest_left(const TriangleMesh& mesh, const Similarity& motion,
                     const Alignment& alignment) {
  const Points back = sphparam::moved(moved(mesh, motion).positions, alignment.motion);
  return (back - mesh.positions).rowwise().norm().maxCoeff();
}

/// Faces whose middles are on one side of a plane.
TriangleMesh part_of(const TriangleMesh& mesh, const Vector3& normal, double most) {
  TriangleMesh part = mesh;
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 3; ++k) middle += mesh.position(mesh.triangles(f, k)) / 3;
    if (normal.dot(middle) < most) part.triangles.row(kept++) = mesh.triangles.row(f);
  }
  part.triangles.conservativeResize(kept, 3);
  return part;
}

}  // namespace

TEST_CASE("alignment: a body that was moved is put back, to rounding, from near and from far") {
  const TriangleMesh mesh = lumpy();
  const Similarity near = turn_of(8, {1, 2, 3}, {0.1, -0.05, 0.02}),
                   far = turn_of(140, {3, -1, 2}, {40, -25, 10});
  const Alignment from_near = align_surfaces(mesh, moved(mesh, near)),
                  from_far = align_surfaces(mesh, moved(mesh, far));
  CHECK(farthest_left(mesh, near, from_near) < 1e-12);
  CHECK(farthest_left(mesh, far, from_far) < 1e-12);
  CHECK(from_near.start == AlignmentStart::AsTheyAre);
  CHECK(from_far.start == AlignmentStart::PrincipalAxes);
  for (const Alignment& alignment : {from_near, from_far}) {
    CHECK(alignment.rms < 1e-13);
    CHECK(alignment.motion.scale == 1);
    CHECK(alignment.kept == 1);
    CHECK(alignment.motion.rotation.determinant() == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("alignment: what lies where it belongs stays there, to the bit") {
  const TriangleMesh mesh = lumpy();
  const Alignment alignment = align_surfaces(mesh, mesh, {.scale = true});
  CHECK(alignment.motion.matrix() == Similarity().matrix());
  CHECK(alignment.iterations == 0);
}

TEST_CASE("alignment: with scale, millimetres come onto metres, and without nothing is scaled") {
  const TriangleMesh mesh = lumpy();
  const Similarity motion = turn_of(100, {1, 1, 0}, {500, 0, -200}, 1000);
  const Alignment scaled = align_surfaces(mesh, moved(mesh, motion), {.scale = true});
  CHECK(scaled.motion.scale == Approx(0.001).epsilon(1e-12));
  CHECK(farthest_left(mesh, motion, scaled) < 1e-11);
  const Alignment rigid = align_surfaces(mesh, moved(mesh, motion), {.samples = 200});
  CHECK(rigid.motion.scale == 1);
  CHECK_FALSE(rigid.scaled);
  CHECK(scaled.scaled);
}

TEST_CASE(
    "alignment: a part of a body lies exactly where it was taken from: the rest is left out") {
  const TriangleMesh mesh = lumpy(), part = part_of(mesh, {1, 0.2, 0}, 0.6);
  const Similarity motion = turn_of(6, {0, 1, 1}, {0.05, 0.05, -0.05});
  const Alignment forth = align_surfaces(part, moved(mesh, motion));
  CHECK(farthest_left(mesh, motion, forth) < 1e-9);
  CHECK(forth.kept < 0.95);
  CHECK(forth.rms < 1e-7);
  const Alignment back = align_surfaces(mesh, moved(part, motion), {.scale = true});
  CHECK(farthest_left(mesh, motion, back) < 1e-9);
}

TEST_CASE("alignment: far from the origin and in any unit it is the same") {
  const TriangleMesh mesh = lumpy();
  const Similarity motion = turn_of(8, {1, 2, 3}, {0.1, -0.05, 0.02});
  const TriangleMesh other = moved(mesh, motion);
  const Similarity there = {1e-30, Eigen::Matrix3d::Identity(), {0, 0, 0}},
                   far = {1, Eigen::Matrix3d::Identity(), {5e5, 4e6, 100}};
  const Eigen::Matrix3d turn = align_surfaces(mesh, other).motion.rotation;
  CHECK((align_surfaces(moved(mesh, there), moved(other, there)).motion.rotation - turn).norm() <
        1e-13);
  CHECK((align_surfaces(moved(mesh, far), moved(other, far)).motion.rotation - turn).norm() < 1e-8);
}

TEST_CASE("alignment: turns of a ball are left as they were, its place is found") {
  const TriangleMesh ball = icosphere(3);
  const Similarity motion = turn_of(0, {0, 0, 1}, {0.3, 0.1, -0.2});
  const Alignment alignment = align_surfaces(ball, moved(ball, motion));
  CHECK((alignment.motion.shift + motion.shift).norm() < 1e-3);
  CHECK(alignment.rms < 1e-3);
}

TEST_CASE("alignment: a mirror image is not mirrored") {
  const TriangleMesh mesh = lumpy();
  TriangleMesh mirrored = mesh;
  mirrored.positions.col(0) *= -1;
  const Alignment alignment = align_surfaces(mesh, mirrored);
  CHECK(alignment.motion.rotation.determinant() == Approx(1).epsilon(1e-14));
  CHECK(alignment.kept < 0.99);  // the lump is not where it is
}

TEST_CASE("alignment: the same bits for any number of threads, others for another seed") {
  const TriangleMesh mesh = lumpy(), other = moved(icosphere(3), turn_of(20, {1, 0, 0}, {1, 0, 0}));
  const Alignment one = align_surfaces(mesh, other, {.samples = 3000, .threads = 1}),
                  five = align_surfaces(mesh, other, {.samples = 3000, .threads = 5}),
                  seed = align_surfaces(mesh, other, {.samples = 3000, .seed = 2});
  CHECK(one.motion.matrix() == five.motion.matrix());
  CHECK(one.rms == five.rms);
  CHECK(one.motion.matrix() != seed.motion.matrix());
}

TEST_CASE("alignment: what cannot be sampled is refused, and it can be stopped") {
  const TriangleMesh mesh = icosphere(2);
  TriangleMesh flat = mesh, none{mesh.positions, Triangles(0, 3)}, away = mesh;
  flat.positions.setOnes();
  away.positions.array() += 1e200;
  const auto side_of = [](const TriangleMesh& first, const TriangleMesh& second) {
    try {
      align_surfaces(first, second);
    } catch (const UnmeasurableSurface& error) {
      return std::optional(error.side());
    }
    return std::optional<Side>();
  };
  CHECK(side_of(flat, mesh) == Side::First);
  CHECK(side_of(mesh, flat) == Side::Second);
  CHECK(side_of(none, mesh) == Side::First);
  CHECK(side_of(mesh, away) == Side::Second);
  CHECK_THROWS_AS(align_surfaces(mesh, mesh, {.samples = 0}), std::invalid_argument);
  const Progress stop = [](std::string_view, double done) { return done < 0.2; };
  CHECK_THROWS_AS(align_surfaces(mesh, lumpy(), {.progress = stop}), Cancelled);
}

}  // namespace sphparam
