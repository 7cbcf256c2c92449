#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "curvilinear/cut_sphere.h"
#include "curvilinear/harmonic.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

namespace {

// A solver keeps references to topology and cut mesh.
template <class Mesh, class Cut>
constexpr bool solver_takes =
    std::is_constructible_v<HarmonicSolver, Mesh, Cut, ChartBoundary, bool>;
static_assert(solver_takes<const Topology&, CutMesh&>);
static_assert(!solver_takes<Topology, CutMesh&>);
static_assert(!solver_takes<Topology&, CutMesh>);
static_assert(!solver_takes<Topology, CutMesh>);

constexpr double pi = std::numbers::pi;
constexpr double epsilon = 0.02;

CurvilinearMap periodic_map(const CutSphere& s, int threads = 1) {
  return harmonic_map(s.mesh, s.topology, s.cut, cylinder_boundary(s.mesh, s.cut, epsilon, epsilon),
                      WeightKind::SymmetricMeanValue, threads);
}

/// ½ Σ_edges w (Δθ)² over the edges of the disk.
double theta_energy(const CutSphere& s, const std::vector<double>& weights,
                    const Eigen::VectorXd& theta) {
  double energy = 0;
  for (Halfedge h = 0; h < s.topology.halfedge_count(); ++h) {
    const Vertex i = s.topology.origin(h), j = s.topology.target(h);
    if (s.cut.is_pole(i) || s.cut.is_pole(j)) continue;
    const double difference = theta[j] - theta[i] + s.cut.jump(h);
    energy += 0.25 * weights[static_cast<size_t>(h)] * difference * difference;
  }
  return energy;
}

}  // namespace

TEST_CASE("harmonic: the paper's rectangle is filled, its sides are where they belong") {
  const CutSphere s(icosphere(3));
  const CurvilinearMap map = harmonic_map(
      s.mesh, s.topology, s.cut, rectangle_boundary(s.mesh, s.cut, epsilon), WeightKind::MeanValue);
  for (Vertex v = 0; v < s.topology.vertex_count(); ++v) {
    if (s.cut.is_pole(v)) continue;
    CHECK(map.theta[v] >= 0);
    CHECK(map.theta[v] < 2 * pi);
    CHECK(map.phi[v] >= epsilon);
    CHECK(map.phi[v] <= pi - epsilon);
  }
  const std::vector<Vertex>& path = s.cut.date_line().path;
  double whole = 0, here = 0;
  for (size_t i = 2; i + 1 < path.size(); ++i) {
    whole += (s.mesh.position(path[i]) - s.mesh.position(path[i - 1])).norm();
  }
  for (size_t i = 1; i + 1 < path.size(); ++i) {
    if (i > 1) here += (s.mesh.position(path[i]) - s.mesh.position(path[i - 1])).norm();
    CHECK(map.theta[path[i]] == 0);
    CHECK(map.phi[path[i]] == Approx(epsilon + (pi - 2 * epsilon) * here / whole));
  }
  for (const auto* link : {&s.cut.north_link(), &s.cut.south_link()}) {
    for (size_t i = 1; i < link->size(); ++i) {
      CHECK(map.theta[(*link)[i]] > map.theta[(*link)[i - 1]]);
    }
  }
  CHECK(map.phi[s.cut.north_link()[1]] == epsilon);
  CHECK(map.phi[s.cut.south_link()[1]] == pi - epsilon);
}

TEST_CASE("harmonic: the rectangle is one-to-one for mean values on an induced date line") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    const CurvilinearMap map =
        harmonic_map(s.mesh, s.topology, s.cut, rectangle_boundary(s.mesh, s.cut, epsilon),
                     WeightKind::MeanValue);
    CHECK(planar_folds(s.topology, s.cut, map) == 0);
  }
}

TEST_CASE("harmonic: the periodic map is one-to-one and keeps between the rims") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const CutSphere s(mesh);
    const CurvilinearMap map = periodic_map(s);
    CHECK(planar_folds(s.topology, s.cut, map) == 0);
    for (Vertex v = 0; v < s.topology.vertex_count(); ++v) {
      if (s.cut.is_pole(v)) continue;
      CHECK(map.phi[v] >= epsilon);
      CHECK(map.phi[v] <= pi - epsilon);
    }
  }
}

TEST_CASE("harmonic: on a globe theta grows by equal steps from meridian to meridian") {
  const TriangleMesh mesh = uv_sphere(16, 9);
  const Topology topology(mesh);
  const Poles poles{0, topology.vertex_count() - 1};
  const CutMesh cut(topology,
                    induced_date_line(topology, shortest_date_line(mesh, topology, poles)));
  const CurvilinearMap map =
      harmonic_map(mesh, topology, cut, cylinder_boundary(mesh, cut, epsilon, epsilon),
                   WeightKind::SymmetricMeanValue);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const Vertex i = topology.origin(h), j = topology.target(h);
    if (cut.is_pole(i) || cut.is_pole(j) || mesh.positions(i, 2) != mesh.positions(j, 2)) continue;
    CHECK(std::abs(map.theta[j] - map.theta[i] + cut.jump(h)) == Approx(2 * pi / 16));
    CHECK(map.phi[i] == Approx(map.phi[j]));
  }
}

