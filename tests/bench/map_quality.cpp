// How far maps end from the least energy known, on shapes that are hard: slivers, elongated
// features, exact spheres, vertices in other orders.
//
// Usage: map_quality [--half a|b|all] [--only WORD] [--low FILE] [MESH …]
// The least energy known is that of five roads to λ = 1: the three qualities, and maps made at
// λ = 10, 100 and 1000 brought down by factors of four, each converged; `--low FILE` keeps it from
// run to run. Columns: triangles; that energy; normal, draft and best relative to it; symmetric
// Dirichlet energy of normal and of the best map known; the share that normal says is left; CPU
// seconds. Half b is for judging what was made with half a.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "embedding/newton/optimise.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "support/hard_shapes.h"
#include "support/real_meshes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Subject {
  std::string name;
  char half;  // a: to work with, b: to judge with
  std::function<TriangleMesh()> make;
};

TriangleMesh stretched(TriangleMesh mesh, double factor) {
  mesh.positions.col(2) *= factor;
  return mesh;
}

TriangleMesh real_mesh(const std::string& name) {
  return prepare_for_mapping(read_mesh((real_mesh_folder("genus0") / name).string())).mesh;
}

void add_made(std::vector<Subject>& all) {
  const auto add = [&](std::string name, char half, std::function<TriangleMesh()> make) {
    all.push_back({std::move(name), half, std::move(make)});
  };
  char half = 'a';
  for (const double at : {0.01, 0.002, 0.02, 0.0005}) {
    const std::string share = std::to_string(at);
    add("icosphere 5, slivers " + share, half,
        [at] { return with_slivers(icosphere(5), 0.2, at, 1); });
    add("uv 120x60, slivers " + share, half,
        [at] { return with_slivers(uv_sphere(120, 60), 0.2, at, 2); });
    for (const char* mesh : {"spot_triangulated.obj", "homer.obj", "bunny_hr.obj", "camel.off",
                             "fox.ply", "cow.off"}) {
      add(std::string(mesh) + ", slivers " + share, half,
          [=] { return with_slivers(real_mesh(mesh), 0.2, at, 3); });
    }
    half = half == 'a' ? 'b' : 'a';
  }
  for (const char* mesh : {"homer.obj", "koala.obj", "cow.off", "hand_closed.obj"}) {
    add(std::string(mesh) + ", slivers in a band", half, [=] {
      const TriangleMesh whole = real_mesh(mesh);
      const double low = whole.positions.col(1).minCoeff(),
                   high = whole.positions.col(1).maxCoeff();
      return with_slivers(whole, 0.3, 0.003, 4, [=](const Vector3& x) {
        return std::abs(x.y() - 0.4 * low - 0.6 * high) < 0.03 * (high - low);
      });
    });
    half = half == 'a' ? 'b' : 'a';
  }
  for (const auto& [level, count, aspect, rings] : {std::tuple{1, 3, 10.0, 30},
                                                    {1, 4, 20.0, 40},
                                                    {2, 3, 20.0, 30},
                                                    {2, 4, 40.0, 60},
                                                    {2, 12, 10.0, 20},
                                                    {2, 12, 20.0, 40},
                                                    {3, 25, 60.0, 60},
                                                    {3, 40, 30.0, 30},
                                                    {4, 100, 20.0, 25},
                                                    {4, 150, 40.0, 40}}) {
    add("ball, " + std::to_string(count) + " bristles " + std::to_string(int(aspect)) + ":1", half,
        [=] { return brush(level, count, aspect, rings); });
    half = half == 'a' ? 'b' : 'a';
  }
  for (const auto& [aspect, around] : {std::pair{30.0, 12},
                                       {60.0, 12},
                                       {100.0, 16},
                                       {200.0, 10},
                                       {500.0, 12},
                                       {1000.0, 10},
                                       {3000.0, 8},
                                       {2000.0, 8}}) {
    add("dumbbell " + std::to_string(int(aspect)) + ":1", half,
        [=] { return dumbbell(aspect, 0.02, around); });
    half = half == 'a' ? 'b' : 'a';
  }
  for (const auto& [meridians, rings] : {std::pair{60, 30},
                                         {120, 60},
                                         {200, 100},
                                         {240, 160},
                                         {500, 4},
                                         {300, 3},
                                         {16, 400},
                                         {12, 300}}) {
    add("uv " + std::to_string(meridians) + "x" + std::to_string(rings), half,
        [=] { return uv_sphere(meridians, rings); });
    half = half == 'a' ? 'b' : 'a';
  }
  for (const double factor : {10.0, 30.0, 60.0, 100.0}) {
    add("ball stretched " + std::to_string(int(factor)), half,
        [=] { return stretched(icosphere(4), factor); });
    half = half == 'a' ? 'b' : 'a';
  }
  for (const auto& [rings, around] : {std::pair{100, 8}, {60, 16}, {400, 8}, {300, 12}}) {
    add("tube " + std::to_string(rings) + "x" + std::to_string(around), half,
        [=] { return tube(rings, around); });
    half = half == 'a' ? 'b' : 'a';
  }
}

