#include <catch2/catch.hpp>
#include <limits>
#include <numbers>
#include <set>

#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/level_embedding.h"
#include "exact_area.h"
#include "maps.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/all_triangulations.h"
#include "support/coil.h"
#include "support/instruction_limit.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

SphericalChart chart_of(const TriangleMesh& mesh, const SphereMap& map, int threads = 0) {
  return spherical_chart(mesh, Topology(mesh), map, threads);
}

/// A map by one start, the finest level left as it comes beyond so many times an isometry's energy:
/// triangles of limbs are thinner on it than on the map that is made of several.
SphereMap embedded(const TriangleMesh& mesh, Quality quality, double demanding) {
  return *embed_by_levels(mesh, Topology(mesh), {.quality = quality}, {}, {.demanding = demanding})
              .map;
}

bool usable(const TriangleMesh& mesh, const SphereMap& map) {
  return certify(Topology(mesh), map).bijective();
}

/// What must hold for every chart, whatever it was made of. `exact`: also by rational arithmetic.
void check_laws(const TriangleMesh& mesh, const SphereMap& map, bool exact = false) {
  REQUIRE(usable(mesh, map));
  const SphericalChart chart = chart_of(mesh, map);
  CHECK(chart.certificate.one_to_one());
  CHECK(chart.certificate.max_shift < 1e-11);
  CHECK(certify_chart(chart).max_shift == chart.certificate.max_shift);  // of all rays, asked anew
  const auto vertices = static_cast<int>(chart.points.rows());
  const Topology refined(chart.triangles, vertices);
  CHECK(vertices - refined.edge_count() + refined.face_count() == 2);
  CHECK(refined.face_count() == mesh.face_count() + 2 * chart.counts.splits());
  CHECK(certify(refined, {chart.points}).bijective());
  CHECK(chart.certificate.inverted.empty());
  if (!exact) return;
  const ExactArea area = exact_area(chart);
  CHECK(area.sum == 1);
  CHECK(area.not_positive == 0);
}

/// The point of the geodesic map that a refined vertex says it is.
Vector3 mapped(const TriangleMesh& mesh, const SphereMap& map, const SurfacePoint& point) {
  Vector3 ray = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    ray += point.barycentric[k] * map.point(mesh.triangles(point.face, k));
  return ray.normalized();
}

}  // namespace

TEST_CASE("chart: small spheres as they stand") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), icosahedron(), icosphere(2),
                                   uv_sphere(12, 5), uv_sphere(3, 1)}) {
    check_laws(mesh, normalised(mesh.positions), true);
  }
}

TEST_CASE("chart: a sphere with vertices at the poles and along the meridian is left alone") {
  const TriangleMesh mesh = uv_sphere(12, 5);
  const SphericalChart chart = chart_of(mesh, {mesh.positions});
  CHECK(chart.counts.splits() == 0);
  CHECK(chart.triangles == mesh.triangles);
  CHECK(chart.points.row(0) == mesh.positions.row(0));
  CHECK(chart.north == 0);
  CHECK(chart.south == mesh.vertex_count() - 1);
  // Every vertex once, five on the seam twice, each pole once a triangle.
  CHECK(chart.wedge_count() == mesh.vertex_count() + 5 + 2 * 11);
}

TEST_CASE("chart: thousands of random rotations of small meshes") {
  std::mt19937 random(1);
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), icosahedron(), uv_sphere(12, 5)}) {
    for (int i = 0; i < 500; ++i) {
      const SphereMap map = rotated(normalised(mesh.positions), random_rotation(random));
      check_laws(mesh, map, i < 20);
    }
  }
}

TEST_CASE("chart: every triangulation with up to 8 vertices, turned at random") {
  std::mt19937 random(2);
  for (int vertices = 4; vertices <= 8; ++vertices) {
    for (const Rotations& rotations : all_triangulations(vertices)) {
      const TriangleMesh mesh = mesh_of(rotations, 1);
      const SphereMap map = gnomonic_embedding(mesh, Topology(mesh), {}).map;
      check_laws(mesh, map, true);
      for (int i = 0; i < 3; ++i) {
        const SphereMap turned = rotated(map, random_rotation(random));
        if (usable(mesh, turned)) check_laws(mesh, turned, true);
      }
    }
  }
}

TEST_CASE("chart: poles ever nearer to a vertex or an edge") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(1), uv_sphere(12, 5)}) {
    const SphereMap map = normalised(mesh.positions);
    for (const double distance : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3}) {
      for (int i = 0; i < 12; ++i) {
        const auto f = static_cast<Face>(random() % static_cast<unsigned>(mesh.face_count()));
        const Vector3 a = map.point(mesh.triangles(f, 0)), b = map.point(mesh.triangles(f, 1));
        const Vector3 across = a.cross(b).normalized();
        const double t = i % 2 ? uniform(random) : 0;
        const SphereMap turned =
            aimed(map, (((1 - t) * a + t * b).normalized() + distance * across).normalized());
        if (usable(mesh, turned)) check_laws(mesh, turned);
      }
    }
  }
}

