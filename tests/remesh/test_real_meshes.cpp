#include <catch2/catch.hpp>
#include <filesystem>

#include "sphparam/io/mesh_reader.h"
#include "io/polygons/welding.h"
#include "remesh/remesh.h"
#include "sphparam/parameterize.h"
#include "support/real_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
namespace fs = std::filesystem;

TEST_CASE("real meshes: on every grid they are closed, of genus 0, certified") {
  for (const fs::path& path : real_meshes()) {
    const MeshFile source = prepare_for_mapping(read_mesh(path.string()));
    const SphereMap map = parameterize(source.mesh, {.quality = Quality::Draft}).map;
    for (const char* name : {"ico:4", "octa:33", "cube:16", "uv:64x32", "healpix:16"}) {
      INFO(path.filename().string() << " on " << name);
      const Remeshed result = remesh(source, map, make_grid(parse_grid(name)));  // none unlocated
      CHECK(certify(require_sphere(result.file.mesh), result.map).bijective());
      CHECK(result.file.mesh.positions.allFinite());
    }
  }
}
