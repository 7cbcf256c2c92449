// Any bytes are a mesh file or a ReadError. What was read keeps the promises of mesh_reader.h, can
// be inspected and prepared, and comes back from the writers as it went in.

#include <cstdint>
#include <optional>
#include <string_view>

#include "expect.h"
#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/mesh/mesh_defects.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

void expect_promises(const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  expect(mesh.positions.allFinite(), "positions are finite");
  if (mesh.triangles.size() > 0) {
    expect(mesh.triangles.minCoeff() >= 0, "indices are not negative");
    expect(mesh.triangles.maxCoeff() < mesh.vertex_count(), "indices are in range");
  }
  for (const Property& property : file.vertex_properties)
    expect(static_cast<Eigen::Index>(property.values.size()) == mesh.vertex_count(),
           "a vertex property has a value a vertex");
  for (const Property& property : file.face_properties)
    expect(static_cast<Eigen::Index>(property.values.size()) == mesh.face_count(),
           "a face property has a value a face");
  if (file.corner_texcoords)
    expect(file.corner_texcoords->rows() == 3 * mesh.face_count(), "texture coordinates a corner");
  if (file.corner_normals)
    expect(file.corner_normals->rows() == 3 * mesh.face_count(), "normals a corner");
  if (file.second_texcoords)
    expect(file.second_texcoords->rows() == 3 * mesh.face_count(), "second coordinates a corner");
  if (file.corner_tangents)
    expect(file.corner_tangents->rows() == 3 * mesh.face_count(), "tangents a corner");
}

/// STL and glTF have corners without numbers; where two are at one place, welding makes a face that
/// no file with numbers may hold: `map` refuses or repairs it before anything is written.
bool names_a_vertex_twice(const Triangles& triangles) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const auto face = triangles.row(f);
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return true;
  }
  return false;
}

void expect_round_trip(const MeshFile& file) {
  if (names_a_vertex_twice(file.mesh.triangles)) return;
  const std::string bytes = serialise_ply(file);
  const MeshFile again = read_mesh(bytes, "again.ply", {});
  expect(again.mesh.positions == file.mesh.positions, "positions survive writing and reading");
  expect(again.mesh.triangles == file.mesh.triangles, "triangles survive writing and reading");
  expect(serialise_ply(again) == bytes, "writing what was read changes nothing");
  if (file.mesh.triangles.size() == 0) return;  // an OBJ of nothing is no file
  for (const auto serialise : {serialise_obj, serialise_off}) {
    const std::string text = serialise(file);
    expect(read_mesh(text, "again", {}).mesh.triangles == file.mesh.triangles,
           "triangles survive text");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::optional<MeshFile> file;
  try {
    file = read_mesh(bytes, SPHPARAM_FUZZED_NAME, {});
  } catch (const ReadError&) {
    return 0;
  }
  expect_promises(*file);
  expect_round_trip(*file);
  inspect_mesh(file->mesh);
  expect_promises(prepare_for_mapping(*std::move(file)));
  return 0;
}