TEST_CASE("chart: y = ±0 and vertices within rounding of the meridian lie on it") {
  TriangleMesh mesh = uv_sphere(12, 5);
  for (const double y : {0.0, -0.0, 1e-17, -1e-17, 1e-15, -1e-15}) {
    SphereMap map{mesh.positions};
    for (int ring = 0; ring < 5; ++ring) map.points(1 + 12 * ring, 1) = y;
    const SphericalChart chart = chart_of(mesh, map);
    CHECK(chart.certificate.one_to_one());
    CHECK(chart.counts.splits() == 0);
    CHECK(chart.counts.snapped_vertices == (y == 0 ? 0 : 5));
    for (int ring = 0; ring < 5; ++ring) CHECK(chart.uv(1 + 12 * ring, 0) == 0);
  }
}

TEST_CASE("chart: seam copies are equal in v and exactly one turn apart, the fan in the middle") {
  std::mt19937 random(4);
  const TriangleMesh mesh = icosphere(2);
  const SphericalChart chart = chart_of(mesh, rotated({mesh.positions}, random_rotation(random)));
  int copies = 0, fans = 0;
  for (int w = 0; w < chart.wedge_count(); ++w) {
    const Vertex v = chart.wedge_vertices[static_cast<size_t>(w)];
    const WedgeKind kind = chart.wedge_kinds[static_cast<size_t>(w)];
    if (kind == WedgeKind::Seam) CHECK(chart.uv(w, 0) == 0);
    if (kind == WedgeKind::Ordinary) CHECK((chart.uv(w, 0) > 0 && chart.uv(w, 0) < 1));
    if (kind == WedgeKind::PoleFan) ++fans;
    if (kind == WedgeKind::SeamCopy) {
      ++copies;
      CHECK(chart.uv(w, 0) == 1);
      CHECK(chart.uv(w, 1) == chart.uv(v, 1));
      CHECK(chart.wedge_kinds[static_cast<size_t>(v)] == WedgeKind::Seam);
    }
  }
  CHECK(copies > 5);
  int pole_faces = 0;
  for (Face f = 0; f < static_cast<Face>(chart.triangles.rows()); ++f) {
    const int k = chart.pole_corner(f);
    if (k < 0) continue;
    ++pole_faces;
    const auto u = [&](int corner) { return chart.uv(chart.wedges(f, corner % 3), 0); };
    CHECK(u(k) == 0.5 * (u(k + 1) + u(k + 2)));
  }
  CHECK(fans == pole_faces);
}

TEST_CASE("chart: (u, v) are θ/2π and ϕ/π of points on the geodesic map") {
  std::mt19937 random(5);
  const TriangleMesh mesh = random_sphere_mesh(60, 7);
  const SphereMap map = rotated(parameterize(mesh).map, random_rotation(random));
  const SphericalChart chart = chart_of(mesh, map);
  CHECK(chart.counts.fold_splits > 0);
  for (int w = 0; w < chart.wedge_count(); ++w) {
    const Vertex v = chart.wedge_vertices[static_cast<size_t>(w)];
    const Vector3 x = chart.points.row(v);
    const SurfacePoint& point = chart.surface_points[static_cast<size_t>(v)];
    CHECK(point.barycentric.minCoeff() >= 0);
    CHECK(point.barycentric.sum() == Approx(1).epsilon(1e-14));
    CHECK((mapped(mesh, map, point) - x).norm() < 1e-13);
    const SphericalCoordinates c = to_spherical(x);
    CHECK(chart.uv(w, 1) == Approx(c.phi / std::numbers::pi).margin(1e-14));
    if (chart.wedge_kinds[static_cast<size_t>(w)] != WedgeKind::PoleFan) {
      const double turns = chart.uv(w, 0) - c.theta / (2 * std::numbers::pi);
      CHECK(std::abs(turns - std::round(turns)) < 1e-14);
    }
  }
}

TEST_CASE("chart: hubs of huge valence cost no more than others") {
  std::mt19937 random(6);
  const TriangleMesh mesh = uv_sphere(100000, 1);
  CHECK(chart_of(mesh, {mesh.positions}).certificate.one_to_one());
  const SphereMap turned = rotated({mesh.positions}, random_rotation(random));
  if (usable(mesh, turned)) CHECK(chart_of(mesh, turned).certificate.one_to_one());
}