TEST_CASE("harmonic: the twist is the one of least energy") {
  const CutSphere s(random_sphere_mesh(300, 7));
  const std::vector<double> weights =
      EdgeWeights(s.mesh, s.topology, WeightKind::SymmetricMeanValue).with(s.topology);
  const CurvilinearMap map = periodic_map(s);
  const double least = theta_energy(s, weights, map.theta);
  Eigen::VectorXd eta = (map.phi.array() - epsilon) / (pi - 2 * epsilon);
  for (const double c : {-0.1, -1e-3, 1e-3, 0.1}) {
    CHECK(theta_energy(s, weights, map.theta + c * eta) > least);
  }
  // Nor does it pay to move any single vertex that is not on a link.
  for (Vertex v = 0; v < s.topology.vertex_count(); v += 5) {
    bool free = !s.cut.is_pole(v);
    s.topology.for_each_outgoing(
        v, [&](Halfedge h) { free = free && !s.cut.is_pole(s.topology.target(h)); });
    Eigen::VectorXd moved = map.theta;
    moved[v] += 1e-3;
    if (free) CHECK(theta_energy(s, weights, moved) > least);
  }
}

TEST_CASE("harmonic: rim gaps of the cylinder stay below half a turn and above zero") {
  // A pole with a flat triangle that takes half of its angle, and one of no angle at all.
  TriangleMesh mesh = tube(10, 3);
  mesh.positions.row(0) = 0.5 * (mesh.positions.row(1) + mesh.positions.row(2));
  const Topology topology(mesh);
  const CutMesh cut(
      topology, induced_date_line(topology, shortest_date_line(mesh, topology,
                                                               {0, topology.vertex_count() - 1})));
  const ChartBoundary boundary = cylinder_boundary(mesh, cut, epsilon, epsilon);
  for (const auto* link : {&cut.north_link(), &cut.south_link()}) {
    for (size_t i = 0; i < link->size(); ++i) {
      const bool last = i + 1 == link->size();
      const double gap = boundary.values.theta[(*link)[last ? 0 : i + 1]] + (last ? 2 * pi : 0) -
                         boundary.values.theta[(*link)[i]];
      CHECK(gap > 0);
      CHECK(gap < 0.9 * pi + 1e-12);
    }
  }
}

TEST_CASE("harmonic: a planted fold is counted, and only it") {
  const CutSphere s(icosphere(3));
  CurvilinearMap map = periodic_map(s);
  // A vertex across the opposite edge of one of its faces turns that face, not its neighbours.
  const Vertex v = s.cut.date_line().path[s.cut.date_line().path.size() / 2];
  map.theta[v] += 2 * pi;
  CHECK(planar_folds(s.topology, s.cut, map) > 0);
  map.theta[v] -= 2 * pi;
  CHECK(planar_folds(s.topology, s.cut, map) == 0);
  // Three corners on a line: one face, exactly flat.
  const Face f = Topology::face(s.topology.outgoing(v));
  CurvilinearMap flat = map;
  for (int k = 0; k < 3; ++k) flat.phi[s.topology.vertex(f, k)] = 1;
  CHECK(planar_folds(s.topology, s.cut, flat) >= 1);
}

TEST_CASE("harmonic: chart signs are exact where rounding would decide") {
  // A long thin triangle a tenth of an ulp wide: the products agree in all their digits.
  const CutSphere s(icosphere(1));
  CurvilinearMap map = periodic_map(s);
  Face f = 0;
  while (s.cut.removed(f) || s.cut.turn(3 * f) + s.cut.turn(3 * f + 1) + s.cut.turn(3 * f + 2) > 0)
    ++f;
  const long before = planar_folds(s.topology, s.cut, map);
  CHECK(before == 0);
  const auto place = [&](int corner, double phi, double theta) {
    map.phi[s.topology.vertex(f, corner)] = phi;
    map.theta[s.topology.vertex(f, corner)] = theta;
  };
  const double ulp = 0x1p-52;
  place(0, 1, 1);
  place(1, 1 + ulp, 1 + ulp);
  place(2, 1.5, 1.5);
  const long flat = planar_folds(s.topology, s.cut, map);
  place(2, 1.5, 1.5 + ulp);  // to the left of the line: counter-clockwise
  const long positive = planar_folds(s.topology, s.cut, map);
  CHECK(flat == positive + 1);
}

TEST_CASE("harmonic: the same bytes for 1, 2 and 4 threads") {
  const CutSphere s(icosphere(5));
  const CurvilinearMap one = periodic_map(s, 1);
  for (const int threads : {2, 4}) {
    const CurvilinearMap more = periodic_map(s, threads);
    CHECK(more.theta == one.theta);
    CHECK(more.phi == one.phi);
  }
}
