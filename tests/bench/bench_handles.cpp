// What it costs to be rid of handles and to close holes by fillers, and what is made of them.
//
//     bench_handles --map            # generated surfaces, up to 900,000 triangles; and their maps
//     bench_handles --write FOLDER   # these as .obj, for others' programs (handle_peers.py)

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "sphparam/io/mesh_writer.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Cost {
  double wall, processor;
};

template <class Work>
Cost cost_of(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t clock = std::clock();
  work();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  return {wall.count(), static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC};
}

/// Of the process, so far.
double peak_bytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

struct Specimen {
  const char* name;
  TriangleMesh mesh;
};

/// Small ones first: peaks of memory only grow.
Specimen specimen(int i) {
  switch (i) {
    case 0:
      return {"ball_with_noise", noisy_ball(48, 0.2, 4)};
    case 1:
      return {"tubes_11_by_11", tube_grid(11, 11, 16, 0.21)};
    case 2:
      return {"large_ball_with_noise", noisy_ball(90, 0.115, 9)};
    default:
      return {"tubes_11_by_11_finely", tube_grid(11, 11, 20, 0.25)};
  }
}
constexpr int specimens = 4;

double summed_length(const RepairedMesh& cut) {
  double length = 0;
  for (const HandleLoop& loop : cut.handles) length += loop.length;
  return length;
}

RepairOptions handles_alone() {
  RepairOptions options = RepairOptions::none();
  options.handles = true;
  options.longest_handle = 10;
  return options;
}

void measure_handles(const Specimen& specimen, bool with_map) {
  RepairedMesh cut;
  const Cost cost = cost_of([&] { cut = repair_mesh(specimen.mesh, handles_alone()); });
  const double cutting = peak_bytes();
  Cost map_cost = {};
  if (with_map && cut.inspection.is_sphere()) {
    map_cost = cost_of([&] { parameterize(cut.mesh); });
  }
  std::printf("| %s | %ld | %zu | %.4g | %.2f | %.2f | %.2f | %.0f | %.0f |\n", specimen.name,
              static_cast<long>(specimen.mesh.face_count()), cut.handles.size(), summed_length(cut),
              cost.wall, cost.processor, map_cost.processor, cutting / 1e6, peak_bytes() / 1e6);
  std::fflush(stdout);
}

/// A disk of triangles whose rim is a curve that winds in and out in space.
TriangleMesh bent_sheet(int rim) {
  TriangleMesh mesh;
  mesh.positions.resize(2 * rim, 3);
  mesh.triangles.resize(2 * rim, 3);
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim, bend = std::sin(37 * angle);
    const double radius = 1 + 0.3 * bend;
    mesh.positions.row(2 * i) << radius * std::cos(angle), radius * std::sin(angle), 0.5 * bend;
    mesh.positions.row(2 * i + 1) << 1.1 * radius * std::cos(angle), 1.1 * radius * std::sin(angle),
        0.5 * bend;
    const int next = (i + 1) % rim;
    mesh.triangles.row(2 * i) << 2 * i, 2 * i + 1, 2 * next + 1;
    mesh.triangles.row(2 * i + 1) << 2 * i, 2 * next + 1, 2 * next;
  }
  return mesh;
}

/// A band, so two boundaries of this length.
void measure_fillers(int rim) {
  const TriangleMesh sheet = bent_sheet(rim);
  RepairOptions options = RepairOptions::none();
  options.holes = options.keep_holes = true;
  RepairedMesh closed;
  const Cost cost = cost_of([&] { closed = repair_mesh(sheet, options); });
  const auto added = static_cast<double>(closed.mesh.face_count() - sheet.face_count());
  std::printf("| %d | %.3f | %.2f | %.2f |\n", 2 * rim, cost.processor,
              1e6 * cost.processor / (2 * rim), added / (2 * rim));
}

}  // namespace

int main(int count, char** words) {
  std::string folder;
  CLI::App app("What handles and holes cost");
  bool with_map = false;
  app.add_flag("--map", with_map, "Map what comes out too: a minute for the largest");
  app.add_option("--write", folder, "Write the surfaces here, and measure nothing");
  CLI11_PARSE(app, count, words);
  if (!folder.empty()) {
    for (int i = 0; i < specimens; ++i) {
      const Specimen written = specimen(i);
      MeshFile file;
      file.mesh = written.mesh;
      write_mesh(folder + "/" + written.name + ".obj", file);
    }
    return 0;
  }
  std::printf(
      "| surface | triangles | handles | loops, length of all | s | CPU s | CPU s of the map | "
      "peak MB | "
      "peak MB of the map |\n|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 0; i < specimens; ++i) measure_handles(specimen(i), with_map);
  std::printf(
      "\n| edges of boundaries | CPU s | µs an edge | fillers an edge |\n|---|---|---|---|\n");
  for (const int rim : {1000, 10'000, 100'000, 1'000'000}) measure_fillers(rim);
}
