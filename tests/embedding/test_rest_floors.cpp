#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "embedding/energy/rest_floors.h"
#include "embedding/sweeps/ring_packs.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

namespace {

/// Of edges 01, 12 and 20.
std::array<double, 3> squared_edges(const RestTriangle& t) {
  const double base = 1 / t.inverse_base, height = 1 / t.inverse_height, foot = t.foot * base;
  return {base * base, (base - foot) * (base - foot) + height * height,
          foot * foot + height * height};
}

double area_of(const RestTriangle& t) { return 0.5 / (t.inverse_base * t.inverse_height); }

/// What is to be added to each squared edge, by the definition.
double added(const RestTriangle& t, double mu, double faces) {
  const auto [a, b, c] = squared_edges(t);
  const double mean_edge2 = 4 / std::numbers::sqrt3 * 4 * std::numbers::pi / faces;
  return mu * mu * (2.0 / 3 * (a + b + c) + mean_edge2);
}

RestTriangle triangle(const Vector3& a, const Vector3& b) { return rest_triangle(a, b, 0.0); }

}  // namespace

TEST_CASE("rest_floors: every squared edge of a fattened triangle is longer by the same") {
  constexpr double mu = 0.3, faces = 500;
  for (const RestTriangle& t :
       {triangle({0.1, 0, 0}, {0.05, 0.08, 0}), triangle({0.2, 0.1, 0}, {-0.3, 1e-3, 2e-4}),
        triangle({1e-9, 0, 0}, {0.3, 1e-10, 0}), triangle({1e-4, 0, 0}, {0, 1e-4, 0})}) {
    const RestTriangle fat = fattened(t, Fatness(mu, faces));
    const double c = added(t, mu, faces);
    for (size_t k = 0; k < 3; ++k)
      CHECK(squared_edges(fat)[k] == Approx(squared_edges(t)[k] + c).epsilon(1e-12));
    CHECK(fat.area == Approx(area_of(fat)).epsilon(1e-12));
    // Of the same triangle, whichever corner is first.
    const RestTriangle turned = fattened(rotated(t, 1), Fatness(mu, faces));
    CHECK(turned.area == Approx(fat.area).epsilon(1e-6));
  }
}

TEST_CASE("rest_floors: an equilateral triangle of the mean area keeps its shape") {
  constexpr double faces = 100, edge2 = 4 / std::numbers::sqrt3 * 4 * std::numbers::pi / faces;
  const double edge = std::sqrt(edge2);
  const RestTriangle t = triangle({edge, 0, 0}, {edge / 2, edge * std::numbers::sqrt3 / 2, 0});
  const RestTriangle fat = fattened(t, Fatness(0.2, faces));
  CHECK(fat.foot == Approx(0.5));
  CHECK(fat.area == Approx(t.area * (1 + 0.04 * 3)));
}

TEST_CASE("rest_floors: a sliver keeps at least its part of its length as width") {
  const double mu = 0.1;
  for (const double height : {1e-2, 1e-5, 1e-12, 0.0}) {
    const RestTriangle fat =
        fattened(rest_triangle({1, 0, 0}, {0.4, height, 0}, 1e-30), Fatness(mu, 1e9));
    const auto [a, b, c] = squared_edges(fat);
    CHECK(2 * fat.area / std::sqrt(std::max({a, b, c})) > 0.8 * mu * (height > 0));
  }
}

TEST_CASE("rest_floors: without fatness triangles are what they are, to the bit") {
  const TriangleMesh mesh = with_slivers(icosphere(2), 0.2, 1e-3, 3);
  const RestTriangles source = measure_source(mesh), same = fattened(source, 0, 1);
  for (size_t f = 0; f < source.size(); ++f) CHECK(same[f].area == source[f].area);
  const RestTriangles fat = fattened(source, 0.1, 1), threaded = fattened(source, 0.1, 3);
  for (size_t f = 0; f < source.size(); ++f) {
    CHECK(fat[f].area > source[f].area);
    CHECK(fat[f].foot == threaded[f].foot);
  }
}

TEST_CASE("rest_floors: rings of eight vertices at a time have the same fattened triangles") {
  const TriangleMesh mesh = with_slivers(icosphere(2), 0.2, 1e-3, 3);
  MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh), 1);
  for (size_t l = hierarchy.size() - 1; l-- > 0;)
    complete_positions(hierarchy[l], hierarchy[l + 1], 1);
  const HierarchyLevel& level = hierarchy.front();
  const RestFloors floors(1e-12, Fatness(0.2, 2.0 * level.vertex_count() - 4));
  const RingPacks packs = pack_rings(level, floors, 1);
  int seen = 0;
  for (const RingPack& pack : packs.packs) {
    for (int lane = 0; lane < pack_width; ++lane) {
      const Vertex v = pack.vertex[lane];
      if (v < 0) continue;
      for (int i = 0; i < level.valence(v); ++i, ++seen) {
        const auto edge = [&](int k) -> Vector3 {
          return level.positions.row(level.ring_begin(v)[k % level.valence(v)]) -
                 level.positions.row(v);
        };
        const RestTriangle t = rest_triangle(edge(i), edge(i + 1), floors);
        const RingSlot& slot = packs.slots[pack.first_slot + static_cast<size_t>(i)];
        const double base2 = 1 / (t.inverse_base * t.inverse_base);
        CHECK(slot.alpha[lane] == Approx(t.area * t.area / (2 * base2)).epsilon(1e-5));
        CHECK(slot.beta[lane] == Approx(base2 / 8).epsilon(1e-5));
        CHECK(slot.shear[lane] == Approx(t.foot).epsilon(1e-5));
      }
    }
  }
  CHECK(seen == Topology(mesh).halfedge_count());
}
