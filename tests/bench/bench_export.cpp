// What an export costs: chart, tangents, buffers, proof as stored and container, beside writing the
// same arrays as a binary PLY; the encoding of an image apart. Seconds of the processors.
//
// Usage: bench_export [MESH]
// Without a mesh: the icosphere of 327,680 triangles, turned, so that date line and poles cut it.

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "chart/one_to_one.h"
#include "gltf/export_asset.h"
#include "gltf/images/variant_images.h"
#include "gltf/stored_chart.h"
#include "gltf/written_check.h"
#include "io/attributes/shading_normals.h"
#include "io/polygons/welding.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

constexpr int repetitions = 7;

/// Of the processors, all threads together; the least of some times.
double least_seconds(const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

struct Mapped {
  MeshFile file;
  SphereMap map;
};

Mapped sphere() {
  MeshFile file;
  file.mesh = tests::icosphere(7);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto turn =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
          .normalized()
          .toRotationMatrix();
  SphereMap map{file.mesh.positions * turn.transpose()};
  return {std::move(file), std::move(map)};
}

Mapped mapped_file(const char* path) {
  MeshFile file = prepare_for_mapping(read_mesh(path));
  const std::optional<SphereMap> written = read_sphere(file);
  SphereMap map = written ? *written : parameterize(file.mesh).map;
  return {std::move(file), std::move(map)};
}

void add_columns(MeshFile& file, const FloatRows& rows, const std::vector<const char*>& names) {
  for (size_t k = 0; k < names.size(); ++k) {
    const Eigen::VectorXd column = rows.col(static_cast<Eigen::Index>(k)).cast<double>();
    file.set_vertex_property({names[k], ScalarType::Float32,
                              std::vector<double>(column.data(), column.data() + column.size())});
  }
}

/// The same numbers as a mesh file: float32 positions, normals, tangents and (u, v); triangles.
MeshFile as_mesh_file(const Surface& surface) {
  MeshFile file;
  file.position_type = ScalarType::Float32;
  file.mesh.positions = surface.positions.cast<double>();
  file.mesh.triangles.resize(static_cast<Eigen::Index>(surface.indices.size() / 3), 3);
  std::ranges::copy(surface.indices, file.mesh.triangles.data());
  add_columns(file, surface.normals, {"nx", "ny", "nz"});
  add_columns(file, surface.tangents, {"tx", "ty", "tz", "tw"});
  add_columns(file, surface.texcoords.front(), {"s", "t"});
  return file;
}

}  // namespace

int main(int argc, char** argv) {
  // Memory once taken stays: else luck decides which of the rows pays for fresh pages.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  const Mapped mapped = argc > 1 ? mapped_file(argv[1]) : sphere();
  const Topology topology(mapped.file.mesh);
  const GeometryOptions options{.buffers = {.tangents = true}};
  const ExportChart chart = export_chart(mapped.file.mesh, topology, mapped.map);
  const ExportGeometry geometry = export_geometry(chart, mapped.file, options);
  const Asset asset{.name = "mesh",
                    .levels = {geometry.surface},
                    .images = {},
                    .materials = {{.name = "plain"}},
                    .extras = {}};
  const MeshFile arrays = as_mesh_file(geometry.surface);
  const std::string glb = glb_bytes(asset);

  const double ply = least_seconds([&] { serialise_ply(arrays); });
  std::printf("%ld triangles, %zu of them split; a PLY of the same arrays: %.1f ms\n",
              static_cast<long>(chart.chart.triangles.rows()),
              static_cast<size_t>(chart.chart.counts.splits()), 1e3 * ply);
  double sum = 0;
  const auto row = [&](const char* name, const std::function<void()>& work, bool counts) {
    const double seconds = least_seconds(work);
    if (counts) sum += seconds;
    std::printf("%-34s %8.1f ms %6.1f × PLY\n", name, 1e3 * seconds, seconds / ply);
  };
  row(
      "chart, certified", [&] { export_chart(mapped.file.mesh, topology, mapped.map); }, true);
  row(
      "normals, tangents, buffers",
      [&] {
        const Shape shape = mesh_shape(chart.chart, mapped.file.mesh, shading_normals(mapped.file),
                                       upright_axes({}));
        chart_surface(chart.chart, shape, {}, mapped.file, options.buffers);
      },
      true);
  row(
      "container", [&] { glb_bytes(asset); }, true);
  std::printf("%-34s %8.1f ms %6.1f × PLY (to be at most 10)\n", "together", 1e3 * sum, sum / ply);
  row(
      "certificate as stored", [&] { certify_stored(chart.chart, stored_uv(chart.chart, {}), {}); },
      false);
  row(
      "of that, whether it is one-to-one",
      [&] { is_one_to_one(chart.chart, read_uv(stored_uv(chart.chart, {}), {})); }, false);
  row(
      "reading back and comparing", [&] { check_written(glb, "mesh.glb", asset, {}); }, false);
  row(
      "quantised container", [&] { glb_bytes(asset, {.quantise = true}); }, false);
  row(
      "compressed container", [&] { glb_bytes(asset, {.compress = true}); }, false);
  row(
      "an image, 2048 × 1024, as PNG",
      [&] { test_asset_image(TestImage::Checker, 2048, Convention::Sphparam); }, false);
}
