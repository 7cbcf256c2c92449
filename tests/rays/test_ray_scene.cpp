#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "rays/cosine_rays.h"
#include "rays/distinct_faces.h"
#include "rays/ray_scene.h"
#include "rays/triangle_distance.h"
#include "support/hedgehog.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

struct Random {
  std::mt19937 bits{11};
  double number() { return std::uniform_real_distribution<double>(-1, 1)(bits); }
  Vector3 point() { return {number(), number(), number()}; }
};

/// Triangles that have nothing to do with each other; of every fifth two corners are one point, of
/// every seventh the third lies on a side, of every eleventh nearly.
TriangleMesh triangle_soup(int triangles, double size) {
  Random random;
  TriangleMesh mesh{Points(3 * triangles, 3), Triangles(triangles, 3)};
  for (int f = 0; f < triangles; ++f) {
    const Vector3 at = random.point();
    Vector3 corners[3];
    for (Vector3& corner : corners) corner = at + size * random.point();
    const Vector3 side = corners[1] - corners[0];
    if (f % 5 == 0) corners[1] = corners[0];
    if (f % 7 == 0) corners[2] = corners[0] + 0.3 * side;
    if (f % 11 == 0) corners[2] = corners[0] + 0.3 * side + 1e-10 * random.point();
    for (int i = 0; i < 3; ++i) {
      mesh.positions.row(3 * f + i) = corners[i];
      mesh.triangles(f, i) = 3 * f + i;
    }
  }
  return mesh;
}

NearestPoint by_brute_force(const TriangleMesh& mesh, const Vector3& p) {
  NearestPoint best = {{-1, Vector3::Zero()}, std::numeric_limits<double>::infinity()};
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.triangles.row(f);
    const TrianglePoint found = nearest_on_triangle(
        p, mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2]));
    if (found.squared_distance < best.squared_distance) {
      best = {{f, found.barycentric}, found.squared_distance};
    }
  }
  return best;
}

void check_nearest(const TriangleMesh& mesh, const RayScene& scene, const Vector3& p, Face guess) {
  const NearestPoint found = scene.nearest(p, guess), expected = by_brute_force(mesh, p);
  CHECK(found.on.face == expected.on.face);
  CHECK(found.on.barycentric == expected.on.barycentric);
  CHECK(found.squared_distance == expected.squared_distance);
}

}  // namespace

TEST_CASE("ray scene: the nearest point is that of brute force to the bit, with any guess") {
  Random random;
  for (const double size : {0.02, 0.5}) {
    const TriangleMesh soup = triangle_soup(400, size);
    const RayScene scene(soup);
    for (int i = 0; i < 500; ++i) {
      check_nearest(soup, scene, 1.5 * random.point(), i % 3 == 0 ? -1 : i % 400);
    }
  }
}

TEST_CASE("ray scene: of a long body the nearest point is found from any guess, and from none") {
  TriangleMesh body = icosphere(2);  // thick at one end
  for (Eigen::Index v = 0; v < body.vertex_count(); ++v)
    body.positions.row(v).tail<2>() *= 0.6 + 0.5 * body.positions(v, 0);
  body.positions.col(0) *= 4;
  body.positions.col(0).array() += 1;
  const RayScene scene(body);
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double away = i % 2 ? 1 : 1e5;
    const Vector3 p = i == 0 ? Vector3(1, 0, 0)
                             : Vector3(away * Vector3(3 * random.number(), random.number(), 0));
    for (Face guess = -1; guess < body.face_count(); guess += 13)
      check_nearest(body, scene, p, guess);
  }
}

TEST_CASE("ray scene: what is within a distance is what the nearest point says, with any guess") {
  Random random;
  const TriangleMesh soup = triangle_soup(400, 0.1);
  const RayScene scene(soup);
  for (int i = 0; i < 500; ++i) {
    const double away = i % 5 == 0 ? 1e5 : 1.5;
    const Vector3 p = away * random.point();
    const double nearest = std::sqrt(by_brute_force(soup, p).squared_distance);
    for (const Face guess : {-1, i % 400}) {
      CHECK(scene.is_within(nearest * (1 + 1e-12), p, guess));
      CHECK(scene.is_within(4 * nearest, p, guess));
      CHECK_FALSE(scene.is_within(nearest * (1 - 1e-12), p, guess));
      CHECK_FALSE(scene.is_within(nearest / 4, p, guess));
    }
  }
}

