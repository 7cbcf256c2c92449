// Tries the certificate against rational arithmetic that shares no code with it.
//
// Usage: certificate_trial [--count 10000000] [--seed 1] [--jobs N]
//   signs      --count determinants of rays that lie in a plane but for a few units in the last
//              place, against cpp_rational
//   verdicts   100 + --count / 200 maps of small meshes, one-to-one or broken on purpose, against
//   "all
//              determinants positive, a random direction in one triangle", both rational
// Exit code 0: no difference; 1 otherwise.

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>

#include "embedding/constructions/progressive.h"
#include "random.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/orientation.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::campaign::Random;

namespace {

constexpr std::int64_t grain = 1000;
constexpr std::int64_t signs_a_verdict = 200, fewest_maps = 100;

// --- the oracle ---------------------------------------------------------------------------------

using Rational = boost::multiprecision::cpp_rational;

int rational_sign(const Vector3& a, const Vector3& b, const Vector3& c) {
  const auto r = [](double x) { return Rational(x); };
  const Rational det = r(a[0]) * (r(b[1]) * r(c[2]) - r(b[2]) * r(c[1])) -
                       r(a[1]) * (r(b[0]) * r(c[2]) - r(b[2]) * r(c[0])) +
                       r(a[2]) * (r(b[0]) * r(c[1]) - r(b[1]) * r(c[0]));
  return det.sign();
}

bool rationally_bijective(const TriangleMesh& mesh, const Points& rays, Random& random) {
  const auto corner = [&](Eigen::Index f, int k) -> Vector3 {
    return rays.row(mesh.triangles(f, k));
  };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    if (rational_sign(corner(f, 0), corner(f, 1), corner(f, 2)) <= 0) return false;
  }
  const Vector3 direction = random.direction();
  int holding = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    bool inside = true;
    for (int k = 0; k < 3 && inside; ++k) {
      inside = rational_sign(corner(f, k), corner(f, (k + 1) % 3), direction) > 0;
    }
    holding += inside;
  }
  return holding == 1;
}

// --- what is tried ------------------------------------------------------------------------------

/// Up to three units in the last place away.
double nudged(double x, Random& random) {
  const double towards = random.chance(0.5) ? 4.0 : -4.0;
  for (int n = random.below(4); n > 0; --n) x = std::nextafter(x, towards);
  return x;
}

Vector3 nearly_in_plane(const Vector3& a, const Vector3& b, Random& random) {
  const Vector3 c = random.uniform(-1, 1) * a + random.uniform(-1, 1) * b;
  return {nudged(c[0], random), nudged(c[1], random), nudged(c[2], random)};
}

bool signs_differ(Random& random) {
  const double scale = random.chance(0.5) ? 1.0 : std::ldexp(1.0, random.between(-400, 50));
  const Vector3 a = random.in_cube(), b = random.in_cube();
  const Vector3 c = scale * nearly_in_plane(a, b, random);
  return orientation(a, b, c) != rational_sign(a, b, c);
}

/// A map and the mesh it is of.
struct Case {
  TriangleMesh mesh;
  Points rays;
};

Case sound_case(Random& random) {
  const TriangleMesh mesh =
      random_sphere_mesh(random.between(4, 40), static_cast<unsigned>(random.bits()));
  const auto embedding = embed_progressively(mesh, Topology(mesh), {.threads = 1});
  return {mesh, embedding.map ? embedding.map->points : mesh.positions};
}

Vertex some_vertex(const Case& c, Random& random) {
  return random.below(static_cast<int>(c.rays.rows()));
}

constexpr std::array<const char*, 7> kinds{"sound",        "two rays swapped", "a ray reversed",
                                           "equal rays",   "covered k times",  "a face turned flat",
                                           "other lengths"};

/// A ray in the plane of the edge opposite to it in one of its faces, give or take some ulps.
void flatten_face(Case& c, Random& random) {
  const auto f = random.below(static_cast<int>(c.mesh.face_count()));
  const Vector3 a = c.rays.row(c.mesh.triangles(f, 0)), b = c.rays.row(c.mesh.triangles(f, 1));
  const Vector3 middle = random.uniform(0.1, 1) * a + random.uniform(0.1, 1) * b;
  for (int k = 0; k < 3; ++k) c.rays(c.mesh.triangles(f, 2), k) = nudged(middle[k], random);
}

Case make_case(size_t kind, Random& random) {
  if (kind == 4) {
    const int turns = random.between(2, 4), meridians = random.between(2 * turns + 1, 20);
    const int rings = random.between(1, 5);
    return {uv_sphere(meridians, rings), wound_rays(meridians, rings, turns)};
  }
  Case c = sound_case(random);
  const Vertex v = some_vertex(c, random), w = some_vertex(c, random);
  const Vector3 ray = c.rays.row(v);
  if (kind == 1) {
    c.rays.row(v) = c.rays.row(w);
    c.rays.row(w) = ray;
  } else if (kind == 2) {
    c.rays.row(v) = -ray;
  } else if (kind == 3) {
    c.rays.row(w) = ray;
  } else if (kind == 5) {
    flatten_face(c, random);
  } else if (kind == 6) {
    for (Eigen::Index i = 0; i < c.rays.rows(); ++i) {
      c.rays.row(i) *= std::ldexp(1.0, random.between(-60, 60));
    }
  }
  return c;
}

struct Count {
  std::atomic<std::int64_t> tried{0}, accepted{0}, different{0};
};

void try_verdict(size_t kind, Random& random, Count& count) {
  const Case c = make_case(kind, random);
  const bool verdict = certify(Topology(c.mesh), {c.rays}, 1).bijective();
  ++count.tried;
  count.accepted += verdict;
  count.different += verdict != rationally_bijective(c.mesh, c.rays, random);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tries the certificate against rational arithmetic.");
  std::int64_t count = 10'000'000;
  std::uint64_t seed = 1;
  int jobs = 0;
  app.add_option("--count", count)->check(CLI::PositiveNumber);
  app.add_option("--seed", seed);
  app.add_option("--jobs", jobs, "threads; 0: all cores");
  CLI11_PARSE(app, argc, argv);

  Count signs;
  parallel_for(count, grain, jobs, [&](std::int64_t first, std::int64_t last) {
    Random random(seed * 1'000'003 + static_cast<std::uint64_t>(first));
    for (std::int64_t i = first; i < last; ++i) signs.different += signs_differ(random);
    signs.tried += last - first;
  });
  std::array<Count, kinds.size()> verdicts;
  const std::int64_t maps = fewest_maps + count / signs_a_verdict;
  parallel_for(maps, grain / 10, jobs, [&](std::int64_t first, std::int64_t last) {
    Random random(~seed * 1'000'003 + static_cast<std::uint64_t>(first));
    for (std::int64_t i = first; i < last; ++i) {
      const size_t kind = static_cast<size_t>(i) % kinds.size();
      try_verdict(kind, random, verdicts[kind]);
    }
  });

  std::puts("| what | tried | accepted | different |\n|---|---|---|---|");
  const auto print = [](const char* what, const Count& c) {
    std::printf("| %s | %lld | %lld | %lld |\n", what, static_cast<long long>(c.tried),
                static_cast<long long>(c.accepted), static_cast<long long>(c.different));
  };
  print("signs", signs);
  bool good = signs.different == 0;
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    print(kinds[kind], verdicts[kind]);
    good = good && verdicts[kind].different == 0;
  }
  const bool refused = verdicts[2].accepted == 0 && verdicts[4].accepted == 0;  // never one-to-one
  return good && refused ? 0 : 1;
}
