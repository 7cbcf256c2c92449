// Maps every combinatorial type of triangulated sphere with a given number of vertices or fewer,
// with random positions, by each method, and certifies every map.
//
// Usage: exhaustive [--max-vertices 13] [--method progressive|one-vertex-lift|grid-lift|all]
//                   [--jobs N] [--seed N]
// Exit code 0: all types were found (OEIS A000109), and all maps are certified; 1 otherwise.

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/grid_lift.h"
#include "embedding/constructions/progressive.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/stopwatch.h"
#include "support/all_triangulations.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr int least_vertices = 4, most_vertices = 14;
/// OEIS A000109, from 4 vertices on.
constexpr std::array<size_t, 11> types{1, 1, 2, 5, 14, 50, 233, 1249, 7595, 49566, 339722};

using MapMaker = std::function<SphereMap(const TriangleMesh&, const Topology&)>;

struct NamedMethod {
  std::string name;
  MapMaker make;  // a map without rows: it has none
};

std::vector<NamedMethod> all_methods() {
  return {{"progressive",
           [](const TriangleMesh& mesh, const Topology& topology) {
             return embed_progressively(mesh, topology, {.threads = 1}).map.value_or(SphereMap{});
           }},
          {"one-vertex-lift",
           [](const TriangleMesh& mesh, const Topology& topology) {
             return gnomonic_embedding(mesh, topology, {.sweeps = 2, .threads = 1}).map;
           }},
          {"grid-lift", [](const TriangleMesh& mesh, const Topology& topology) {
             return grid_lift(mesh, topology, {.sweeps = 2, .threads = 1}).map;
           }}};
}

bool is_certified(const NamedMethod& method, const TriangleMesh& mesh) {
  const Topology topology(mesh);
  const SphereMap map = method.make(mesh, topology);
  return map.points.rows() == mesh.vertex_count() && certify(topology, map, 1).bijective();
}

size_t count_certified(const NamedMethod& method, const std::vector<Rotations>& triangulations,
                       unsigned seed, int jobs) {
  std::atomic<size_t> certified{0};
  parallel_for(std::ssize(triangulations), 64, jobs, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const TriangleMesh mesh =
          mesh_of(triangulations[static_cast<size_t>(i)], seed + static_cast<unsigned>(i));
      certified += is_certified(method, mesh);
    }
  });
  return certified;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps all triangulations of the sphere with few vertices.");
  int vertices = 13, jobs = 0;
  unsigned seed = 1;
  std::string wanted = "all";
  app.add_option("--max-vertices", vertices)->check(CLI::Range(least_vertices, most_vertices));
  app.add_option("--method", wanted)
      ->check(CLI::IsMember({"progressive", "one-vertex-lift", "grid-lift", "all"}));
  app.add_option("--jobs", jobs, "threads; 0: all cores");
  app.add_option("--seed", seed, "of the positions");
  CLI11_PARSE(app, argc, argv);

  std::puts("| vertices | types | method | certified | seconds |\n|---|---|---|---|---|");
  bool good = true;
  Stopwatch stopwatch;
  for (int n = least_vertices; n <= vertices; ++n) {
    const std::vector<Rotations> triangulations = all_triangulations(n);
    const size_t expected = types[static_cast<size_t>(n - least_vertices)];
    std::printf("| %d | %zu of %zu | (found) | | %.1f |\n", n, triangulations.size(), expected,
                stopwatch.lap());
    good = good && triangulations.size() == expected;
    for (const NamedMethod& method : all_methods()) {
      if (wanted != "all" && wanted != method.name) continue;
      const size_t certified = count_certified(method, triangulations, seed, jobs);
      std::printf("| %d | %zu | %s | %zu | %.1f |\n", n, triangulations.size(), method.name.c_str(),
                  certified, stopwatch.lap());
      std::fflush(stdout);
      good = good && certified == triangulations.size();
    }
  }
  return good ? 0 : 1;
}
