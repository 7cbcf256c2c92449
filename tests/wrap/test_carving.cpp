#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "sphparam/mesh/mesh_defects.h"
#include "wrap/carving.h"
#include "wrap/level_surface.h"

namespace sphparam {

namespace {

constexpr int side = 9;

Lattice lattice() { return {Vector3::Zero(), 1, {side, side, side}}; }

/// A random solid, and where its points are a random field.
Solid random_solid(unsigned seed, std::vector<float>& field) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-0.5f, 1.5f);
  Solid solid(side * side * side, 0);
  field.assign(solid.size(), 1);
  for (int z = 1; z + 1 < side; ++z) {
    for (int y = 1; y + 1 < side; ++y) {
      for (int x = 1; x + 1 < side; ++x) {
        const auto i = static_cast<size_t>(lattice().index(x, y, z));
        field[i] = value(random);
        solid[i] = field[i] <= 0;
      }
    }
  }
  return solid;
}

/// How many points hang together with this one, which are taken away.
std::int64_t taken_away(Solid& solid, std::int64_t start) {
  std::vector<std::int64_t> waiting = {start};
  solid[static_cast<size_t>(start)] = 0;
  std::int64_t count = 0;
  for (; !waiting.empty(); ++count) {
    const std::int64_t p = waiting.back();
    waiting.pop_back();
    for (const std::int64_t stride : lattice().strides()) {
      if (!solid[static_cast<size_t>(p + stride)]) continue;
      solid[static_cast<size_t>(p + stride)] = 0;
      waiting.push_back(p + stride);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("solid: its parts are the points that hang together by neighbours") {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::vector<float> field;
    const Solid solid = random_solid(seed, field);
    Solid left = solid;
    std::vector<std::int64_t> sizes;
    for (std::int64_t i = 0; i < std::ssize(left); ++i)
      if (left[static_cast<size_t>(i)]) sizes.push_back(taken_away(left, i));
    CHECK(parts_of(lattice(), solid) == sizes);
    Solid largest = solid;
    keep_largest(lattice(), largest);
    CHECK(std::ranges::count(largest, 1) == std::ranges::max(sizes));
  }
}

TEST_CASE("solid: all that is near but for the lattice's faces, and what it surrounds") {
  std::vector<float> field(side * side * side, -1);
  field[static_cast<size_t>(lattice().index(4, 4, 4))] = 1;
  std::vector<std::int64_t> hollows;
  const Solid solid = surrounded(lattice(), field, hollows);
  CHECK(hollows == std::vector{lattice().index(4, 4, 4)});
  const auto is_inner = [](int i) { return i > 0 && i < side - 1; };
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const bool inner = is_inner(x) && is_inner(y) && is_inner(z);
        CHECK(solid[static_cast<size_t>(lattice().index(x, y, z))] == inner);
      }
    }
  }
  CHECK(hollow_share(field, solid) == 1.0 / (7 * 7 * 7));
  CHECK(euler_characteristic(lattice(), solid) == 1);
}

TEST_CASE("level surface: closed and manifold about any solid, and of its Euler characteristic") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<float> field;
    const Solid solid = random_solid(seed, field);
    const TriangleMesh mesh = level_surface(lattice(), field, solid);
    const MeshInspection found = inspect_mesh(mesh);
    for (const MeshDefect& defect : found.defects) {
      INFO(defect.message);
      CHECK(
          (defect.kind == DefectKind::SeveralComponents || defect.kind == DefectKind::WrongGenus));
    }
    // Of a solid's boundary, twice that of the solid.
    CHECK(found.euler_characteristic == 2 * euler_characteristic(lattice(), solid));
    CHECK(found.volume > 0);
  }
}

TEST_CASE("level surface: vertices are where the field is 0, half-way where it does not say") {
  struct Neighbour {
    Vector3 offset;
    float value;
    double share;  // of the way there from the only solid point, whose value is −1
  };
  const Neighbour neighbours[] = {{{1, 0, 0}, 3, 0.25},          {{-1, 0, 0}, 1e6f, 0.05},
                                  {{0, 1, 0}, 0.0078125f, 0.95}, {{0, -1, 0}, -2, 0.5},
                                  {{0, 0, 1}, 0, 0.5},           {{0, 0, -1}, 0, 0.5}};
  const Vector3 middle(4, 4, 4);
  const auto index_of = [](const Vector3& p) {
    return static_cast<size_t>(
        lattice().index(static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<int>(p.z())));
  };
  std::vector<float> field(side * side * side, 1);
  Solid solid(field.size(), 0);
  field[index_of(middle)] = -1;
  solid[index_of(middle)] = 1;
  for (const Neighbour& one : neighbours) field[index_of(middle + one.offset)] = one.value;
  const TriangleMesh mesh = level_surface(lattice(), field, solid);
  CHECK(mesh.vertex_count() == 14);
  for (const Neighbour& one : neighbours) {
    const Vector3 expected = middle + one.share * one.offset;
    INFO(expected.transpose());
    CHECK((mesh.positions.rowwise() - expected.transpose()).rowwise().norm().minCoeff() < 1e-12);
  }
}

TEST_CASE("simple points: the surface keeps its Euler characteristic and its number of pieces") {
  // All neighbourhoods of a point, in a solid of nothing else: what is simple changes neither.
  const auto strides = lattice().strides();
  const std::int64_t middle = lattice().index(4, 4, 4);
  const auto pieces = [](const Solid& solid) {
    std::vector<std::int64_t> hollows;
    std::vector<float> field(solid.size());
    for (size_t i = 0; i < solid.size(); ++i) field[i] = solid[i] ? -1.0f : 1.0f;
    surrounded(lattice(), field, hollows);
    return std::array<std::int64_t, 3>{euler_characteristic(lattice(), solid),
                                       static_cast<std::int64_t>(parts_of(lattice(), solid).size()),
                                       std::ssize(hollows)};
  };
  std::mt19937 random(3);
  int simple = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const unsigned neighbours = random() & 0x3fff;
    Solid solid(side * side * side, 0);
    for (int k = 0; k < Lattice::neighbours; ++k)
      solid[static_cast<size_t>(middle + strides[k])] = neighbours >> k & 1;
    const auto without = pieces(solid);
    solid[static_cast<size_t>(middle)] = 1;
    const bool same = pieces(solid) == without;
    if (is_simple(neighbours)) CHECK(same);
    simple += is_simple(neighbours);
  }
  CHECK(simple > 100);
  CHECK_FALSE(is_simple(0));
  CHECK_FALSE(is_simple(0x3fff));
}

TEST_CASE("carving: a ball with all that is to be kept, whatever that is") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<float> field;
    const Solid kept = random_solid(seed, field);
    const Solid ball = carve_ball(lattice(), field, kept, {});
    for (size_t i = 0; i < kept.size(); ++i) REQUIRE((!kept[i] || ball[i]));
    CHECK(inspect_mesh(level_surface(lattice(), field, ball)).defects.empty());
  }
}

TEST_CASE("carving: nothing stays but what is kept, where that is a ball") {
  Solid kept(side * side * side, 0);
  for (int z = 3; z <= 5; ++z) {
    for (int x = 2; x <= 6; ++x) kept[static_cast<size_t>(lattice().index(x, 4, z))] = 1;
  }
  CHECK(carve_ball(lattice(), std::vector<float>(kept.size(), 1), kept, {}) == kept);
}

}  // namespace sphparam
