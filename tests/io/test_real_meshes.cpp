#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "io/polygons/welding.h"
#include "reading.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/real_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
namespace fs = std::filesystem;

namespace {

struct Entry {
  std::string name;
  long vertices, faces;
};

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, separator);) fields.push_back(field);
  return fields;
}

bool is_ours(const std::string& name) {
  return name.ends_with(".obj") || name.ends_with(".ply") || name.ends_with(".off");
}

/// Rows of a table with the columns name, vertices, faces at the given places.
std::vector<Entry> read_table(const fs::path& path, char separator, std::size_t name,
                              std::size_t vertices) {
  std::vector<Entry> entries;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> fields = split(line, separator);
    if (fields.size() <= vertices + 1) continue;
    const auto trimmed = [&](std::size_t i) { return replaced(fields[i], " ", ""); };
    if (is_ours(trimmed(name)))
      entries.push_back({trimmed(name), std::atol(trimmed(vertices).c_str()),
                         std::atol(trimmed(vertices + 1).c_str())});
  }
  return entries;
}

/// Files that must be refused, and where.
const std::map<std::string, std::string> refusals = {
    {"assimp__box_longline.obj", "names a vertex twice"},
    {"draco__Box.ply", ".ply:35: the header of a binary file ends its lines in CR alone"},
    {"geogram.data__corrupted_invalid_face_count.ply",
     ".ply:50: 22 records of element 'face' do not fit"},
    {"geogram.data__truncated.ply", ".ply:46: 12 records of element 'vertex' do not fit"},
    {"libhedra__eyeye_circular.off", "of 800"},
    {"matlab-toolboxes__hole_sphere1.off", ".off:3: expected a number, found '-0.000000,'"},
    {"meshlab__office_chair.obj", "names a vertex twice"},
    {"tinyobjloader__test-nan.obj", ".obj:12: expected a number, found 'nan'"},
};

}  // namespace

TEST_CASE("real meshes: every genus-0 mesh is read whole and is a sphere") {
  const fs::path folder = real_mesh_folder("genus0");
  if (folder.empty()) return;
  const std::vector<Entry> entries = read_table(folder / "README.md", '|', 1, 4);
  CHECK(entries.size() == 16);
  for (const auto& [name, vertices, faces] : entries) {
    INFO(name);
    const MeshFile file = read_mesh((folder / name).string());
    CHECK(file.mesh.vertex_count() == vertices);
    CHECK(file.mesh.face_count() == faces);
    std::vector<std::string> notes;
    CHECK(inspect_mesh(prepare_for_mapping(file, &notes).mesh).is_sphere());
    CHECK(notes.empty());
    const std::string once = serialise_ply(file);
    CHECK(serialise_ply(read(once)) == once);
  }
}

TEST_CASE("real meshes: bad files are refused with a place, bad surfaces are read") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  const std::vector<Entry> entries = read_table(folder / "README.tsv", '\t', 0, 5);
  CHECK(entries.size() == 34);
  for (const auto& [name, vertices, faces] : entries) {
    INFO(name);
    const auto refused = refusals.find(name);
    if (refused != refusals.end()) {
      CHECK_THROWS_WITH(read_mesh((folder / name).string()),
                        Catch::Matchers::Contains(refused->second));
      continue;
    }
    const MeshFile file = read_mesh((folder / name).string());
    if (vertices == 0) continue;  // the table has no counts
    CHECK(file.mesh.vertex_count() == vertices);
    CHECK(file.mesh.face_count() == faces);
  }
}

TEST_CASE("real meshes: what is closed as indexed is not welded") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  const MeshFile file = read_mesh((folder / "CGoGN_2__aneurysm_3D.ply").string());
  CHECK(inspect_mesh(prepare_for_mapping(file).mesh).is_sphere());
  CHECK_FALSE(inspect_mesh(weld_exact(file).file.mesh).is_sphere());
}

TEST_CASE("real meshes: what needs welding, and GIFTI, becomes a sphere on its way to the map") {
  const fs::path folder = real_mesh_folder("genus0");
  if (folder.empty()) return;
  for (const auto& [name, vertices, faces] :
       {Entry{"Duck.glb", 2108, 4212},
        {"scallop.glb", 60002, 120000},
        {"fox_ascii.stl", 313, 622},
        {"S1200.L.white_MSMAll.32k_fs_LR.surf.gii", 32492, 64980}}) {
    INFO(name);
    const TriangleMesh mesh = prepare_for_mapping(read_mesh((folder / name).string())).mesh;
    CHECK(mesh.vertex_count() == vertices);
    CHECK(mesh.face_count() == faces);
    CHECK(inspect_mesh(mesh).is_sphere());
  }
}

TEST_CASE("real meshes: a glTF of many parts is read, and is no sphere for the reasons known") {
  const fs::path folder = real_mesh_folder("bad");
  if (folder.empty()) return;
  const MeshFile file = read_mesh((folder / "trimesh__CesiumMilkTruck.glb").string());
  CHECK(file.mesh.vertex_count() == 3564);
  CHECK(file.mesh.face_count() == 3624);
  const MeshInspection inspection = inspect_mesh(prepare_for_mapping(file).mesh);
  CHECK_FALSE(inspection.is_sphere());
  CHECK(inspection.defects.size() == 3);  // open, non-manifold vertices, components
}
