#include "hurting_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "growth.h"
#include "random.h"
#include "sphparam/mesh/topology.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

namespace sphparam::campaign {
namespace {

using namespace sphparam::tests;

constexpr int most_faces = 5000;

// --- plain bodies -------------------------------------------------------------------------------

/// Smooth bumps and dents on the unit sphere, as factors of directions.
class Bumps {
 public:
  Bumps(Random& random, double height) {
    for (int i = random.between(2, 7); i > 0; --i) {
      bumps_.push_back(
          {random.direction(), random.uniform(4, 20), random.uniform(-0.3, 1) * height});
    }
  }

  double operator()(const Vector3& direction) const {
    double radius = 1;
    for (const Bump& b : bumps_) {
      radius += b.height * std::exp(b.width * (b.centre.dot(direction) - 1));
    }
    return radius;
  }

 private:
  struct Bump {
    Vector3 centre;
    double width, height;
  };
  std::vector<Bump> bumps_;
};

TriangleMesh bumped(TriangleMesh mesh, Random& random) {
  const Bumps bumps(random, 0.8);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    mesh.positions.row(v) *= bumps(mesh.position(static_cast<Vertex>(v)).normalized());
  }
  return mesh;
}

TriangleMesh bumpy_ball(Random& random) {
  return bumped(random.chance(0.5) ? icosphere(random.between(2, 4))
                                   : uv_sphere(random.between(12, 60), random.between(8, 40)),
                random);
}

// --- slivers ------------------------------------------------------------------------------------

TriangleMesh some_body(Random& random);

TriangleMesh slivers_everywhere(Random& random) {
  const TriangleMesh body = some_body(random);
  const double share = random.uniform(0.02, 0.33), at = random.logarithmic(1e-6, 1e-2);
  return with_slivers(body, share, at, static_cast<unsigned>(random.bits()));
}

TriangleMesh slivers_in_a_band(Random& random) {
  const TriangleMesh body = some_body(random);
  const Vector3 axis = random.direction();
  const VectorX height = body.positions * axis;
  const double low = height.minCoeff(), high = height.maxCoeff();
  const double middle = random.uniform(low, high), half = random.uniform(0.02, 0.1) * (high - low);
  return with_slivers(body, random.uniform(0.1, 0.33), random.logarithmic(1e-6, 1e-2),
                      static_cast<unsigned>(random.bits()),
                      [=](const Vector3& x) { return std::abs(axis.dot(x) - middle) < half; });
}

/// As marching through a volume leaves them.
TriangleMesh volume_slivers(Random& random) {
  const int across = random.between(8, 20);
  const Bumps bumps(random, 0.4);
  const Vector3 centre = Vector3::Constant((across - 1) / 2.0) + 0.5 * random.in_cube();
  return largest_part(volume_surface({across, across, across}, [&](int x, int y, int z) {
    const Vector3 from = Vector3(x, y, z) - centre;
    const double length = std::max(from.norm(), 1e-3);
    return 0.3 * across * bumps(from / length) - length;
  }));
}

/// Vertices crowd about a point: edges near it are halved again and again.
TriangleMesh refined_in_one_place(Random& random) {
  TriangleMesh mesh = bumpy_ball(random);
  const Vector3 place = mesh.position(random.below(static_cast<int>(mesh.vertex_count())));
  double radius = 0.5;
  for (int i = random.between(6, 30); i > 0 && mesh.face_count() < most_faces; --i) {
    mesh = with_slivers(mesh, 0.33, 0.5, static_cast<unsigned>(random.bits()),
                        [&](const Vector3& x) { return (x - place).norm() < radius; });
    radius *= 0.8;
  }
  return mesh;
}

// --- elongated ----------------------------------------------------------------------------------

TriangleMesh long_tube(Random& random) {
  const int around = random.between(4, 16);
  const double aspect = random.logarithmic(10, 1000);
  const int rings = std::clamp(static_cast<int>(aspect * around / 3), 10, most_faces / 2 / around);
  TriangleMesh mesh = tube(rings, around);
  mesh.positions.col(2) *= 2 * aspect / rings;
  return mesh;
}

TriangleMesh long_ball(Random& random) {
  TriangleMesh mesh = bumpy_ball(random);
  mesh.positions.col(random.below(3)) *= random.logarithmic(10, 1000);
  return mesh;
}

/// Every vertex drawn out by a little, some by a lot.
TriangleMesh needles(Random& random) {
  TriangleMesh mesh = bumpy_ball(random);
  const double share = random.logarithmic(0.003, 0.1), longest = random.logarithmic(3, 300);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    if (random.chance(share)) mesh.positions.row(v) *= random.logarithmic(1.5, longest);
  }
  return mesh;
}