TEST_CASE("ray scene: where many triangles are equally near, the first of them is told") {
  const TriangleMesh ball = icosphere(3);
  const RayScene scene(ball);
  for (int v = 0; v < ball.vertex_count(); v += 7) {
    check_nearest(ball, scene, ball.position(v), -1);
    check_nearest(ball, scene, 2 * ball.position(v), static_cast<Face>(ball.face_count() - 1));
  }
  check_nearest(ball, scene, Vector3::Zero(), 17);  // nearly the same distance from everywhere
}

TEST_CASE("ray scene: triangles that are the same are asked once, and the first of them is told") {
  TriangleMesh ball = random_sphere_mesh(200, 5);
  ball.positions.bottomRows(150).rowwise() = Vector3(0.1, 0.2, 0.3).transpose();
  ball.positions.row(7) = ball.positions.row(8).eval();
  const std::vector<Face> faces = distinct_faces(ball);
  CHECK(std::ranges::is_sorted(faces));
  CHECK(10 * std::ssize(faces) < 7 * ball.face_count());
  CHECK(distinct_faces(icosphere(2)).size() == 320);
  const RayScene scene(ball);
  Random random;
  for (int i = 0; i < 300; ++i) check_nearest(ball, scene, 1.5 * random.point(), i % 3 - 1);
  check_nearest(ball, scene, {0.1, 0.2, 0.3}, -1);
}

TEST_CASE("ray scene: where long triangles lie across the axes, all answers are the same") {
  TriangleMesh sheaf = tube(2, 60), across = sheaf;
  for (TriangleMesh* mesh : {&sheaf, &across}) mesh->positions.leftCols<2>() *= 1e-3;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  across.positions = sheaf.positions * turn.transpose();
  const RayScene along_axis(sheaf), scene(across);
  Random random;
  for (int i = 0; i < 200; ++i) check_nearest(across, scene, random.point(), i % 3 - 1);
  for (int i = 0; i < 20; ++i) {
    const Vector3 origin(0.5, 0.1 * random.point().x(), 0.3 * random.point().y());
    const Vector3 towards = Vector3(-origin.x(), -origin.y(), 0.1).normalized();
    const RayHit one = along_axis.first_hit(origin, towards, 4),
                 two = scene.first_hit(turn * origin, turn * towards, 4);
    CHECK((one.face >= 0) == (two.face >= 0));
    CHECK(one.distance == Approx(two.distance).margin(1e-5));
  }
}

TEST_CASE("ray scene: where thin triangles lie across all axes, nearest points are as exact") {
  Random random;
  for (const double scale : {1e-60, 1.0, 1e60}) {
    TriangleMesh hairs = hedgehog(60, 12, 1);
    hairs.positions.array() = scale * (hairs.positions.array() + 100);
    const RayScene scene(hairs);
    for (int i = 0; i < 150; ++i) {
      const double away = i % 10 == 0 ? 1e7 : 12;
      const Vector3 p = scale * (away * random.point().array() + 100);
      check_nearest(hairs, scene, p, i % 3 - 1);
      const double nearest = std::sqrt(by_brute_force(hairs, p).squared_distance);
      CHECK(scene.is_within(nearest * (1 + 1e-9), p, i % 3 - 1));
      CHECK_FALSE(scene.is_within(nearest * (1 - 1e-9), p, i % 3 - 1));
    }
    for (int v = 0; v < hairs.vertex_count(); v += 13)
      check_nearest(hairs, scene, hairs.position(v), -1);
  }
}

TEST_CASE("ray scene: nearest points stay exact far away, far from the origin and at any scale") {
  Random random;
  TriangleMesh soup = triangle_soup(200, 0.3);
  const RayScene scene(soup);
  for (const double distance : {1e2, 1e3, 1e4, 1e6, 1e9}) {
    for (int i = 0; i < 20; ++i) check_nearest(soup, scene, distance * random.point(), -1);
  }
  const Vector3 beyond = 1e15 * random.point();
  CHECK(scene.nearest(beyond).squared_distance ==
        Approx(by_brute_force(soup, beyond).squared_distance).epsilon(1e-14));
  for (const double scale : {1e-140, 1e-60, 1e-3, 1e60, 1e140}) {
    TriangleMesh moved = soup;
    moved.positions.array() = scale * (soup.positions.array() + 1e6);
    const RayScene moved_scene(moved);
    for (int i = 0; i < 50; ++i) {
      const Vector3 p = scale * (random.point().array() + 1e6);
      check_nearest(moved, moved_scene, p, -1);
    }
  }
}