void add_real(std::vector<Subject>& all) {
  char half = 'a';
  for (const char* mesh : {"cow.off", "homer.obj", "camel.off", "fox.ply"}) {
    for (unsigned order = 1; order <= 5; ++order) {
      all.push_back({std::string(mesh) + ", order " + std::to_string(order), half,
                     [=] { return relabelled(real_mesh(mesh), order); }});
    }
    half = half == 'a' ? 'b' : 'a';
  }
  for (const auto& path : real_meshes()) {
    all.push_back({path.filename().string(), half,
                   [=] { return prepare_for_mapping(read_mesh(path.string())).mesh; }});
    half = half == 'a' ? 'b' : 'a';
  }
  const auto hurt = real_mesh_folder("hurt");
  for (const char* mesh : {"tripod674.ply", "brush5_61.ply", "dumbbell3000.ply"}) {
    all.push_back(
        {mesh, 'a', [=] { return prepare_for_mapping(read_mesh((hurt / mesh).string())).mesh; }});
  }
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Outcome {
  double energy = 0, symmetric_dirichlet = 0, seconds = 0, gap = -1;
  std::string warning = {};
  SphereMap map = {};
};

class Shape {
 public:
  explicit Shape(TriangleMesh mesh)
      : mesh_(std::move(mesh)), topology_(require_sphere(mesh_)), source_(measure_source(mesh_)) {}

  int faces() const { return topology_.face_count(); }

  Outcome map(const ParameterizeOptions& options) const {
    const double start = cpu_seconds();
    Parameterization p = parameterize(mesh_, topology_, options);
    Outcome outcome = judged(std::move(p.map), cpu_seconds() - start);
    outcome.gap = p.energy_gap.value_or(-1);
    for (const std::string& warning : p.warnings) outcome.warning += warning;
    return outcome;
  }

  /// From a map made at λ, down by factors of four.
  Outcome come_down(double lambda) const {
    ParameterizeOptions options{.automatic_poles = false};
    options.energy.lambda = lambda;
    SphereMap map = parameterize(mesh_, topology_, options).map;
    while (lambda > 1) {
      lambda = std::max(1.0, lambda / 4);
      OptimiseOptions how{.least_gain = 1e-2, .max_steps = 6};
      how.energy.lambda = lambda;
      map = optimise(topology_, source_, map, how).map;
    }
    return judged(optimise(topology_, source_, map, {.least_gain = 1e-6}).map, 0);
  }

  Outcome converged(const SphereMap& map) const {
    return judged(optimise(topology_, source_, map, {.least_gain = 1e-6}).map, 0);
  }

 private:
  Outcome judged(SphereMap map, double seconds) const {
    Outcome outcome{distortion_energy(topology_, source_, map, {}), 0, seconds};
    outcome.symmetric_dirichlet = summarise(measure_distortion(mesh_, map)).symmetric_dirichlet;
    outcome.map = std::move(map);
    return outcome;
  }

  TriangleMesh mesh_;
  Topology topology_;
  RestTriangles source_;
};

using Lowest = std::map<std::string, std::pair<double, double>>;  // energy, symmetric Dirichlet

Lowest read_lowest(const std::string& path) {
  Lowest lowest;
  std::ifstream in(path);
  std::string name;
  for (double energy, dirichlet; std::getline(in, name, '\t') && in >> energy >> dirichlet;) {
    lowest[name] = {energy, dirichlet};
    in.ignore();
  }
  return lowest;
}

void write_lowest(const std::string& path, const Lowest& lowest) {
  std::ofstream out(path);
  out.precision(12);
  for (const auto& [name, figures] : lowest) {
    out << name << '\t' << figures.first << ' ' << figures.second << '\n';
  }
}

void judge(const Subject& subject, Lowest& lowest, bool with_best) {
  const Shape shape(subject.make());
  const auto at_quality = [&](Quality quality) {
    return shape.map({.automatic_poles = false, .quality = quality});
  };
  const Outcome normal = at_quality(Quality::Normal), draft = at_quality(Quality::Draft);
  const Outcome best = with_best ? at_quality(Quality::Best) : normal;
  std::vector<Outcome> known{normal, draft, best};
  if (!lowest.contains(subject.name)) {
    for (const double lambda : {10.0, 100.0, 1000.0}) known.push_back(shape.come_down(lambda));
    known.push_back(shape.converged(best.map));
  }
  const auto least = std::min_element(
      known.begin(), known.end(), [](const auto& a, const auto& b) { return a.energy < b.energy; });
  auto& [energy, dirichlet] =
      lowest.try_emplace(subject.name, least->energy, least->symmetric_dirichlet).first->second;
  if (least->energy < energy) energy = least->energy, dirichlet = least->symmetric_dirichlet;
  const auto ratio = [e = energy](const Outcome& outcome) { return outcome.energy / e; };
  std::printf("%-36.36s %7d %9.4g | %9.5g %9.5g %9.5g | %8.4g %8.4g | %7.3g %6.3f %6.3f %s\n",
              subject.name.c_str(), shape.faces(), energy, ratio(normal), ratio(draft), ratio(best),
              normal.symmetric_dirichlet, dirichlet, normal.gap, normal.seconds, best.seconds,
              normal.warning.substr(0, 60).c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("how far maps end from the least energy known");
  std::string half = "all", only, low;
  std::vector<std::string> files;
  bool no_best = false;
  app.add_option("--half", half)->check(CLI::IsMember({"a", "b", "all"}));
  app.add_option("--only", only);
  app.add_option("--low", low);
  app.add_flag("--no-best", no_best);
  app.add_option("meshes", files);
  CLI11_PARSE(app, argc, argv);
  std::vector<Subject> subjects;
  for (const std::string& file : files) {
    subjects.push_back({file, 'a', [=] { return prepare_for_mapping(read_mesh(file)).mesh; }});
  }
  if (files.empty()) {
    add_made(subjects);
    if (!real_meshes().empty()) add_real(subjects);
  }
  Lowest lowest = low.empty() ? Lowest{} : read_lowest(low);
  std::printf("%-36s %7s %9s | %9s %9s %9s | %8s %8s | %7s %6s %6s\n", "mesh", "faces", "lowest",
              "normal", "draft", "best", "symD", "of best", "gap", "CPU s", "best s");
  for (const Subject& subject : subjects) {
    if (half != "all" && half[0] != subject.half) continue;
    if (subject.name.find(only) == std::string::npos) continue;
    try {
      judge(subject, lowest, !no_best);
    } catch (const std::exception& error) {
      std::printf("%-36s %s\n", subject.name.c_str(), error.what());
    }
    if (!low.empty()) write_lowest(low, lowest);
  }
  return 0;
}
