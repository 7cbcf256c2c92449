// What a displacement image costs, beside the bake of positions of the same size. Both with their
// encoder, as float EXR, and without: seconds of the processors, the least of three times in turns.
//
//   bench_displacement                      a rough ball of 82 k triangles on ico:5, 4096 × 2048
//   bench_displacement MESH [GRID [WIDTH]]

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>

#include "bake/bake_rows.h"
#include "bake/field_registry.h"
#include "bake/make_scene.h"
#include "displace/displacement_file.h"
#include "image/image_writer.h"
#include "io/attributes/shading_normals.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/subdivision.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

constexpr int threads = 2, times = 3;

/// Of all threads.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

MeshFile rough_ball() {
  MeshFile file;
  file.mesh = tests::icosphere(6);
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    const Vector3 q = file.mesh.positions.row(v);
    file.mesh.positions.row(v) *=
        1 + 0.2 * std::sin(3 * q.x() + 2 * q.y()) + 0.01 * std::sin(40 * q.x() + 35 * q.z());
  }
  return file;
}

struct Seconds {
  double computing, encoding;
  double all() const { return computing + encoding; }
  void lower_to(const Seconds& other) {
    computing = std::min(computing, other.computing);
    encoding = std::min(encoding, other.encoding);
  }
};

Seconds bake_positions(const MeshFile& file, const SphereMap& map, int width) {
  const double start = processor_seconds();
  const MappedMesh mapped({.file = file, .map = map}, threads);
  const BakeScene scene{make_source(mapped), make_target(mapped, true, threads), {}, threads};
  std::vector<SurfaceField> fields;
  fields.push_back(make_field("position", scene));
  double encoding = 0;
  std::vector<char> bytes;
  ImageWriter writer({.width = width,
                      .height = width / 2,
                      .channels = 3,
                      .format = ImageFormat::Exr,
                      .sample_type = SampleType::Float},
                     in_memory(bytes));
  bake(scene, fields, {.width = width, .height = width / 2, .threads = threads},
       [&](size_t, int, int rows, const float* values) {
         const double before = processor_seconds();
         writer.write_rows(values, rows);
         encoding += processor_seconds() - before;
       });
  const double baked = processor_seconds();
  writer.close();
  return {baked - start - encoding, encoding + processor_seconds() - baked};
}

Seconds displace(const MappedMesh& mapped, const SphereGrid& grid, const SubdivisionFit& fit,
                 int width) {
  const double start = processor_seconds();
  const DirectedBase base(grid, fit.control, fit.topology->scheme(), threads);
  const Displacement made =
      make_displacement(base, mapped.mesh(), mapped.topology(), mapped.locator(),
                        {.width = width, .height = width / 2, .threads = threads});
  const double computed = processor_seconds();
  encode_displacement(made, ImageDepth::Float, "grid", name_of(fit.topology->scheme()));
  return {computed - start, processor_seconds() - computed};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("What a displacement image costs, beside the bake of positions of the same size.");
  std::string mesh, grid_name = "ico:5";
  int width = 4096;
  app.add_option("MESH", mesh, "else a rough ball of 82 k triangles");
  app.add_option("GRID", grid_name)->capture_default_str();
  app.add_option("WIDTH", width, "of the image")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const MeshFile file = mesh.empty() ? rough_ball() : prepare_for_mapping(read_mesh(mesh));
  const SphereGrid grid = make_grid(parse_grid(grid_name));
  const SphereMap map = parameterize(file.mesh).map;
  const MappedMesh mapped({.file = file, .map = map}, threads);
  const Scheme scheme = grid.faces.degree(0) == 3 ? Scheme::Loop : Scheme::CatmullClark;
  const SubdivisionFit fit = fit_subdivision(mapped, grid, {.scheme = scheme, .threads = threads});
  bake_positions(file, map, width / 4);  // warms what is warmed once
  Seconds baked = bake_positions(file, map, width), displaced = displace(mapped, grid, fit, width);
  for (int i = 1; i < times; ++i) {
    baked.lower_to(bake_positions(file, map, width));
    displaced.lower_to(displace(mapped, grid, fit, width));
  }
  const double texels = 0.5 * width * width;
  std::printf("%ld triangles, %ld control points, %d × %d\n",
              static_cast<long>(file.mesh.face_count()), static_cast<long>(fit.control.rows()),
              width, width / 2);
  const auto row = [&](const char* what, const Seconds& seconds) {
    std::printf("  %-14s %7.2f s (%5.0f ns a texel) + encoding %6.2f s = %6.2f s\n", what,
                seconds.computing, 1e9 * seconds.computing / texels, seconds.encoding,
                seconds.all());
  };
  row("position bake", baked);
  row("displacement", displaced);
  std::printf("  displacement / bake: %.2f with encoding (wanted: at most 2), %.2f without\n",
              displaced.all() / baked.all(), displaced.computing / baked.computing);
} catch (const std::exception& error) {
  std::cerr << "bench_displacement: " << error.what() << "\n";
  return 1;
}
