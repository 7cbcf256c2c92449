#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "embedding/constructions/progressive.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/solid_angle_aim.h"
#include "embedding/newton/even_areas.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/optimise.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "support/hard_shapes.h"
#include "support/reference_newton.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// An ellipsoid, and its map of equal directions.
struct Stretched {
  TriangleMesh mesh;
  SphereMap start{mesh.positions};
  Topology topology{mesh};
  RestTriangles source;

  explicit Stretched(double factor, int level = 4) : mesh(icosphere(level)) {
    mesh.positions.col(0) *= factor;
    source = measure_source(mesh);
  }
};

SphereMap embedded(const TriangleMesh& mesh, Quality quality) {
  return *embed_progressively(mesh, Topology(mesh), {.quality = quality}).map;
}

double energy_of(const TriangleMesh& mesh, const SphereMap& map) {
  return distortion_energy(Topology(mesh), measure_source(mesh), map, {});
}

}  // namespace

TEST_CASE("optimise: agrees with Newton's method by Cholesky factors") {
  const Stretched s(3);
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const DistortionEnergy energy{.kind = kind};
    const NewtonResult exact =
        minimise_by_newton(s.topology, s.source, s.start, {.energy = energy, .least_gain = 1e-10});
    const Optimisation r =
        optimise(s.topology, s.source, s.start, {.energy = energy, .least_gain = 1e-9});
    CHECK(r.report.converged);
    CHECK(r.report.energy_after == Approx(exact.report.energy_after).epsilon(1e-7));
    CHECK(r.report.energy_after ==
          Approx(distortion_energy(s.topology, s.source, r.map, energy)).epsilon(1e-7));
    CHECK(certify(s.topology, r.map).bijective());
  }
}

TEST_CASE("optimise: pinned vertices keep their bits") {
  const Stretched s(2);
  const std::vector<Vertex> pinned{0, 17, 700};
  const Optimisation r = optimise(s.topology, s.source, s.start, {.pinned = pinned});
  for (const Vertex v : pinned) CHECK(r.map.points.row(v) == s.start.points.row(v));
  CHECK(r.map.points.row(1) != s.start.points.row(1));
  CHECK(r.report.energy_after < r.report.energy_before);
}

TEST_CASE("optimise: the same bits for any number of threads") {
  const Stretched s(4, 5);  // large enough to be worth several threads
  const Optimisation one = optimise(s.topology, s.source, s.start, {.max_steps = 5, .threads = 1});
  for (const int threads : {2, 3}) {
    const Optimisation other =
        optimise(s.topology, s.source, s.start, {.max_steps = 5, .threads = threads});
    CHECK(other.map.points == one.map.points);
  }
}

TEST_CASE("optimise: a folded map comes back as it was") {
  Stretched s(2);
  s.start.points.row(5) = -s.start.points.row(5);
  const Optimisation r = optimise(s.topology, s.source, s.start);
  CHECK(r.map.points == s.start.points);
  CHECK(r.report.energy_before == std::numeric_limits<double>::infinity());
  CHECK(r.report.steps == 0);
}

TEST_CASE(
    "optimise: a map that winds twice about its poles, without a fold, comes back as it was") {
  const TriangleMesh mesh = uv_sphere(24, 7);
  const Topology topology(mesh);
  SphereMap twice{mesh.positions};
  for (Vertex v = 1; v + 1 < topology.vertex_count(); ++v) {
    const double x = mesh.positions(v, 0), y = mesh.positions(v, 1), r = std::hypot(x, y);
    twice.points.row(v) << (x * x - y * y) / r, 2 * x * y / r, mesh.positions(v, 2);
  }
  const RestTriangles source = measure_source(mesh);
  const Optimisation r = optimise(topology, source, twice);
  CHECK(r.map.points == twice.points);
  CHECK(std::isfinite(r.report.energy_before));
  CHECK(r.report.energy_after == r.report.energy_before);
  CHECK(r.report.steps == 0);
  CHECK_FALSE(r.report.converged);
}

TEST_CASE("optimise: every vertex pinned, nothing moves") {
  const Stretched s(2);
  std::vector<Vertex> all;
  for (Vertex v = 0; v < s.topology.vertex_count(); ++v) all.push_back(v);
  const Optimisation r = optimise(s.topology, s.source, s.start, {.pinned = all});
  CHECK(r.map.points == s.start.points);
}

TEST_CASE("optimise: tiny meshes and large valences") {
  for (const TriangleMesh& mesh :
       {tetrahedron(), octahedron(), uv_sphere(3000, 1), random_sphere_mesh(300, 3)}) {
    const Topology topology(mesh);
    const SphereMap start = embedded(mesh, Quality::Draft);
    const Optimisation r = optimise(topology, measure_source(mesh), start, {.max_steps = 10});
    CHECK(r.report.energy_after <= r.report.energy_before);
    CHECK(certify(topology, r.map).bijective());
  }
}

