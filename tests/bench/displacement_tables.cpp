// Displacement images: how far a fitted base alone is from its mesh, and how far base and image
// together are, read back from the bytes of the file.
//
// Usage: displacement_tables MESH… [--grid ico:5] [--width 4096] [--depth float|half|u16]
// Markdown on standard output. Ends with 1 where a rebuilt mesh is farther than a tenth of its
// base.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "displace/displacement_file.h"
#include "displace/rebuild.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/subdivision.h"
#include "sphparam/stopwatch.h"

using namespace sphparam;

namespace {

struct Settings {
  std::string grid = "ico:5", depth = "float";
  int width = 4096;
  std::int64_t samples = 1'000'000;
};

ImageDepth depth_named(const std::string& name) {
  return name == "half" ? ImageDepth::Half : name == "u16" ? ImageDepth::Uint16 : ImageDepth::Float;
}

/// Prints a row; returns by what the image divides the RMS.
double try_on(const std::string& path, const Settings& settings) {
  const MeshFile file = prepare_for_mapping(read_mesh(path));
  const TriangleMesh& mesh = file.mesh;
  ParameterizeOptions mapping;
  mapping.energy.lambda = remeshing_lambda;
  const MappedMesh mapped({.file = file, .map = parameterize(mesh, mapping).map});
  const SphereGrid grid = make_grid(parse_grid(settings.grid));
  const Scheme scheme = grid.faces.degree(0) == 3 ? Scheme::Loop : Scheme::CatmullClark;
  const SubdivisionFit fit = fit_subdivision(mapped, grid, {.scheme = scheme});
  const DirectedBase base(grid, fit.control, scheme);
  const Stopwatch stopwatch;
  const Displacement made =
      make_displacement(base, mesh, mapped.topology(), mapped.locator(),
                        {.width = settings.width, .height = settings.width / 2});
  const double seconds = stopwatch.seconds();
  const std::vector<char> bytes =
      encode_displacement(made, depth_named(settings.depth), settings.grid, "");
  const Image image = decode_displacement({bytes.data(), bytes.size()}, path);
  const std::int64_t texels = std::int64_t{image.width} * image.height;
  const Rebuilt rebuilt =
      rebuild(base, image, cuts_for(base, vertices_to_rebuild(image, mesh.vertex_count())));
  const SurfaceDistance alone = measure_distance(mesh, rebuilt.base, {.samples = settings.samples}),
                        with = measure_distance(mesh, rebuilt.mesh, {.samples = settings.samples});
  const double percent = 100 / alone.diagonal_first, gain = alone.rms() / with.rms();
  std::printf(
      "| %s | %ld | %ld | %.4f | %.3f | %.5f | %.3f | %.1f | %.4f | %.1f |\n",
      std::filesystem::path(path).stem().string().c_str(), static_cast<long>(mesh.face_count()),
      static_cast<long>(fit.control.rows()), percent * alone.rms(), percent * alone.max(),
      percent * with.rms(), percent * with.max(), gain,
      100.0 * static_cast<double>(made.figures.missed) / static_cast<double>(texels), seconds);
  std::fflush(stdout);
  return gain;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double wanted = 10;
  CLI::App program("Base and displacement beside the base alone");
  std::vector<std::string> meshes;
  Settings settings;
  program.add_option("MESH", meshes)->required();
  program.add_option("--grid", settings.grid)->capture_default_str();
  program.add_option("--width", settings.width, "of the image; half as many rows")
      ->capture_default_str();
  program.add_option("--depth", settings.depth)->check(CLI::IsMember({"float", "half", "u16"}));
  program.add_option("--samples", settings.samples)->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  std::printf("%s, %d × %d %s; distances in percent of the diagonal, both ways\n\n",
              settings.grid.c_str(), settings.width, settings.width / 2, settings.depth.c_str());
  std::printf(
      "| mesh | triangles | control points | base RMS | base max | rebuilt RMS | rebuilt max | "
      "base / rebuilt | normals that miss, %% | seconds |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  bool all = true;
  for (const std::string& mesh : meshes) all &= try_on(mesh, settings) >= wanted;
  return all ? 0 : 1;
}
