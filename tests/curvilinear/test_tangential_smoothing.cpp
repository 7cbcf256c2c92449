#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "curvilinear/cut_sphere.h"
#include "curvilinear/tangential_smoothing.h"
#include "sphparam/mesh/edge_weights.h"

using namespace sphparam;
using namespace sphparam::tests;
using Operator = SmoothingOptions::Operator;

TEST_CASE("tangential_smoothing: the patch is what is within so many edges of the date line") {
  const CutSphere s(icosphere(3));
  const DateLine& line = s.cut.date_line();
  std::set<Vertex> expected(line.path.begin(), line.path.end());
  for (int rings = 0; rings < 4; ++rings) {
    const std::vector<Vertex> patch = date_line_patch(s.topology, line, rings);
    CHECK(std::set<Vertex>(patch.begin(), patch.end()) == expected);
    CHECK(patch.size() == expected.size());
    const std::set<Vertex> before = expected;
    for (Halfedge h = 0; h < s.topology.halfedge_count(); ++h) {
      if (before.contains(s.topology.origin(h))) expected.insert(s.topology.target(h));
    }
  }
}

TEST_CASE("tangential_smoothing: only the patch moves, and it stays on the sphere") {
  const CutSphere s(icosphere(4));
  SphereMap map{s.mesh.positions};
  for (Vertex v = 0; v < s.topology.vertex_count(); ++v) {
    const Vector3 p = map.point(v);
    map.points.row(v) = (p + 0.02 * Vector3(std::sin(40 * p.y()), 0, 0)).normalized();
  }
  const SphereMap smooth = smooth_date_line(s.mesh, s.topology, s.cut.date_line(), map);
  const std::vector<Vertex> patch = date_line_patch(s.topology, s.cut.date_line(), 5);
  for (Vertex v = 0; v < s.topology.vertex_count(); ++v) {
    const bool inside = std::find(patch.begin(), patch.end(), v) != patch.end();
    CHECK((smooth.point(v) != map.point(v)) == inside);
    CHECK(std::abs(smooth.point(v).norm() - 1) < 1e-14);
  }
}

TEST_CASE("tangential_smoothing: one vertex moves to the projected mean of its neighbours") {
  const CutSphere s(icosphere(2));
  DateLine one_vertex{{s.cut.date_line().path[2]}};
  const Vertex i = one_vertex.path[0];
  const SphereMap map{s.mesh.positions.rowwise().normalized()};
  const auto weights = EdgeWeights(s.mesh, s.topology, WeightKind::MeanValue).with(s.topology);
  for (const Operator kind : {Operator::Uniform, Operator::MeanValue}) {
    Vector3 mean = Vector3::Zero();
    double total = 0;
    s.topology.for_each_outgoing(i, [&](Halfedge h) {
      const double w = kind == Operator::Uniform ? 1 : weights[static_cast<size_t>(h)];
      mean += w * map.point(s.topology.target(h));
      total += w;
    });
    mean /= total;
    const Vector3 x = map.point(i);
    const Vector3 expected = (x + (mean - x) - (mean - x).dot(x) * x).normalized();
    const SphereMap smooth = smooth_date_line(s.mesh, s.topology, one_vertex, map,
                                              {.rings = 0, .sweeps = 1, .laplacian = kind});
    CHECK((smooth.point(i) - expected).norm() < 1e-15);
  }
}

TEST_CASE("tangential_smoothing: no sweep changes nothing, a symmetric map rests") {
  const CutSphere s(icosphere(3));
  const SphereMap map{s.mesh.positions};
  CHECK(smooth_date_line(s.mesh, s.topology, s.cut.date_line(), map, {.sweeps = 0}).points ==
        map.points);
  const CutSphere regular(icosahedron());
  const SphereMap sphere{regular.mesh.positions.rowwise().normalized()};
  const SphereMap smooth =
      smooth_date_line(regular.mesh, regular.topology, regular.cut.date_line(), sphere);
  CHECK((smooth.points - sphere.points).cwiseAbs().maxCoeff() < 1e-14);
}