TEST_CASE("optimise: limbs of nearly conformal maps find their place as a direct solver does") {
  // They are 1e-4 to 1e-6 of the sphere, and move by thousands of their own edges.
  const TriangleMesh mesh = brush(3, 6, 6, 20);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const DistortionEnergy energy{.lambda = least_lambda};
  const auto beyond_conformal = [&](const SphereMap& map) {
    double area = 0;
    for (const RestTriangle& triangle : source) area += triangle.area;
    return distortion_energy(topology, source, map, energy) / area - 1;
  };
  const SphereMap start = *embed_progressively(mesh, topology, {.energy = energy}).map;
  const SphereMap map =
      optimise(topology, source, start, {.energy = energy, .least_gain = 1e-3}).map;
  const SphereMap further =
      minimise_by_newton(topology, source, map, {.energy = energy, .max_steps = 10}).map;
  CHECK(beyond_conformal(map) < 1.005 * beyond_conformal(further));
}

TEST_CASE("optimise_balance: towards conformal the angles win, towards equal area the areas") {
  TriangleMesh mesh = tube(40, 12);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap start = embedded(mesh, Quality::Normal);
  const DistortionSummary middle = summarise(measure_distortion(mesh, start));

  const ProgressiveOptions nearly{.energy = {.lambda = least_lambda}};
  const BalancedMap angles =
      optimise_balance(topology, source, *embed_progressively(mesh, topology, nearly).map,
                       {.balance = Balance::Conformal, .from_lambda = least_lambda});
  const DistortionSummary conformal = summarise(measure_distortion(mesh, angles.map));
  CHECK(angles.lambda < 1e-3);
  CHECK(conformal.mean_abs_ln_angle < middle.mean_abs_ln_angle / 2);
  CHECK(angles.lambda == least_lambda);  // areas fall beyond what any λ makes light
  CHECK(certify(topology, angles.map).bijective());

  const BalancedMap areas =
      optimise_balance(topology, source, start, {.balance = Balance::EqualArea});
  const DistortionSummary equal = summarise(measure_distortion(mesh, areas.map));
  CHECK(equal.weighted_abs_log2_area <= 0.1);
  CHECK(areas.area_error == Approx(equal.weighted_abs_log2_area).epsilon(1e-6));
  CHECK(certify(topology, areas.map).bijective());
}

TEST_CASE("optimise_balance: in a conformal map areas weigh next to nothing, but not nothing") {
  const Stretched s(3);
  const DistortionEnergy nearly{.lambda = least_lambda};
  const SphereMap start = *embed_progressively(s.mesh, s.topology, {.energy = nearly}).map;
  const BalancedMap r = optimise_balance(
      s.topology, s.source, start, {.balance = Balance::Conformal, .from_lambda = least_lambda});
  const auto energy = [&](double lambda) {
    return distortion_energy(s.topology, s.source, r.map, {.lambda = lambda}) / (4 * M_PI);
  };
  const double missed = energy(0) - 1, of_areas = energy(1) - energy(0) - 1;
  CHECK(r.lambda * of_areas < 0.01 * missed);
  CHECK(r.lambda * of_areas > 0.001 * missed);
}

TEST_CASE("optimise_balance: equal areas are solid angles, also of triangles that are large") {
  const TriangleMesh mesh = brush(1, 3, 20, 30);
  const Topology topology(mesh);
  const BalancedMap even =
      optimise_balance(topology, measure_source(mesh), embedded(mesh, Quality::Normal),
                       {.balance = Balance::EqualArea});
  CHECK(even.area_error <= 0.1);
  CHECK(certify(topology, even.map).bijective());
}

TEST_CASE("optimise_balance: areas are even where three triangles are nearly all of the sphere") {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.row(0) *= 20;
  const Topology topology(mesh);
  const SphereMap start = embedded(mesh, Quality::Normal);
  const BalancedMap even =
      optimise_balance(topology, measure_source(mesh), start, {.balance = Balance::EqualArea});
  CHECK(even.area_error <= 0.1);
  CHECK(even.lambda == greatest_lambda);
  CHECK(even.report.steps > 0);
  const DistortionSummary summary = summarise(measure_distortion(mesh, even.map));
  CHECK(summary.weighted_abs_log2_area == Approx(even.area_error).epsilon(1e-9));
  CHECK(summary.mean_abs_ln_angle < 1);  // the climb's is half as much again
  CHECK(certify(topology, even.map).bijective());
}

