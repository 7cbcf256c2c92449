#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>

#include "io/formats/stl_reader.h"
#include "io/formats/stl_writer.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mesh_reader.h"
#include "support/folder.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;

/// A flat triangle after one of area, of four vertices.
MeshFile two_triangles() {
  MeshFile file;
  file.mesh = {Points(4, 3), Triangles(2, 3)};
  file.mesh.positions << 9, 9, 9, 0, 0, 0, 4, 0, 0, 0, 0.5, 0;
  file.mesh.triangles << 1, 2, 3, 1, 2, 2;
  return file;
}

float float_at(const std::string& bytes, std::size_t at) {
  char raw[4];
  std::memcpy(raw, bytes.data() + at, sizeof raw);
  if (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof raw);
  float value = 0;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

std::vector<std::string> losses_of(const MeshFile& file, const std::string& path) {
  PendingFiles files;
  std::vector<std::string> losses = add_mesh(files, path, file);
  files.publish();
  return losses;
}

}  // namespace

TEST_CASE("stl: a header, a count, and for each triangle its normal, its corners and a zero") {
  const std::string bytes = serialise_stl(two_triangles());
  REQUIRE(bytes.size() == 84 + 2 * 50);
  CHECK_FALSE(bytes.starts_with("solid"));
  CHECK(bytes.substr(80, 4) == std::string("\2\0\0\0", 4));
  const std::vector<float> wanted = {0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0.5, 0};
  for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(float_at(bytes, 84 + 4 * i) == wanted[i]);
  for (std::size_t i = 0; i < 3; ++i) CHECK(float_at(bytes, 134 + 4 * i) == 0);  // no normal
  CHECK(bytes.substr(132, 2) == std::string(2, '\0'));
  CHECK(looks_like_binary_stl(bytes));
}

TEST_CASE("stl: of any size normals are of length 1") {
  for (const double size : {1e-30, 1e30}) {
    MeshFile file = two_triangles();
    file.mesh.positions *= size;
    CHECK(float_at(serialise_stl(file), 84 + 8) == 1);
  }
  MeshFile large = two_triangles();
  large.mesh.positions *= 1e39;
  CHECK_THROWS_WITH(serialise_stl(large), Contains("beyond numbers of 32 bits"));
}

TEST_CASE("stl: what is not in it is told, also vertices that become one") {
  const Folder folder;
  MeshFile file;
  file.mesh = icosphere(1);
  file.mesh.positions.row(7) = file.mesh.positions.row(5);
  file.mesh.positions.row(7) *= 1 + 1e-12;  // 32 bits do not tell them apart
  file.set_vertex_property({"mass", ScalarType::Float32, std::vector<double>(42, 1)});
  const std::vector<std::string> losses = losses_of(file, folder / "a.stl");
  REQUIRE(losses.size() == 4);
  CHECK_THAT(losses[0], Contains("the last digits of ") && Contains(" of 42 vertices"));
  CHECK(losses[1] == "not carried: mass of vertices");
  CHECK(losses[2] == "not carried: numbers of vertices: triangles there have corners of their own");
  CHECK_THAT(losses[3], Contains("not carried: 1 of 42 vertices: they lie in the place of others"));
  CHECK(read_mesh(folder / "a.stl").mesh.vertex_count() == 41);

  file.mesh.positions = icosphere(1).positions.cast<float>().cast<double>();
  file.vertex_properties.clear();
  CHECK(losses_of(file, folder / "b.stl") == std::vector<std::string>{losses[2]});
}

TEST_CASE(
    "stl: a mapped mesh is proved as written, and no sphere is, whose vertices need numbers") {
  const Folder folder;
  const MappedMesh ball = mapped(icosphere(2), SphereMap{icosphere(2).positions});
  save_mapped(folder / "ball.stl", ball);
  CHECK(read_mesh(folder / "ball.stl").mesh.face_count() == ball.mesh().face_count());
  CHECK_THROWS_WITH(save_sphere(folder / "sphere.stl", ball),
                    Contains("vertices have no numbers there") && Contains(".mz3"));
  CHECK_FALSE(is_written_as_sphere("a.stl"));
  CHECK(is_written_as_sphere("a.ply.gz"));
  CHECK_FALSE(is_written_as_sphere("a.glb"));
  CHECK_THAT(sphere_extensions(), Contains(".off, .vtk") && !Contains(".stl"));
}

}  // namespace sphparam::tests
