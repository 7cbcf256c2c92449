#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "bake/uv_raster.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/welding.h"
#include "sphparam/parameterize.h"

using namespace sphparam;
namespace fs = std::filesystem;

TEST_CASE("real meshes: every texel of every image has one owner") {
  const char* const given = std::getenv("SPHPARAM_MESHES");
  const fs::path folder = fs::path(given ? given : SPHPARAM_DEFAULT_MESHES) / "genus0";
  if (!fs::is_directory(folder)) {
    std::cout << "skipped: no folder " << folder << "\n";
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension == ".txt" || extension == ".md" || extension == ".png") continue;
    INFO(entry.path().filename().string());
    const TriangleMesh mesh =
        tools::prepare_for_mapping(tools::read_mesh(entry.path().string())).mesh;
    const Topology topology(mesh);
    const SphericalChart chart =
        spherical_chart(mesh, topology, parameterize(mesh, {.quality = Quality::Draft}).map);
    for (const int width : {1024, 4096}) {
      const tools::UvRaster raster(chart, width, width / 2);
      std::int64_t owned = 0;
      for (int b = 0; b < raster.band_count(); ++b) {
        for (const tools::RasterRun& run : raster.runs(b)) owned += run.count;  // throws at gaps
      }
      CHECK(owned == std::int64_t{width} * width / 2);
    }
  }
}
