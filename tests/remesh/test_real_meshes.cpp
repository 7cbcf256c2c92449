#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "mesh_io/mesh_reader.h"
#include "mesh_io/welding.h"
#include "remesh/remesh.h"
#include "sphparam/parameterize.h"

using namespace sphparam;
using namespace sphparam::tools;
namespace fs = std::filesystem;

TEST_CASE("real meshes: on every grid they are closed, of genus 0, certified") {
  const char* const given = std::getenv("SPHPARAM_MESHES");
  const fs::path folder = fs::path(given ? given : SPHPARAM_DEFAULT_MESHES) / "genus0";
  if (!fs::is_directory(folder)) {
    std::cout << "skipped: no folder " << folder << "\n";
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension == ".txt" || extension == ".md" || extension == ".png") continue;
    const MeshFile source = prepare_for_mapping(read_mesh(entry.path().string()));
    const SphereMap map = parameterize(source.mesh, {.quality = Quality::Draft}).map;
    for (const char* name : {"ico:4", "octa:33", "cube:16", "uv:64x32", "healpix:16"}) {
      INFO(entry.path().filename().string() << " on " << name);
      const Remeshed result = remesh(source, map, make_grid(parse_grid(name)));  // none unlocated
      CHECK(certify(require_sphere(result.file.mesh), result.map).bijective());
      CHECK(result.file.mesh.positions.allFinite());
    }
  }
}