TriangleMesh some_dumbbell(Random& random) {
  const int around = random.between(6, 14);
  const double most = 2.0 * most_faces / around / around;  // aspect·around/3 rings of 2·around
  return dumbbell(random.logarithmic(10, std::min(1000.0, most)), random.logarithmic(0.01, 0.3),
                  around);
}

// --- limbs --------------------------------------------------------------------------------------

double edge_at(const TriangleMesh& mesh, const Topology& topology, Vertex v) {
  double sum = 0;
  topology.for_each_outgoing(
      v, [&](Halfedge h) { sum += (mesh.position(topology.target(h)) - mesh.position(v)).norm(); });
  return sum / topology.valence(v);
}

/// A limb at v: so many times as long as wide, of rings about as far apart as wide.
TriangleMesh with_long_limb(const TriangleMesh& mesh, Vertex v, double aspect,
                            const Vector3& direction, double taper) {
  const Topology topology(mesh);
  const double width = 2 * edge_at(mesh, topology, v);
  const int left = (most_faces - static_cast<int>(mesh.face_count())) / (2 * topology.valence(v));
  const int rings = std::clamp(static_cast<int>(2 * aspect), 1, std::max(1, left));
  return with_limb(mesh, v, rings, direction * (width * aspect / rings), taper);
}

TriangleMesh some_brush(Random& random) {
  const int level = random.between(1, 3);
  const int count = random.between(3, 10 << level);
  const int rings = std::clamp(most_faces / (12 * count), 3, 60);
  return brush(level, count, random.logarithmic(5, 100), rings);
}

/// Teeth in a row on a long bar.
TriangleMesh comb(Random& random) {
  TriangleMesh mesh = tube(random.between(20, 80), 8);
  const auto count = static_cast<Vertex>(mesh.vertex_count());
  const double aspect = random.logarithmic(5, 100);
  const Vector3 direction = Vector3::UnitX();
  for (Vertex v = 9; v + 9 < count; v += 16) {
    if (mesh.face_count() < most_faces) mesh = with_long_limb(mesh, v, aspect, direction, 1);
  }
  return mesh;
}

/// A body with bent legs.
TriangleMesh spider(Random& random) {
  TriangleMesh mesh = icosphere(random.between(1, 2));
  const Topology body(mesh);
  const double aspect = random.logarithmic(3, 60), taper = random.uniform(0.9, 1);
  const int bodies = body.vertex_count();
  for (int leg = 0; leg < 8; ++leg) {
    const auto v = static_cast<Vertex>((leg * 7919) % bodies);
    Vector3 direction = mesh.position(v).normalized();
    for (int part = 0; part < 3 && mesh.face_count() < most_faces; ++part) {
      mesh = with_long_limb(mesh, v, aspect / 3, direction, taper);
      direction = (direction + 0.8 * random.direction()).normalized();
    }
  }
  return mesh;
}

/// Branches on the ends of branches.
TriangleMesh fractal_tree(Random& random) {
  TriangleMesh mesh = icosphere(1);
  struct Branch {
    Vertex at;
    Vector3 direction;
    double aspect;
  };
  std::vector<Branch> open{{0, mesh.position(0), random.logarithmic(5, 40)}};
  const int most = random.between(3, 40);
  for (size_t i = 0; i < open.size() && std::ssize(open) < most; ++i) {
    const auto [at, direction, aspect] = open[i];
    if (mesh.face_count() > most_faces) break;
    mesh = with_long_limb(mesh, at, aspect, direction, 0.98);
    const Topology topology(mesh);
    open.push_back({at, (direction + 0.7 * random.direction()).normalized(), 0.7 * aspect});
    const Vertex beside = topology.target(topology.outgoing(at));
    open.push_back({beside, (direction + 0.7 * random.direction()).normalized(), 0.7 * aspect});
  }
  return mesh;
}

// --- mazes --------------------------------------------------------------------------------------

using Cell = std::array<int, 3>;
using Corridor = std::pair<Cell, Cell>;

/// A random spanning tree of a grid of cells.
std::vector<Corridor> spanning_tree(const Cell& size, Random& random) {
  const auto index = [&](const Cell& c) {
    return static_cast<size_t>((c[2] * size[1] + c[1]) * size[0] + c[0]);
  };
  std::vector<char> seen(static_cast<size_t>(size[0] * size[1] * size[2]), 0);
  std::vector<Cell> path{{0, 0, 0}};
  std::vector<Corridor> tree;
  seen[0] = 1;
  while (!path.empty()) {
    std::vector<Cell> next;
    for (int k = 0; k < 3; ++k) {
      for (const int by : {-1, 1}) {
        Cell c = path.back();
        c[static_cast<size_t>(k)] += by;
        const int x = c[static_cast<size_t>(k)];
        if (x >= 0 && x < size[static_cast<size_t>(k)] && !seen[index(c)]) next.push_back(c);
      }
    }
    if (next.empty()) {
      path.pop_back();
      continue;
    }
    const Cell chosen = next[static_cast<size_t>(random.below(static_cast<int>(next.size())))];
    seen[index(chosen)] = 1;
    tree.emplace_back(path.back(), chosen);
    path.push_back(chosen);
  }
  return tree;
}

