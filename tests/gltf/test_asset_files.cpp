#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sphparam/gltf/export.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"
#include "support/bytes_of.h"
#include "support/folder.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

const ExportOptions small{.look = {.image_width = 64}};

MappedMesh ball(const std::string& name) {
  MeshFile file;
  file.mesh = icosphere(1);
  const SphereMap map{file.mesh.positions};
  return MappedMesh({.file = std::move(file), .map = map, .name = name});
}

}  // namespace

TEST_CASE("asset files: an asset is called as its mesh, without folders and endings") {
  for (const auto& [name, called] : {std::pair("scans/egg.v2.obj", "egg.v2"),
                                     {"egg.sph.ply", "egg"},
                                     {"egg.ply.gz", "egg"},
                                     {"mesh", "mesh"}})
    CHECK(make_asset(ball(name), small).name == called);
}

TEST_CASE("asset files: of an .obj its .mtl and an image, of a .ply an image") {
  const Look look = make_look(ball("ball.obj"), small);
  const auto files = [&](const std::string& path) { return textured_files(path, look); };
  CHECK(files("to/a.obj") == std::vector<std::string>{"to/a.obj", "to/a.mtl", "to/a_checker.png"});
  CHECK(files("to/a.ply") == std::vector<std::string>{"to/a.ply", "to/a_checker.png"});
}

TEST_CASE("asset files: a textured mesh without an image is refused") {
  const Folder folder;
  PendingFiles files;
  for (const char* name : {"a.obj", "a.ply"}) {
    CHECK_THROWS_AS(textured_files(folder / name, {}), std::invalid_argument);
    CHECK_THROWS_AS(add_textured_mesh(files, folder / name, ball("ball.obj"), {}, small),
                    std::invalid_argument);
  }
}

TEST_CASE("asset files: images and buffers that no export wrote are never replaced") {
  const MappedMesh mapped = ball("ball.obj");
  const auto written_to = [&](const std::string& path) {
    path.ends_with(".gltf") ? write_asset(path, make_asset(mapped, small))
                            : void(write_textured_mesh(path, mapped, small));
  };
  for (const auto& [name, beside, word] : {std::tuple("a.gltf", "a_checker.png", "image"),
                                           {"a.gltf", "a.bin", "buffer"},
                                           {"a.ply", "a_checker.png", "image"},
                                           {"a.obj", "a_checker.png", "image"}}) {
    INFO(name << " " << beside);
    const Folder folder;
    const std::string path = folder / name, other = folder / beside,
                      free = folder /
                             ("a_sphparam" + std::filesystem::path(name).extension().string());
    write_file(other, "an artist's");
    CHECK_THROWS_WITH(written_to(path), other + ": is there, and is no " + word +
                                            " of an export: -o " + free + " leaves it as it is");
    CHECK(bytes_of(other) == "an artist's");
    CHECK(!std::filesystem::exists(path));
    std::filesystem::remove(other);
    for (int i = 0; i < 2; ++i) written_to(path);  // its own are
    std::filesystem::remove(path);                 // and belong to nobody without it
    if (path.ends_with(".obj")) std::filesystem::remove(folder / "a.mtl");
    CHECK_NOTHROW(written_to(path));  // the same bytes are no loss
    std::filesystem::remove(path);
    if (path.ends_with(".obj")) std::filesystem::remove(folder / "a.mtl");
    write_file(other, bytes_of(other) + "!");
    CHECK_THROWS_AS(written_to(path), WriteError);
  }
}

TEST_CASE("asset files: an image is shared by exports of one name, not with files of strangers") {
  const MappedMesh mapped = ball("ball.obj");
  const Folder folder;
  write_asset(folder / "a.gltf", make_asset(mapped, small));
  CHECK_NOTHROW(write_textured_mesh(folder / "a.ply", mapped, small));
  std::filesystem::remove(folder / "a.gltf");
  CHECK_NOTHROW(write_textured_mesh(folder / "a.obj", mapped, small));
  std::filesystem::remove(folder / "a.ply");
  std::filesystem::remove(folder / "a.mtl");
  write_file(folder / "a_checker.png", "an artist's");
  write_file(folder / "a.gltf",
             R"({"asset": {"generator": "a stranger"}, "images": [{"uri": "a_checker.png"}]})");
  CHECK_THROWS_AS(write_textured_mesh(folder / "a.ply", mapped, small), WriteError);
  CHECK_THROWS_AS(write_asset(folder / "a.gltf", make_asset(mapped, small)), WriteError);
  CHECK_NOTHROW(write_asset(folder / "a.gltf", make_asset(mapped, small),
                            {.container = GltfContainer::Embedded}));
}

TEST_CASE(
    "asset files: names that a line of text cannot hold are refused, where they stand in one") {
  const MappedMesh mapped = ball("ball.obj");
  const Folder folder;
  for (const std::string name : {"w\nv 9 9 9\n", " lead", "a\tb", "a\\b", "a\rb", "a\x7F"}) {
    INFO(name);
    for (const char* kind : {".obj", ".ply"}) {
      CHECK_THROWS_AS(require_export_place(folder / (name + kind)), WriteError);
      CHECK_THROWS_AS(write_textured_mesh(folder / (name + kind), mapped, small), WriteError);
    }
    CHECK(folder.names().empty());
    CHECK_NOTHROW(require_export_place(folder / (name + ".gltf")));
  }
  CHECK_NOTHROW(require_export_place(folder / "two words .obj"));
}

TEST_CASE("asset files: numbers that a .ply or .obj changes or has no place for are told") {
  const MappedMesh plain = ball("ball.obj");
  MeshFile file = plain.file();
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  std::vector<double> labels(count, 5), ramp;
  labels.back() = 0x1p40;
  for (std::size_t v = 0; v < count; ++v) ramp.push_back(static_cast<double>(v));
  file.set_vertex_property({"id", ScalarType::Int64, labels});
  file.set_vertex_property({"near", ScalarType::Int64, std::vector<double>(count, 5)});
  for (const char* name : {"t", "nx"}) file.set_vertex_property({name, ScalarType::Float64, ramp});
  const MappedMesh mapped({.file = std::move(file), .map = plain.map(), .name = "ball.obj"});
  const Folder folder;
  const auto warnings = write_textured_mesh(folder / "a.ply", mapped, small).warnings;
  CHECK(warnings ==
        std::vector<std::string>{
            "not carried: nx of vertices: the normals' stand there",
            "not carried: id as labels: whole numbers beyond 32 bits are doubles there, which are "
            "averaged (.vtp and .vtk have room)"});
  const MeshFile back = read_mesh(folder / "a.ply");
  REQUIRE(back.find_vertex_property("t"));
  for (std::size_t v = 0; v < count; ++v)  // the mesh's own vertices come first
    CHECK(back.find_vertex_property("t")->values[v] == ramp[v]);
  CHECK(back.find_vertex_property("near")->type == ScalarType::Int32);
  CHECK(
      write_textured_mesh(folder / "b.obj", mapped, small).warnings ==
      std::vector<std::string>{"not carried: nx of vertices: the normals' stand there",
                               "not carried: id, near and t of vertices: .ply has room for that"});
}

}  // namespace sphparam::tests
