#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "remesh/flat_places.h"
#include "remesh/float32_places.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/resample.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A ball that is its own map, turned so that no vertex lies on another one's.
TriangleMesh ball(int halvings, double turn = 0) {
  TriangleMesh mesh = icosphere(halvings);
  const Eigen::AngleAxisd rotation(turn, Vector3(1, 2, 3).normalized());
  mesh.positions = mesh.positions * rotation.toRotationMatrix().transpose();
  return mesh;
}

MappedMesh mapped(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  return MappedMesh({.file = std::move(file), .map = {mesh.positions}});
}

struct Spheres {
  MappedMesh current;
  TriangleMesh target;
  Topology topology;
  Spheres(int from, int to)
      : current(mapped(ball(from))), target(ball(to, 0.4)), topology(target) {}

  Gather adaptive(int threads = 1) const {
    return adap_bary_area_weights(current, topology, {target.positions},
                                  vertex_areas(current.mesh()), vertex_areas(target), threads);
  }
};

double sum_of(const Gather& gather, std::int64_t i) {
  const auto at = static_cast<size_t>(i);
  return std::accumulate(gather.weights.begin() + gather.starts[at],
                         gather.weights.begin() + gather.starts[at + 1], 0.0);
}

std::vector<double> heights(const TriangleMesh& mesh) {
  const auto z = mesh.positions.col(2);
  return {z.begin(), z.end()};
}

double integral(const TriangleMesh& mesh, const std::vector<double>& values) {
  return vertex_areas(mesh).dot(
      Eigen::Map<const VectorX>(values.data(), static_cast<Eigen::Index>(values.size())));
}

}  // namespace

TEST_CASE("resample: weights are of every new vertex, none is nothing, and they sum to 1") {
  for (const auto& [from, to] : {std::pair(3, 1), std::pair(2, 2), std::pair(1, 3)}) {
    const Spheres spheres(from, to);
    for (const Gather& gather :
         {barycentric_weights(spheres.current, spheres.target.positions), spheres.adaptive()}) {
      REQUIRE(gather.count() == spheres.target.vertex_count());
      for (std::int64_t i = 0; i < gather.count(); ++i) CHECK(sum_of(gather, i) == Approx(1));
      CHECK(*std::min_element(gather.weights.begin(), gather.weights.end()) > 0);
      CHECK(gather.vertices.size() == gather.weights.size());
    }
  }
}

TEST_CASE("resample: the direction of a vertex takes from it alone") {
  const Spheres spheres(2, 2);
  const Gather gather = barycentric_weights(spheres.current, 4 * spheres.current.mesh().positions);
  for (std::int64_t i = 0; i < gather.count(); ++i) {
    REQUIRE(gather.starts[static_cast<size_t>(i)] == i);
    CHECK(gather.vertices[static_cast<size_t>(i)] == i);
  }
}

TEST_CASE("resample: barycentric weights are those of the nearest point of flat triangles") {
  const Spheres spheres(2, 1);
  const Gather gather = barycentric_weights(spheres.current, spheres.target.positions);
  const Points& points = spheres.current.mesh().positions;
  for (std::int64_t i = 0; i < gather.count(); ++i) {
    Vector3 place = Vector3::Zero();
    for (auto e = gather.starts[static_cast<size_t>(i)];
         e < gather.starts[static_cast<size_t>(i) + 1]; ++e)
      place += gather.weights[static_cast<size_t>(e)] *
               points.row(gather.vertices[static_cast<size_t>(e)]).transpose();
    const Vector3 p = spheres.target.positions.row(i);
    double nearest = 1;
    for (Face f = 0; f < spheres.current.topology().face_count(); ++f)
      for (double a = 0; a <= 1; a += 0.0625)
        for (double b = 0; a + b <= 1; b += 0.0625) {
          const auto corner = [&](int k) -> Vector3 {
            return points.row(spheres.current.mesh().triangles(f, k));
          };
          const Vector3 other = a * corner(0) + b * corner(1) + (1 - a - b) * corner(2);
          nearest = std::min(nearest, (other - p).norm());
        }
    CHECK((place - p).norm() <= nearest + 1e-12);
  }
}

TEST_CASE("resample: by areas, a coarser sphere leaves nothing out and nearly keeps integrals") {
  const Spheres spheres(4, 2);
  const Gather gather = spheres.adaptive();
  std::vector<char> used(static_cast<size_t>(spheres.current.mesh().vertex_count()), 0);
  for (const Vertex v : gather.vertices) used[static_cast<size_t>(v)] = 1;
  CHECK(std::count(used.begin(), used.end(), 0) == 0);
  std::vector<double> spike(used.size(), 0.0);
  spike[100] = 1;
  const double before = integral(spheres.current.mesh(), spike);
  CHECK(integral(spheres.target, weighted_means(gather, spike)) == Approx(before).epsilon(0.15));
  CHECK(integral(spheres.target,
                 weighted_means(barycentric_weights(spheres.current, spheres.target.positions),
                                spike)) != Approx(before).epsilon(0.5));
}

