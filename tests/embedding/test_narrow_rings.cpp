#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "embedding/constructions/narrow_rings.h"
#include "sphparam/sphere/orientation.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A mesh on the unit sphere as a level and its own image.
struct Ball {
  explicit Ball(const TriangleMesh& mesh) : hierarchy(build_hierarchy(mesh, Topology(mesh), 1)) {
    for (size_t l = hierarchy.size() - 1; l-- > 0;) {
      complete_positions(hierarchy[l], hierarchy[l + 1], 1);
    }
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
      image.push_back(image_point(Vector3(mesh.positions.row(v)).normalized()));
    }
  }

  const HierarchyLevel& level() const { return hierarchy.front(); }

  std::vector<Vector3> ring(Vertex v) const {
    std::vector<Vector3> points;
    for (int i = 0; i < level().valence(v); ++i) {
      points.push_back(image[static_cast<size_t>(level().ring_begin(v)[i])].vector());
    }
    return points;
  }

  RestRing rest(Vertex v) const {
    std::vector<Vector3> edges;
    for (int i = 0; i < level().valence(v); ++i) {
      edges.emplace_back(level().positions.row(level().ring_begin(v)[i]) -
                         level().positions.row(v));
    }
    return RestRing(edges, 1e-12);
  }

  double energy(Vertex v) const {
    return rest(v).energy({}, ring(v), image[static_cast<size_t>(v)].vector());
  }

  MeshHierarchy hierarchy;
  std::vector<ImagePoint> image;
  NarrowRings::Options options{{}, 1e-12, 1.7, 1, [] {}};
};

}  // namespace

TEST_CASE(
    "rest ring: mean value coordinates give a flat ring's vertex back, however near an edge") {
  for (const double off : {0.0, 0.5, 0.99, 0.9999}) {
    const double size = 1e-5;  // so small that the sphere is flat there
    std::vector<Vector3> edges, ring;
    for (int i = 0; i < 6; ++i) {
      const double angle = M_PI * i / 3;
      const Vector3 corner(size * (std::cos(angle) - off), size * std::sin(angle), 0);
      edges.push_back(corner);
      ring.push_back((Vector3(0, 0, 1) + corner).normalized());
    }
    const Vector3 point = RestRing(edges, 1e-30).mean_value_point(ring);
    CHECK((point - Vector3(0, 0, 1)).norm() < 1e-4 * size * (1 - off) + 1e-15);
  }
}

TEST_CASE(
    "narrow rings: a vertex goes where its ring's energy is less than in the kernel's middle") {
  Ball ball(icosphere(2));
  NarrowRings rings(ball.level(), ball.image, ball.options);
  for (Vertex v = 0; v < 100; ++v) {
    const Vector3 own = ball.image[static_cast<size_t>(v)].vector();
    CHECK(rings.place(v) == Room::Enough);
    const Vector3 placed = ball.image[static_cast<size_t>(v)].vector();
    CHECK((placed - own).norm() < 0.02);
    const std::vector<Vector3> ring = ball.ring(v);
    for (size_t i = 0; i < ring.size(); ++i) {
      CHECK(orientation(placed, ring[i], ring[(i + 1) % ring.size()]) > 0);
    }
  }
}

TEST_CASE("narrow rings: what was squeezed in gets room, and pinned vertices stay") {
  Ball ball(icosphere(3));
  // The ring of a vertex shrinks towards it, so that it has a ten-thousandth of its area.
  const Vertex squeezed = 100;
  const Vector3 centre = ball.image[squeezed].vector();
  for (int i = 0; i < ball.level().valence(squeezed); ++i) {
    ImagePoint& point = ball.image[static_cast<size_t>(ball.level().ring_begin(squeezed)[i])];
    point = image_point((centre + 0.01 * (point.vector() - centre)).normalized());
  }
  const double before = ball.energy(squeezed);
  REQUIRE(ball.rest(squeezed).is_narrow({}, before));
  const Vertex pinned = ball.level().ring_begin(squeezed)[0];
  const Vector3 held = ball.image[static_cast<size_t>(pinned)].vector();
  NarrowRings(ball.level(), ball.image, ball.options).open({squeezed}, {pinned});
  CHECK(ball.image[static_cast<size_t>(pinned)].vector() == held);
  CHECK(ball.energy(squeezed) < 0.1 * before);
  NarrowRings(ball.level(), ball.image, ball.options).open({squeezed}, {});
  CHECK_FALSE(ball.rest(squeezed).is_narrow({}, ball.energy(squeezed)));
}
