// Measures maps from file bytes to certified buffer, stage by stage, in ratios to one yardstick:
//
//   Y = Eigen's SimplicialLDLT analyse + factor + two solves of the Laplacian of a 70,000-triangle
//       mesh, per triangle, on one thread, right before each run: others use the machine too. The
//       run with the median ratio is printed.
//
// Usage: benchmark [--threads N] [--methods progressive,curvilinear,paper] [--largest TRIANGLES]
//                  [--repeat N] [--embedding] [MESH …]
// Each stage stands beside its budget. --embedding adds the embedding alone, on one thread and on
// two, and with narrower instruction sets than the machine's.
// Without meshes: the samples, three real meshes where SPHPARAM_MESHES (or the default folder) has
// them, and subdivided ones up to 1.5 million triangles. Never a test: machines are noisy.

#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "io/files/read_back.h"
#include "io/polygons/welding.h"
#include "lanes.h"
#include "loop_subdivision.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"
#include "yardstick.h"

using namespace sphparam;
using namespace sphparam::bench;

namespace {

std::string read_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

struct Subject {
  std::string name;
  std::string bytes;
};

// --- one run ------------------------------------------------------------------------------------

/// Highest resident size since the last reset, in bytes.
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::atof(line.c_str() + 6);
  }
  return 0;
}
void reset_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

struct Run {
  std::vector<std::pair<std::string, double>> stages;  // seconds
  double seconds = 0;
  double memory = 0;  // bytes: the highest resident size, above what was there before
  bool certified = false;
  std::string made_by;
  DistortionSummary distortion;
  double triangles = 0;
  double yardstick = 0;  // seconds a triangle, right before

  double ratio() const { return seconds / (yardstick * triangles); }
};

Run run(const std::string& bytes, const std::string& name, Method method, int threads) {
  Run result;
  reset_peak();
  const double memory_before = peak_bytes();
  const double start = now();
  double last = start;
  const auto lap = [&](const std::string& stage) {
    const double t = now();
    result.stages.emplace_back(stage, t - last);
    last = t;
  };
  auto [file, topology] = make_mappable(read_mesh(bytes, name, {}));
  lap("read");
  const Parameterization map =
      parameterize(file.mesh, topology.value(), {.method = method, .threads = threads});
  double staged = 0;
  for (const StageRecord& stage : map.stages) staged += stage.seconds;
  result.stages.emplace_back("gate", now() - last - staged);
  for (const StageRecord& stage : map.stages) result.stages.emplace_back(stage.name, stage.seconds);
  last = now();
  file = attach_map(std::move(file), map.map, {});
  const std::string written = serialise_ply(file);
  const TriangleMesh mesh = std::move(file.mesh);
  file = {};  // all that it carried is in the buffer
  lap("serialise");
  const MeshFile reread = read_mesh(written, "buffer.ply", own_map);
  lap("read back");
  const Certificate certificate =
      certify_read_back(reread, *read_sphere(reread), *topology, threads);
  lap("certify buffer");
  result.seconds = now() - start;
  result.memory = peak_bytes() - memory_before;
  result.certified = certificate.bijective();
  result.made_by = map.made_by;
  result.triangles = static_cast<double>(mesh.face_count());
  result.distortion = summarise(measure_distortion(mesh, map.map, threads));
  return result;
}

Run median_of(int repeat, const Subject& subject, Method method, int threads,
              const Yardstick& yardstick) {
  std::vector<Run> runs;
  for (int i = 0; i < repeat; ++i) {
    const double now = yardstick.measure();
    runs.push_back(run(subject.bytes, subject.name, method, threads));
    runs.back().yardstick = now;
  }
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.ratio() < b.ratio(); });
  return runs[runs.size() / 2];
}

/// What a stage of the default method may take on two threads, in Y; all together 1.
const std::map<std::string, double> budgets = {
    {"read", 0.12},           {"gate", 0.06},      {"progressive embedding", 0.6},
    {"certificate", 0.03},    {"serialise", 0.04}, {"pole placement", 0.07},
    {"certify buffer", 0.04}, {"read back", 0.04}};

void print(const std::string& name, const std::string& method, const Run& run) {
  const double unit = run.yardstick * run.triangles;
  std::printf("| %s | %.0f | %s | %s | %s | %.3f | %.2f | %.0f | %.3f | %.3f | %.2f |\n",
              name.c_str(), run.triangles, method.c_str(), run.made_by.c_str(),
              run.certified ? "yes" : "no", run.seconds, run.ratio(), run.memory / run.triangles,
              run.distortion.mean_abs_ln_angle, run.distortion.mean_abs_ln_area,
              run.distortion.symmetric_dirichlet);
  std::printf("|   |   |   | ");
  for (const auto& [stage, seconds] : run.stages) {
    std::printf("%s %.2f", stage.c_str(), seconds / unit);
    const auto budget = budgets.find(stage);
    if (budget != budgets.end()) std::printf(" of %.2f", budget->second);
    std::printf(", ");
  }
  std::printf("(in Y) | | | | | | | |\n");
  std::fflush(stdout);
}