TEST_CASE("resample: by areas, a finer sphere takes what the ray meets") {
  const Spheres spheres(1, 3);
  const Gather gather = spheres.adaptive();
  const std::vector<double> found = weighted_means(gather, heights(spheres.current.mesh()));
  const std::vector<double> wanted = heights(spheres.target);
  for (size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(wanted[i]).margin(0.15));
}

TEST_CASE("resample: means stay among their values, NaN spreads as far as its weight") {
  const Spheres spheres(2, 3);
  const Gather gather = barycentric_weights(spheres.current, spheres.target.positions);
  std::vector<double> values(static_cast<size_t>(spheres.current.mesh().vertex_count()), 0.1);
  for (const double value : weighted_means(gather, values)) CHECK(value == 0.1);
  values[7] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> found = weighted_means(gather, values);
  for (std::int64_t i = 0; i < gather.count(); ++i) {
    const auto at = static_cast<size_t>(i);
    const bool names = std::count(gather.vertices.begin() + gather.starts[at],
                                  gather.vertices.begin() + gather.starts[at + 1], 7) > 0;
    CHECK(std::isnan(found[at]) == names);
  }
}

TEST_CASE("resample: labels go by the sum of their weights") {
  Gather gather;
  gather.starts = {0, 3, 6};
  gather.vertices = {0, 1, 2, 0, 1, 2};
  gather.weights = {0.4, 0.3, 0.3, 0.5, 0.25, 0.25};
  CHECK(weightiest_labels(gather, {5, 9, 9}) == std::vector<double>{9, 5});
}

TEST_CASE("resample: all columns are resampled, and what a file says stays") {
  VertexData data;
  data.kind = DataKind::Labels;
  data.labels = {{5, {}, "five"}};
  data.triangles = 12;
  data.columns = {{"a", ScalarType::Int32, {5, 5, 7}}, {"b", ScalarType::Int32, {7, 5, 7}}};
  Gather gather;
  gather.starts = {0, 3};
  gather.vertices = {0, 1, 2};
  gather.weights = {0.3, 0.3, 0.4};
  const VertexData made = resample_data(data, gather);
  CHECK(made.columns[0].values == std::vector<double>{5});
  CHECK(made.columns[1].values == std::vector<double>{7});
  CHECK(made.labels.size() == 1);
  CHECK(made.triangles == 0);
  gather.vertices = {0, 1, 3};
  CHECK_THROWS_AS(resample_data(data, gather), std::invalid_argument);
}

TEST_CASE("resample: the same weights for any number of threads, remesh takes them") {
  const Spheres spheres(3, 2);
  const Gather one = spheres.adaptive(1), three = spheres.adaptive(3);
  CHECK(one.vertices == three.vertices);
  CHECK(one.weights == three.weights);
  MeshFile file;
  file.mesh = spheres.current.mesh();
  file.vertex_properties = {{"height", ScalarType::Float64, heights(file.mesh)}};
  const MappedMesh source({.file = file, .map = {file.mesh.positions}});
  SphereGrid grid{.directions = spheres.target.positions, .faces = {}};
  grid.faces = triangles_as_polygons(spheres.target.triangles);
  const Remeshed made = remesh(source, grid,
                               {.sample = SampleMode::AdapBaryArea,
                                .source_areas = vertex_areas(file.mesh),
                                .grid_areas = vertex_areas(spheres.target)});
  CHECK(made.file().find_vertex_property("height")->values ==
        weighted_means(one, heights(file.mesh)));
  CHECK_THROWS_AS(
      remesh(source, grid, {.sample = SampleMode::AdapBaryArea, .grid_areas = VectorX::Ones(3)}),
      std::invalid_argument);
}

TEST_CASE("resample: rays of unit length are found again as their file had them") {
  // As programs of the field write them, and as Workbench scales them: to 100, rounded.
  const TriangleMesh target = ball(3, 0.3);
  for (const float radius : {100.0F, 1.0F}) {
    const Float32Points file = (static_cast<double>(radius) * target.positions).cast<float>();
    const Points rays = file.cast<double>();
    const Float32Points direct = at_radius_100(rays),
                        again = at_radius_100(rays.rowwise().normalized());
    CHECK(direct == again);
    for (Eigen::Index i = 0; i < file.rows(); ++i) {
      const float x = file(i, 0), y = file(i, 1), z = file(i, 2);
      const float factor = 100 / std::sqrt(x * x + y * y + z * z);
      CHECK(again(i, 0) == x * factor);
      CHECK(again(i, 2) == z * factor);
    }
  }
}