TEST_CASE("ray scene: from inside a closed mesh no ray gets out, whatever edge it aims at") {
  for (const double offset : {0.0, 1e6}) {
    TriangleMesh ball = icosphere(3);
    ball.positions.array() += offset;
    const RayScene scene(ball);
    const Vector3 centre = Vector3::Constant(offset);
    for (int v = 0; v < ball.vertex_count(); ++v) {
      const Vector3 towards = (ball.position(v) - centre).normalized();
      CHECK(scene.first_hit(centre, towards, 10).face >= 0);
    }
    for (int f = 0; f < ball.face_count(); ++f) {
      const auto corners = ball.triangles.row(f);
      const Vector3 middle = (ball.position(corners[0]) + ball.position(corners[1])) / 2;
      CHECK(scene.first_hit(centre, (middle - centre).normalized(), 10).face >= 0);
    }
  }
}

TEST_CASE("ray scene: a hit has its face and distance, a miss and what is out of reach have none") {
  const TriangleMesh box = octahedron();  // |x| + |y| + |z| = 1
  const RayScene scene(box);
  const RayHit hit = scene.first_hit({3, 0.1, 0.2}, {-1, 0, 0}, 10);
  REQUIRE(hit.face >= 0);
  CHECK(hit.distance == Approx(3 - 0.7));
  for (const int v : {0, 1, 2}) {
    const Vector3 corner = box.position(box.triangles(hit.face, v));
    CHECK(corner.minCoeff() >= 0);
  }
  CHECK(scene.first_hit({3, 0.1, 0.2}, {-1, 0, 0}, 2.2).face < 0);
  CHECK(scene.first_hit({3, 0.1, 0.2}, {1, 0, 0}, 10).face < 0);
}

TEST_CASE("ray scene: bundles say what single rays say, for any number of rays") {
  const TriangleMesh ball = random_sphere_mesh(300, 3);  // crumpled
  const RayScene scene(ball);
  const double reach = 0.7;
  for (const size_t count : {1u, 2u, 63u, 64u, 65u, 200u}) {
    Random random;
    const Vector3 origin = 0.5 * random.point();
    std::vector<Eigen::Vector3f> directions(count);
    for (auto& d : directions) d = random.point().normalized().cast<float>();
    std::vector<std::uint8_t> blocked(count, 7);
    std::vector<float> distances(count + 1, -1);
    scene.find_blocked(origin, directions, reach, blocked);
    scene.find_distances(origin, directions, reach, std::span(distances).first(count));
    CHECK(distances[count] == -1);
    for (size_t i = 0; i < count; ++i) {
      const RayHit hit = scene.first_hit(origin, directions[i].cast<double>(), reach);
      CHECK(int{blocked[i]} == int{hit.face >= 0});
      CHECK(distances[i] == Approx(hit.face >= 0 ? hit.distance : reach).margin(1e-6));
    }
  }
}

TEST_CASE("ray scene: what is no ray meets nothing, and does not disturb those beside it") {
  const RayScene scene(icosphere(2));
  const double none = std::nan("");
  const Vector3 origin(3, 0, 0), way(-1, 0, 0);
  const std::vector<Ray> rays = {{origin, Vector3::Constant(none), 9},
                                 {Vector3(none, 0, 0), way, 9},
                                 {origin, way, 9},
                                 {origin, way, none}};
  std::vector<RayHit> hits(rays.size());
  scene.first_hits(rays, hits);
  for (const size_t i : {0u, 1u, 3u}) CHECK(hits[i].face < 0);
  CHECK(hits[2].distance == Approx(2).margin(0.1));
}

