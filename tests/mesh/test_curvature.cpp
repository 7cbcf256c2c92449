#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sphparam/mesh/curvature.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;

double integral(const Eigen::VectorXd& density, const Curvature& c) { return density.dot(c.area); }

Curvature curvature_of(const TriangleMesh& mesh, double scale = 0, int threads = 0) {
  return measure_curvature(mesh, Topology(mesh), scale, threads);
}

/// A sphere some of whose vertices, no two of them neighbours, are all but at a neighbour's place.
TriangleMesh with_slivers(TriangleMesh mesh) {
  const Topology topology(mesh);
  std::vector<char> taken(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Vertex v = 0; v < mesh.vertex_count(); v += 3) {
    bool free = !taken[static_cast<size_t>(v)];
    const auto mark = [&](Halfedge h) { taken[static_cast<size_t>(topology.target(h))] = 1; };
    topology.for_each_outgoing(
        v, [&](Halfedge h) { free = free && !taken[static_cast<size_t>(topology.target(h))]; });
    if (!free) continue;
    mark(topology.twin(topology.outgoing(v)));
    topology.for_each_outgoing(v, mark);
    const Vector3 to = mesh.position(topology.target(topology.outgoing(v)));
    mesh.positions.row(v) = (to + 1e-6 * (mesh.position(v) - to)).normalized();
  }
  return mesh;
}

}  // namespace

TEST_CASE("curvature: Gauss curvature integrates to 4 pi on every sphere, at every scale") {
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(2), tube(30, 7), uv_sphere(40, 3),
                                   random_sphere_mesh(200, 3), with_slivers(icosphere(3))}) {
    for (const double scale : {0.0, 0.05, 0.7}) {
      const Curvature c = curvature_of(mesh, scale);
      CHECK(integral(c.gauss, c) == Approx(4 * pi).epsilon(1e-6));
      CHECK(c.mean.allFinite());
    }
  }
}

TEST_CASE("curvature: a sphere of radius r has mean curvature 1/r and Gauss curvature 1/r^2") {
  TriangleMesh mesh = icosphere(4);
  mesh.positions *= 3;
  const Curvature c = curvature_of(mesh);
  CHECK((c.mean.array() - 1.0 / 3).abs().maxCoeff() < 0.15 / 3);  // at valence 5
  CHECK(integral(c.mean, c) / c.area.sum() == Approx(1.0 / 3).epsilon(2e-3));
  CHECK(integral(c.gauss, c) / c.area.sum() == Approx(1.0 / 9).epsilon(5e-3));
  const Curvature smooth = curvature_of(mesh, 0.6);
  CHECK((smooth.mean.array() - 1.0 / 3).abs().maxCoeff() < 0.02 / 3);
  CHECK(equal_area_radius(mesh) == Approx(3).epsilon(5e-3));
}

TEST_CASE(
    "curvature: a tube of radius 1 has mean curvature 1/2 and no Gauss curvature, inside out "
    "it has the opposite sign") {
  TriangleMesh mesh = tube(40, 64);
  Curvature c = curvature_of(mesh);
  const Vertex middle = 1 + 20 * 64;
  CHECK(c.mean[middle] == Approx(0.5).epsilon(5e-3));
  CHECK(std::abs(c.gauss[middle]) < 1e-9);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  c = curvature_of(mesh);
  CHECK(c.mean[middle] == Approx(-0.5).epsilon(5e-3));
}

TEST_CASE("curvature: averaged over a scale, it keeps its integral and its extremes shrink") {
  const TriangleMesh mesh = with_slivers(icosphere(4));
  const Curvature raw = curvature_of(mesh), smooth = curvature_of(mesh, 0.2);
  CHECK(smooth.scale == 0.2);
  CHECK(integral(smooth.mean, smooth) == Approx(integral(raw.mean, raw)).epsilon(1e-6));
  // Slivers: nothing is lost in them, and the average is that of the sphere.
  CHECK(raw.gauss.cwiseAbs().maxCoeff() < 4);
  CHECK(raw.mean.cwiseAbs().maxCoeff() < 4);
  CHECK(smooth.gauss.maxCoeff() < raw.gauss.maxCoeff());
  CHECK(smooth.gauss.minCoeff() > raw.gauss.minCoeff());
  CHECK((smooth.mean.array() - 1).abs().maxCoeff() < 0.1);
  CHECK((smooth.gauss.array() - 1).abs().maxCoeff() < 0.2);
}

TEST_CASE("curvature: coinciding vertices and flat faces give finite values") {
  TriangleMesh mesh = icosphere(2);
  mesh.positions.row(mesh.triangles(5, 0)) = mesh.positions.row(mesh.triangles(5, 1));
  for (const double scale : {0.0, 0.3}) {
    const Curvature c = curvature_of(mesh, scale);
    CHECK(c.mean.allFinite());
    CHECK(c.gauss.allFinite());
  }
  mesh.positions.setZero();
  CHECK(curvature_of(mesh, 0.3).gauss.allFinite());
}

TEST_CASE("curvature: an edge without length, or a face in one place, makes no Gauss curvature") {
  for (const int corners : {2, 3}) {
    TriangleMesh mesh = icosphere(2);
    for (int k = 1; k < corners; ++k)
      mesh.positions.row(mesh.triangles(5, k)) = mesh.position(mesh.triangles(5, 0));
    const Curvature c = curvature_of(mesh);
    CHECK(integral(c.gauss, c) == Approx(4 * pi).epsilon(1e-12));
  }
}

