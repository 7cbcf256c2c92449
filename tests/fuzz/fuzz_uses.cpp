// What small meshes of any connectivity and any shape are mapped for. The chart's proof holds for
// an asset as it is stored and read back; a remesh is finite and keeps the map that it was made by.

#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "expect.h"
#include "gltf/export_asset.h"
#include "gltf/written_check.h"
#include "recipe.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"

namespace {

using namespace sphparam;
using namespace sphparam::tests;

void expect_asset(const MeshFile& file, const SphereMap& map, unsigned taste) {
  ExportChartOptions options{.threads = 1};
  if (taste & 1) options.convention = Convention::Blender;
  if (taste & 2) options.refine_poles = 4;
  const ExportChart chart = export_chart(file.mesh, Topology(file.mesh), map, options);
  // Thinner in (u, v) than numbers tell: refused by name.
  if (!chart.chart.certificate.one_to_one()) return;
  const ExportGeometry geometry =
      export_geometry(chart, file, {.buffers = {.tangents = (taste & 4) != 0}, .threads = 1});
  expect(geometry.stored.one_to_one(), "a chart that is one-to-one is so as it is stored");
  const Asset asset{.name = "mesh",
                    .levels = {geometry.surface},
                    .images = {},
                    .materials = {{.name = "plain"}},
                    .extras = {}};
  const GltfOptions how{.compress = (taste & 8) != 0};
  check_written(glb_bytes(asset, how), "mesh.glb", asset, how);
}

void expect_remesh(MeshFile file, SphereMap map, unsigned taste) {
  constexpr const char* grids[] = {"ico:2", "uv:12x6", "octa:9", "cube:4"};
  const Remeshed made = remesh(MappedMesh({.file = std::move(file), .map = std::move(map)}, 1),
                               parse_grid(grids[taste % std::size(grids)]), {.threads = 1});
  expect(made.mesh().positions.allFinite(), "a remesh is finite");
  expect(made.certificate().bijective(), "a remesh has a map");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Recipe recipe({data, size});
  const unsigned taste = recipe.byte();
  MeshFile file;
  file.mesh = recipe.sphere_mesh();
  const Parameterization made = parameterize(file.mesh, {.quality = Quality::Draft, .threads = 1});
  try {
    expect_asset(file, made.map, taste);
  } catch (const std::range_error&) {  // beyond float32, as its message says
  }
  expect_remesh(std::move(file), made.map, taste / 16);
  return 0;
}