TEST_CASE("chart: aggregates squashed to 1e-10, anywhere on the sphere") {
  std::mt19937 random(7);
  const TriangleMesh mesh = icosphere(3);
  for (const double factor : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    for (int i = 0; i < 10; ++i) {
      const SphereMap map = squashed(rotated({mesh.positions}, random_rotation(random)), factor);
      check_laws(mesh, map);
      check_laws(mesh, rotated(map, random_rotation(random)));
    }
  }
}

TEST_CASE("chart: aggregates squashed to 1e-12 that lie on the seam") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> latitude(0.3, 1.3);
  const TriangleMesh mesh = icosphere(3);
  for (const double factor : {1e-6, 1e-9, 1e-12}) {
    for (int i = 0; i < 60; ++i) {
      const Eigen::AngleAxisd onto_seam(latitude(random), Vector3::UnitY());
      const SphereMap map = squashed(rotated({mesh.positions}, random_rotation(random)), factor);
      check_laws(mesh, rotated(map, onto_seam.toRotationMatrix()));
    }
  }
}

TEST_CASE("chart: where triangles are as small as rounding it is certified all the same") {
  std::mt19937 random(8);
  const TriangleMesh mesh = icosphere(3);
  for (const double factor : {1e-12, 1e-13, 1e-14}) {
    for (int i = 0; i < 60; ++i) {
      const SphereMap map =
          rotated(squashed(rotated({mesh.positions}, random_rotation(random)), factor),
                  random_rotation(random));
      if (!usable(mesh, map)) continue;
      const SphericalChart chart = chart_of(mesh, map);
      CHECK(chart.certificate.one_to_one());
      CHECK(exact_area(chart).not_positive == 0);
      CHECK(chart.certificate.max_shift < 1e-4);
      // Crossings of the meridian that round to one point are told apart.
      CHECK(chart.certificate.inverted.empty());
    }
  }
}

TEST_CASE("chart: needles that lie on each other by the thousand take some hundred splits a fold") {
  std::mt19937 random(12);
  for (const int rings : {300, 1000, 3000}) {
    const TriangleMesh mesh = tube(rings, 6);
    const SphereMap map = embedded(mesh, Quality::Draft, 0);
    for (const SphereMap& turned : {map, rotated(map, random_rotation(random))}) {
      const SphericalChart chart = chart_of(mesh, turned);
      CHECK(chart.certificate.one_to_one());
      CHECK(chart.certificate.inverted.empty());
      CHECK(chart.certificate.max_shift < 0x1p-7);
      CHECK(chart.counts.folded_faces > rings / 2);
      CHECK(chart.counts.fold_splits < 200 * chart.counts.folded_faces);
      CHECK(count_folds(chart) == 0);
    }
  }
}

TEST_CASE(
    "chart: a tube wound about the poles takes twice its vertices, and moves some for the rest") {
  const TriangleMesh mesh = coil(19);
  const SphericalChart chart = chart_of(mesh, parameterize(mesh, {.energy = {.lambda = 0.1}}).map);
  CHECK(chart.certificate.one_to_one());
  CHECK(chart.points.rows() <= 2 * mesh.vertex_count());
  CHECK(chart.counts.nudged_vertices > 0);
  CHECK(chart.certificate.max_shift < 0x1p-7);
  CHECK(exact_area(chart).not_positive == 0);
}

TEST_CASE("chart: where ten thousands would have to move together, splits are made at once") {
  TriangleMesh mesh = icosphere(5);  // but for a cap all is in one place
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions(v, 2) < 0.9) mesh.positions.row(v).setZero();
  }
  const SphereMap map = parameterize(mesh, {.quality = Quality::Draft}).map;
  int asked = 0;
  const Progress progress = [&](std::string_view, double) { return ++asked > 0; };
  const SphericalChart chart = spherical_chart(mesh, Topology(mesh), map, 0, progress);
  CHECK(asked == 128);  // parts that move together ask, too: a large one took minutes
  CHECK(chart.counts.nudged_vertices == 0);
  CHECK(chart.certificate.one_to_one());
  CHECK(chart.certificate.inverted.empty());
  CHECK(chart.counts.fold_splits > 4 * mesh.vertex_count());
}

TEST_CASE("chart: where moves would be far, all the splits are made, as often as it takes") {
  const TriangleMesh mesh = coil(24);
  const Topology topology(mesh);
  const SphereMap map = embedded(mesh, Quality::Normal, 1e300);
  double last = 0;
  const Progress progress = [&](std::string_view stage, double share) {
    CHECK(stage == "chart");
    CHECK((last <= share && share <= 1));
    last = share;
    return true;
  };
  const SphericalChart whole = spherical_chart(mesh, topology, map, 0, progress);
  CHECK(whole.certificate.one_to_one());
  CHECK_FALSE(whole.counts.at_limit);
  CHECK(whole.certificate.max_shift < 0x1p-7);
  CHECK(last == 1);
  constexpr int some = 4096;
  REQUIRE(whole.counts.fold_splits > some);
  const SphericalChart cut = spherical_chart(mesh, topology, map, 0, {}, 0);
  CHECK(cut.counts.fold_splits <= some);
  CHECK(cut.certificate.one_to_one());
  CHECK(cut.counts.nudged_vertices > 0);
  const Progress stop = [](std::string_view, double share) { return share == 0; };
  CHECK_THROWS_AS(spherical_chart(mesh, topology, map, 0, stop), Cancelled);
  CHECK_THROWS_AS(spherical_chart(mesh, topology, map, 0, {}, -1), std::invalid_argument);
}

