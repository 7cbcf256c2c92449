#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "embedding/energy/triangle_blocks.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A mesh of several blocks, as Newton steps lay it out.
struct LaidOut {
  TriangleMesh mesh = icosphere(4);
  Topology topology{mesh};
  RestTriangles source = measure_source(mesh);
  std::vector<Vertex> old_name = patch_order(topology);
  std::vector<int> new_name, start{0}, column;
  std::vector<ImagePoint> image;
  TriangleBlocks blocks;

  LaidOut() {
    new_name.resize(old_name.size());
    for (size_t v = 0; v < old_name.size(); ++v) {
      new_name[static_cast<size_t>(old_name[v])] = static_cast<int>(v);
    }
    for (const Vertex v : old_name) {
      image.push_back(image_point(Vector3(mesh.position(v) + Vector3(0.1, 0, 0.05)).normalized()));
      topology.for_each_outgoing(v, [&](Halfedge h) {
        column.push_back(new_name[static_cast<size_t>(topology.target(h))]);
      });
      start.push_back(static_cast<int>(column.size()));
    }
    blocks = TriangleBlocks(topology, source, old_name, new_name, start);
  }
};

}  // namespace

TEST_CASE("patch_order: every vertex once, patches of neighbours") {
  const LaidOut m;
  std::vector<Vertex> sorted = m.old_name, all(sorted.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all);
  // A patch of 256 vertices of valence six has a rim of some 60: most entries stay inside.
  int inside = 0;
  for (size_t v = 0; v < all.size(); ++v) {
    for (int e = m.start[v]; e < m.start[v + 1]; ++e) {
      const int other = m.column[static_cast<size_t>(e)] / TriangleBlocks::size;
      inside += other == static_cast<int>(v) / TriangleBlocks::size;
    }
  }
  CHECK(inside > 3 * static_cast<int>(m.column.size()) / 4);
}

TEST_CASE("triangle blocks: every triangle counts once") {
  const LaidOut m;
  REQUIRE(m.blocks.count() > 5);
  SphereMap map;
  map.points.resize(m.topology.vertex_count(), 3);
  for (size_t v = 0; v < m.image.size(); ++v) {
    map.points.row(m.old_name[v]) = m.image[v].vector().transpose();
  }
  const double expected = distortion_energy(m.topology, m.source, map, {});
  CHECK(m.blocks.energy(m.image, {}, 1) == Approx(expected).epsilon(1e-5));
  CHECK(m.blocks.energy(m.image, {}, 3) == m.blocks.energy(m.image, {}, 1));
}

TEST_CASE("triangle blocks: how often the sphere is covered is told of maps without a fold") {
  const LaidOut m;
  CHECK(m.blocks.covering(m.image, 1) == Approx(1).epsilon(0.01));
  CHECK(m.blocks.covering(m.image, 3) == m.blocks.covering(m.image, 1));
  const TriangleMesh ball = uv_sphere(24, 12);
  const Topology topology(ball);
  std::vector<int> names(static_cast<size_t>(ball.vertex_count())), start{0};
  std::iota(names.begin(), names.end(), 0);
  for (const int v : names) {
    int valence = 0;
    topology.for_each_outgoing(v, [&](Halfedge) { ++valence; });
    start.push_back(start.back() + valence);
  }
  const TriangleBlocks blocks(topology, measure_source(ball), names, names, start);
  for (const int turns : {1, 2, 3}) {
    const Points rays = wound_rays(24, 12, turns);
    std::vector<ImagePoint> image;
    for (const int v : names) image.push_back(image_point(rays.row(v)));
    CHECK(std::isfinite(blocks.energy(image, {}, 1)));
    CHECK(blocks.covering(image, 1) == Approx(turns).epsilon(0.01));
  }
}

TEST_CASE("triangle blocks: an entry of a row leads to the triangle that begins with it") {
  const LaidOut m;
  for (int row = 0; row < m.topology.vertex_count(); ++row) {
    const int first = m.start[static_cast<size_t>(row)];
    const int valence = m.start[static_cast<size_t>(row) + 1] - first;
    const TrianglePack* packs = m.blocks.packs_of(row / TriangleBlocks::size);
    for (int e = 0; e < valence; ++e) {
      const int place = m.blocks.triangle(first + e), corner = m.blocks.corner(first + e);
      REQUIRE(place / pack_width < m.blocks.pack_count(row / TriangleBlocks::size));
      const auto vertex = [&](int k) {
        return packs[place / pack_width].corner[(corner + k) % 3][place % pack_width];
      };
      const auto neighbour = [&](int k) {
        return m.column[static_cast<size_t>(first + k % valence)];
      };
      REQUIRE(vertex(0) == row);
      REQUIRE(vertex(1) == neighbour(e));
      REQUIRE(vertex(2) == neighbour(e + 1));
    }
  }
}

TEST_CASE("triangle blocks: rings are measured as from the source's corners, whichever each is") {
  const LaidOut m;
  TriangleMesh stretched = m.mesh;  // no two corners of a triangle are alike
  stretched.positions *= Eigen::Vector3d(1, 2, 5).asDiagonal();
  double total = 0;
  for (Face f = 0; f < m.topology.face_count(); ++f) {
    const auto corner = [&](int k) { return stretched.position(m.topology.vertex(f, k)); };
    total += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }
  stretched.positions *= std::sqrt(4 * std::numbers::pi / total);  // as sources are measured
  const TriangleBlocks blocks(m.topology, measure_source(stretched), m.old_name, m.new_name,
                              m.start);
  std::array<int, 3> seen{};
  for (int row = 0; row < m.topology.vertex_count(); ++row) {
    const int first = m.start[static_cast<size_t>(row)];
    const int last = m.start[static_cast<size_t>(row) + 1], valence = last - first, lane = row % 8;
    std::vector<RingSlot> slots(static_cast<size_t>(valence), RingSlot{});
    blocks.measure_ring(row, first, last, lane, slots.data());
    const auto edge = [&](int i) -> Vector3 {
      const int other = m.column[static_cast<size_t>(first + i % valence)];
      return stretched.position(m.old_name[static_cast<size_t>(other)]) -
             stretched.position(m.old_name[static_cast<size_t>(row)]);
    };
    for (int i = 0; i < valence; ++i) {
      const Vector3 a = edge(i), b = edge(i + 1);
      const double area = a.cross(b).norm() / 2, base2 = a.squaredNorm();
      const RingSlot& slot = slots[static_cast<size_t>(i)];
      REQUIRE(slot.alpha[lane] == Approx(area * area / (2 * base2)).epsilon(1e-5));
      REQUIRE(slot.beta[lane] == Approx(base2 / 8).epsilon(1e-5));
      REQUIRE(slot.shear[lane] == Approx(a.dot(b) / base2).epsilon(1e-5).margin(1e-5));
      REQUIRE(slot.beta[(lane + 1) % 8] == 0);  // the other lanes are not its business
      ++seen[static_cast<size_t>(blocks.corner(first + i))];
    }
  }
  CHECK(seen == std::array<int, 3>{5120, 5120, 5120});
}