TEST_CASE("curvature: what bends beside faces without area is not lost, on one side or both") {
  TriangleMesh mesh = octahedron();
  const double whole = 0.5 * 12 * std::sqrt(2.0) * std::acos(1.0 / 3);  // ½ Σ length · angle
  const auto total = [&] {
    const Curvature c = curvature_of(mesh);
    return integral(c.mean, c);
  };
  CHECK(total() == Approx(whole).epsilon(1e-12));
  // A vertex on the edge a–b that the face beside it knows, and the other one does not.
  const Topology topology(mesh);
  for (const Halfedge h : {0, topology.twin(0)}) {
    const Vertex a = topology.origin(h), b = topology.target(h), apex = topology.apex(h);
    const auto middle = static_cast<Vertex>(mesh.vertex_count());
    const Eigen::Index faces = mesh.face_count();
    mesh.positions.conservativeResize(middle + 1, 3);
    mesh.positions.row(middle) = 0.25 * mesh.position(a) + 0.75 * mesh.position(b);
    mesh.triangles.conservativeResize(faces + 2, 3);
    mesh.triangles.row(Topology::face(h)) << a, middle, apex;
    mesh.triangles.row(faces) << middle, b, apex;
    mesh.triangles.row(faces + 1) << a, b, middle;
    CHECK(total() == Approx(whole).epsilon(1e-12));
  }
}

TEST_CASE("curvature: of a mesh 2^k times as large, 1/2^k times as large to the last bit") {
  const TriangleMesh mesh = random_sphere_mesh(200, 5);
  const Curvature one = curvature_of(mesh, 0.25);
  for (const int k : {-520, -300, 300, 480}) {  // squares vanish, or overflow
    TriangleMesh scaled = mesh;
    scaled.positions = mesh.positions * std::ldexp(1.0, k);
    const Curvature c = curvature_of(scaled, std::ldexp(0.25, k));
    CHECK(c.mean == one.mean * std::ldexp(1.0, -k));
    CHECK((k < 0 || c.gauss == one.gauss * std::ldexp(1.0, -2 * k)));
    CHECK(c.area == one.area * std::ldexp(1.0, 2 * k));
    CHECK(c.gauss.allFinite());
    CHECK(c.area.allFinite());
    CHECK(equal_area_radius(scaled) == equal_area_radius(mesh) * std::ldexp(1.0, k));
  }
}

TEST_CASE("curvature: one vertex far away leaves finite values, at every scale") {
  for (const double far : {1e100, 1e160, 1e300}) {
    TriangleMesh mesh = icosphere(2);
    mesh.positions.row(17) *= far;
    const double radius = equal_area_radius(mesh);
    CHECK(std::isfinite(radius));
    for (const double scale : {0.0, 0.01, 1.0}) {
      const Curvature c = curvature_of(mesh, scale * radius);
      CHECK(c.mean.allFinite());
      CHECK(c.gauss.allFinite());
      CHECK(c.area.allFinite());
    }
  }
}

TEST_CASE("curvature: the same bits for any number of threads") {
  const TriangleMesh mesh = icosphere(5);
  const Curvature one = curvature_of(mesh, 0.1, 1), many = curvature_of(mesh, 0.1, 3);
  CHECK(one.mean == many.mean);
  CHECK(one.gauss == many.gauss);
}

TEST_CASE("curvature: more area than a sphere in the range of doubles has is told as the largest") {
  constexpr double largest = std::numeric_limits<double>::max();
  TriangleMesh mesh = random_sphere_mesh(200, 5);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {  // corners of a box, a hundred times each
    for (int i = 0; i < 3; ++i) mesh.positions(v, i) = (v * 7 / 3) >> i & 1 ? largest : -largest;
  }
  const double radius = equal_area_radius(mesh);
  CHECK(radius == largest);
  CHECK(measure_curvature(mesh, Topology(mesh), 0.02 * radius).mean.allFinite());
}

TEST_CASE("curvature: fillers count for nothing, however they bend") {
  TriangleMesh mesh = icosphere(4);
  FillerMarks fillers(static_cast<size_t>(mesh.face_count()), 0);
  std::vector<char> on_surface(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    double height = 0;
    for (int k = 0; k < 3; ++k) height += mesh.position(mesh.triangles(f, k)).z() / 3;
    fillers[static_cast<size_t>(f)] = height > 0.5;
    for (int k = 0; k < 3 && height <= 0.5; ++k)
      on_surface[static_cast<size_t>(mesh.triangles(f, k))] = 1;
  }
  const Topology topology(mesh);
  for (const bool flat : {false, true}) {
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      if (flat && !on_surface[static_cast<size_t>(v)]) mesh.positions(v, 2) = 0.5;
    for (const double scale : {0.0, 0.1}) {
      const Curvature c = measure_curvature(mesh, topology, scale, 0, fillers);
      for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
        if (on_surface[static_cast<size_t>(v)]) {
          REQUIRE(c.mean[v] == Approx(1).epsilon(0.15));
          REQUIRE(c.gauss[v] == Approx(1).epsilon(0.25));
        } else if (scale == 0) {
          REQUIRE(std::abs(c.mean[v]) + std::abs(c.gauss[v]) < 1e-6);
        }
      }
    }
  }
}
