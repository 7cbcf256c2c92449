#include "specimens.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "growth.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

// A specimen is a body, sane or grown (limbs, stacks, tubes, poles), and what is done to its
// positions. Every body is a sphere by construction, and positions may be anything finite.

namespace sphparam::campaign {
namespace {

using namespace sphparam::tests;

/// Sizes evenly spread in their logarithm: small meshes find more faults a second.
int some_size(Random& random) { return static_cast<int>(random.logarithmic(8, 2000)); }

TriangleMesh random_body(Random& random) {
  return random_sphere_mesh(some_size(random), static_cast<unsigned>(random.bits()));
}

TriangleMesh sane_body(Random& random) {
  switch (random.below(4)) {
    case 0:
      return icosphere(random.below(4));
    case 1:
      return uv_sphere(random.between(3, 60), random.between(1, 30));
    case 2:
      return tube(random.between(2, 200), random.between(3, 9));
    default:
      return random_body(random);
  }
}

TriangleMesh small_body(Random& random) {
  if (random.chance(0.5)) return icosphere(random.below(3));
  return random_sphere_mesh(random.between(4, 60), static_cast<unsigned>(random.bits()));
}

// --- bodies that are grown ----------------------------------------------------------------------

/// Up to 100 times as long as around, up to five of them, some on the tips of others.
TriangleMesh body_with_limbs(Random& random) {
  TriangleMesh mesh = small_body(random);
  const int limbs = random.between(1, 5);
  Vertex v = random.below(static_cast<int>(mesh.vertex_count()));
  for (int i = 0; i < limbs && mesh.vertex_count() < 2000; ++i) {
    const int around = Topology(mesh).valence(v);
    const int longest = std::max(1, std::min(100 * around, 2000 / around));
    const int rings = static_cast<int>(random.logarithmic(1, longest + 1));
    const Vector3 step = random.logarithmic(0.01, 1) * random.direction();
    mesh = with_limb(mesh, v, rings, step, random.chance(0.5) ? 1.0 : 0.97);
    if (random.chance(0.7)) v = random.below(static_cast<int>(mesh.vertex_count()));
  }
  return mesh;
}

TriangleMesh stacked_body(Random& random) {
  TriangleMesh mesh = small_body(random);
  const int stacks = random.between(1, 4);
  for (int i = 0; i < stacks; ++i) {
    const auto stacking = static_cast<Stacking>(random.below(3));
    const Face face = random.below(static_cast<int>(mesh.face_count()));
    mesh = with_stack(mesh, face, random.between(10, 60), stacking, random);
  }
  return mesh;
}

TriangleMesh thin_tube(int length_to_around, int most_around, Random& random) {
  const int around = random.between(3, most_around);
  return tube(length_to_around * around, around);
}

TriangleMesh many_sided_poles(Random& random) {
  const int sides = random.chance(0.7) ? 2000 : 5000;
  return uv_sphere(sides, random.chance(0.7) ? 1 : 2);
}

// --- what is done to positions ------------------------------------------------------------------

void stretch(TriangleMesh& mesh, Random& random) {  // needles
  if (random.chance(0.5)) {
    mesh.positions.col(random.below(3)) *= 1e5;
  } else {
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
      if (random.chance(0.1)) mesh.positions.row(v) *= random.logarithmic(1, 1e5);
    }
  }
}

/// Vertices on the line through two of their neighbours, or between them.
void make_slivers(TriangleMesh& mesh, Random& random) {
  const Topology topology(mesh);
  const double share = random.uniform(0.05, 0.9);
  const double height = random.chance(0.5) ? 0.0 : random.logarithmic(1e-16, 1e-2);
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (!random.chance(share)) continue;
    const Halfedge h = topology.outgoing(v);
    const Vector3 a = mesh.position(topology.target(h)), b = mesh.position(topology.apex(h));
    mesh.positions.row(v) = a + random.uniform(-0.5, 1.5) * (b - a) + height * random.in_cube();
  }
}

/// Vertices on top of neighbours, or whole regions in one place.
void collapse(TriangleMesh& mesh, Random& random) {
  const Topology topology(mesh);
  const int n = topology.vertex_count();
  if (random.chance(0.5)) {
    const double share = random.uniform(0.05, 1);
    for (Vertex v = 0; v < n; ++v) {
      if (random.chance(share)) {
        mesh.positions.row(v) = mesh.position(topology.target(topology.outgoing(v)));
      }
    }
  } else {
    const int places = random.between(1, 6);
    std::vector<Vector3> place;
    for (int i = 0; i < places; ++i) place.push_back(random.in_cube());
    for (Vertex v = 0; v < n; ++v) {
      mesh.positions.row(v) = place[static_cast<size_t>(random.below(places))];
    }
  }
}