TEST_CASE("chart: one that takes more splits than are allowed says so") {
  const TriangleMesh mesh = coil(40);
  constexpr int some = 4096;
  const Topology topology(mesh);
  const SphereMap first = *embed_by_levels(mesh, topology, {}, {}, {}).map;
  const SphericalChart cut = spherical_chart(mesh, topology, first, 0, {}, 0);
  CHECK(cut.counts.at_limit);
  CHECK(cut.counts.fold_splits == some);
  CHECK_FALSE(cut.certificate.one_to_one());
  CHECK_FALSE(cut.certificate.folded.empty());
  CHECK(cut.triangles.rows() == mesh.face_count() + 2 * cut.counts.splits());
}

TEST_CASE("chart: the same bytes for any number of threads, by any instructions") {
  const TriangleMesh mesh = relabelled(icosphere(5), 3);
  std::mt19937 random(9);
  const SphereMap map = rotated({mesh.positions}, random_rotation(random));
  const SphericalChart one = chart_of(mesh, map, 1);
  for (const int threads : {2, 5}) {
    const SphericalChart many = chart_of(mesh, map, threads);
    CHECK(many.triangles == one.triangles);
    CHECK(many.wedges == one.wedges);
    CHECK(many.uv == one.uv);
    CHECK(many.points == one.points);
  }
  for (const InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2}) {
    const InstructionLimit limit(set);
    CHECK(chart_of(mesh, map, 2).uv == one.uv);
  }
}

TEST_CASE("chart: a map of another mesh, or one that covers no pole, is refused") {
  const TriangleMesh mesh = octahedron();
  CHECK_THROWS_AS(chart_of(mesh, {icosahedron().positions}), std::invalid_argument);
  SphereMap front{mesh.positions};
  front.points.col(0).setOnes();
  CHECK_THROWS_AS(chart_of(mesh, front), std::invalid_argument);
  for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    SphereMap map{mesh.positions};
    map.points.row(2) *= bad;
    CHECK_THROWS_AS(chart_of(mesh, map), std::invalid_argument);
    CHECK_THROWS_AS(wrapped_chart(mesh, Topology(mesh), map), std::invalid_argument);
  }
}

TEST_CASE("wrapped chart: no new vertices, u beyond 1 across the meridian, folds listed") {
  std::mt19937 random(10);
  const TriangleMesh mesh = random_sphere_mesh(60, 7);
  const Topology topology(mesh);
  const SphereMap map = rotated(parameterize(mesh).map, random_rotation(random));
  const SphericalChart wrapped = wrapped_chart(mesh, topology, map);
  CHECK(wrapped.triangles == mesh.triangles);
  CHECK(wrapped.points == map.points);
  CHECK(wrapped.uv.col(0).maxCoeff() > 1);
  CHECK_FALSE(wrapped.certificate.one_to_one());
  CHECK(wrapped.certificate.around_pole.size() == 2);
  // A face that neither folds nor holds a pole spans less than half a turn.
  std::set<Face> bad(wrapped.certificate.around_pole.begin(),
                     wrapped.certificate.around_pole.end());
  bad.insert(wrapped.certificate.folded.begin(), wrapped.certificate.folded.end());
  CHECK(static_cast<int>(bad.size()) < mesh.face_count() / 2);
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    double low = 2, high = 0;
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, wrapped.uv(wrapped.wedges(f, k), 0));
      high = std::max(high, wrapped.uv(wrapped.wedges(f, k), 0));
    }
    if (!bad.contains(f)) CHECK(high - low < 0.5);
    CHECK((exact_area_of_piece(wrapped, f) <= 0) ==
          (std::find(wrapped.certificate.folded.begin(), wrapped.certificate.folded.end(), f) !=
           wrapped.certificate.folded.end()));
  }
}

TEST_CASE("wrapped chart: where nothing crosses the meridian it is the chart") {
  const TriangleMesh mesh = uv_sphere(12, 5);
  const SphericalChart chart = chart_of(mesh, {mesh.positions});
  const SphericalChart wrapped = wrapped_chart(mesh, Topology(mesh), {mesh.positions});
  CHECK(wrapped.uv == chart.uv);
  CHECK(wrapped.wedges == chart.wedges);
  CHECK(wrapped.certificate.one_to_one());
}
