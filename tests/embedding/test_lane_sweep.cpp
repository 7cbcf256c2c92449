#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "embedding/energy/triangle_packs.h"
#include "embedding/sweeps/lane_sweep.h"
#include "lanes.h"
#include "sphparam/sphere/orientation.h"
#include "support/hard_shapes.h"
#include "support/instruction_limit.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3 random_ray(Random& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

/// A wheel of 2k triangles around vertex 0 with a hub on the other side: closed, and vertex 0's
/// ring is the rim.
TriangleMesh double_wheel(int rim, Random& random) {
  TriangleMesh mesh;
  mesh.positions.resize(rim + 2, 3);
  mesh.triangles.resize(2 * rim, 3);
  mesh.positions.row(0) << 0, 0, 1;
  mesh.positions.row(rim + 1) << 0, 0, -1;
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * M_PI * (i + uniform(random, -0.3, 0.3)) / rim;
    mesh.positions.row(1 + i) << std::cos(angle), std::sin(angle), uniform(random, -0.4, 0.4);
    const int next = (i + 1) % rim;
    mesh.triangles.row(2 * i) << 0, 1 + i, 1 + next;
    mesh.triangles.row(2 * i + 1) << rim + 1, 1 + next, 1 + i;
  }
  return mesh;
}

/// Points of a counter-clockwise polygon around `centre`, so flat that rounding matters.
std::vector<Vector3> flat_ring(int count, const Vector3& centre, double size, double flatness,
                               Random& random) {
  const Vector3 u = centre.unitOrthogonal(), v = centre.cross(u);
  const double turn = uniform(random, 0, 2 * M_PI);
  const Vector3 along = std::cos(turn) * u + std::sin(turn) * v, across = centre.cross(along);
  std::vector<Vector3> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * (i + uniform(random, -0.3, 0.3)) / count;
    ring.push_back((centre + size * (std::cos(angle) * along + flatness * std::sin(angle) * across))
                       .normalized());
  }
  return ring;
}

bool sees_all(const std::vector<Vector3>& ring, const Vector3& x) {
  for (size_t i = 0; i < ring.size(); ++i) {
    if (orientation(x, ring[i], ring[(i + 1) % ring.size()]) <= 0) return false;
  }
  return true;
}

/// A point from where the exact predicate sees the ring, if a few tries find one.
std::optional<Vector3> point_inside(const std::vector<Vector3>& ring, const Vector3& middle,
                                    double width, Random& random) {
  for (int i = 0; i < 30; ++i) {
    const Vector3 x = (middle + uniform(random, 0, 1) * width * random_ray(random)).normalized();
    if (sees_all(ring, x)) return x;
  }
  return std::nullopt;
}

HierarchyLevel finest_level(const TriangleMesh& mesh) {
  MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh), 1);
  for (size_t l = hierarchy.size() - 1; l-- > 0;) {
    complete_positions(hierarchy[l], hierarchy[l + 1], 1);
  }
  return hierarchy.front();
}

}  // namespace

TEST_CASE("guard of triangles: what it accepts, the exact predicate calls positive") {
  Random random(7);
  const InstructionSet widest =
      GENERATE(InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512);
  const InstructionLimit limit(widest);
  int accepted = 0, refused_positive = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    // The third point on the great circle of the first two, or a few roundings beside it.
    const double size = std::pow(10, uniform(random, -8, 0));
    const Vector3 a = random_ray(random);
    const Vector3 b = (a + size * random_ray(random)).normalized();
    const Vector3 beside = std::pow(10, uniform(random, -17, -12)) * random_ray(random);
    const Vector3 c = (a + uniform(random, -2, 2) * (b - a) + size * beside).normalized();
    const std::vector<ImagePoint> points{image_point(a), image_point(b), image_point(c)};
    TrianglePack pack{};
    for (int lane = 0; lane < pack_width; ++lane)
      fill_lane({0.5, 1, 1, 0.5}, {0, 1, 2}, lane, pack);
    const bool certain = std::isfinite(guarded_energy(&pack, 1, points.data(), {}));
    const bool positive = orientation(a, b, c) > 0;
    REQUIRE((!certain || positive));
    accepted += certain;
    refused_positive += positive && !certain;
  }
  CHECK(accepted > 1000);          // the attack is on both sides of the bound
  CHECK(refused_positive > 1000);  // what is not certain is refused
}

TEST_CASE("guard of steps: no vertex of a ring that is nearly flat leaves its kernel") {
  Random random(11);
  const InstructionSet widest =
      GENERATE(InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512);
  const InstructionLimit limit(widest);
  int moved = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const int rim = std::uniform_int_distribution<int>(3, 7)(random);
    const TriangleMesh mesh = double_wheel(rim, random);
    const RingPacks packs = pack_rings(finest_level(mesh), 1e-9, 1);
    // Every other ring is long and only roundings wide: every energy is huge, all signs in doubt.
    const bool hard = trial % 2 == 0;
    const double size = std::pow(10, hard ? uniform(random, -0.7, 0) : uniform(random, -7, -1));
    const double width = hard ? std::pow(10, uniform(random, -16.5, -15))
                              : size * std::pow(10, uniform(random, -9, 0));
    const Vector3 middle = random_ray(random);
    const std::vector<Vector3> ring = flat_ring(rim, middle, size, width / size, random);
    const auto start = point_inside(ring, middle, width, random);
    if (!start) continue;
    const Vector3 centre = *start;
    std::vector<ImagePoint> points{image_point(centre)};
    for (const Vector3& p : ring) points.push_back(image_point(p));
    points.push_back(image_point(-centre));
    const double reach = std::pow(10, uniform(random, -1, 3));  // in Newton steps
    for (int c = 0; c < packs.colours(); ++c) {
      for (int p = packs.colour_start[static_cast<size_t>(c)];
           p < packs.colour_start[static_cast<size_t>(c) + 1]; ++p) {
        if (packs.packs[static_cast<size_t>(p)].vertex[0] != 0) continue;
        step_packs(packs, p, p + 1, points.data(), {}, reach);
      }
    }
    // The pack may hold the other hub too; the rim must not have moved for this to mean anything.
    bool rim_moved = false;
    for (int i = 0; i < rim; ++i) {
      rim_moved |= points[static_cast<size_t>(i) + 1].vector() != ring[static_cast<size_t>(i)];
    }
    REQUIRE_FALSE(rim_moved);
    const Vector3 x = points[0].vector();
    if (x == centre) continue;
    ++moved;
    REQUIRE(sees_all(ring, x));
  }
  CHECK(moved > 1000);
}