TEST_CASE("resample: places in 32 bits are the nearest ones, from wherever they are looked for") {
  const Spheres spheres(3, 4);
  const Topology& topology = spheres.current.topology();
  const Points& directions = spheres.target.positions;
  const std::vector<SurfacePoint> located = spheres.current.locator().locate_all(directions);
  const Float32Points sphere = at_radius_100(spheres.current.map().points);
  const Float32Points points = at_radius_100(directions);
  const auto exact = nearest_on_facets(topology, spheres.current.map(), directions, located);
  const auto found = nearest_in_float32(topology, sphere, points, located);
  std::vector<SurfacePoint> elsewhere = found;
  for (SurfacePoint& place : elsewhere)
    place.face = Topology::face(topology.twin(3 * place.face + 1));
  const auto again = nearest_in_float32(topology, sphere, points, elsewhere, 2);
  const auto place_of = [&](const SurfacePoint& place) {
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      sum += place.barycentric[k] * spheres.current.map().point(topology.vertex(place.face, k));
    return sum;
  };
  for (size_t i = 0; i < found.size(); ++i) {
    CHECK((place_of(found[i]) - place_of(exact[i])).norm() < 1e-5);
    CHECK(again[i].face == found[i].face);
    CHECK(again[i].barycentric == found[i].barycentric);
  }
}

TEST_CASE("resample: triangles that 32 bits make lines or points hold what is nearest to these") {
  constexpr double tiny = 1e-9;
  TriangleMesh mesh = ball(2);
  const std::array<Vertex, 3> outer = {mesh.triangles(0, 0), mesh.triangles(0, 1),
                                       mesh.triangles(0, 2)};
  const auto first = static_cast<Vertex>(mesh.vertex_count());
  const auto all = mesh.face_count();
  const Points corners = mesh.positions;
  const Vector3 middle =
      (corners.row(outer[0]) + corners.row(outer[1]) + corners.row(outer[2])).normalized();
  mesh.positions.conservativeResize(first + 3, 3);
  mesh.triangles.conservativeResize(all + 6, 3);
  mesh.triangles.row(0) << first, first + 1, first + 2;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vector3 corner = corners.row(outer[static_cast<size_t>(k)]);
    mesh.positions.row(first + k) = (middle + tiny * (corner - middle)).normalized();
    mesh.triangles.row(all + 2 * k) << outer[static_cast<size_t>(k)],
        outer[static_cast<size_t>(next)], first + next;
    mesh.triangles.row(all + 2 * k + 1) << outer[static_cast<size_t>(k)], first + next, first + k;
  }
  const MappedMesh current = mapped(mesh);
  std::vector<Vector3> probes;
  for (const Vertex v : outer)
    for (int i = 0; i <= 64; ++i)
      for (const Vertex w : outer) {
        const Vector3 to = corners.row(v) + 0.3 * corners.row(w);
        probes.push_back((middle + i / 64.0 * (to - middle)).normalized());
      }
  Points directions(std::ssize(probes), 3);
  for (size_t i = 0; i < probes.size(); ++i)
    directions.row(static_cast<Eigen::Index>(i)) = probes[i];
  const std::vector<SurfacePoint> located = current.locator().locate_all(directions);
  const auto exact = nearest_on_facets(current.topology(), current.map(), directions, located);
  const auto found = nearest_in_float32(current.topology(), at_radius_100(current.map().points),
                                        at_radius_100(directions), located);
  const auto place_of = [&](const SurfacePoint& place) {
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      sum += place.barycentric[k] * current.map().point(current.topology().vertex(place.face, k));
    return sum;
  };
  for (size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].barycentric.sum() == Approx(1));
    CHECK((place_of(found[i]) - place_of(exact[i])).norm() < 1e-5);
  }
}

TEST_CASE("resample: in 32 bits, what is nearest on a side or at a corner has no other weights") {
  const Spheres spheres(2, 2);
  const Topology& topology = spheres.current.topology();
  const Points& corners = spheres.current.map().points;
  Points middles(topology.face_count(), 3);
  std::vector<SurfacePoint> located;
  for (Face f = 0; f < topology.face_count(); ++f) {
    middles.row(f) = corners.row(topology.vertex(f, 0)) + corners.row(topology.vertex(f, 1));
    located.push_back({f, Vector3(0.5, 0.5, 0)});
  }
  const Float32Points sphere = at_radius_100(corners);
  for (const SurfacePoint& place :
       nearest_in_float32(topology, sphere, at_radius_100(middles), located))
    CHECK(place.barycentric.minCoeff() < 1e-5);
  located.resize(static_cast<size_t>(corners.rows()));
  for (Vertex v = 0; v < corners.rows(); ++v)
    located[v].face = Topology::face(topology.outgoing(v));
  for (const SurfacePoint& place : nearest_in_float32(topology, sphere, sphere, located)) {
    CHECK(place.barycentric.maxCoeff() == 1);
    CHECK(place.barycentric.minCoeff() == 0);
  }
}
