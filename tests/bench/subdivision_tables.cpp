// Subdivision surfaces fitted to meshes, beside the plain resampled meshes of as many vertices: how
// far each is from its source. Without a folder: five smooth shapes.
//
// Usage: subdivision_tables [FOLDER] [--samples N]   (Markdown on standard output)
// Ends with 1 where a fit is farther from its source than the plain mesh.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "geodesic_sphere.h"
#include "io/polygons/welding.h"
#include "remesh/subdivision/patch_net.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/subdivision.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

struct Trial {
  const char* grid;
  Scheme scheme;
};
constexpr Trial trials[] = {{"ico:4", Scheme::Loop},
                            {"ico:5", Scheme::Loop},
                            {"cube:16", Scheme::CatmullClark},
                            {"cube:32", Scheme::CatmullClark}};

constexpr int frequency = 64;    // of formulas' spheres: 81,920 triangles
constexpr int pieces_along = 8;  // flat pieces of a patch, where a limit surface is measured

MeshFile over_sphere(Vector3 (*formula)(const Vector3&)) {
  MeshFile file;
  file.mesh = samples::geodesic_sphere(frequency, 0.1).mesh;
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    file.mesh.positions.row(v) = formula(file.mesh.positions.row(v));
  }
  return file;
}

Vector3 ellipsoid(const Vector3& q) { return {2 * q.x(), q.y(), 0.6 * q.z()}; }
Vector3 bumpy(const Vector3& q) {
  return q * (1 + 0.2 * std::sin(3 * q.x()) * std::cos(2 * q.y() + q.z()));
}
Vector3 dumbbell(const Vector3& q) {
  const double waist = 0.35 + 0.65 * q.z() * q.z();
  return {waist * q.x(), waist * q.y(), 1.5 * q.z()};
}

TriangleMesh fine_mesh(const SubdivisionFit& fit, const Polygons& faces) {
  const LimitSurface surface(fit.topology, fit.control);
  const Tessellation pieces = tessellate(faces, static_cast<int>(fit.control.rows()), pieces_along);
  const std::vector<LimitPoint> points = surface.evaluate_all(pieces.vertices);
  TriangleMesh mesh;
  mesh.positions.resize(std::ssize(points), 3);
  for (size_t v = 0; v < points.size(); ++v) {
    mesh.positions.row(static_cast<Eigen::Index>(v)) = points[v].position;
  }
  mesh.triangles = triangulate(mesh.positions, pieces.faces).triangles;
  return mesh;
}

/// Prints one cell; returns by what the fit divides the RMS.
double try_on(const MeshFile& source, const SphereMap& map, const Trial& trial,
              std::int64_t samples) {
  const SphereGrid grid = make_grid(parse_grid(trial.grid));
  const MappedMesh mapped({.file = source, .map = map});
  const Remeshed plain = remesh(mapped, grid, {.transfer = {"none"}});
  const SubdivisionFit fit = fit_subdivision(mapped, grid, {.scheme = trial.scheme});
  const SurfaceDistance before = measure_distance(source.mesh, plain.mesh(), {.samples = samples});
  const SurfaceDistance after =
      measure_distance(source.mesh, fine_mesh(fit, grid.faces), {.samples = samples});
  const double percent = 100 / before.diagonal_first, ratio = before.rms() / after.rms();
  std::printf(" %.4f / %.4f: %.2f |", percent * before.rms(), percent * after.rms(), ratio);
  std::fflush(stdout);
  return ratio;
}

void print_head() {
  std::string head = "| RMS plain / fitted, % of the diagonal: ratio | triangles |",
              rule = "|---|---|";
  for (const Trial& trial : trials) {
    head.append(" ").append(trial.grid).append(" |");
    rule += "---|";
  }
  std::printf("%s\n%s\n", head.c_str(), rule.c_str());
}

/// Prints one row; returns the least ratio.
double print_row(const std::string& name, const MeshFile& source, std::int64_t samples) {
  const SphereMap map = parameterize(source.mesh).map;
  std::printf("| %s | %ld |", name.c_str(), static_cast<long>(source.mesh.face_count()));
  double least = INFINITY;
  for (const Trial& trial : trials) least = std::min(least, try_on(source, map, trial, samples));
  std::printf("\n");
  return least;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Fits subdivision surfaces, and measures them beside plain resampled meshes.");
  std::string folder;
  std::int64_t samples = 200'000;
  app.add_option("FOLDER", folder);
  app.add_option("--samples", samples, "of each surface")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  print_head();
  double least = INFINITY;
  const auto row = [&](const std::string& name, const MeshFile& source) {
    least = std::min(least, print_row(name, source, samples));
  };
  if (folder.empty()) {
    row("ellipsoid", over_sphere(ellipsoid));
    row("bumpy sphere", over_sphere(bumpy));
    row("dumbbell", over_sphere(dumbbell));
    row("creature", samples::make_creature());
    row("cortex", samples::make_cortex());
  } else {
    for (const std::filesystem::path& path : bench::mesh_files(folder)) {
      row(path.stem().string(), prepare_for_mapping(read_mesh(path)));
    }
  }
  std::printf("\nleast ratio: %.2f\n", least);
  return least >= 1 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "subdivision_tables: " << error.what() << "\n";
  return 1;
}
