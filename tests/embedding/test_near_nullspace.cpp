#include <catch2/catch.hpp>
#include <cmath>

#include "elastic_network.h"
#include "embedding/multigrid/near_nullspace.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A network's points, aggregated twice.
struct TwoLevels {
  Network network{icosphere(4), 1e-3};
  PointRows rows{network.points.data(), network.units.data()};
  Aggregates aggregates = aggregate(network.matrix, {}, 0.05), parents;
  std::vector<AggregateSite> sites = gather_sites(rows, aggregates, 2), parent_sites;

  /// Eight aggregates of aggregates: the octants.
  TwoLevels() {
    for (const AggregateSite& s : sites) {
      const Vector3& c = s.centre;
      parents.of_row.push_back((c.x() > 0) + 2 * (c.y() > 0) + 4 * (c.z() > 0));
    }
    list_members(parents, 8);
    parent_sites = gather_sites(sites, parents);
  }
};

/// The amounts by which aggregates turn with the sphere.
Unknowns turns(const std::vector<AggregateSite>& sites, const Vector3& omega) {
  Unknowns y;
  for (const AggregateSite& s : sites) {
    const TangentFrame frame = tangent_frame(s.centre);
    for (const double amount :
         {omega.dot(frame.u) / s.radius, omega.dot(frame.v) / s.radius, omega.dot(s.centre), 0.0}) {
      y.push_back(amount);
    }
  }
  return y;
}

/// P y, with P in blocks.
template <int N>
Unknowns times(const std::vector<Block<N, near_nullspace>>& p, const Aggregates& aggregates,
               const Unknowns& y) {
  Unknowns x;
  for (size_t row = 0; row < p.size(); ++row) {
    for (int i = 0; i < N; ++i) {
      double sum = 0;
      for (int k = 0; k < near_nullspace; ++k) {
        sum += p[row](i, k) * y[near_nullspace * at(aggregates.of_row[row]) + at(k)];
      }
      x.push_back(sum);
    }
  }
  return x;
}

}  // namespace

TEST_CASE("aggregate modes: turns of the whole sphere are among them, on every level") {
  const TwoLevels levels;
  const Vector3 omega(0.3, -0.5, 0.8);
  const Unknowns children = turns(levels.sites, omega), parents = turns(levels.parent_sites, omega);
  Unknowns x(levels.network.size(), 0.0);
  prolong_to_points(levels.rows, levels.aggregates, levels.sites, children.data(), x.data(), 2);
  for (size_t v = 0; v < levels.network.points.size(); ++v) {
    const Vector3 point = levels.network.points[v].vector(), velocity = omega.cross(point);
    const TangentFrame frame = tangent_frame(point);
    const double unit = levels.network.units[v];
    CHECK(unit * x[2 * v] == Approx(velocity.dot(frame.u)).margin(1e-10));
    CHECK(unit * x[2 * v + 1] == Approx(velocity.dot(frame.v)).margin(1e-10));
  }
  const Unknowns found = times(site_prolongation(levels.sites, levels.parents, levels.parent_sites),
                               levels.parents, parents);
  for (size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(children[i]).margin(1e-4));
}

TEST_CASE("aggregate modes: a dilation draws every point towards its aggregate's centre") {
  const TwoLevels levels;
  Unknowns dilation(near_nullspace * levels.sites.size(), 0.0);
  for (size_t c = 0; c < levels.sites.size(); ++c) dilation[near_nullspace * c + 3] = 1;
  Unknowns x(levels.network.size(), 0.0);
  prolong_to_points(levels.rows, levels.aggregates, levels.sites, dilation.data(), x.data(), 1);
  for (size_t v = 0; v < levels.network.points.size(); ++v) {
    const Vector3 point = levels.network.points[v].vector();
    const Vector3 way = levels.sites[at(levels.aggregates.of_row[v])].centre - point;
    const TangentFrame frame = tangent_frame(point);
    const double unit = levels.network.units[v];
    CHECK(unit * x[2 * v] == Approx(way.dot(frame.u)).margin(1e-6));
    CHECK(unit * x[2 * v + 1] == Approx(way.dot(frame.v)).margin(1e-6));
  }
}

TEST_CASE(
    "aggregate modes: a parent's dilation draws its children's points towards its own centre") {
  const TwoLevels levels;
  const auto p = site_prolongation(levels.sites, levels.parents, levels.parent_sites);
  Unknowns dilation(near_nullspace * levels.parent_sites.size(), 0.0);
  for (size_t c = 0; c < levels.parent_sites.size(); ++c) dilation[near_nullspace * c + 3] = 1;
  const Unknowns y = times(p, levels.parents, dilation);
  Unknowns x(levels.network.size(), 0.0);
  prolong_to_points(levels.rows, levels.aggregates, levels.sites, y.data(), x.data(), 1);
  double error = 0, size = 0;
  for (size_t v = 0; v < levels.network.points.size(); ++v) {
    const Vector3 point = levels.network.points[v].vector();
    const int parent = levels.parents.of_row[at(levels.aggregates.of_row[v])];
    const Vector3 way = levels.parent_sites[at(parent)].centre - point;
    const TangentFrame frame = tangent_frame(point);
    const double unit = levels.network.units[v];
    const Eigen::Vector2d wanted(way.dot(frame.u), way.dot(frame.v));
    error += (unit * Eigen::Vector2d(x[2 * v], x[2 * v + 1]) - wanted).squaredNorm();
    size += wanted.squaredNorm();
  }
  CHECK(std::sqrt(error / size) < 0.05);
}

TEST_CASE(
    "aggregate modes: P in blocks is the P that is made at every use, and so is its transpose") {
  const TwoLevels levels;
  const auto p = point_prolongation(levels.rows, levels.aggregates, levels.sites, 2);
  const Unknowns y = random_vector(near_nullspace * levels.sites.size(), 1);
  const Unknowns r = random_vector(levels.network.size(), 2),
                 expected = times(p, levels.aggregates, y);
  Unknowns x(r.size(), 0.0), b(y.size());
  prolong_to_points(levels.rows, levels.aggregates, levels.sites, y.data(), x.data(), 2);
  for (size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(expected[i]).margin(1e-10));
  restrict_from_points(levels.rows, levels.aggregates, levels.sites, r.data(), b.data(), 2);
  CHECK(dot(b, y) == Approx(dot(r, x)).epsilon(1e-9));
}
