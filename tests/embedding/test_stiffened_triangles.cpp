#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "embedding/energy/map_image.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/stiffened_triangles.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A sphere as its own map, in the mesh's order.
struct Ball {
  TriangleMesh mesh = icosphere(4);
  Topology topology{mesh};
  std::vector<ImagePoint> image = image_of({mesh.positions});
  TriangleBlocks blocks;
  std::vector<Vector3> still{image.size(), Vector3::Zero()};

  Ball() {
    std::vector<int> names(image.size()), start{0};
    std::iota(names.begin(), names.end(), 0);
    for (const int v : names) {
      start.push_back(start.back());
      topology.for_each_outgoing(v, [&](Halfedge) { ++start.back(); });
    }
    blocks = TriangleBlocks(topology, measure_source(mesh), names, names, start);
  }

  /// Vertex v on its way to a neighbour, by so many times the way.
  std::vector<Vector3> motion(Vertex v, double far) const {
    std::vector<Vector3> result = still;
    topology.for_each_outgoing(v, [&](Halfedge h) {
      const Vector3 way = mesh.position(topology.target(h)) - mesh.position(v);
      result[static_cast<size_t>(v)] = far * way;
    });
    return result;
  }
};

/// By what the Hessian of each triangle with this corner is multiplied, as blocks see it.
std::vector<double> factors(const Ball& ball, const StiffenedTriangles& stiffened, Vertex v) {
  std::vector<double> found;
  for (int b = 0; b < ball.blocks.count(); ++b) {
    const int packs = ball.blocks.pack_count(b);
    const auto terms = std::make_unique<TriangleTerms[]>(static_cast<size_t>(packs));
    for (int p = 0; p < packs; ++p) {
      for (auto* entries : {&terms[p].diagonal[0][0], &terms[p].gradient[0][0]}) {
        std::fill(*entries, *entries + pack_width, 1.0);
      }
    }
    stiffened.apply(ball.blocks, b, terms.get());
    for (int p = 0; p < packs; ++p) {
      const TrianglePack& pack = ball.blocks.packs_of(b)[p];
      for (int lane = 0; lane < pack_width; ++lane) {
        CHECK(terms[p].gradient[0][0][lane] == 1);
        for (const auto& corner : pack.corner) {
          if (corner[lane] == v) found.push_back(terms[p].diagonal[0][0][lane]);
        }
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("stiffened triangles: none where no vertex moves, or where all turn with the sphere") {
  const Ball ball;
  StiffenedTriangles stiffened;
  CHECK_FALSE(stiffened.stiffen(ball.blocks, ball.image, ball.still, 1));
  std::vector<Vector3> turn;
  for (const ImagePoint& x : ball.image) turn.push_back(Vector3(0, 0, 0.6).cross(x.vector()));
  CHECK_FALSE(stiffened.stiffen(ball.blocks, ball.image, turn, 1));
  for (const double factor : factors(ball, stiffened, 3)) CHECK(factor == 1);
}

TEST_CASE("stiffened triangles: those that a vertex runs into, the more the sooner") {
  const Ball ball;
  constexpr Vertex v = 200;
  const auto greatest = [](const std::vector<double>& all) {
    return *std::max_element(all.begin(), all.end());
  };
  double before = 1;
  for (const double far : {4.0, 100.0, 1000.0}) {
    StiffenedTriangles stiffened;
    REQUIRE(stiffened.stiffen(ball.blocks, ball.image, ball.motion(v, far), 1));
    const std::vector<double> of_ring = factors(ball, stiffened, v);
    CHECK(*std::min_element(of_ring.begin(), of_ring.end()) == 1);  // those behind it
    CHECK(greatest(of_ring) > before);
    CHECK(greatest(of_ring) >= far);      // a triangle is gone before the vertex is there
    CHECK(greatest(of_ring) < 10 * far);  // but not long before
    before = greatest(of_ring);
    for (const double factor : factors(ball, stiffened, 700)) CHECK(factor == 1);
  }
  StiffenedTriangles stiffened;
  CHECK_FALSE(stiffened.stiffen(ball.blocks, ball.image, ball.motion(v, 0.4), 1));
}

TEST_CASE("stiffened triangles: the same for any number of threads") {
  const Ball ball;
  std::vector<Vector3> motion = ball.motion(200, 50);
  motion[700] = ball.motion(700, 7)[700];
  StiffenedTriangles one, three;
  CHECK(one.stiffen(ball.blocks, ball.image, motion, 1));
  CHECK(three.stiffen(ball.blocks, ball.image, motion, 3));
  for (const Vertex v : {200, 700}) CHECK(factors(ball, one, v) == factors(ball, three, v));
}

TEST_CASE("Newton steps among slivers are not cut short by the first that would be folded") {
  // Slivers of slivers: without what is tested the steps are 0.004, 0.002 and 0.06 long.
  const auto in_band = [](const Vector3& x) { return std::abs(x.z()) < 0.3; };
  TriangleMesh mesh =
      with_slivers(with_slivers(icosphere(4), 0.3, 1e-3, 5, in_band), 0.3, 1e-3, 6, in_band);
  mesh.positions.col(0) *= 3;
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = *embed_progressively(mesh, topology, {.quality = Quality::Draft}).map;
  GlobalNewton newton(topology, source, image_of(map), {}, 1);
  const double before = newton.energy({});
  for (int step = 0; step < 3; ++step) {
    CHECK(newton.step({}, 0.5).length > 0.02);
    newton.sweep({}, 5);
  }
  const double after = newton.energy({});
  for (int step = 0; step < 20; ++step) {
    newton.step({}, 0.5);
    newton.sweep({}, 5);
  }
  CHECK(before - after > 0.8 * (before - newton.energy({})));
}