void add_noise(TriangleMesh& mesh, Random& random) {
  const Topology topology(mesh);
  double edge = 0;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    edge += (mesh.position(topology.origin(h)) - mesh.position(topology.target(h))).norm();
  }
  const double amplitude = random.logarithmic(0.1, 10) * edge / topology.halfedge_count();
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    mesh.positions.row(v) += amplitude * random.in_cube();
  }
}

void flatten(TriangleMesh& mesh, Random& random) {
  const double factors[] = {1e-1, 1e-4, 1e-4, 1e-4, 1e-12, 0};
  mesh.positions.col(random.below(3)) *= factors[random.below(6)];
}

void scatter(TriangleMesh& mesh, Random& random) {
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) mesh.positions.row(v) = random.in_cube();
}

/// 1e±300, denormals, or each axis of another size.
void scale(TriangleMesh& mesh, Random& random) {
  const double scales[] = {1e300, 1e-300, 1e-310, 1e150, 1e-150};
  const double largest = std::max(1.0, mesh.positions.cwiseAbs().maxCoeff());
  mesh.positions /= largest;
  if (random.chance(0.7)) {
    mesh.positions *= scales[random.below(5)];
  } else {
    for (int k = 0; k < 3; ++k) mesh.positions.col(k) *= scales[random.below(5)];
  }
}

/// Far from the origin and tiny: most of the detail is rounded away.
void move_away(TriangleMesh& mesh, Random& random) {
  mesh.positions *= random.logarithmic(1e-8, 1e-2);
  mesh.positions.rowwise() += (random.logarithmic(1e3, 1e10) * random.direction()).transpose();
}

// --- families -----------------------------------------------------------------------------------

using Maker = TriangleMesh (*)(Random&);
using Change = void (*)(TriangleMesh&, Random&);

struct Family {
  const char* name;
  int weight;
  Maker body;
  Change change = nullptr;
};

constexpr Change changes[] = {stretch, make_slivers, collapse, add_noise,
                              flatten, scatter,      move_away};

TriangleMesh any_body(Random& random) {
  switch (random.below(5)) {
    case 0:
      return body_with_limbs(random);
    case 1:
      return stacked_body(random);
    default:
      return sane_body(random);
  }
}

void change_more_than_once(TriangleMesh& mesh, Random& random) {
  for (int i = random.between(2, 4); i > 0; --i) changes[random.below(7)](mesh, random);
  if (random.chance(0.2)) scale(mesh, random);
}

/// Weights out of 10,000.
const std::vector<Family> families{
    {"random triangulations", 800, random_body},
    {"limbs up to 100:1", 1200, body_with_limbs},
    {"stacked, depth up to 60", 1000, stacked_body},
    {"needles 1e5:1", 800, any_body, stretch},
    {"slivers and zero areas", 900, any_body, make_slivers},
    {"coincident vertices", 900, any_body, collapse},
    {"noise", 700, any_body, add_noise},
    {"flattened", 700, any_body, flatten},
    {"random positions", 700, any_body, scatter},
    {"tubes 100:1", 210, [](Random& r) { return thin_tube(100, 5, r); }},
    {"tubes 1000:1", 20, [](Random& r) { return thin_tube(1000, 5, r); }},
    {"tubes 7000:1", 2, [](Random& r) { return thin_tube(7000, 3, r); }},
    {"poles of valence 2000, 5000", 60, many_sided_poles},
    {"1e±300 coordinates", 700, any_body, scale},
    {"tiny and far away", 600, any_body, move_away},
    {"several at once", 708, any_body, change_more_than_once}};

const Family& some_family(Random& random) {
  const int all = std::accumulate(families.begin(), families.end(), 0,
                                  [](int sum, const Family& f) { return sum + f.weight; });
  int left = random.below(all);
  for (const Family& family : families) {
    if ((left -= family.weight) < 0) return family;
  }
  return families.front();
}

}  // namespace

Specimen make_specimen(std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // keeps neighbouring seeds apart
  Random random((seed * 1'000'003 + number) * golden);
  const Family& family = some_family(random);
  Specimen specimen{family.name, family.body(random)};
  if (family.change) family.change(specimen.mesh, random);
  if (random.chance(0.5)) {
    specimen.mesh = relabelled(specimen.mesh, static_cast<unsigned>(random.bits()));
  }
  return specimen;
}

}  // namespace sphparam::campaign