TEST_CASE("lanes: the same bits from every instruction set, sweeps and Newton steps alike") {
  const TriangleMesh mesh = tube(200, 8);  // long: the finish has something to do
  const Topology topology(mesh);
  for (const EnergyKind kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const auto points = [&](InstructionSet widest) {
      const InstructionLimit limit(widest);
      return embed_progressively(mesh, topology,
                                 {.energy = {.kind = kind}, .quality = Quality::Best})
          .map->points;
    };
    const Points baseline = points(InstructionSet::Baseline);
    CHECK(points(InstructionSet::Avx2) == baseline);
    CHECK(points(InstructionSet::Avx512) == baseline);
  }
}

TEST_CASE("packs: thin and missing rest triangles count as equilateral ones of the least area") {
  TriangleMesh mesh = icosphere(1);
  const Vertex neighbour = Topology(mesh).target(Topology(mesh).outgoing(0));
  mesh.positions.row(0) = mesh.positions.row(neighbour);  // two triangles without area
  const double least = 1e-6;
  const RingPacks packs = pack_rings(finest_level(mesh), least, 1);
  int replaced = 0;
  for (const RingPack& pack : packs.packs) {
    for (int i = 0; i < pack.valence; ++i) {
      const RingSlot& slot = packs.slots[pack.first_slot + static_cast<size_t>(i)];
      for (int lane = 0; lane < pack_width; ++lane) {
        REQUIRE(std::isfinite(slot.alpha[lane]));
        REQUIRE(std::isfinite(slot.shear[lane]));
        if (slot.beta[lane] == 0) continue;  // no such neighbour
        // αβ = F²/16
        const double area = 4 * std::sqrt(double(slot.alpha[lane]) * double(slot.beta[lane]));
        CHECK(area >= least * (1 - 1e-6));
        replaced += std::abs(area / least - 1) < 1e-5 && slot.shear[lane] == 0.5f;
      }
    }
  }
  CHECK(replaced == 6);  // three corners each
}

TEST_CASE("placement: vertices lie in their rings on the sphere as they do on the source") {
  const TriangleMesh mesh = with_slivers(icosphere(5), 0.2, 0.01, 3);
  const HierarchyLevel level = finest_level(mesh);
  const RingPacks packs = pack_rings(level, 1e-14, 1);
  std::vector<ImagePoint> points;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    points.push_back(image_point(Vector3(mesh.positions.row(v)).normalized()));
  }
  const std::vector<ImagePoint> own = points;
  const int removed = packs.colour_start[1];
  std::vector<unsigned char> refused(static_cast<size_t>(removed));
  place_in_rings(packs, 0, removed, points.data(), refused.data());
  int slivers = 0, left_alone = 0;
  for (const Vertex v : level.removed) {
    double near = 1;  // length of the shortest edge
    for (int i = 0; i < level.valence(v); ++i) {
      const auto w = static_cast<size_t>(level.ring_begin(v)[i]);
      near = std::min(near, (own[w].vector() - own[static_cast<size_t>(v)].vector()).norm());
    }
    const double off =
        (points[static_cast<size_t>(v)].vector() - own[static_cast<size_t>(v)].vector()).norm();
    left_alone += off == 0;
    slivers += near < 1e-3;
    CHECK(off < 0.15 * near);
  }
  CHECK(slivers > 100);
  CHECK(left_alone < slivers / 10);
}

TEST_CASE("sweeps: energies of rings are told as they are before the step") {
  Random random(5);
  const TriangleMesh mesh = uv_sphere(24, 11);  // valences from 4 to 24: packs have empty slots
  const HierarchyLevel level = finest_level(mesh);
  const RingPacks packs = pack_rings(level, 1e-14, 1);
  std::vector<ImagePoint> points;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    points.push_back(image_point(Vector3(mesh.positions.row(v))));
  }
  for (const EnergyKind kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    std::vector<float> energy(points.size());
    std::vector<ImagePoint> moved = points;
    for (int c = 0; c < packs.colours(); ++c) {  // each colour from the same points
      moved = points;
      step_packs(packs, packs.colour_start[static_cast<size_t>(c)],
                 packs.colour_start[static_cast<size_t>(c) + 1], moved.data(), {.kind = kind}, 1,
                 energy.data());
    }
    double sum = 0;
    for (const float e : energy) sum += static_cast<double>(e) / 3;
    const double whole =
        distortion_energy(Topology(mesh), measure_source(mesh), {mesh.positions}, {.kind = kind});
    CHECK(sum == Approx(whole).epsilon(1e-4));
  }
}
