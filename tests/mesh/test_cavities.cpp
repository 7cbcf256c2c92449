#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mesh/cavities.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "support/joined.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::StartsWith;

namespace {

TriangleMesh ball(int level, double radius, bool inward = false) {
  TriangleMesh mesh = icosphere(level);
  mesh.positions *= radius;
  if (inward) mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

double volume(const TriangleMesh& mesh) { return std::abs(inspect_mesh(mesh).volume); }

/// A ball with two cavities, beside which a smaller one looks inward and another one outward; one
/// within looks outward.
TriangleMesh hollow_ball() {
  TriangleMesh all = joined(ball(3, 1), ball(1, 0.1, true), {0.3, 0, 0});
  all = joined(all, ball(1, 0.1, true), {0, 0, 0});
  all = joined(all, ball(1, 0.1, true), {3, 0, 0});
  all = joined(all, ball(1, 0.1), {-3, 0, 0});
  return joined(all, ball(1, 0.1), {0, 0.5, 0});
}

}  // namespace

TEST_CASE("cavities: components within the largest that look inward, and no others") {
  const TriangleMesh outward = hollow_ball();
  TriangleMesh inward = outward, far = outward, large = outward;
  inward.triangles.col(1).swap(inward.triangles.col(2));  // all the other way round
  far.positions.rowwise() += Eigen::RowVector3d(1e6, -1e6, 1e6);
  large.positions *= 1e150;
  for (const TriangleMesh& mesh : {outward, far, large}) {
    const Cavities found = find_cavities(mesh);
    CHECK(found.lowest == std::vector<Vertex>{642, 684});
    CHECK(found.lowest_of_solids == std::vector<Vertex>{810});
    CHECK(found.share == Approx(2 * volume(ball(1, 0.1)) / volume(ball(3, 1))));
  }
  CHECK(find_cavities(outward).volume == Approx(2 * volume(ball(1, 0.1))));
  CHECK(find_cavities(inward).lowest == std::vector<Vertex>{642, 684});
}

TEST_CASE("cavities: a ball within a cavity is enclosed once") {
  const TriangleMesh shell = joined(ball(3, 1), ball(2, 0.5, true), {0, 0, 0});
  CHECK(find_cavities(joined(shell, ball(1, 0.1), {0.2, 0, 0})).lowest_of_solids.empty());
  CHECK(find_cavities(joined(shell, ball(1, 0.1), {0.75, 0, 0})).lowest_of_solids ==
        std::vector<Vertex>{642 + 162});
}

TEST_CASE(
    "cavities: a point straight below vertices and edges of the largest is inside all the same") {
  TriangleMesh mesh = octahedron();
  mesh = joined(mesh, mesh, {0, 0, 0});
  mesh.positions.bottomRows(6) *= 0.25;
  mesh.triangles.bottomRows(8).col(1).swap(mesh.triangles.bottomRows(8).col(2));
  for (int turn = 0; turn < 6; ++turn) {  // the lowest vertex is another one each time
    CHECK(find_cavities(mesh).lowest == std::vector<Vertex>{6});
    mesh.positions = Points(mesh.positions * Eigen::Matrix3d{{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}});
  }
}

TEST_CASE("cavities: none of one component, of an open one, or where nothing has a place") {
  CHECK(find_cavities(icosphere(1)).lowest.empty());
  CHECK(find_cavities({}).lowest.empty());
  TriangleMesh open = joined(ball(3, 1), ball(1, 0.1, true), {0, 0, 0});
  open.triangles = Triangles(open.triangles.bottomRows(open.face_count() - 1));
  CHECK(find_cavities(open).lowest.empty());
  TriangleMesh torn = joined(ball(3, 1), ball(1, 0.1, true), {0, 0, 0});
  torn.triangles.conservativeResize(torn.face_count() - 1, 3);
  CHECK(find_cavities(torn).lowest.empty());
  TriangleMesh absent = hollow_ball();
  absent.positions(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(find_cavities(absent).lowest.empty());
  absent = hollow_ball();
  absent.triangles(0, 0) = static_cast<Vertex>(absent.vertex_count());
  CHECK(find_cavities(absent).lowest.empty());
}

TEST_CASE("cavities: which of what repair drops were some is told, with their volume") {
  const auto message = [](const TriangleMesh& mesh) {
    for (const RepairAction& action : repair_mesh(mesh, {.least_kept = 0.9}).actions)
      if (action.kind == RepairKind::ComponentDropped) return action.message;
    return std::string();
  };
  const TriangleMesh one = joined(ball(3, 1), ball(3, 0.1, true), {0, 0, 0});
  CHECK(message(one) ==
        "1 component dropped, a cavity within what was kept (volume 0.00415, 0.1 % of it): with "
        "vertices 642");
  const TriangleMesh two = joined(one, ball(3, 0.1, true), {0.5, 0, 0});
  CHECK(message(two) ==
        "2 components dropped, all of them cavities within what was kept (volume 0.00831, 0.2 % of "
        "it): with vertices 642, 1284");
  CHECK_THAT(message(hollow_ball()),
             StartsWith("5 components dropped, 2 of them cavities within what was kept (volume "));
  CHECK_THAT(message(joined(ball(3, 1), ball(1, 0.1), {3, 0, 0})),
             StartsWith("1 component dropped: with vertices 642"));
}