/// The embedding alone, adjacency excluded.
void print_embedding(const Subject& subject, int repeat, const Yardstick& yardstick) {
  const MeshFile file = prepare_for_mapping(read_mesh(subject.bytes, subject.name, {}));
  const Topology topology(file.mesh);
  const auto measure = [&](int threads, InstructionSet widest) {
    limit_instruction_set(widest);
    std::vector<double> ratios;
    for (int i = 0; i < repeat; ++i) {
      const double unit = yardstick.measure() * static_cast<double>(file.mesh.face_count());
      const double start = now();
      embed_progressively(file.mesh, topology, {.threads = threads});
      ratios.push_back((now() - start) / unit);
    }
    limit_instruction_set(InstructionSet::Avx512);
    std::sort(ratios.begin(), ratios.end());
    return ratios[ratios.size() / 2];
  };
  std::printf(
      "|   |   |   | embedding: one thread %.2f of 0.80, two %.2f of 0.60; one thread with "
      "AVX2 %.2f, baseline %.2f (in Y) | | | | | | | |\n",
      measure(1, InstructionSet::Avx512), measure(2, InstructionSet::Avx512),
      measure(1, InstructionSet::Avx2), measure(1, InstructionSet::Baseline));
  std::fflush(stdout);
}

// --- what is measured ---------------------------------------------------------------------------

Subject subdivided(const std::string& name, TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) mesh = loop_subdivided(mesh);
  MeshFile file;
  file.mesh = std::move(mesh);
  return {name + " subdivided " + std::to_string(times) + "x.ply", serialise_ply(file)};
}

std::vector<Subject> default_subjects() {
  std::vector<Subject> subjects;
  for (const auto& [name, file] : {std::pair{"body.ply", samples::make_body(32)},
                                   std::pair{"creature.ply", samples::make_creature()},
                                   std::pair{"cortex.ply", samples::make_cortex()},
                                   std::pair{"body 70k.ply", samples::make_body(59)},
                                   std::pair{"body 348k.ply", samples::make_body(132)}}) {
    subjects.push_back({name, serialise_ply(file)});
  }
  const std::string folder = meshes_folder();
  if (!std::filesystem::exists(folder)) {
    std::puts("real meshes: skipped, there is no folder of them (SPHPARAM_MESHES)\n");
    return subjects;
  }
  for (const char* name : {"mannequin.off", "camel.off", "nefertiti-lowres.obj", "koala.obj"}) {
    subjects.push_back({name, read_bytes(folder + name)});
  }
  const auto mesh = [&](const char* name) {
    return prepare_for_mapping(read_mesh(folder + name)).mesh;
  };
  subjects.push_back(subdivided("mannequin", mesh("mannequin.off"), 2));
  subjects.push_back(subdivided("spot", mesh("spot_triangulated.obj"), 3));
  subjects.push_back(subdivided("mannequin", mesh("mannequin.off"), 3));
  return subjects;
}

const std::map<std::string, Method> methods = {{"progressive", Method::Progressive},
                                               {"curvilinear", Method::Curvilinear},
                                               {"paper", Method::Paper}};

/// Runs on a small mesh, so that the pages of the program's code, its threads and their stacks are
/// there before anything is measured: they do not grow with the mesh. Returns what they take.
double warm_up(const std::vector<std::string>& wanted, int threads) {
  reset_peak();
  const double before = peak_bytes();
  const Subject small{"body.ply", serialise_ply(samples::make_body(8))};
  for (const std::string& method : wanted)
    run(small.bytes, small.name, methods.at(method), threads);
  reset_peak();
  return peak_bytes() - before;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times maps against one Laplace solve.");
  int threads = 0, repeat = 3;
  double largest = 2e6;
  bool embedding = false;
  std::vector<std::string> wanted{"progressive", "curvilinear"}, paths;
  app.add_option("--threads", threads, "0: all cores");
  app.add_option("--repeat", repeat, "runs of each; the median is printed");
  app.add_option("--largest", largest, "skip meshes with more triangles");
  app.add_flag("--embedding", embedding, "the embedding alone, by threads and instruction sets");
  app.add_option("--methods", wanted, "progressive, curvilinear, paper")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"progressive", "curvilinear", "paper"}));
  app.add_option("MESH", paths, "files instead of the default ones");
  CLI11_PARSE(app, argc, argv);

  std::vector<Subject> subjects;
  for (const std::string& path : paths) {
    subjects.push_back({std::filesystem::path(path).filename(), read_bytes(path)});
  }
  if (paths.empty()) subjects = default_subjects();

  const Yardstick yardstick(yardstick_mesh(meshes_folder()));
  std::printf("Y = %.3f µs a triangle at first\n\n", 1e6 * yardstick.measure());
  std::printf("Code, threads and stacks that any first run brings in: %.1f MB\n\n",
              1e-6 * warm_up(wanted, threads));
  std::puts(
      "| mesh | triangles | method | made by | certified | seconds | Y × triangles | bytes a "
      "triangle | angle | area | symD |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
  for (const Subject& subject : subjects) {
    if (static_cast<double>(subject.bytes.size()) > 60 * largest) continue;
    for (const std::string& method : wanted) {
      print(subject.name, method,
            median_of(repeat, subject, methods.at(method), threads, yardstick));
    }
    if (embedding) print_embedding(subject, repeat, yardstick);
  }
}
