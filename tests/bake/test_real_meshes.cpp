#include <catch2/catch.hpp>
#include <filesystem>

#include "bake/texels/texel_owners.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "support/real_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

TEST_CASE("real meshes: every texel of every image has one owner") {
  for (const fs::path& path : real_meshes()) {
    INFO(path.filename().string());
    const TriangleMesh mesh =
        sphparam::prepare_for_mapping(sphparam::read_mesh(path.string())).mesh;
    const Topology topology(mesh);
    const SphericalChart chart =
        spherical_chart(mesh, topology, parameterize(mesh, {.quality = Quality::Draft}).map);
    for (const int width : {1024, 4096}) {
      const sphparam::TexelOwners owners(chart, width, width / 2);
      std::int64_t owned = 0;
      for (int b = 0; b < owners.band_count(); ++b) {
        for (const sphparam::TexelRun& run : owners.runs(b)) owned += run.count;  // throws at gaps
      }
      CHECK(owned == std::int64_t{width} * width / 2);
    }
  }
}
