// What a hemisphere costs, from the file of its surface to the certified file of its sphere, as
// `sphparam map lh.white --write-sphere lh.sphere` does it, stage by stage.
//
//     bench_hemisphere [SURFACE]     without one: the sample cortex on the grid ico:7, which has
//                                    163,842 vertices, as FreeSurfer's fsaverage

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <vector>

#include "sample_meshes.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/remesh/remesh.h"

using namespace sphparam;
namespace fs = std::filesystem;

namespace {

constexpr int repetitions = 9;

struct Cost {
  double wall = 0, processor = 0;
};

/// Medians.
class Clock {
 public:
  template <class Work>
  void time(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t clock = std::clock();
    work();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    walls_.push_back(wall.count());
    processors_.push_back(static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC);
  }
  Cost cost() { return {median(walls_), median(processors_)}; }

 private:
  static double median(std::vector<double>& seconds) {
    std::ranges::sort(seconds);
    return seconds[seconds.size() / 2];
  }
  std::vector<double> walls_, processors_;
};

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "bench_hemisphere_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
};

void write_cortex(const fs::path& folder, const std::string& path) {
  const std::string coarse = folder / "cortex.ply";
  write_mesh(coarse, samples::make_cortex());
  write_mesh(path, remesh(load_mapped(coarse), parse_grid("ico:7")).file());
}

struct Stages {
  Clock read, map, write, all;
};

void run_once(const std::string& surface, const std::string& sphere, int threads, Stages& stages) {
  stages.all.time([&] {
    std::optional<MeshSource> source;
    Parameterization map;
    stages.read.time([&] { source = read_source(surface); });
    stages.map.time([&] {
      ParameterizeOptions options;
      options.threads = threads;
      map = parameterize(source->file.mesh, *source->topology, options);
    });
    stages.write.time([&] {
      PendingFiles files;
      const Provenance lines = provenance_of(
          map, {.method = "progressive", .options = "", .verdict = verdict(map.certificate)},
          FileNumbers(source->file));
      add_sphere(files, sphere, {source->file, *source->topology, map.map, map.certificate, lines},
                 {.threads = threads});
      files.publish();
    });
  });
}

void measure(const std::string& surface, const std::string& sphere, int threads) {
  Stages stages;
  for (int i = 0; i < repetitions; ++i) run_once(surface, sphere, threads, stages);
  std::printf("| %d |", threads);
  for (Clock* clock : {&stages.read, &stages.map, &stages.write, &stages.all}) {
    const Cost cost = clock->cost();
    std::printf(" %.3f (%.3f) |", cost.wall, cost.processor);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) try {
  const Folder folder;
  const std::string surface = argc > 1 ? argv[1] : folder.path / "lh.white";
  if (argc < 2) write_cortex(folder.path, surface);
  std::printf("%ld vertices; seconds, in brackets of the processor\n\n",
              static_cast<long>(read_source(surface).file.mesh.vertex_count()));
  std::printf(
      "| threads | read, check, connect | map | round, certify, write, read back | all |\n");
  std::printf("|---|---|---|---|---|\n");
  for (const int threads : {1, 2}) measure(surface, folder.path / "lh.sphere", threads);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
