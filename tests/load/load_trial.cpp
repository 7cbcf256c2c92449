// One process under load: many threads that map at once, and hours of maps, charts, assets and
// remeshes one after another.
//
//     load_trial --maps 1000          as many threads, started together, a map each, half of them
//                                     by several threads: every map has the bits that it has alone
//     load_trial --soak 60            minutes, in rounds of the same shapes: the same bits in each,
//                                     and after the first two no round may leave more memory in use
//
// Fails with 1 where a map differs or memory grows.

#include <malloc.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "digest.h"
#include "gltf/export_asset.h"
#include "hurting_shapes.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

constexpr int shape_count = 17;            // one of each family
constexpr Eigen::Index most_faces = 1000;  // so that rounds are short
constexpr int rounds_before = 2;           // tables and pools are there, memory is in pieces
constexpr std::size_t room = 256 << 10;    // bytes that threads' own heaps come and go by

struct Settings {
  std::uint64_t seed = 1;
  int maps = 0;
  double soak = 0;  // minutes
};

std::vector<TriangleMesh> make_shapes(std::uint64_t seed) {
  std::vector<TriangleMesh> shapes;
  for (std::uint64_t number = 0; shapes.size() < shape_count; ++number) {
    TriangleMesh mesh = make_hurting_shape(seed, number).mesh;
    if (mesh.face_count() <= most_faces) shapes.push_back(std::move(mesh));
  }
  return shapes;
}

Parameterization map_of(const TriangleMesh& mesh, int threads) {
  return parameterize(mesh, {.quality = Quality::Draft, .threads = threads});
}

std::uint64_t bits_of(const SphereMap& map) {
  Digest digest;
  digest.add(map.points);
  return digest.bits();
}

/// How many differ from what they are alone.
int differing_at_once(const std::vector<TriangleMesh>& shapes, int count) {
  std::vector<std::uint64_t> alone;
  for (const TriangleMesh& mesh : shapes) alone.push_back(bits_of(map_of(mesh, 1).map));
  std::atomic<int> differing = 0;
  std::barrier start(count);
  const auto map_one = [&](int i) {
    const std::size_t shape = static_cast<std::size_t>(i) % shapes.size();
    start.arrive_and_wait();
    try {
      const Parameterization made = map_of(shapes[shape], i % 2 == 0 ? 1 : 0);
      if (bits_of(made.map) != alone[shape] || !made.certificate.bijective()) ++differing;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "map %d: %s\n", i, error.what());
      ++differing;
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back(map_one, i);
  threads.clear();
  return differing;
}

/// A map and what people make of it.
std::uint64_t bits_of_all(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  const Parameterization made = map_of(mesh, 0);
  Digest digest;
  digest.add(made.map.points);
  const ExportChart chart = export_chart(mesh, Topology(mesh), made.map, {});
  if (chart.chart.certificate.one_to_one()) {
    const ExportGeometry geometry = export_geometry(chart, file, {});
    const auto bytes = glb_bytes({.name = "mesh",
                                  .levels = {geometry.surface},
                                  .images = {},
                                  .materials = {{.name = "plain"}},
                                  .extras = {}},
                                 {});
    digest.add(Eigen::Map<const Eigen::Matrix<char, Eigen::Dynamic, 1>>(
        bytes.data(), static_cast<Eigen::Index>(bytes.size())));
  }
  const Remeshed remeshed =
      remesh(MappedMesh({.file = std::move(file), .map = made.map}, 1), parse_grid("ico:8"), {});
  digest.add(remeshed.mesh().positions);
  return digest.bits();
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// What the system has given this process, in bytes.
std::size_t resident_bytes() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return pages * 4096;
}

class Soak {
 public:
  explicit Soak(const std::vector<TriangleMesh>& shapes) : shapes_(shapes) {}

  bool holds_for(double minutes) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(60 * minutes);
    while (rounds_ <= rounds_before || std::chrono::steady_clock::now() < end) {
      if (!round()) return false;
    }
    return true;
  }

 private:
  bool round() {
    std::vector<std::uint64_t> bits;
    for (const TriangleMesh& mesh : shapes_) bits.push_back(bits_of_all(mesh));
    const std::size_t in_use = bytes_in_use();
    std::printf("round %d: %.2f MB in use, %.1f MB resident\n", ++rounds_,
                1e-6 * static_cast<double>(in_use), 1e-6 * static_cast<double>(resident_bytes()));
    std::fflush(stdout);
    if (rounds_ == 1) first_ = bits;
    if (rounds_ <= rounds_before) most_ = std::max(most_, in_use + room);
    if (bits != first_) std::printf("other bits than in the first round\n");
    if (in_use > most_) std::printf("memory grows\n");
    return bits == first_ && in_use <= most_;
  }

  const std::vector<TriangleMesh>& shapes_;
  std::vector<std::uint64_t> first_;
  std::size_t most_ = 0;
  int rounds_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("one process under load");
  Settings settings;
  app.add_option("--seed", settings.seed);
  app.add_option("--maps", settings.maps);
  app.add_option("--soak", settings.soak);
  CLI11_PARSE(app, argc, argv);
  const std::vector<TriangleMesh> shapes = make_shapes(settings.seed);
  int failures = 0;
  if (settings.maps > 0) {
    failures = differing_at_once(shapes, settings.maps);
    std::printf("%d maps at once, %d other than alone\n", settings.maps, failures);
  }
  if (settings.soak > 0 && !Soak(shapes).holds_for(settings.soak)) ++failures;
  return failures == 0 ? 0 : 1;
}
