// Every mesh of a folder on a grid of each kind: how far the result is from its source, and whether
// it is closed, of genus 0 and certified.
//
// Usage: remesh_tables FOLDER [--samples N]   (Markdown on standard output)

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

const std::vector<std::string> grids = {"ico:6", "octa:129", "cube:64", "uv:512x256", "healpix:64"};

/// What is wrong with a mesh on a grid; empty: nothing.
std::string fault_of(const Remeshed& result) {
  try {
    return certify(require_sphere(result.mesh()), result.map()).bijective() ? "" : "folds";
  } catch (const MeshError& error) {
    return error.what();
  }
}

struct Row {
  std::string distances;  // cells of the table
  std::vector<std::string> faults;
};

/// Locating a direction that no triangle holds throws: none is ever guessed.
Row remesh_on_all(const MeshFile& source, const SphereMap& map, std::int64_t samples) {
  Row row;
  const MappedMesh mapped({.file = source, .map = map});
  for (const std::string& name : grids) {
    const Remeshed result = remesh(mapped, parse_grid(name), {.transfer = {"none"}});
    const std::string fault = fault_of(result);
    if (!fault.empty()) row.faults.push_back(name + ": " + fault);
    const SurfaceDistance distance =
        measure_distance(source.mesh, result.mesh(), {.samples = samples});
    char cell[64];
    std::snprintf(cell, sizeof cell, " %.3f / %.2f |",
                  100 * distance.rms() / distance.diagonal_first,
                  100 * distance.max() / distance.diagonal_first);
    row.distances += cell;
  }
  return row;
}

void print_head() {
  std::string head = "| RMS / Hausdorff, % of the diagonal | triangles |", rule = "|---|---|";
  for (const std::string& name : grids) {
    head += " " + name + " |";
    rule += "---|";
  }
  std::printf("%s closed, genus 0, certified |\n%s---|\n", head.c_str(), rule.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Resamples all meshes of a folder on grids of every kind, and measures them.");
  std::string folder;
  std::int64_t samples = 200'000;
  app.add_option("FOLDER", folder)->required();
  app.add_option("--samples", samples, "of each surface")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  print_head();
  size_t faults = 0;
  for (const std::filesystem::path& path : bench::mesh_files(folder)) {
    const MeshFile source = prepare_for_mapping(read_mesh(path));
    const Row row = remesh_on_all(source, parameterize(source.mesh).map, samples);
    std::string verdict = row.faults.empty() ? "all" : "";
    for (const std::string& fault : row.faults) verdict += (verdict.empty() ? "" : "; ") + fault;
    std::printf("| %s | %ld |%s %s |\n", path.stem().c_str(),
                static_cast<long>(source.mesh.face_count()), row.distances.c_str(),
                verdict.c_str());
    std::fflush(stdout);
    faults += row.faults.size();
  }
  return faults == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "remesh_tables: " << error.what() << "\n";
  return 1;
}
