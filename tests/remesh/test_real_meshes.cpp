#include <catch2/catch.hpp>
#include <filesystem>

#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "support/mapped.h"
#include "support/real_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
namespace fs = std::filesystem;

TEST_CASE("real meshes: on every grid they are closed, of genus 0, certified") {
  for (const fs::path& path : real_meshes()) {
    MeshFile file = prepare_for_mapping(read_mesh(path.string()));
    SphereMap map = parameterize(file.mesh, {.quality = Quality::Draft}).map;
    const MappedMesh source = mapped(std::move(file), std::move(map));
    for (const char* name : {"ico:4", "octa:33", "cube:16", "uv:64x32", "healpix:16"}) {
      INFO(path.filename().string() << " on " << name);
      const Remeshed result = remesh(source, parse_grid(name));  // none unlocated
      CHECK(certify(require_sphere(result.mesh()), result.map()).bijective());
      CHECK(result.mesh().positions.allFinite());
    }
  }
}