TEST_CASE("even_areas: solid angles become areas, pinned vertices keep their bits") {
  TriangleMesh mesh = icosphere(2);
  const SphereMap start{mesh.positions};
  mesh.positions.col(2) *= 4;
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const auto error_of = [&](const SphereMap& map) {
    return area_error(topology, source, image_of(map), 1);
  };
  REQUIRE(error_of(start) > 0.2);
  const EvenAreasOptions options{.area_error = 1e-6, .pinned = {0, 17}};
  const EvenedMap evened = even_areas(topology, source, start, options);
  const SphereMap& even = evened.map;
  CHECK(evened.steps > 0);
  CHECK(error_of(even) < 1e-6);
  CHECK(certify(topology, even).bijective());
  for (const Vertex v : options.pinned) CHECK(even.point(v) == start.point(v));
  EvenAreasOptions alone = options;
  alone.threads = 1;
  CHECK(even_areas(topology, source, start, alone).map.points == even.points);
  // What is even stays; what is asked for is not overshot by far.
  const EvenedMap again = even_areas(topology, source, even, {});
  CHECK(again.steps == 0);
  CHECK(again.map.points == even.points);
  // Where all are pinned nothing moves.
  EvenAreasOptions none = options;
  none.pinned.clear();
  for (Vertex v = 0; v < topology.vertex_count(); ++v) none.pinned.push_back(v);
  CHECK(even_areas(topology, source, start, none).map.points == start.points);
}

TEST_CASE("aimed_at_solid_angles: an icosahedron that is its own map aims at its determinants") {
  const TriangleMesh mesh = icosahedron();
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const std::vector<ImagePoint> image = image_of({mesh.positions.rowwise().normalized()});
  CHECK(area_error(topology, source, image, 1) == Approx(0).margin(1e-12));
  CHECK(determinant_error(topology, source, image, 1) > 0.5);
  const RestTriangles aimed = aimed_at_solid_angles(topology, source, image, 1);
  for (Face f = 0; f < topology.face_count(); ++f) {
    const auto corner = [&](int k) {
      return image[static_cast<size_t>(topology.vertex(f, k))].vector();
    };
    const double det = corner(0).dot(corner(1).cross(corner(2)));
    CHECK(aimed[static_cast<size_t>(f)].area == Approx(det / 2));
  }
}

TEST_CASE("optimise_balance: reaches a given lambda and is optimal there") {
  const Stretched s(3);
  for (const double lambda : {1e-4, 300.0}) {
    const BalancedMap r =
        optimise_balance(s.topology, s.source, s.start,
                         {.optimise = {.energy = {.lambda = lambda}, .least_gain = 1e-8}});
    CHECK(r.lambda == lambda);
    const NewtonResult further =
        minimise_by_newton(s.topology, s.source, r.map, {.energy = {.lambda = lambda}});
    CHECK(further.report.energy_after > (1 - 1e-5) * r.report.energy_after);
  }
}

TEST_CASE("recentring: lowers the energy of a conformal map that is off centre") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  std::vector<ImagePoint> image;
  const Vector3 a(0.5, 0.2, 0);  // a Möbius transformation: conformal, but crowded at a
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v).normalized();
    image.push_back(image_point(((1 - a.squaredNorm()) * x + 2 * (1 + a.dot(x)) * a).normalized()));
  }
  const DistortionEnergy energy{.lambda = 1e-4};
  GlobalNewton newton(topology, measure_source(mesh), image, {}, 1);
  const double before = newton.energy(energy);
  double after = before;
  for (int i = 0; i < 12; ++i) after = newton.recentre(energy);
  const double best = distortion_energy(topology, measure_source(mesh), {mesh.positions}, energy);
  CHECK(after - best < 0.05 * (before - best));
}

TEST_CASE("quality: each is at least as good as the one before, on a shape with long protrusions") {
  const TriangleMesh mesh = tube(40, 12);
  const double draft = energy_of(mesh, embedded(mesh, Quality::Draft));
  const double normal = energy_of(mesh, embedded(mesh, Quality::Normal));
  const double best = energy_of(mesh, embedded(mesh, Quality::Best));
  CHECK(normal < draft);
  CHECK(best <= normal);
  CHECK(normal < 1.01 * best);
}

TEST_CASE("quality: the best is stationary, and above no other quality") {
  for (const TriangleMesh& mesh :
       {brush(1, 3, 20, 30), dumbbell(30, 0.02, 8), with_slivers(tube(40, 12), 0.2, 1e-3, 1)}) {
    const SphereMap map = embedded(mesh, Quality::Best);
    const double best = energy_of(mesh, map);
    CHECK(best <= energy_of(mesh, embedded(mesh, Quality::Draft)));
    CHECK(best <= energy_of(mesh, embedded(mesh, Quality::Normal)));
    const Optimisation further =
        optimise(Topology(mesh), measure_source(mesh), map, {.least_gain = 1e-6});
    CHECK(further.report.energy_after > (1 - 1e-4) * best);
  }
}
