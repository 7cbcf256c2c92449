#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>

#include "remesh/limit_subject.h"
#include "remesh/subdivision/patch_net.h"
#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/sphere_grid.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

const std::vector<LimitSubject> subjects = {
    {"ico:0", Scheme::Loop},          {"ico:2", Scheme::Loop},
    {"octa:7", Scheme::Loop},         {"cube:1", Scheme::CatmullClark},
    {"cube:4", Scheme::CatmullClark}, {"ico:1", Scheme::CatmullClark},
    {"uv:7x5", Scheme::CatmullClark}};

/// A grid's sphere with bumps, the same ones each time.
Points bumpy(const SphereGrid& grid) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> bump(-0.2, 0.2);
  Points points = grid.directions;
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] += bump(engine);
  return points;
}

LimitSurface surface_of(const LimitSubject& subject) {
  const SphereGrid grid = subject.grid();
  return LimitSurface(grid.faces, bumpy(grid), subject.scheme);
}

/// Where corner k of a face is.
LimitPlace corner_of(const LimitTopology& topology, int face, int degree, int k) {
  const int first = topology.first_patch(face);
  if (topology.first_patch(face + 1) - first > 1) return {first + k, 0, 0};
  if (degree == 3) return {first, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
  return {first, k == 1 || k == 2 ? 1.0 : 0.0, k >= 2 ? 1.0 : 0.0};
}

/// The neighbours of each vertex, and the means of its faces' other corners.
struct Ring {
  std::map<int, int> neighbours;
  Vector3 sum = Vector3::Zero(), face_sum = Vector3::Zero();
};
std::vector<Ring> rings_of(const Polygons& faces, const Points& control) {
  std::vector<Ring> rings(static_cast<size_t>(control.rows()));
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const auto polygon = faces.polygon(f);
    Vector3 mean = Vector3::Zero();
    for (const int v : polygon) mean += control.row(v) / static_cast<double>(polygon.size());
    for (size_t k = 0; k < polygon.size(); ++k) {
      Ring& ring = rings[static_cast<size_t>(polygon[k])];
      const int next = polygon[(k + 1) % polygon.size()];
      ++ring.neighbours[next];
      ring.sum += control.row(next);
      ring.face_sum += mean;
    }
  }
  return rings;
}

/// Loop (1987): the limit of a vertex.
Vector3 loop_limit(const Vector3& at, const Ring& ring) {
  const auto n = static_cast<double>(ring.neighbours.size());
  const double c = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4, beta = (5.0 / 8 - c * c) / n,
               chi = 1 / (3 / (8 * beta) + n);
  return (1 - n * chi) * at + chi * ring.sum;
}

/// Halstead, Kass and DeRose (1993), after one step of Catmull's and Clark's, whose faces are
/// quads.
Vector3 catmull_clark_limit(const Vector3& at, const Ring& ring) {
  const auto n = static_cast<double>(ring.neighbours.size());
  return (n * n * at + 4 * ring.sum + ring.face_sum) / (n * (n + 5));
}

Vector3 at(const LimitSurface& surface, const LimitPlace& place) {
  return surface.evaluate(place).position;
}

}  // namespace

