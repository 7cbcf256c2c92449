#include <catch2/catch.hpp>

#include "curvilinear/cut_sphere.h"
#include "curvilinear/harmonic.h"
#include "curvilinear/lift.h"
#include "curvilinear/paper_map.h"
#include "curvilinear/quasi_harmonic.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("paper_map: the stages are the paper's, in its order, each shown once") {
  const CutSphere s(icosphere(3));
  std::vector<std::string> shown;
  std::vector<Points> maps;
  const PaperResult result = map_as_paper(s.mesh, s.topology, s.poles, {}, {},
                                          [&](const PaperStage& stage, const SphereMap& map) {
                                            shown.push_back(stage.name);
                                            maps.push_back(map.points);
                                          });
  CHECK(shown == std::vector<std::string>{"initial", "iteration 1", "iteration 2", "iteration 3",
                                          "smoothing"});
  REQUIRE(result.stages.size() == shown.size());
  for (size_t i = 0; i < shown.size(); ++i) CHECK(result.stages[i].name == shown[i]);
  CHECK(maps.back() == result.map.points);
}

TEST_CASE("paper_map: it is the stages composed by hand") {
  for (const WeightKind kind : {WeightKind::MeanValue, WeightKind::Cotangent}) {
    const CutSphere s(icosphere(3));
    const PaperResult result =
        map_as_paper(s.mesh, s.topology, s.poles,
                     {.epsilon = 0.03, .iterations = 1, .rings = 2, .sweeps = 4, .weights = kind});
    const CutMesh cut(s.topology, shortest_date_line(s.mesh, s.topology, s.poles));
    const ChartBoundary boundary = rectangle_boundary(s.mesh, cut, 0.03);
    const EdgeWeights weights(s.mesh, s.topology, kind);
    SphereMap map = lift(cut, harmonic_map(s.mesh, s.topology, cut, boundary, kind));
    HarmonicSolver solver(s.topology, cut, boundary, weights.symmetric());
    map = lift(cut, solver.solve(weights.with(s.topology, area_distortion(s.mesh, map))));
    map = smooth_date_line(s.mesh, s.topology, cut.date_line(), map, {.rings = 2, .sweeps = 4});
    CHECK(result.map.points == map.points);
  }
}

TEST_CASE(
    "paper_map: mean values leave the chart without folds, raw cotangents of slivers do not") {
  TriangleMesh mesh = uv_sphere(40, 20);
  for (Vertex v = 0; v < mesh.vertex_count(); v += 2) mesh.positions.row(v) *= 1.3;
  mesh.positions.col(2) *= 0.1;  // flat: obtuse triangles all over
  const CutSphere s(mesh);
  for (const PaperStage& stage : map_as_paper(s.mesh, s.topology, s.poles).stages) {
    CHECK(stage.planar_folds == 0);
  }
  const PaperResult cotangent =
      map_as_paper(s.mesh, s.topology, s.poles, {.weights = WeightKind::Cotangent});
  CHECK(cotangent.stages.front().planar_folds > 0);
}

TEST_CASE("paper_map: it can be cancelled") {
  const CutSphere s(icosphere(2));
  CHECK_THROWS_AS(map_as_paper(s.mesh, s.topology, s.poles, {},
                               [](std::string_view stage, double) { return stage != "smoothing"; }),
                  Cancelled);
}