TEST_CASE("ray scene: rays side by side meet what they meet alone, each within its own reach") {
  const TriangleMesh ball = random_sphere_mesh(300, 5);  // crumpled
  const RayScene scene(ball);
  Random random;
  for (const size_t count : {1u, 7u, 64u, 100u}) {
    const Vector3 origin = 0.3 * random.point(), way = random.point().normalized();
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; ++i)
      rays.push_back({origin + 0.1 * random.point(), (way + 0.1 * random.point()).normalized(),
                      i % 5 == 4 ? -1 : 0.06 * static_cast<double>(i % 50)});
    std::vector<RayHit> hits(count);
    scene.first_hits(rays, hits);
    for (size_t i = 0; i < count; ++i) {
      const RayHit alone =
          rays[i].reach < 0
              ? RayHit{}
              : scene.first_hit(rays[i].origin, rays[i].unit_direction, rays[i].reach);
      CHECK((hits[i].face < 0) == (alone.face < 0));
      CHECK(hits[i].distance == Approx(alone.distance).margin(1e-6));
    }
    if (count == 100)
      CHECK(std::count_if(hits.begin() + 64, hits.end(), [](auto& h) { return h.face >= 0; }) > 10);
  }
}

TEST_CASE("ray scene: the clearance frees rays from their own surface, at any place and scale") {
  for (const double scale : {1e-8, 1.0, 1e8}) {
    for (const double offset : {0.0, 1e4}) {
      TriangleMesh ball = icosphere(4);
      ball.positions = scale * (ball.positions.array() + offset);
      const RayScene scene(ball);
      const CosineRays rays(16);
      std::vector<Eigen::Vector3f> directions(static_cast<size_t>(rays.count()));
      std::vector<std::uint8_t> blocked(directions.size());
      size_t hits = 0;
      for (int f = 0; f < ball.face_count(); ++f) {
        const auto corners = ball.triangles.row(f);
        const Vector3 a = ball.position(corners[0]), b = ball.position(corners[1]),
                      c = ball.position(corners[2]);
        const Vector3 normal = (b - a).cross(c - a).normalized();
        const Vector3 origin = (0.2 * a + 0.3 * b + 0.5 * c) + scene.clearance() * normal;
        rays.aim(normal.cast<float>(), static_cast<std::uint64_t>(f), directions);
        scene.find_blocked(origin, directions, scene.diagonal(), blocked);
        for (const std::uint8_t hit : blocked) hits += hit;
      }
      CHECK(hits == 0);
    }
  }
}

TEST_CASE("ray scene: rays go the same ways at every size that doubles have") {
  const TriangleMesh ball = octahedron();
  const Vector3 origin(0.125, 0.0625, 0), towards = Vector3(1, 2, 4).normalized();
  const RayHit unit = RayScene(ball).first_hit(origin, towards, 4);
  REQUIRE(unit.face >= 0);
  for (const int exponent : {-1000, -600, 600, 1020, 1023}) {
    INFO("2^" << exponent);
    const double size = std::ldexp(1.0, exponent);
    TriangleMesh sized = ball;
    sized.positions *= size;
    const RayScene scene(sized);
    const RayHit hit = scene.first_hit(size * origin, towards, scene.diagonal());
    CHECK(hit.face == unit.face);
    CHECK(hit.distance / size == unit.distance);
  }
}

TEST_CASE(
    "ray scene: rays that start beyond what floats hold meet nothing, of a mesh that is one "
    "point") {
  TriangleMesh point = octahedron();
  point.positions.rowwise() = Vector3(1e159, 9e159, -5e159).transpose();
  const RayScene scene(point);
  const std::vector<Eigen::Vector3f> directions(9, Eigen::Vector3f::UnitX());
  std::vector<std::uint8_t> blocked(directions.size(), 7);
  std::vector<float> distances(directions.size());
  for (const Vector3& origin : {point.position(0), Vector3(1.0000001 * point.position(0))}) {
    scene.find_blocked(origin + Vector3(0, 1e150, 0), directions, 1, blocked);
    scene.find_distances(origin + Vector3(0, 1e150, 0), directions, 1, distances);
    CHECK(std::ranges::all_of(blocked, [](std::uint8_t hit) { return hit == 0; }));
    CHECK(std::ranges::all_of(distances, [](float way) { return way == 1; }));
  }
}

TEST_CASE("ray scene: a mesh without triangles or with numbers that are none is refused") {
  CHECK_THROWS_AS(RayScene(TriangleMesh{}), std::invalid_argument);
  TriangleMesh ball = tetrahedron();
  ball.positions(1, 1) = std::nan("");
  CHECK_THROWS_AS(RayScene(ball), std::invalid_argument);
  for (const Vertex beyond : {-1, 4}) {
    ball = tetrahedron();
    ball.triangles(2, 0) = beyond;
    CHECK_THROWS_AS(RayScene(ball), std::invalid_argument);
  }
}

}  // namespace sphparam