TEST_CASE("limit surface: at the vertices of a triangle mesh it is where Loop says") {
  for (const LimitSubject& subject : subjects) {
    if (subject.scheme != Scheme::Loop) continue;
    const SphereGrid grid = subject.grid();
    const LimitSurface surface = surface_of(subject);
    const std::vector<Ring> rings = rings_of(grid.faces, surface.control());
    for (int f = 0; f < static_cast<int>(grid.faces.count()); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int v = grid.faces.polygon(f)[static_cast<size_t>(k)];
        const Vector3 expected =
            loop_limit(surface.control().row(v), rings[static_cast<size_t>(v)]);
        INFO(subject.name << ", face " << f << ", corner " << k);
        CHECK((at(surface, corner_of(surface.topology(), f, 3, k)) - expected).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("limit surface: at the vertices of a quad mesh it is where Catmull and Clark say") {
  const LimitSubject subject{"cube:4", Scheme::CatmullClark};
  const LimitSurface coarse = surface_of(subject);
  // Of a vertex, the mean of a quad's corners is a face point only after a step.
  const ControlMesh fine = subdivide_to_quads({subject.grid().faces, {coarse.control()}});
  const std::vector<Ring> rings = rings_of(fine.faces, fine.points[0]);
  const LimitSurface surface(fine.faces, fine.points[0], Scheme::CatmullClark);
  for (int f = 0; f < static_cast<int>(fine.faces.count()); ++f) {
    const int v = fine.faces.polygon(f)[0];
    const Ring& ring = rings[static_cast<size_t>(v)];
    // 4·(edge points) + (face points) after the next step is this of the points before it:
    const auto n = static_cast<double>(ring.neighbours.size());
    const Vector3 corner = surface.control().row(v), q = ring.face_sum / n,
                  r = (corner + ring.sum / n) / 2, moved = (q + 2 * r + (n - 3) * corner) / n;
    Ring next = ring;
    next.sum = (n * corner + ring.sum + 2 * ring.face_sum) / 4;
    INFO("face " << f);
    CHECK((at(surface, {f, 0, 0}) - catmull_clark_limit(moved, next)).norm() < 1e-12);
  }
}

TEST_CASE("limit surface: a step of subdivision does not change it") {
  for (const LimitSubject& subject : subjects) {
    if (subject.scheme != Scheme::CatmullClark) continue;
    const SphereGrid grid = subject.grid();
    const LimitSurface surface = surface_of(subject);
    const ControlMesh fine = subdivide_to_quads({grid.faces, {surface.control()}});
    const LimitSurface same(fine.faces, fine.points[0], Scheme::CatmullClark);
    REQUIRE(same.topology().patch_count() == std::ssize(grid.faces.corners));
    int corner = 0;
    for (int f = 0; f < static_cast<int>(grid.faces.count()); ++f) {
      for (int k = 0; k < grid.faces.degree(f); ++k, ++corner) {
        INFO(subject.name << ", face " << f << ", corner " << k);
        const LimitPlace place = corner_of(surface.topology(), f, grid.faces.degree(f), k);
        CHECK((at(surface, place) - at(same, {corner, 0, 0})).norm() < 1e-12);
        const LimitPlace middle = grid.faces.degree(f) == 4
                                      ? LimitPlace{surface.topology().first_patch(f), 0.5, 0.5}
                                      : LimitPlace{surface.topology().first_patch(f) + k, 1, 1};
        CHECK((at(surface, middle) - at(same, {corner, 1, 1})).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("limit surface: positions and normals agree across edges") {
  for (const LimitSubject& subject : subjects) {
    const SphereGrid grid = subject.grid();
    ControlMesh mesh{grid.faces, {bumpy(grid)}};
    if (subject.scheme == Scheme::CatmullClark) mesh = subdivide_to_quads(mesh);
    const LimitSurface surface(mesh.faces, mesh.points[0], subject.scheme);
    const PatchNet net(mesh.faces);
    const double middle = 0.37;
    for (int p = 0; p < net.patch_count(); ++p) {
      const LimitPlace inside{p, middle, 0}, outside = net.cross({p, middle, -1e-13});
      REQUIRE(outside.patch != p);
      const LimitPoint here = surface.evaluate(inside),
                       there = surface.evaluate(clamped(outside, net.degree()));
      INFO(subject.name << ", patch " << p);
      CHECK((here.position - there.position).norm() < 1e-9);
      CHECK((here.normal() - there.normal()).norm() < 1e-3);  // of Gregory patches, almost
    }
  }
}

TEST_CASE("limit surface: derivatives are those of the positions, curvature that of the normals") {
  constexpr double h = 1e-5;
  for (const LimitSubject& subject : subjects) {
    const LimitSurface surface = surface_of(subject);
    for (int p = 0; p < surface.topology().patch_count(); ++p) {
      INFO(subject.name << ", patch " << p);
      const LimitPatch patch = surface.patch(p);
      const double s = 0.31, t = 0.27;
      const LimitPoint point = patch.evaluate(s, t);
      const LimitPoint s0 = patch.evaluate(s - h, t), s1 = patch.evaluate(s + h, t),
                       t0 = patch.evaluate(s, t - h), t1 = patch.evaluate(s, t + h);
      CHECK(((s1.position - s0.position) / (2 * h) - point.by_s).norm() < 1e-8);
      CHECK(((t1.position - t0.position) / (2 * h) - point.by_t).norm() < 1e-8);
      // The normal turns by −(shape operator): K = det, 2H = trace of it.
      Eigen::Matrix<double, 3, 2> x, n;
      x << point.by_s, point.by_t;
      n << (s1.normal() - s0.normal()) / (2 * h), (t1.normal() - t0.normal()) / (2 * h);
      const Eigen::Matrix2d shape = (x.transpose() * x).inverse() * (x.transpose() * n);
      const LimitCurvature curvature = patch.curvature(s, t);
      CHECK(curvature.mean == Approx(shape.trace() / 2).epsilon(1e-4).margin(1e-4));
      CHECK(curvature.gauss == Approx(shape.determinant()).epsilon(1e-4).margin(1e-4));
    }
  }
}

TEST_CASE("limit surface: the limit of a fine sphere's grid bends as a sphere does") {
  const SphereGrid grid = make_grid(parse_grid("ico:4"));
  const LimitSurface surface(grid.faces, 2 * grid.directions, Scheme::Loop);
  const LimitPlace place{600, 0.3, 0.3};
  CHECK(surface.curvature(place).mean == Approx(0.5).epsilon(0.05));
  CHECK(surface.curvature(place).gauss == Approx(0.25).epsilon(0.05));
  CHECK(surface.evaluate(place).normal().dot(at(surface, place).normalized()) > 0.9999);
}

TEST_CASE("limit surface: polynomials are those that patches are evaluated by") {
  for (const LimitSubject& subject :
       {LimitSubject{"ico:3", Scheme::Loop}, {"cube:8", Scheme::CatmullClark}}) {
    const LimitSurface surface = surface_of(subject);
    const int highest = subject.scheme == Scheme::Loop ? 4 : 3;
    int polynomials = 0;
    for (int p = 0; p < surface.topology().patch_count(); ++p) {
      const LimitPatch patch = surface.patch(p);
      if (!patch.is_polynomial()) continue;
      ++polynomials;
      Vector3 sum = Vector3::Zero();
      Eigen::Index m = 0;
      for (int i = 0; i <= highest; ++i) {
        for (int j = 0; j <= (subject.scheme == Scheme::Loop ? highest - i : highest); ++j)
          sum += std::pow(0.2, i) * std::pow(0.7, j) * patch.coefficients().row(m++);
      }
      REQUIRE((sum - patch.evaluate(0.2, 0.7).position).norm() < 1e-13);
    }
    CHECK(polynomials > surface.topology().patch_count() / 2);
  }
}

TEST_CASE("limit surface: many places at once, on any threads, as one by one") {
  for (const LimitSubject& subject : subjects) {
    const LimitSurface surface = surface_of(subject);
    std::vector<LimitPlace> places;
    for (int p = 0; p < surface.topology().patch_count(); ++p) {
      for (const double s : {0.0, 0.1, 0.5}) places.push_back({p, s, 0.25});
      for (int i = 0; i < p % 20; ++i) places.push_back({p, 0.025 * i, 0.5 - 0.02 * i});
    }
    const auto one = surface.evaluate_all(places, 1), three = surface.evaluate_all(places, 3);
    const auto curvatures = surface.curvature_all(places, 2);
    for (size_t i = 0; i < places.size(); ++i) {
      const LimitPoint alone = surface.evaluate(places[i]);
      REQUIRE(one[i].position == alone.position);
      REQUIRE(one[i].by_t == alone.by_t);
      REQUIRE(three[i].by_s == alone.by_s);
      REQUIRE(curvatures[i].mean == surface.curvature(places[i]).mean);
    }
  }
}

TEST_CASE("limit surface: a patch made of another one's is as if made anew") {
  for (const LimitSubject& subject : subjects) {
    const LimitSurface surface = surface_of(subject);
    const Points others = 2 * surface.control().rowwise().reverse();
    const LimitSurface other(surface.shared_topology(), others);
    for (int p = 0; p < surface.topology().patch_count(); ++p) {
      const LimitPatch made(surface.patch(p), other.control());
      CHECK(made.index() == p);
      const LimitPoint point = made.evaluate(0.3, 0.6), anew = other.evaluate({p, 0.3, 0.6});
      REQUIRE(point.position == anew.position);
      REQUIRE(point.by_t == anew.by_t);
    }
  }
}

TEST_CASE("limit surface: what is none is refused") {
  const SphereGrid quads = make_grid(parse_grid("cube:2"));
  CHECK_THROWS_WITH(LimitSurface(quads.faces, quads.directions, Scheme::Loop),
                    "face 0 has 4 corners, and Loop's scheme is for triangles");
  CHECK_THROWS_AS(LimitSurface(quads.faces, quads.directions.topRows(5), Scheme::CatmullClark),
                  std::invalid_argument);
  const LimitSurface surface(quads.faces, quads.directions, Scheme::CatmullClark);
  for (const int patch : {-1, surface.topology().patch_count()})
    CHECK_THROWS_AS(surface.evaluate({patch, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(LimitSurface(nullptr, Points()), std::invalid_argument);
  const SphereGrid crowded = make_grid(parse_grid("uv:513x3"));
  CHECK_THROWS_AS(LimitSurface(crowded.faces, crowded.directions, Scheme::CatmullClark),
                  std::invalid_argument);
}
