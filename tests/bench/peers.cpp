// Puts another system's sphere for a mesh beside ours: certificate, distortion, time, in one table.
//
// Usage: peers MESH SPHERE … [--seconds S …] [--names NAME …] [--threads N]
// Each SPHERE has the vertices and triangles of MESH in its order, about the origin, of any radius;
// S is the CPU time its maker took, as the user measured it. Ours is made here and now, by the
// default method in its qualities and balances.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

struct Row {
  std::string name;
  std::optional<double> cpu_seconds;
  SphereMap map;
  Certificate certificate;
};

/// CPU time of this process, all threads.
double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The file's map, or its positions: rays have no length, and distortion wants unit ones.
Row peer(const TriangleMesh& mesh, const Topology& topology, const std::string& path) {
  const MeshFile file = read_mesh(path);
  if (file.mesh.triangles != mesh.triangles) {
    throw std::runtime_error(path + ": its triangles are not those of the mesh, in its order");
  }
  SphereMap map = read_sphere(file).value_or(SphereMap{file.mesh.positions});
  const Certificate certificate = certify(topology, map);
  map.points.rowwise().normalize();
  return {std::filesystem::path(path).stem(), std::nullopt, std::move(map), certificate};
}

Row ours(const TriangleMesh& mesh, const ParameterizeOptions& options, const std::string& name) {
  const double start = cpu_now();
  Parameterization result = parameterize(mesh, options);
  return {name, cpu_now() - start, std::move(result.map), std::move(result.certificate)};
}

std::string verdict_words(const Certificate& certificate) {
  if (certificate.bijective()) return "yes";
  return std::to_string(certificate.fold_count()) + " folded, degree " +
         std::to_string(certificate.degree);
}

void print(const TriangleMesh& mesh, const Row& row) {
  const DistortionSummary d = summarise(measure_distortion(mesh, row.map));
  std::printf("| %s | ", row.name.c_str());
  row.cpu_seconds ? std::printf("%.3g", *row.cpu_seconds) : std::printf("–");
  std::printf(" | %s | %.4f | %.4f | %.4g |\n", verdict_words(row.certificate).c_str(),
              d.mean_abs_ln_angle, d.weighted_abs_log2_area, d.symmetric_dirichlet);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Puts other systems' spheres of a mesh beside ours.");
  std::string mesh_path;
  std::vector<std::string> spheres, names;
  std::vector<double> seconds;
  int threads = 1;
  app.add_option("MESH", mesh_path)->required();
  app.add_option("SPHERE", spheres, "the same mesh on a sphere");
  app.add_option("--seconds", seconds, "CPU time of each");
  app.add_option("--names", names, "of each, for the table");
  app.add_option("--threads", threads, "for ours");
  CLI11_PARSE(app, argc, argv);

  const TriangleMesh mesh = read_mesh(mesh_path).mesh;
  const Topology topology = require_sphere(mesh);
  std::printf("Y = %.3f µs a triangle; %ld triangles\n\n",
              1e6 * bench::measure_yardstick(bench::yardstick_mesh(bench::meshes_folder())),
              static_cast<long>(mesh.face_count()));
  std::puts(
      "| sphere | CPU s | bijective | mean \\|ln angle\\| | weighted \\|log2 area\\| | symD |\n"
      "|---|---|---|---|---|---|");
  for (size_t i = 0; i < spheres.size(); ++i) {
    Row row = peer(mesh, topology, spheres[i]);
    if (i < names.size()) row.name = names[i];
    if (i < seconds.size()) row.cpu_seconds = seconds[i];
    print(mesh, row);
  }
  const auto run = [&](ParameterizeOptions options, const char* name) {
    options.threads = threads;
    print(mesh, ours(mesh, options, name));
  };
  run({.quality = Quality::Draft}, "ours, draft");
  run({}, "ours, normal");
  run({.quality = Quality::Best}, "ours, best");
  run({.balance = Balance::Conformal}, "ours, conformal");
  run({.balance = Balance::EqualArea}, "ours, equal-area");
  run({.automatic_poles = false,
       .energy = {.kind = EnergyKind::SymmetricDirichlet},
       .quality = Quality::Best},
      "ours, best symmetric Dirichlet, no poles");
} catch (const std::exception& error) {
  std::cerr << "peers: " << error.what() << "\n";
  return 1;
}
