#include <catch2/catch.hpp>
#include <set>

#include "io/files/gzip.h"
#include "io/formats/mesh_formats.h"
#include "io/reading.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

MeshFile mapped_icosphere() {
  MeshFile file;
  file.mesh = icosphere(1);
  file.mesh.positions *= 2;
  return attach_map(file, {icosphere(1).positions}, {{"verdict", "one-to-one"}});
}

/// Of the triangles, one after the other.
Points corners_of(const TriangleMesh& mesh) {
  Points corners(3 * mesh.face_count(), 3);
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) corners.row(3 * f + k) = mesh.positions.row(mesh.triangles(f, k));
  return corners;
}

std::string name_for(const MeshFormat& format) {
  return "mesh" + std::string(format.extensions.front());
}

}  // namespace

TEST_CASE("mesh_formats: no two formats have one extension, and all are found by theirs") {
  std::set<std::string_view> seen;
  for (const MeshFormat& format : mesh_formats()) {
    for (const std::string_view extension : format.extensions) {
      if (extension.empty()) continue;
      CHECK(seen.insert(extension).second);
      CHECK(format_of_extension(extension) == &format);
      CHECK(is_mesh_name("a" + std::string(extension)));
      CHECK(is_mesh_name("a" + std::string(extension) + ".gz"));
    }
  }
  CHECK_FALSE(format_of_extension(""));
  CHECK_FALSE(is_mesh_name("report.json"));
}

TEST_CASE(
    "mesh_formats: what is written looks like its format, also under no name, and reads back") {
  for (const MeshFormat& format : mesh_formats()) {
    INFO(format.names);
    CHECK(is_written(name_for(format)) == (format.write != nullptr));
    if (!format.write) {
      CHECK_THROWS_AS(serialise_mesh(name_for(format), mapped_icosphere()), WriteError);
      continue;
    }
    const std::string bytes = serialise_mesh(name_for(format), mapped_icosphere());
    CHECK(format.looks_so(bytes));
    const std::string packed = serialise_mesh(name_for(format) + ".gz", mapped_icosphere());
    CHECK(unzip(packed, "a", bytes.size()).bytes == bytes);
    CHECK(read(packed, "nameless").format.ends_with(", gzip"));
    const MeshFile back = read(bytes, "nameless");
    const double rounding = back.position_type == ScalarType::Float32 ? 1e-6 : 0;
    CHECK((corners_of(back.mesh) - corners_of(mapped_icosphere().mesh)).cwiseAbs().maxCoeff() <=
          rounding);
    CHECK(back.mesh.vertex_count() == 42);
    CHECK((back.mesh.triangles == mapped_icosphere().mesh.triangles) == !format.own_corners);
    CHECK(read_sphere(back).has_value() == format.keeps_map);
    CHECK(read_provenance(back).empty() != format.keeps_map);  // no verdict on a map that is gone
    CHECK(keeps_map(name_for(format)) == format.keeps_map);
  }
}

TEST_CASE("mesh_formats: on a sphere the verdict stays, for the positions are the map") {
  MeshFile sphere = sphere_mesh(mapped_icosphere(), {icosphere(1).positions}, {{"verdict", "x"}});
  for (const char* name : {"s.ply", "s.obj", "s.off", "s.gii", "s.vtk", "s.vtp.gz"}) {
    const MeshFile back = read(serialise_mesh(name, sphere, {.is_sphere = true}), name);
    CHECK(read_provenance(back) == Provenance{{"verdict", "x"}});
  }
}

TEST_CASE("mesh_formats: without an extension, and on standard output, a mesh is a PLY") {
  const std::string ply = serialise_mesh("a.ply", mapped_icosphere());
  CHECK(serialise_mesh("-", mapped_icosphere()) == ply);
  CHECK(serialise_mesh("a", mapped_icosphere()) == ply);
  CHECK_FALSE(is_written("a.xyz"));
}

TEST_CASE("mesh_formats: people are told all that are read") {
  CHECK(readable_formats() ==
        "OBJ, PLY, OFF, STL, 3MF, glTF, GLB, FBX, COLLADA, 3DS, X3D, VTK, VTP, GIFTI, FreeSurfer, "
        "MZ3, ICQ and "
        "PDS plate table");
  CHECK(readable_formats("or").ends_with("ICQ or PDS plate table"));
}