double distance_to(const Corridor& corridor, const Vector3& x) {
  const auto point = [](const Cell& c) { return Vector3(c[0], c[1], c[2]); };
  const Vector3 a = point(corridor.first), b = point(corridor.second);
  return (x - a - std::clamp((x - a).dot(b - a), 0.0, 1.0) * (b - a)).norm();
}

/// The walls of a maze: tubes along all its corridors.
TriangleMesh maze(Random& random) {
  const bool flat = random.chance(0.5);
  const Cell cells = flat ? Cell{random.between(2, 5), random.between(2, 5), 1}
                          : Cell{random.between(2, 3), random.between(2, 3), random.between(2, 3)};
  constexpr int step = 5;
  constexpr double radius = 0.35;
  const std::vector<Corridor> tree = spanning_tree(cells, random);
  const auto voxels = [&](size_t k) { return step * cells[k] + 1; };
  return largest_part(volume_surface({voxels(0), voxels(1), voxels(2)}, [&](int x, int y, int z) {
    const Vector3 at = (Vector3(x, y, z) - Vector3::Constant(step / 2.0)) / step;
    double nearest = 1e3;
    for (const Corridor& c : tree) nearest = std::min(nearest, distance_to(c, at));
    return radius - nearest;
  }));
}

// --- fans and spheres ---------------------------------------------------------------------------

TriangleMesh exact_sphere(Random& random) {
  const int meridians = static_cast<int>(random.logarithmic(8, 300));
  return uv_sphere(meridians, static_cast<int>(random.logarithmic(
                                  3, std::min(600.0, 0.5 * most_faces / meridians))));
}

/// A turned part as programs for design cut it into triangles: few rings, many sides.
TriangleMesh long_fans(Random& random) {
  std::vector<ProfilePoint> profile;
  double z = 0;
  for (int i = random.between(2, 12); i > 0; --i) {
    profile.push_back({z, random.logarithmic(0.05, 1)});
    z -= random.chance(0.3) ? 1e-3 : random.uniform(0.05, 1);
  }
  const int most = most_faces / 2 / static_cast<int>(profile.size() + 1);
  return body_of_revolution(profile, std::min(most, static_cast<int>(random.logarithmic(24, 720))));
}

TriangleMesh some_body(Random& random) {
  switch (random.below(6)) {
    case 0:
      return long_ball(random);
    case 1:
      return spider(random);
    case 2:
      return some_brush(random);
    default:
      return bumpy_ball(random);
  }
}

TriangleMesh tiny_body(Random& random) {
  switch (random.below(3)) {
    case 0:
      return random.chance(0.5) ? octahedron() : icosahedron();
    case 1:
      return tube(random.between(1, 6), random.between(3, 6));
    default:
      return bumped(icosphere(random.between(0, 1)), random);
  }
}

struct Family {
  const char* name;
  TriangleMesh (*make)(Random&);
};

constexpr std::array families = {Family{"slivers everywhere", slivers_everywhere},
                                 Family{"slivers in a band", slivers_in_a_band},
                                 Family{"slivers of volumes", volume_slivers},
                                 Family{"refined in one place", refined_in_one_place},
                                 Family{"tubes 10 to 1000:1", long_tube},
                                 Family{"balls drawn out", long_ball},
                                 Family{"needles", needles},
                                 Family{"dumbbells", some_dumbbell},
                                 Family{"brushes", some_brush},
                                 Family{"combs", comb},
                                 Family{"spiders", spider},
                                 Family{"fractal trees", fractal_tree},
                                 Family{"mazes", maze},
                                 Family{"exact spheres", exact_sphere},
                                 Family{"long fans", long_fans},
                                 Family{"a few triangles", tiny_body},
                                 Family{"plain", bumpy_ball}};

}  // namespace

HurtingShape make_hurting_shape(std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // keeps neighbouring seeds apart
  Random random((seed * 1'000'003 + number) * golden);
  const Family& family = families[number % families.size()];
  HurtingShape shape{family.name, family.make(random)};
  if (random.chance(0.5)) {
    shape.mesh = relabelled(shape.mesh, static_cast<unsigned>(random.bits()));
  }
  if (random.chance(0.3)) shape.mesh.positions *= random.logarithmic(1e-30, 1e30);
  return shape;
}

}  // namespace sphparam::campaign
