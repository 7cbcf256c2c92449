#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <tuple>

#include "io/attributes/authorship.h"
#include "io/attributes/material_comments.h"
#include "io/attributes/source_attributes.h"
#include "io/formats/gltf/gltf_files.h"
#include "io/polygons/welding.h"
#include "io/reading.h"
#include "io/sphere_angles.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;
namespace fs = std::filesystem;

namespace {

void append(std::string& bytes, std::uint32_t word, int width = 4) {
  for (int i = 0; i < width; ++i) bytes.push_back(static_cast<char>(word >> (8 * i)));
}

std::string floats(const std::vector<double>& numbers) {
  std::string bytes;
  for (const double number : numbers)
    append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
  return bytes;
}

std::string integers(const std::vector<std::uint32_t>& numbers, int width) {
  std::string bytes;
  for (const std::uint32_t number : numbers) append(bytes, number, width);
  return bytes;
}

std::string chunk(const std::string& kind, std::string bytes, char padding) {
  while (bytes.size() % 4 != 0) bytes.push_back(padding);
  std::string result;
  append(result, static_cast<std::uint32_t>(bytes.size()));
  return result + kind + bytes;
}

std::string glb(const std::string& json, const std::string& binary) {
  const std::string body = chunk("JSON", json, ' ') +
                           (binary.empty() ? std::string() : chunk({"BIN\0", 4}, binary, '\0'));
  std::string header = "glTF";
  append(header, 2);
  append(header, static_cast<std::uint32_t>(12 + body.size()));
  return header + body;
}

/// A glTF file in the making: one binary chunk, a view and an accessor for each block of bytes.
struct Gltf {
  std::string binary, views, accessors;
  int count = 0;
  std::string meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
  std::string rest = R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)";
  std::string asset = R"({"version":"2.0"})";

  Gltf& add(const std::string& bytes, int component_type, std::size_t elements,
            const std::string& type, const std::string& more = "") {
    const std::string comma = count > 0 ? "," : "";
    views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(binary.size()) +
             R"(,"byteLength":)" + std::to_string(bytes.size()) + "}";
    accessors += comma + R"({"bufferView":)" + std::to_string(count) + R"(,"componentType":)" +
                 std::to_string(component_type) + R"(,"count":)" + std::to_string(elements) +
                 R"(,"type":")" + type + "\"" + more + "}";
    binary += bytes;
    while (binary.size() % 4 != 0) binary.push_back('\0');
    ++count;
    return *this;
  }

  std::string json(const std::string& uri = "") const {
    return R"({"asset":)" + asset + R"(,"buffers":[{"byteLength":)" +
           std::to_string(binary.size()) + (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") +
           R"(}],"bufferViews":[)" + views + R"(],"accessors":[)" + accessors + R"(],"meshes":)" +
           meshes + "," + rest + "}";
  }
  std::string bytes() const { return glb(json(), binary); }
};

std::vector<double> coordinates(const TriangleMesh& mesh) {
  return {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
}
std::vector<std::uint32_t> corners(const TriangleMesh& mesh) {
  return {mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()};
}

/// The tetrahedron (1 1 1), (−1 −1 1), (−1 1 −1), (1 −1 −1).
Gltf tetrahedron_gltf() {
  const TriangleMesh mesh = tetrahedron();
  return Gltf()
      .add(floats(coordinates(mesh)), 5126, 4, "VEC3")
      .add(integers(corners(mesh), 2), 5123, 12, "SCALAR");
}

std::string with(const std::string& from, const std::string& to) {
  Gltf gltf = tetrahedron_gltf();
  for (std::string* part : {&gltf.meshes, &gltf.rest, &gltf.asset, &gltf.views, &gltf.accessors})
    *part = replaced(*part, from, to);
  return gltf.bytes();
}

}  // namespace

TEST_CASE("gltf_reader: a binary file gives its mesh") {
  const MeshFile file = read(tetrahedron_gltf().bytes());
  CHECK(file.format == "glTF binary");
  CHECK(file.mesh.positions == tetrahedron().positions);
  CHECK(file.mesh.triangles == tetrahedron().triangles);
  CHECK(file.position_type == ScalarType::Float32);
  CHECK(file.notes.empty());
}

TEST_CASE("gltf_reader: indices of every type, or none, mean the same triangles") {
  const TriangleMesh mesh = tetrahedron();
  for (const auto& [type, width] : {std::pair{5121, 1}, {5123, 2}, {5125, 4}}) {
    const std::string bytes = Gltf()
                                  .add(floats(coordinates(mesh)), 5126, 4, "VEC3")
                                  .add(integers(corners(mesh), width), type, 12, "SCALAR")
                                  .bytes();
    CHECK(read(bytes).mesh.triangles == mesh.triangles);
  }
  Gltf soup;
  std::vector<double> all;
  for (const std::uint32_t corner : corners(mesh))
    for (int axis = 0; axis < 3; ++axis)
      all.push_back(mesh.positions(static_cast<Eigen::Index>(corner), axis));
  soup.add(floats(all), 5126, 12, "VEC3");
  soup.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
  CHECK(inspect_mesh(sphparam::prepare_for_mapping(read(soup.bytes())).mesh).is_sphere());
}

TEST_CASE("gltf_reader: strips and fans are turned as the specification says") {
  const auto shape = [](int mode, std::vector<std::uint32_t> indices) {
    Gltf gltf;
    gltf.add(floats(coordinates(tetrahedron())), 5126, 4, "VEC3")
        .add(integers(indices, 1), 5121, indices.size(), "SCALAR");
    gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" +
                  std::to_string(mode) + "}]}]";
    return read(gltf.bytes());
  };
  // A tetrahedron is a strip of four triangles.
  const MeshFile strip = shape(5, {0, 1, 2, 3, 0, 1});
  CHECK(strip.mesh.face_count() == 4);
  CHECK(inspect_mesh(strip.mesh).is_sphere());
  CHECK(strip.mesh.triangles.row(1) == Eigen::RowVector3i(1, 3, 2));
  const MeshFile stitched = shape(5, {0, 1, 2, 2, 2, 3});
  CHECK(stitched.mesh.face_count() == 1);
  CHECK(contains(stitched.notes.at(0), "3 triangles"));
  const MeshFile fan = shape(6, {3, 0, 1, 2});
  CHECK(fan.mesh.triangles.row(0) == Eigen::RowVector3i(0, 1, 3));
  CHECK(fan.mesh.triangles.row(1) == Eigen::RowVector3i(1, 2, 3));
}

TEST_CASE("gltf_reader: transforms are those of the node and all above it") {
  const auto placed = [](const std::string& nodes) {
    Gltf gltf = tetrahedron_gltf();
    gltf.rest = std::string("\"nodes\":") + nodes + R"(,"scenes":[{"nodes":[0]}])";
    return read(gltf.bytes()).mesh;
  };
  const TriangleMesh plain = tetrahedron();
  const TriangleMesh moved =
      placed(R"([{"children":[1],"translation":[1,2,3]},{"mesh":0,"scale":[2,2,2]}])");
  CHECK(moved.position(0) == Vector3(3, 4, 5));
  const TriangleMesh other_order =
      placed(R"([{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,2,3]}])");
  CHECK(other_order.position(0) == Vector3(4, 6, 8));
  // A quarter turn about z: x → y.
  const TriangleMesh turned = placed(
      R"([{"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[3,1,1]}])");
  CHECK((turned.position(0) - Vector3(-1, 3, 1)).norm() < 1e-12);
  const TriangleMesh by_matrix =
      placed(R"([{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]}])");
  CHECK(by_matrix.position(0) == Vector3(6, 7, 8));
  CHECK(by_matrix.triangles == plain.triangles);
}

TEST_CASE("gltf_reader: a mirrored node keeps its outside outside") {
  Gltf gltf = tetrahedron_gltf();
  gltf.rest = R"("nodes":[{"mesh":0,"scale":[-1,1,1]}])";  // and no scene: the roots are read
  const MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.position(0) == Vector3(-1, 1, 1));
  const auto volume = [](const TriangleMesh& mesh) {
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
      sum +=
          mesh.position(mesh.triangles(f, 0))
              .dot(mesh.position(mesh.triangles(f, 1)).cross(mesh.position(mesh.triangles(f, 2))));
    return sum;
  };
  CHECK(volume(file.mesh) == volume(tetrahedron()));
}

TEST_CASE("gltf_reader: all meshes and primitives are one mesh, shared vertices stay shared") {
  const TriangleMesh mesh = tetrahedron();
  std::vector<std::uint32_t> all = corners(mesh);
  const std::vector<std::uint32_t> first(all.begin(), all.begin() + 6),
      second(all.begin() + 6, all.end());
  Gltf gltf;
  gltf.add(floats(coordinates(mesh)), 5126, 4, "VEC3")
      .add(integers(first, 2), 5123, 6, "SCALAR")
      .add(integers(second, 2), 5123, 6, "SCALAR");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1},)"
                R"({"attributes":{"POSITION":0},"indices":2,"material":0}]}])";
  gltf.rest = R"("nodes":[{"mesh":0},{"mesh":0,"translation":[9,0,0]}],"scenes":[{"nodes":[0,1]}],)"
              R"("materials":[{"name":"red"},{}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.vertex_count() == 8);
  CHECK(file.mesh.face_count() == 8);
  CHECK(file.materials == std::vector<std::string>{"material 1", "red"});
  CHECK(values_of(file.find_face_property("material")) ==
        std::vector<double>{0, 0, 1, 1, 0, 0, 1, 1});
}

TEST_CASE("gltf_reader: attributes survive, and welding moves them to the corners") {
  // A tetrahedron whose last face has vertices of its own, with other texture coordinates.
  TriangleMesh mesh = tetrahedron();
  std::vector<double> xyz = coordinates(mesh), uv(14), normals;
  std::vector<std::uint32_t> indices = corners(mesh), colours;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t corner = indices[static_cast<std::size_t>(9 + k)];
    for (int axis = 0; axis < 3; ++axis)
      xyz.push_back(mesh.positions(static_cast<Eigen::Index>(corner), axis));
    indices[static_cast<std::size_t>(9 + k)] = static_cast<std::uint32_t>(4 + k);
    uv[static_cast<std::size_t>(8 + 2 * k)] = 0.5;
    uv[static_cast<std::size_t>(9 + 2 * k)] = 0.25;
  }
  for (std::uint32_t v = 0; v < 7; ++v) {
    normals.insert(normals.end(), {0, 0, 1});
    colours.insert(colours.end(), {255, 10 * v, 0, 128});
  }
  Gltf gltf;
  gltf.add(floats(xyz), 5126, 7, "VEC3")
      .add(integers(indices, 2), 5123, 12, "SCALAR")
      .add(floats(uv), 5126, 7, "VEC2")
      .add(floats(normals), 5126, 7, "VEC3")
      .add(integers(colours, 1), 5121, 7, "VEC4", R"(,"normalized":true)")
      .add(integers({1, 2, 3, 4, 5, 6, 7}, 2), 5123, 7, "SCALAR");
  gltf.views = replaced(gltf.views, R"("byteLength":14})", R"("byteLength":14})");
  gltf.meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"NORMAL":3,"COLOR_0":4,)"
      R"("_RANK":5,"TEXCOORD_1":2},"indices":1}]}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(values_of(file.find_vertex_property("t"))[4] == 0.75);  // upwards
  // Linear light in the file, sRGB in memory: 30/255 is 0.3775; alpha is as it is.
  CHECK(file.find_vertex_property("green")->type == ScalarType::Float32);
  CHECK(values_of(file.find_vertex_property("red"))[3] == 1);
  CHECK(values_of(file.find_vertex_property("green"))[3] == Approx(0.37751).epsilon(1e-4));
  CHECK(values_of(file.find_vertex_property("blue"))[3] == 0);
  CHECK(values_of(file.find_vertex_property("alpha"))[3] == Approx(128 / 255.0));
  const auto light = sphparam::linear_colours(file);
  REQUIRE(light);
  CHECK(light->row(3).isApprox(Eigen::RowVector3d(1, 30 / 255.0, 0), 1e-6));
  CHECK_FALSE(sphparam::linear_colours(read(tetrahedron_gltf().bytes())));
  CHECK(values_of(file.find_vertex_property("_RANK"))[6] == 7);
  CHECK(file.find_vertex_property("_RANK")->type == ScalarType::Uint16);

  const MeshFile welded = sphparam::prepare_for_mapping(file);
  CHECK(inspect_mesh(welded.mesh).is_sphere());
  REQUIRE(welded.corner_texcoords);
  CHECK((*welded.corner_texcoords)(11, 0) == 0.5);
  CHECK((*welded.corner_texcoords)(0, 0) == 0);
  CHECK(values_of(welded.find_vertex_property("nz"))[0] == 1);  // the same in all copies
}

TEST_CASE("gltf_reader: colours of whole numbers are shares of the largest, said to be so or not") {
  for (const auto& [type, width, one] : {std::tuple{5121, 1, 51U}, {5123, 2, 13107U}}) {
    std::vector<std::uint32_t> rgba;
    for (int v = 0; v < 4; ++v) rgba.insert(rgba.end(), {5 * one, one, 0, one});
    const auto with = [&](const std::string& more) {
      Gltf gltf = tetrahedron_gltf();
      gltf.add(integers(rgba, width), type, 4, "VEC4", more);
      gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1}]}])";
      return read(gltf.bytes());
    };
    const MeshFile said = with(R"(,"normalized":true)"), unsaid = with("");
    for (const char* const name : {"red", "green", "blue", "alpha"})
      CHECK(values_of(unsaid.find_vertex_property(name)) ==
            values_of(said.find_vertex_property(name)));
    CHECK(values_of(unsaid.find_vertex_property("red")) == std::vector<double>(4, 1));
    CHECK(values_of(unsaid.find_vertex_property("alpha")) == std::vector<double>(4, 0.2));
    CHECK(said.notes.empty());
    CHECK(unsaid.notes ==
          std::vector<std::string>{
              "COLOR_0 is of whole numbers not said to be normalised: taken as if"});
  }
}

TEST_CASE("gltf_reader: an attribute may share the accessor of the positions") {
  // As normals of a sphere about the origin do, where files are made smaller.
  Gltf gltf = tetrahedron_gltf();
  gltf.meshes = R"([{"primitives":[{"attributes":{"NORMAL":0,"POSITION":0},"indices":1}]}])";
  const MeshFile file = read(gltf.bytes());
  for (const auto& [name, axis] : {std::pair{"nx", 0}, {"ny", 1}, {"nz", 2}}) {
    const std::vector<double>& values = values_of(file.find_vertex_property(name));
    REQUIRE(values.size() == 4);
    for (Eigen::Index v = 0; v < 4; ++v)
      CHECK(values[static_cast<std::size_t>(v)] == tetrahedron().positions(v, axis));
  }
}

TEST_CASE("gltf_reader: a primitive without colours beside one with colours is white") {
  Gltf gltf;
  gltf.add(floats({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, 3, "VEC3")
      .add(integers({51, 0, 0, 51, 51, 0, 0, 51, 51, 0, 0, 51}, 1), 5121, 3, "VEC4",
           R"(,"normalized":true)");
  for (const bool first : {true, false}) {
    const std::string plain = R"({"attributes":{"POSITION":0}})",
                      coloured = R"({"attributes":{"POSITION":0,"COLOR_0":1}})";
    gltf.meshes =
        R"([{"primitives":[)" + (first ? plain + "," + coloured : coloured + "," + plain) + "]}]";
    const MeshFile file = read(gltf.bytes());
    const std::size_t white = first ? 0 : 3, own = 3 - white;
    for (const char* name : {"red", "green", "blue", "alpha"})
      CHECK(values_of(file.find_vertex_property(name))[white] == 1);
    CHECK(values_of(file.find_vertex_property("green"))[own] == 0);
    CHECK(values_of(file.find_vertex_property("alpha"))[own] == Approx(0.2));
    CHECK(file.notes.empty());
  }
}

TEST_CASE("gltf_reader: what primitives hold in several types becomes double, in one type stays") {
  Gltf gltf;
  gltf.add(floats({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, 3, "VEC3")
      .add(integers({1, 2, 3}, 2), 5123, 3, "SCALAR")
      .add(floats({0.5, 1.5, 2.5}), 5126, 3, "SCALAR")
      .add(integers({4, 5, 6}, 2), 5123, 3, "SCALAR");
  const auto ranks = [&](const std::string& other) {
    gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"_RANK":1}},)"
                  R"({"attributes":{"POSITION":0,"_RANK":)" +
                  other + "}}]}]";
    return *read(gltf.bytes()).find_vertex_property("_RANK");
  };
  CHECK(ranks("2").type == ScalarType::Float64);
  CHECK(ranks("2").values == std::vector<double>{1, 2, 3, 0.5, 1.5, 2.5});
  CHECK(ranks("3").type == ScalarType::Uint16);
}

TEST_CASE("gltf_reader: quantised and sparse accessors are decoded") {
  Gltf gltf;
  gltf.asset = R"({"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"])";
  std::string bytes;
  for (const int n : {127, 127, 127, 0, -127, -127, 127, 0, -128, 127, -127, 0, 127, -127, -127, 0})
    bytes.push_back(static_cast<char>(n));
  gltf.add(bytes, 5120, 4, "VEC3", R"(,"normalized":true)")
      .add(integers(corners(tetrahedron()), 2), 5123, 12, "SCALAR")
      .add(integers({1, 3}, 1), 5121, 2, "SCALAR")
      .add(integers({0x81, 0x81, 0, 0x7f, 0x7f, 0x7f}, 1), 5120, 2, "VEC3");
  gltf.views = replaced(gltf.views, R"("byteLength":16})", R"("byteLength":16,"byteStride":4})");
  CHECK(read(gltf.bytes()).mesh.positions == tetrahedron().positions);  // −128 is −1 too
  gltf.accessors = replaced(
      gltf.accessors, R"("normalized":true)",
      R"("normalized":true,"sparse":{"count":2,"indices":{"bufferView":2,"componentType":5121},)"
      R"("values":{"bufferView":3}})");
  const Points positions = read(gltf.bytes()).mesh.positions;
  CHECK(positions.row(1) == Eigen::RowVector3d(-1, -1, 0));
  CHECK(positions.row(2) == tetrahedron().positions.row(2));
  CHECK(positions.row(3) == Eigen::RowVector3d(1, 1, 1));

  gltf.binary[gltf.binary.size() - 12] = 3;  // sparse indices 3, 3
  CHECK(contains(complaint(gltf.bytes()), "do not increase"));
  gltf.binary[gltf.binary.size() - 12] = 1;
  gltf.binary[gltf.binary.size() - 11] = 4;
  CHECK(contains(complaint(gltf.bytes()), "sparse index is out of range"));
}

TEST_CASE("gltf_reader: buffers come from data URIs or from files next to the glTF, nowhere else") {
  const Folder own;
  const fs::path& folder = own.path;
  fs::create_directories(folder / "inner");
  const Gltf gltf = tetrahedron_gltf();
  const auto write = [](const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  };
  write(folder / "inner" / "a b+c.bin", gltf.binary);
  write(folder / "secret.bin", gltf.binary);
  fs::create_symlink("../secret.bin", folder / "inner" / "link.bin");
  fs::create_directory(folder / "inner" / "folder.bin");
  const fs::path path = folder / "inner" / "a.gltf";
  const auto said = [&](const std::string& uri) {
    write(path, gltf.json(uri));
    try {
      sphparam::read_mesh(path.string());
    } catch (const sphparam::ReadError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto open_before = open_files();
  CHECK(said("a%20b+c.bin").empty());
  CHECK(sphparam::read_mesh(path.string()).companions ==
        std::vector<std::string>{(folder / "inner" / "a b+c.bin").string()});
  CHECK(said("./a%20b+c.bin").empty());
  CHECK(said("a%20b%2Bc%2ebi%6e").empty());
  CHECK(contains(said("../secret.bin"), "'..'"));
  CHECK(contains(said("%2e%2e/secret.bin"), "'..'"));
  CHECK(contains(said("..%5Csecret.bin"), "backslash"));
  CHECK(contains(said((folder / "secret.bin").string()), "absolute"));
  CHECK(contains(said("file:secret.bin"), "scheme"));
  CHECK(contains(said("http://a/b.bin"), "scheme"));
  CHECK(contains(said("a.bin%00.png"), "control"));
  for (const char* uri : {"a%zz", "a%", "a%2", "a%2g.bin", "a%g2.bin", "a%-2.bin", "a% 2.bin"})
    CHECK(contains(said(uri), "hexadecimal"));
  CHECK(contains(said("link.bin"), "out of the folder"));
  CHECK(contains(said("folder.bin"), "no regular file"));
  CHECK(contains(said("missing.bin"), "No such file"));
  CHECK(open_files() == open_before);
  CHECK(contains(said("data:text/html,x"), "data URI"));
  CHECK(contains(complaint(gltf.json("a%20b+c.bin")), "only a glTF read from a file"));

  Gltf tiny;  // one triangle, its 36 bytes as base64
  tiny.add(floats({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, 3, "VEC3");
  tiny.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
  const MeshFile file = read(tiny.json(
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"));
  CHECK(file.format == "glTF");
  CHECK(file.mesh.position(1) == Vector3(1, 0, 0));
}

TEST_CASE("gltf_reader: images are never opened") {
  Gltf gltf = tetrahedron_gltf();
  gltf.meshes = replaced(gltf.meshes, R"("indices":1)", R"("indices":1,"material":0)");
  gltf.rest +=
      R"(,"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"../../no/such.png"}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(contains(file.comments.at(0), "base colour of m: texture ../../no/such.png"));
  gltf.rest = replaced(gltf.rest, R"("uri":"../../no/such.png")",
                       R"("bufferView":0,"mimeType":"image/png")");
  CHECK(complaint(gltf.bytes()).empty());
}

TEST_CASE("gltf_reader: what is not supported is refused by name") {
  const auto refused = [](const std::string& from, const std::string& to,
                          const std::string& expected) {
    const std::string message = complaint(with(from, to), "a.glb");
    INFO(to << " -> " << message);
    CHECK(contains(message, expected));
  };
  const auto required = [&](const std::string& extension) {
    refused(R"("version":"2.0"})",
            R"("version":"2.0"},"extensionsRequired":[")" + extension + R"("])", extension);
  };
  required("EXT_mesh_of_nobody");
  refused("\"2.0\"", "\"1.0\"", "glTF '1.0'");
  refused(R"("indices":1)", R"("indices":1,"mode":0)", "points");
  refused(R"("indices":1)", R"("indices":1,"mode":1)", "lines");
  refused(R"("indices":1)", R"("indices":1,"mode":7)", "mode 7");
}

TEST_CASE("gltf_reader: what breaks the rules is refused, with its place") {
  const auto refused = [](const std::string& from, const std::string& to,
                          const std::string& expected) {
    const std::string message = complaint(with(from, to), "a.glb");
    INFO(to << " -> " << message);
    CHECK(contains(message, expected));
    CHECK(contains(message, "a.glb: "));
  };
  refused(R"("count":12)", R"("count":13)", "accessor 1: its elements do not fit");
  refused(R"("count":12)", R"("count":4611686018427387904)", "out of range");
  refused(R"("count":12)", R"("count":1073741824)", "accessor 1");
  refused(R"("count":12)", R"("count":0)", "no elements");
  refused(R"("count":12)", R"("count":-1)", "not a positive integer");
  refused(R"("count":12)", R"("count":11)", "whole triangles");
  refused(R"("componentType":5123)", R"("componentType":5122)", "unsigned");
  refused(R"("componentType":5123)", R"("componentType":5124)", "5124");
  refused(R"("componentType":5123)", R"("componentType":5121)", "");
  refused(R"("byteOffset":48)", R"("byteOffset":52)", "past the end");
  refused(R"("byteOffset":48)", R"("byteOffset":18446744073709551608)", "out of range");
  refused(R"("byteLength":48)", R"("byteLength":48,"byteStride":8)", "stride");
  refused(R"("buffer":0,"byteOffset":48)", R"("buffer":7,"byteOffset":48)", "buffer");
  refused(R"("bufferView":1)", R"("bufferView":9)", "bufferView");
  refused(R"("bufferView":0)", R"("bufferView":-1)", "no data");
  refused(R"("bufferView":0,)", "", "no data");
  refused(R"("byteOffset":0)", R"("byteOffset":-4)", "byteOffset is out of range");
  refused(R"("VEC3")", R"("VEC2")", "components");
  refused(R"("VEC3")", R"("MAT3")", "components");
  refused(R"("POSITION":0)", R"("POSITION":5)", "there are 2");
  refused(R"("POSITION":0)", R"("NORMAL":0)", "no positions");
  refused(R"({"POSITION":0})", R"([])", "without attributes");
  refused(R"("indices":1)", R"("indices":1.5)", "no whole number");
  refused(R"("indices":1)", R"("indices":4294967297)", "out of range");
  refused(R"("indices":1)", R"("indices":3)", "out of bounds");
  refused(R"("mesh":0)", R"("mesh":3)", "mesh 3 is not there");
  refused(R"("mesh":0)", R"("mesh":0,"children":[0])", "two parents");
  refused(R"("mesh":0)", R"("mesh":0,"children":[8])", "node 8 is not there");
  refused(R"("mesh":0)", R"("mesh":0,"scale":[1,0,1])", "singular");
  refused(R"("mesh":0)", R"("mesh":0,"scale":[1,1])", "wrong number");
  refused(R"("mesh":0)", R"("mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1])", "affine");
  refused(R"("mesh":0)", R"("mesh":0,"rotation":[0,0,0,0])", "rotation is zero");
  refused(R"("scene":0)", R"("scene":2)", "scene 2");
  refused(R"("scene":0)", R"("scene":0,)", "byte");
  refused(R"("scene":0)", R"("scene":0,"scene":nan)", "malformed");

  Gltf gltf = tetrahedron_gltf();
  gltf.binary[49] = 1;  // the first index becomes 256 + …
  CHECK(contains(complaint(gltf.bytes()), "accessor 1: index 0 names vertex"));
  gltf = tetrahedron_gltf();
  gltf.binary.replace(0, 4, std::string("\0\0\xc0\x7f", 4));
  CHECK(contains(complaint(gltf.bytes()),
                 "accessor 0: element 0 is no finite number as mesh 0 primitive 0 places it; "
                 "`sphparam map --repair` drops"));
}

TEST_CASE("gltf_reader: positions that are no finite numbers are read where they may be") {
  Gltf gltf = tetrahedron_gltf();
  gltf.binary.replace(0, 4, std::string("\0\0\xc0\x7f", 4));
  const MeshFile file = read_mesh(gltf.bytes(), "a.glb", {.non_finite = true});
  REQUIRE(file.mesh.vertex_count() == 4);
  CHECK(std::isnan(file.mesh.positions(0, 0)));
  CHECK(file.mesh.positions.bottomRows(3).allFinite());
  CHECK(file.mesh.face_count() == 4);
}

TEST_CASE("gltf_reader: the container is checked before its JSON") {
  const std::string good = tetrahedron_gltf().bytes();
  const auto patched = [&](std::size_t at, std::uint32_t word) {
    std::string bytes = good;
    std::string patch;
    append(patch, word);
    return complaint(bytes.replace(at, 4, patch), "a.glb");
  };
  CHECK(contains(patched(4, 1), "version 2 is"));
  CHECK(contains(patched(8, static_cast<std::uint32_t>(good.size() + 4)), "the file has"));
  CHECK(contains(patched(8, 8), "length"));
  CHECK(contains(patched(8, 16), "header of a chunk"));
  CHECK(contains(patched(8, 14), "header of a chunk"));
  CHECK(contains(patched(12, 0xfffffff0), "past the end"));
  CHECK(contains(patched(12, 6), "multiple of 4"));
  CHECK(contains(patched(16, 0), "no JSON"));
  CHECK(contains(complaint("glTF"), "too short"));
  CHECK(read(good + "more").notes.size() == 1);
  // Every cut of the file is an error, none is a crash.
  for (std::size_t size = 4; size < good.size(); ++size)
    CHECK_FALSE(complaint(good.substr(0, size), "a.glb").empty());
}

TEST_CASE("gltf_reader: few bytes do not become many") {
  // Nodes that name the same mesh over and over, of 998 triangles: a million is let pass.
  constexpr std::uint32_t vertices = 1000;
  std::vector<std::uint32_t> strip(vertices);
  std::iota(strip.begin(), strip.end(), 0U);
  std::vector<double> xyz;
  for (const std::uint32_t v : strip) xyz.insert(xyz.end(), {v / 2.0, v % 2 * 1.0, 0.0});
  Gltf gltf;
  gltf.add(floats(xyz), 5126, vertices, "VEC3").add(integers(strip, 2), 5123, vertices, "SCALAR");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}])";
  const auto placed = [&](int times) {
    std::string nodes, roots;
    for (int i = 0; i < times; ++i) {
      nodes.append(i ? "," : "").append(R"({"mesh":0})");
      roots.append(i ? "," : "").append(std::to_string(i));
    }
    gltf.rest = R"("nodes":[)" + nodes + R"(],"scenes":[{"nodes":[)" + roots + "]}]";
    return gltf.bytes();
  };
  // 2²⁰, and two for each of the 14,000 bytes.
  CHECK(read(placed(1078)).mesh.face_count() == 1078 * 998);
  CHECK(contains(complaint(placed(1079)), "more triangles than the limit of 1076576"));
  // An accessor of zeros with one sparse element.
  gltf = tetrahedron_gltf();
  gltf.accessors = replaced(gltf.accessors, R"("bufferView":0,)", "");
  gltf.accessors = replaced(gltf.accessors, R"("count":4,)",
                            R"("count":200000000,"sparse":{"count":1,"indices":{"bufferView":1,)"
                            R"("componentType":5121},"values":{"bufferView":0}},)");
  CHECK(contains(complaint(gltf.bytes()), "more numbers than"));
  // A second buffer that would copy the binary chunk again.
  CHECK(contains(
      complaint(replaced(tetrahedron_gltf().bytes(), R"(}],"bufferViews")", R"(}],"bufferviews")")),
      "accessor"));
  const std::string json = tetrahedron_gltf().json();
  CHECK(contains(complaint(glb(replaced(json, R"("buffers":[)", R"("buffers":[{"byteLength":4},)"),
                               tetrahedron_gltf().binary)),
                 "neither a URI nor"));
}

TEST_CASE("gltf_reader: the limits on JSON hold at their values and not beyond") {
  const Gltf gltf = tetrahedron_gltf();
  const std::string bytes = gltf.bytes();
  const auto check_limit = [&](auto member, std::int64_t value) {
    for (const int step : {-1, 0, 1}) {
      sphparam::ReadOptions options;
      options.*member = value + step;
      INFO(value + step << ": " << complaint(bytes, "a.glb", options));
      CHECK(complaint(bytes, "a.glb", options).empty() == (step >= 0));
    }
  };
  check_limit(&sphparam::ReadOptions::max_json_bytes,
              static_cast<std::int64_t>((gltf.json().size() + 3) / 4 * 4));
  check_limit(&sphparam::ReadOptions::max_json_depth, 6);
  check_limit(&sphparam::ReadOptions::max_json_objects, 12);
  check_limit(&sphparam::ReadOptions::max_json_values, 41);
  check_limit(&sphparam::ReadOptions::max_vertices, 4);
  check_limit(&sphparam::ReadOptions::max_faces, 4);
  CHECK(contains(complaint(R"({"a":)" + std::string(1000000, '[')), "nested deeper"));
}

TEST_CASE("gltf_reader: damaged files give a mesh or a ReadError, nothing else") {
  const std::string seed = tetrahedron_gltf().bytes();
  std::mt19937 random(2013);
  long accepted = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = seed;
    for (auto edits = random() % 3 + 1; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      const char digits[] = "0123456789-.,[]{}\":";
      bytes[at] = random() % 2 ? static_cast<char>(random()) : digits[random() % 19];
    }
    try {
      const MeshFile file = read(bytes, "a.glb");
      ++accepted;
      REQUIRE(file.mesh.positions.allFinite());
      REQUIRE(file.mesh.triangles.minCoeff() >= 0);
      REQUIRE(file.mesh.triangles.maxCoeff() < file.mesh.vertex_count());
    } catch (const sphparam::ReadError&) {
      ++refused;
    }
  }
  CHECK(accepted > 500);
  CHECK(refused > 500);
}

TEST_CASE("gltf_reader: texture coordinates are those that the material says, transformed") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2")
      .add(floats({0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.75}), 5126, 4, "VEC2");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":3},)"
                R"("indices":1,"material":0}]}])";
  gltf.rest += R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
               R"("textures":[{"source":0}],"images":[{"bufferView":0,"mimeType":"image/png"}])";
  const auto with_info = [&](const std::string& info) {
    Gltf other = gltf;
    other.rest = replaced(other.rest, R"("index":0})", R"("index":0,)" + info + "}");
    return read(other.bytes());
  };
  const auto uv = [](const MeshFile& file, std::size_t vertex) {
    return std::pair{values_of(file.find_vertex_property("s"))[vertex],
                     1 - values_of(file.find_vertex_property("t"))[vertex]};
  };
  const MeshFile second = with_info(R"("texCoord":1)");
  CHECK(uv(second, 3) == std::pair{0.5, 0.75});
  CHECK(contains(second.notes.at(0), "TEXCOORD_0"));
  CHECK(second.base_colours.at(0).problem.empty());

  const auto transform = [](const std::string& members) {
    return R"("extensions":{"KHR_texture_transform":{)" + members + "}}";
  };
  const MeshFile moved = with_info(transform(R"("scale":[2,4],"offset":[0.5,-1])"));
  CHECK(uv(moved, 3) == std::pair{2.5, 3.0});
  // A quarter turn takes u to −v: counter-clockwise, where v points down.
  const MeshFile turned = with_info(transform(R"("rotation":1.5707963267948966)"));
  CHECK(uv(turned, 1).first == Approx(0).margin(1e-12));
  CHECK(uv(turned, 1).second == Approx(-1));
  CHECK(uv(turned, 2).first == Approx(1));
  CHECK(uv(with_info(transform(R"("texCoord":1)")), 3).second == 0.75);
  CHECK(uv(with_info(transform(R"("scale":"x","offset":[1])")), 3) == std::pair{1.0, 1.0});
  CHECK(contains(with_info(R"("texCoord":2)").base_colours.at(0).problem, "are not there"));
}

TEST_CASE("gltf_reader: primitives that share vertices, but not where images lie, have their own") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2");
  const std::string one = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":)";
  gltf.meshes = R"([{"primitives":[)" + one + "0}," + one + "1}," + one + "0}]}]";
  gltf.rest += R"(,"materials":[{},{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
               R"("extensions":{"KHR_texture_transform":{"scale":[2,2]}}}}}],)"
               R"("textures":[{"source":0}],"images":[{"bufferView":0,"mimeType":"image/png"}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.vertex_count() == 8);
  CHECK(file.mesh.face_count() == 12);
  CHECK(values_of(file.find_vertex_property("s"))[1] == 1);
  CHECK(values_of(file.find_vertex_property("s"))[5] == 2);
}

TEST_CASE("gltf_reader: a material brings its base colour: factor, image, wrap modes") {
  Gltf gltf = tetrahedron_gltf();
  gltf.meshes = replaced(gltf.meshes, R"("indices":1)", R"("indices":1,"material":1)");
  gltf.rest +=
      R"(,"materials":[{"name":"unused"},{"name":"m","pbrMetallicRoughness":{)"
      R"("baseColorFactor":[0.5,0.25,1,0.75],"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],)"
      R"("images":[{"bufferView":0,"mimeType":"image/png"}])";
  const MeshFile inside = read(gltf.bytes());
  REQUIRE(inside.base_colours.size() == 1);
  const sphparam::MaterialTexture& colour = inside.base_colours[0];
  CHECK(colour.factor == std::array{0.5, 0.25, 1.0, 0.75});
  CHECK(colour.wrap_s == sphparam::Wrapping::Clamp);
  CHECK(colour.wrap_t == sphparam::Wrapping::Mirror);
  CHECK(colour.problem.empty());
  REQUIRE(colour.bytes);
  CHECK(std::string(colour.bytes->begin(), colour.bytes->end()) ==
        gltf.binary.substr(0, colour.bytes->size()));

  const std::string in_view = R"("bufferView":0,"mimeType":"image/png")";
  const auto with_image = [&](const std::string& image) {
    Gltf other = gltf;
    other.rest = replaced(other.rest, in_view, image);
    return read(other.bytes()).base_colours.at(0);
  };
  CHECK(
      with_image(R"("uri":"../secret.png")").problem ==
      "'..': files outside of the mesh's folder are not read; copy it there, or pack all into one "
      ".glb");
  CHECK(contains(with_image(R"("uri":"skin.png")").problem, "only a glTF read from a file"));
  CHECK(with_image(R"("uri":"skin.png")").path == "skin.png");
  gltf.rest = replaced(gltf.rest, R"("samplers":[{"wrapS":33071,"wrapT":33648}],)", "");
  CHECK(read(gltf.bytes()).base_colours.at(0).wrap_s == sphparam::Wrapping::Repeat);
}

TEST_CASE(
    "gltf_reader: a material brings its channels, each as it lies on the mesh's coordinates") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,)"
                R"("material":0}]}])";
  gltf.rest +=
      R"(,"materials":[{"doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,)"
      R"("pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0.75,)"
      R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}},)"
      R"("metallicRoughnessTexture":{"index":1}},"normalTexture":{"index":0,"scale":2},)"
      R"("occlusionTexture":{"index":0,"strength":0.5,"texCoord":1},"emissiveFactor":[1,0.5,0],)"
      R"("emissiveTexture":{"index":1,"extensions":{"KHR_texture_transform":)"
      R"({"scale":[2,3],"offset":[0.5,0.25],"rotation":1.5707963267948966}}},)"
      R"("extensions":{"KHR_materials_unlit":{},)"
      R"("KHR_materials_emissive_strength":{"emissiveStrength":4}}},{}],)"
      R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"a.png"},{"uri":"b.png"}])";
  const MeshFile file = read(gltf.bytes());
  REQUIRE(file.channels.size() == 1);
  const sphparam::MaterialChannels& said = file.channels[0];
  CHECK(said.double_sided);
  CHECK(said.unlit);
  CHECK(said.alpha_mode == sphparam::AlphaMode::Mask);
  CHECK(said.alpha_cutoff == 0.25);
  CHECK(said.roughness.factor[0] == 0.75);
  CHECK(said.roughness.channel == 1);
  CHECK(said.metallic.factor[0] == 0.5);
  CHECK(said.metallic.channel == 2);
  CHECK(said.metallic.image == "b.png");
  CHECK(said.normal.factor[0] == 2);
  CHECK(said.emission.factor == std::array{4.0, 2.0, 0.0, 1.0});
  // Occlusion lies on other coordinates, which are not there: its strength stays.
  CHECK(said.occlusion.image.empty());
  CHECK(contains(sphparam::losses_among(file.notes).at(0),
                 "textures whose texture coordinates are not there of 1 of 1 material"));
  // The mesh's (s, t) of vertex 3 are (1.5, 0); where each image is looked up is as glTF says.
  const std::size_t v = 3;
  const double s = values_of(file.find_vertex_property("s"))[v],
               t = values_of(file.find_vertex_property("t"))[v];
  CHECK(std::pair{s, t} == std::pair{1.5, 0.0});
  const auto placed = [&](const sphparam::MaterialTexture& texture, int row) {
    const auto& p = texture.placement[static_cast<std::size_t>(row)];
    return p[0] * s + p[1] * t + p[2];
  };
  CHECK(placed(said.roughness, 0) == Approx(1));
  CHECK(placed(said.roughness, 1) == Approx(0).margin(1e-12));
  CHECK(placed(said.emission, 0) == Approx(3 + 0.5));
  CHECK(placed(said.emission, 1) == Approx(1 - (-2 + 0.25)));
  // A strength that is no number is as if it was not there.
  gltf.rest = replaced(gltf.rest, R"("emissiveStrength":4)", R"("emissiveStrength":"x")");
  CHECK(read(gltf.bytes()).channels.at(0).emission.factor == std::array{1.0, 0.5, 0.0, 1.0});
}

TEST_CASE(
    "gltf_reader: an image whose place on the mesh's coordinates is no number is not carried") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,)"
                R"("material":0}]}])";
  const auto texture = [](const std::string& scale) {
    return R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":)" + scale + "}}}";
  };
  const std::string rest = gltf.rest;
  for (const auto& [first, other] :
       {std::pair{"[1e-10,1]", "[1e308,1]"}, {"[1,1e-10]", "[1,1e308]"}}) {
    gltf.rest = rest + R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":)" +
                texture(first) + R"(},"occlusionTexture":)" + texture(other) +
                R"(}],"textures":[{"source":0}],"images":[{"uri":"a.png"}])";
    const MeshFile file = read(gltf.bytes());
    CHECK(file.base_colours.at(0).image == "a.png");
    CHECK(file.channels.at(0).occlusion.image.empty());
    CHECK(sphparam::losses_among(file.notes) ==
          std::vector<std::string>{
              "not carried: occlusion textures whose place is no number of 1 of 1 material"});
  }
}

TEST_CASE(
    "gltf_reader: second texture coordinates and tangents come along where images need them") {
  // The tangents lie along x, the node turns x to y and mirrors z.
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2")
      .add(floats({0.5, 0, 0.5, 1, 0, 0.25, 0, 0}), 5126, 4, "VEC2")
      .add(floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}), 5126, 4, "VEC4");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":3,)"
                R"("TANGENT":4},"indices":1,"material":0}]}])";
  gltf.rest =
      R"("nodes":[{"mesh":0,"matrix":[0,2,0,0,-2,0,0,0,0,0,-2,0,0,0,0,1]}],)"
      R"("scenes":[{"nodes":[0]}],"scene":0,)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)"
      R"("normalTexture":{"index":0},"occlusionTexture":{"index":1,"texCoord":1,"extensions":)"
      R"({"KHR_texture_transform":{"offset":[0.5,0]}}},"emissiveTexture":{"index":1,"texCoord":2},)"
      R"("emissiveFactor":[1,1,1]}],)"
      R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"a.png"},{"uri":"b.png"}])";
  const MeshFile file = read(gltf.bytes());
  // Without its image the factor would light all of it.
  CHECK(file.channels.at(0).emission.factor == std::array<double, 4>{0, 0, 0, 1});
  REQUIRE(file.second_texcoords);
  REQUIRE(file.corner_tangents);
  CHECK_FALSE(file.find_vertex_property("second s"));
  CHECK(file.channels.at(0).occlusion.second);
  CHECK_FALSE(file.channels.at(0).normal.second);
  CHECK(file.channels.at(0).occlusion.placement[0] == std::array<double, 3>{1, 0, 0.5});
  const std::array<double, 4> u = {0.5, 0.5, 0, 0}, v = {0, 1, 0.25, 0};
  for (Eigen::Index i = 0; i < file.mesh.triangles.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(file.mesh.triangles.data()[i]);
    CHECK((*file.second_texcoords)(i, 0) == u[vertex]);
    CHECK((*file.second_texcoords)(i, 1) == 1 - v[vertex]);
    const double hand = vertex == 3 ? 1 : -1;
    CHECK(file.corner_tangents->row(i).isApprox(Eigen::RowVector4d(0, 1, 0, hand)));
  }
  CHECK(sphparam::losses_among(file.notes) ==
        std::vector<std::string>{
            "not carried: emissive textures on a third set of texture coordinates of 1 of 1 "
            "material"});
}

TEST_CASE("gltf_reader: second coordinates that one material uses are told as lost of the other") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2");
  const auto primitive = [](int material) {
    return R"({"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":2},"indices":1,"material":)" +
           std::to_string(material) + "}";
  };
  gltf.rest += R"(,"materials":[{"occlusionTexture":{"index":0,"texCoord":1},)"
               R"("normalTexture":{"index":0,"texCoord":1},)"
               R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},{}],)"
               R"("textures":[{"source":0}],"images":[{"uri":"a.png"}])";
  const auto losses_of = [&](const std::string& primitives) {
    gltf.meshes = R"([{"primitives":[)" + primitives + "]}]";
    return sphparam::losses_among(read(gltf.bytes()).notes);
  };
  CHECK(losses_of(primitive(0)).empty());
  CHECK(losses_of(primitive(1)) ==
        std::vector<std::string>{"not carried: of the vertices TEXCOORD_1"});
  CHECK(losses_of(primitive(0) + "," + primitive(1)) ==
        std::vector<std::string>{
            "not carried: of the vertices TEXCOORD_1 where no material there uses it"});
}

TEST_CASE("gltf_reader: which textures show their texels unfiltered is noted") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({0, 0, 1, 0, 0, 1, 1, 1}), 5126, 4, "VEC2");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,)"
                R"("material":0}]}])";
  gltf.rest += R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},)"
               R"("metallicRoughnessTexture":{"index":1}},"normalTexture":{"index":0}}],)"
               R"("samplers":[{"magFilter":9728},{"magFilter":9729}],)"
               R"("textures":[{"source":0,"sampler":0},{"source":0,"sampler":1}],)"
               R"("images":[{"uri":"a.png"}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(file.comments.front() == "material 0: unfiltered texels of base colour, normal");
  CHECK(sphparam::is_noted_nearest(file, 0, "base colour"));
  CHECK_FALSE(sphparam::is_noted_nearest(file, 0, "roughness"));
  CHECK_FALSE(sphparam::is_noted_nearest(file, 1, "base colour"));
}

TEST_CASE("gltf_reader: morph targets move the mesh as their weights in the file stand") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC3")
      .add(floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}), 5126, 4, "VEC3")
      .add(floats({0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC3");
  const auto mesh = [](const std::string& weights) {
    return R"([{"primitives":[{"attributes":{"POSITION":0,"NORMAL":3},"indices":1,)"
           R"("targets":[{"POSITION":2,"NORMAL":4},{"POSITION":2}]}])" +
           weights + "}]";
  };
  gltf.meshes = mesh("");
  const MeshFile rest = read(gltf.bytes());
  CHECK(rest.mesh.position(0) == Vector3(1, 1, 1));
  CHECK(sphparam::losses_among(rest.notes) ==
        std::vector<std::string>{"not carried: 2 morph targets"});
  gltf.meshes = mesh(R"(,"weights":[0.5,0.25])");
  const MeshFile moved = read(gltf.bytes());
  CHECK(moved.mesh.position(0) == Vector3(2.5, 1, 1));
  CHECK(moved.mesh.position(1) == rest.mesh.position(1));
  const double half = std::sqrt(0.5);
  CHECK(values_of(moved.find_vertex_property("nx"))[0] == Approx(half));
  CHECK(values_of(moved.find_vertex_property("ny"))[0] == Approx(half));
  CHECK(values_of(moved.find_vertex_property("nx"))[1] == 1);
  CHECK(sphparam::losses_among(moved.notes) ==
        std::vector<std::string>{
            "not carried: 2 morph targets: the mesh is read as their weights stand"});
  // Those of the node stand instead of the mesh's.
  gltf.rest = replaced(gltf.rest, R"("nodes":[{"mesh":0)", R"("nodes":[{"mesh":0,"weights":[0,1])");
  CHECK(read(gltf.bytes()).mesh.position(0) == Vector3(3, 1, 1));
  gltf.meshes = replaced(gltf.meshes, R"({"POSITION":2}])", R"({"POSITION":1}])");
  CHECK_FALSE(complaint(gltf.bytes()).empty());
}

TEST_CASE("gltf_reader: factors of a material's finish are carried, what makes no sense is not") {
  const auto finish_of = [](const std::string& extensions, const std::string& node = "") {
    Gltf gltf = tetrahedron_gltf();
    gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}])";
    if (!node.empty())
      gltf.rest = R"("nodes":[{"mesh":0,)" + node + R"(}],"scenes":[{"nodes":[0]}],"scene":0)";
    gltf.rest += R"(,"materials":[{"extensions":{)" + extensions + "}}]";
    const MeshFile file = read(gltf.bytes());
    return std::pair{file.channels.at(0).finish, sphparam::losses_among(file.notes)};
  };
  const auto [all, losses] = finish_of(
      R"("KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatRoughnessFactor":0.25},)"
      R"("KHR_materials_sheen":{"sheenColorFactor":[0.5,0.25,1],"sheenRoughnessFactor":0.75},)"
      R"("KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":2},)"
      R"("KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[2,1,0]},)"
      R"("KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":1.5,)"
      R"("iridescenceThicknessMinimum":10,"iridescenceThicknessMaximum":500},)"
      R"("KHR_materials_volume":{"thicknessFactor":0.5,"attenuationDistance":3,)"
      R"("attenuationColor":[1,0.5,0]},"KHR_materials_dispersion":{"dispersion":0.1})",
      R"("scale":[2,2,2])");
  CHECK(losses.empty());
  sphparam::MaterialFinish expected;
  expected.clearcoat = 0.5;
  expected.clearcoat_roughness = 0.25;
  expected.sheen = {0.5, 0.25, 1};
  expected.sheen_roughness = 0.75;
  expected.transmission = 1;
  expected.ior = 2;
  expected.specular = 0.5;
  expected.specular_colour = {2, 1, 0};
  expected.iridescence = 1;
  expected.iridescence_ior = 1.5;
  expected.iridescence_thickness = 500;
  expected.thickness = 1;  // as large as the node makes it
  expected.attenuation_distance = 3;
  expected.attenuation_colour = {1, 0.5, 0};
  expected.dispersion = 0.1;
  CHECK(all == expected);

  for (const char* nonsense :
       {R"("KHR_materials_clearcoat":{"clearcoatFactor":2})", R"("KHR_materials_ior":{"ior":0.5})",
        R"("KHR_materials_ior":{"ior":"glass"})", R"("KHR_materials_sheen":[1])",
        R"("KHR_materials_sheen":{"sheenColorFactor":[1,0]})",
        R"("KHR_materials_sheen":{"sheenColorFactor":[1,0,"x"]})",
        R"("KHR_materials_volume":{"thicknessFactor":-1,"attenuationDistance":1e300})"})
    CHECK(finish_of(nonsense).first == sphparam::MaterialFinish());

  // The image says where it is glass: without it all would be.
  const auto [glass, told] = finish_of(
      R"("KHR_materials_transmission":{"transmissionFactor":1,"transmissionTexture":{"index":0}},)"
      R"("KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessTexture":{"index":0}})");
  CHECK(glass.transmission == 0);
  CHECK(glass.clearcoat == 1);
  CHECK(told == std::vector<std::string>{"not carried: clearcoatRoughnessTexture and "
                                         "transmissionTexture of 1 of 1 material"});
}

namespace {

/// A tetrahedron with `count` materials, each with an image of its own, all of the view `view`.
Gltf with_images(int count, const std::string& view) {
  Gltf gltf = tetrahedron_gltf();
  std::string materials, textures, images;
  for (int i = 0; i < count; ++i) {
    const std::string comma = i > 0 ? "," : "", number = std::to_string(i);
    materials +=
        comma + R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + number + "}}}";
    textures += comma + R"({"source":)" + number + "}";
    images += comma + R"({"bufferView":)" + std::to_string(gltf.count + (i % 2)) + "}";
  }
  gltf.views += "," + view + "," + view;
  gltf.meshes = replaced(gltf.meshes, R"("indices":1)", R"("indices":1,"material":0)");
  gltf.rest += R"(,"materials":[)" + materials + R"(],"textures":[)" + textures +
               R"(],"images":[)" + images + "]";
  return gltf;
}

}  // namespace

TEST_CASE(
    "gltf_reader: images of views that run past their buffer are refused, wherever they end") {
  for (const std::string view :
       {R"({"buffer":0,"byteLength":1000000})", R"({"buffer":0,"byteOffset":72,"byteLength":1})",
        R"({"buffer":0,"byteOffset":2000000000,"byteLength":4})",
        R"({"buffer":0,"byteOffset":9007199254740991,"byteLength":9007199254740991})",
        R"({"buffer":7,"byteLength":4})"}) {
    INFO(view);
    CHECK_FALSE(complaint(with_images(1, view).bytes()).empty());
  }
}

TEST_CASE("gltf_reader: bytes that many images show are kept once, and no more than the file has") {
  const std::string view = R"({"buffer":0,"byteLength":72})";
  CHECK(read(with_images(100, view).bytes()).base_colours[0].bytes->size() == 72);
  // Two overlapping views of most of the buffer are more than it holds.
  Gltf greedy = with_images(2, view);
  greedy.views = replaced(greedy.views, view + "," + view,
                          view + R"(,{"buffer":0,"byteOffset":4,"byteLength":68})");
  greedy.rest =
      replaced(greedy.rest, R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}})",
               R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  CHECK(complaint(greedy.bytes()).empty());  // nothing uses the second
  greedy.rest =
      replaced(greedy.rest, R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})",
               R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":1}})");
  CHECK(contains(complaint(greedy.bytes()), "more bytes than the buffers hold"));
}

TEST_CASE("gltf_reader: chunks without their padding are read, and noted") {
  Gltf gltf = tetrahedron_gltf();
  gltf.rest += " ";
  gltf.add(integers({7}, 1), 5121, 1, "SCALAR");  // the buffer has a length that needs padding
  gltf.binary.resize(gltf.binary.size() - 3);
  while (gltf.json().size() % 4 == 0) gltf.rest += " ";
  const std::string json = gltf.json();
  const auto file = [&](bool json_padded, bool length_with_padding) {
    std::string body;
    const auto add = [&](const std::string& kind, std::string bytes, char filling, bool pad) {
      const std::size_t bare = bytes.size();
      while (pad && bytes.size() % 4 != 0) bytes.push_back(filling);
      append(body, static_cast<std::uint32_t>(length_with_padding ? bytes.size() : bare));
      body += kind + bytes;
    };
    add("JSON", json, ' ', json_padded);
    add({"BIN\0", 4}, gltf.binary, '\0', false);
    std::string header = "glTF";
    append(header, 2);
    append(header, static_cast<std::uint32_t>(12 + body.size()));
    return header + body;
  };
  for (const bool json_padded : {false, true}) {
    for (const bool length_with_padding : {false, true}) {
      const MeshFile mesh = read(file(json_padded, length_with_padding), "a.glb");
      CHECK(mesh.mesh.positions == tetrahedron().positions);
      REQUIRE_FALSE(mesh.notes.empty());
      CHECK(contains(mesh.notes[0], "lack their padding"));
    }
  }
}

TEST_CASE("gltf_reader: numbers that are not aligned are read as they are, and noted") {
  const TriangleMesh mesh = tetrahedron();
  Gltf gltf = Gltf()
                  .add(integers({7}, 1) + floats(coordinates(mesh)), 5126, 4, "VEC3")
                  .add(integers(corners(mesh), 2), 5123, 12, "SCALAR");
  gltf.views = replaced(gltf.views, R"("byteOffset":0,"byteLength":49)",
                        R"("byteOffset":1,"byteLength":48)");
  const MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.positions == mesh.positions);
  REQUIRE(file.notes.size() == 1);
  CHECK(contains(file.notes[0], "1 accessor not aligned"));
}

TEST_CASE("gltf_reader: WebP is the image of a texture that has no other") {
  const auto image_of = [](const std::string& texture) {
    Gltf gltf = tetrahedron_gltf();
    gltf.meshes = replaced(gltf.meshes, R"("indices":1)", R"("indices":1,"material":0)");
    gltf.rest +=
        R"(,"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
        R"("images":[{"uri":"a.png"},{"uri":"b.webp"}],"textures":[)" +
        texture + "]";
    return read(gltf.bytes()).base_colours.at(0).image;
  };
  CHECK(image_of(R"({"extensions":{"EXT_texture_webp":{"source":1}}})") == "b.webp");
  CHECK(image_of(R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})") == "a.png");
  CHECK(image_of(R"({"extensions":{"EXT_texture_webp":{"source":9}}})") == "texture 0");
  CHECK(image_of(R"({"extensions":{"EXT_texture_webp":{}}})") == "texture 0");
}

TEST_CASE("gltf_reader: what a file says beside shape and materials is told, a line a kind") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats(std::vector<double>(16, 1)), 5126, 4, "VEC4")
      .add(floats(std::vector<double>(8, 0)), 5126, 4, "VEC2");
  gltf.meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0,"TANGENT":2,"TEXCOORD_1":3,"_PAIR":3,)"
      R"("WEIGHTS_0":2},"indices":1,"material":0,"targets":[{"POSITION":0},{"POSITION":0}]},)"
      R"({"attributes":{"POSITION":0,"TANGENT":2,"TEXCOORD_1":3,"_PAIR":3,"WEIGHTS_0":2},)"
      R"("indices":1,"material":1,"targets":[{"POSITION":0},{"POSITION":0}]}]}])";
  gltf.rest =
      R"("nodes":[{"mesh":0,"skin":0},{}],"scenes":[{"nodes":[0]}],"scene":0,)"
      R"("skins":[{"joints":[1]}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)"
      R"("animations":[{},{}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)"
      R"("materials":[{"name":"plain","pbrMetallicRoughness":{"metallicFactor":1}},)"
      R"({"name":"glow","emissiveFactor":[0,1,0],"doubleSided":true,)"
      R"("extensions":{"KHR_materials_anisotropy":{},)"
      R"("KHR_materials_emissive_strength":{}}}])";
  const std::vector<std::string> losses = sphparam::losses_among(read(gltf.bytes()).notes);
  CHECK(losses ==
        std::vector<std::string>{"not carried: 'KHR_materials_anisotropy' of 1 of 2 materials",
                                 "not carried: 1 broken skin: the mesh is read unposed",
                                 "not carried: 2 morph targets",
                                 "not carried: of the vertices TANGENT, TEXCOORD_1 and _PAIR",
                                 "not carried: 2 animations, 1 camera and 1 light"});
}

TEST_CASE("gltf_reader: a material by specular colour becomes one by metallic and roughness") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats(std::vector<double>(8, 0)), 5126, 4, "VEC2");
  gltf.meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]}])";
  const std::string rest = gltf.rest;
  const auto read_with = [&](const std::string& said) {
    gltf.rest = rest +
                R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]},)"
                R"("extensions":{"KHR_materials_pbrSpecularGlossiness":)" +
                said +
                R"(}}],"textures":[{"source":0},{"source":1}],)"
                R"("images":[{"uri":"d.png"},{"uri":"s.png"}])";
    return read(gltf.bytes());
  };
  const MeshFile plain =
      read_with(R"({"diffuseFactor":[0.25,0.5,0.75,0.5],"specularFactor":[0.04,0.04,0.04],)"
                R"("glossinessFactor":0.25})");
  CHECK(plain.notes.empty());
  CHECK(plain.base_colours[0].factor[1] == Approx(0.5));
  CHECK(plain.base_colours[0].factor[3] == 0.5);
  CHECK(plain.channels[0].roughness.factor[0] == 0.75);
  CHECK(plain.channels[0].metallic.factor[0] == 0);
  CHECK_FALSE(plain.base_colours[0].made_of);

  const std::string images =
      R"({"diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1}})";
  const MeshFile file = read_with(images);
  CHECK(file.notes.empty());
  const MaterialTexture& colour = file.base_colours[0];
  CHECK(colour.image == "d.png and s.png");
  REQUIRE(colour.made_of);
  CHECK(colour.made_of->diffuse.path == "d.png");
  CHECK(colour.made_of->specular.path == "s.png");
  for (const MaterialTexture* part : {&colour.made_of->diffuse, &colour.made_of->specular})
    CHECK(contains(part->problem, "only a glTF read from a file"));
  CHECK(colour.made_of == file.channels[0].metallic.made_of);
  CHECK(file.channels[0].roughness.channel == 1);
  CHECK(file.channels[0].metallic.channel == 2);
  CHECK_FALSE(sphparam::is_noted_nearest(file, 0, "roughness"));

  gltf.rest = replaced(gltf.rest, R"({"source":1})", R"({"source":1,"sampler":0})") +
              R"(,"samplers":[{"magFilter":9728}])";
  const MeshFile nearest = read(gltf.bytes());
  CHECK(sphparam::is_noted_nearest(nearest, 0, "roughness"));
  CHECK(sphparam::is_noted_nearest(nearest, 0, "metallic"));
  CHECK_FALSE(sphparam::is_noted_nearest(nearest, 0, "base colour"));
  gltf.rest = replaced(gltf.rest, R"({"source":0})", R"({"source":0,"sampler":0})");
  CHECK(sphparam::is_noted_nearest(read(gltf.bytes()), 0, "base colour"));

  const MeshFile apart =
      read_with(replaced(images, R"({"index":1})",
                         R"({"index":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})"));
  CHECK(apart.base_colours[0].image == "d.png");
  CHECK(sphparam::losses_among(apart.notes) ==
        std::vector<std::string>{"not carried: specular textures in another place than diffuse "
                                 "ones of 1 of 1 material"});
  for (const char* broken : {"7", "{}", R"({"diffuseTexture":7,"diffuseFactor":[1]})"}) {
    INFO(broken);
    CHECK(read_with(broken).notes.empty());
  }
}

TEST_CASE("gltf_reader: variants, of which none is read, are told") {
  Gltf gltf = tetrahedron_gltf();
  gltf.rest = R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],)"
              R"("extensions":{"KHR_materials_variants":{"variants":[{"name":"a"},{"name":"b"}]}})";
  CHECK(sphparam::losses_among(read(gltf.bytes()).notes) ==
        std::vector<std::string>{"not carried: 2 variants"});
}

namespace {

/// Two joints, of which the first doubles what was bound to it and the second takes it from z = 4
/// to z = 5. Vertices: the first joint's, the second's, half of each, and of no weights.
Gltf skinned_tetrahedron() {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(integers({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, 1), 5121, 4, "VEC4")
      .add(floats({1, 0, 0, 0, 1, 0, 0, 0, 2, 2, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC4")
      .add(floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1,  //
                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1}),
           5126, 2, "MAT4")
      .add(floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, 4, "VEC3");
  gltf.meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3,"NORMAL":5},)"
      R"("indices":1}]}])";
  gltf.rest =
      R"("nodes":[{"mesh":0,"skin":0,"translation":[9,9,9]},{"scale":[2,2,4],"children":[2]},)"
      R"({"translation":[0,0,1.25],"scale":[0.5,0.5,0.25]}],"scenes":[{"nodes":[0,1]}],)"
      R"("skins":[{"joints":[1,2],"inverseBindMatrices":4}])";
  return gltf;
}

}  // namespace

TEST_CASE("gltf_reader: a mesh with a skin is as its joints stand, wherever its node is") {
  const TriangleMesh bound = tetrahedron();
  const MeshFile file = read(skinned_tetrahedron().bytes());
  const auto first = [&](int v) -> Vector3 {
    return bound.position(v).cwiseProduct(Vector3(2, 2, 4));
  };
  const auto second = [&](int v) -> Vector3 { return bound.position(v) + Vector3(0, 0, 1); };
  CHECK(file.mesh.position(0) == first(0));
  CHECK(file.mesh.position(1) == second(1));
  CHECK(file.mesh.position(2) == Vector3((first(2) + second(2)) / 2));
  CHECK(file.mesh.position(3) == second(3));
  CHECK(file.mesh.triangles == bound.triangles);
  const std::vector<double>& z = file.find_vertex_property("nz")->values;
  CHECK(z[0] == 1);  // across what is stretched
  CHECK(sphparam::losses_among(file.notes) ==
        std::vector<std::string>{"not carried: 1 skin: the mesh is read as the joints stand"});
}

TEST_CASE("gltf_reader: what joints mirror is turned over") {
  Gltf gltf = skinned_tetrahedron();
  gltf.rest = replaced(gltf.rest, "[2,2,4]", "[2,2,-4]");
  const TriangleMesh mirrored = read(gltf.bytes()).mesh;
  CHECK(mirrored.position(0).z() == -4 * tetrahedron().position(0).z());
  CHECK(mirrored.triangles.col(1) == tetrahedron().triangles.col(2));
}

TEST_CASE("gltf_reader: a broken skin leaves the mesh where its node puts it, and is told") {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {R"("joints":[1,2])", R"("joints":[1,7])"},
           {R"("joints":[1,2])", R"("joints":[1])"},
           {R"("joints":[1,2])", R"("joints":[1,2,1])"},
           {R"("scenes":[{"nodes":[0,1]}])", R"("scenes":[{"nodes":[0]}])"},
           {R"("inverseBindMatrices":4)", R"("inverseBindMatrices":3)"},
           {R"("inverseBindMatrices":4)", R"("inverseBindMatrices":99)"},
           {R"("skin":0)", R"("skin":1)"}}) {
    Gltf gltf = skinned_tetrahedron();
    gltf.rest = replaced(gltf.rest, from, to);
    const MeshFile file = read(gltf.bytes());
    INFO(to);
    CHECK(file.mesh.position(0) == Vector3(10, 10, 10));
    CHECK(sphparam::losses_among(file.notes) ==
          std::vector<std::string>{"not carried: 1 broken skin: the mesh is read unposed"});
  }
  Gltf gltf = skinned_tetrahedron();
  gltf.meshes = replaced(gltf.meshes, R"("WEIGHTS_0":3)", R"("WEIGHTS_0":5)");
  CHECK(read(gltf.bytes()).mesh.position(0) == Vector3(10, 10, 10));
}

TEST_CASE("gltf_reader: instances of a mesh are all there") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({10, 0, 0, 0, 10, 0}), 5126, 2, "VEC3")
      .add(floats({0, 0, 1, 0, 0, 0, 0, 1}), 5126, 2, "VEC4")
      .add(floats({1, 1, 1, 2, 2, 2}), 5126, 2, "VEC3");
  gltf.rest =
      R"("nodes":[{"mesh":0,"translation":[0,0,5],"extensions":{"EXT_mesh_gpu_instancing":)"
      R"({"attributes":{"TRANSLATION":2,"ROTATION":3,"SCALE":4}}}}],"scenes":[{"nodes":[0]}],)"
      R"("extensionsRequired":["EXT_mesh_gpu_instancing"])";
  const TriangleMesh one = tetrahedron();
  const MeshFile file = read(gltf.bytes());
  REQUIRE(file.mesh.vertex_count() == 8);
  CHECK(file.notes.empty());
  for (int v = 0; v < 4; ++v) {
    const Vector3 at = one.position(v);
    CHECK(file.mesh.position(v) == Vector3(10 - at.x(), -at.y(), 5 + at.z()));
    CHECK(file.mesh.position(4 + v) == Vector3(2 * at.x(), 10 + 2 * at.y(), 5 + 2 * at.z()));
  }
}

TEST_CASE("gltf_reader: instances may be more triangles than a file has bytes, up to a million") {
  constexpr std::uint32_t vertices = 1000, instances = 400;
  std::vector<double> xyz;
  std::vector<std::uint32_t> strip;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    xyz.insert(xyz.end(), {v / 2.0, v % 2 * 1.0, 0.0});
    strip.push_back(v);
  }
  Gltf gltf;
  gltf.add(floats(xyz), 5126, vertices, "VEC3")
      .add(integers(strip, 2), 5123, vertices, "SCALAR")
      .add(floats(std::vector<double>(3 * instances, 1)), 5126, instances, "VEC3");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}])";
  const std::string forest =
      R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2}}}})";
  gltf.rest =
      R"("nodes":[)" + forest + "," + forest + "," + forest + R"(],"scenes":[{"nodes":[0,1,2]}])";
  const MeshFile file = read(gltf.bytes());
  // Two forests are there, of the third one tree.
  CHECK(file.mesh.vertex_count() == vertices * (2 * instances + 1));
  CHECK(file.mesh.face_count() == (vertices - 2) * (2 * instances + 1));
  CHECK(sphparam::losses_among(file.notes) ==
        std::vector<std::string>{"not carried: the instances of 1 mesh, read once"});
}

TEST_CASE("gltf_reader: instances that are broken or far too many are told, the mesh read once") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({10, 0, 0, 0, 10, 0}), 5126, 2, "VEC3")
      .add(floats(std::vector<double>(900000, 1)), 5126, 300000, "VEC3");
  const auto with = [&](const std::string& attributes) {
    gltf.rest = R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" +
                attributes + R"(}}}}],"scenes":[{"nodes":[0]}])";
    return read(gltf.bytes());
  };
  for (const std::string attributes :
       {R"("TRANSLATION":9)", R"("TRANSLATION":2,"SCALE":3)", R"("ROTATION":2)", R"("_ID":2)",
        R"("SCALE":2)", R"("TRANSLATION":3)"}) {
    INFO(attributes);
    const MeshFile file = with(attributes);
    CHECK(file.mesh.vertex_count() == 4);
    CHECK(sphparam::losses_among(file.notes) ==
          std::vector<std::string>{"not carried: the instances of 1 mesh, read once"});
  }
}

TEST_CASE("gltf_reader: the angles of _THETA_PHI are a map") {
  Gltf gltf = tetrahedron_gltf();
  std::vector<double> angles;
  for (Eigen::Index v = 0; v < 4; ++v) {
    const SphericalCoordinates at = to_spherical(tetrahedron().position(static_cast<int>(v)));
    angles.insert(angles.end(), {at.theta, at.phi});
  }
  gltf.add(floats(angles), 5126, 4, "VEC2");
  gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"_THETA_PHI":2},"indices":1}]}])";
  const MeshFile file = read(gltf.bytes());
  CHECK(file.notes.empty());
  CHECK_FALSE(sphparam::read_sphere(file));
  const auto map = sphparam::read_angles(file);
  REQUIRE(map);
  CHECK((std::sqrt(3.0) * map->points - tetrahedron().positions).cwiseAbs().maxCoeff() < 1e-6);
  CHECK_FALSE(sphparam::read_angles(read(tetrahedron_gltf().bytes())));
}

TEST_CASE("gltf_reader: who made an asset stays with it, other metadata is told in one line") {
  Gltf gltf = tetrahedron_gltf();
  gltf.asset =
      R"({"version":"2.0","copyright":"(c) Me\nCC-BY","extras":{"license":"CC-BY-4.0","n":[1,2.5,)"
      R"(true],"sphparam":{"up":"x"},"author":"M\u00e9"}})";
  gltf.rest = R"("nodes":[{"mesh":0,"extras":{"sku":"A-17"}},{"extras":{}}],)"
              R"("scenes":[{"nodes":[0,1],"extras":3}],"scene":0,"extras":{"rootKey":[1]},)"
              R"("extensions":{"KHR_xmp_json_ld":{"packets":[{}]}})";
  gltf.meshes =
      R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}],"extras":{"targetNames":[]}}])";
  const sphparam::MeshFile file = read(gltf.bytes());
  CHECK(file.comments ==
        std::vector<std::string>{
            "copyright (c) Me CC-BY",
            R"(asset extras {"author":"Mé","license":"CC-BY-4.0","n":[1,2.5,true]})", "up axis y"});
  CHECK(sphparam::noted_authorship(file).copyright == "(c) Me CC-BY");
  CHECK(sphparam::losses_among(file.notes) ==
        std::vector<std::string>{
            "not carried: XMP metadata; extras of the file, 1 scene and 1 node"});
  sphparam::MeshFile other;
  other.comments = {"copyright of nobody", "scanned"};
  sphparam::take_authorship(other, file);
  CHECK(other.comments == std::vector<std::string>{"scanned", file.comments[0], file.comments[1]});
}

TEST_CASE("gltf_reader: extras of the asset that are not carried are told, our own are none") {
  const auto losses_with = [](const std::string& extras) {
    Gltf gltf = tetrahedron_gltf();
    gltf.asset = R"({"version":"2.0","extras":)" + extras + "}";
    return sphparam::losses_among(read(gltf.bytes()).notes);
  };
  const std::string long_text = '"' + std::string(1 << 16, 'x') + '"';
  const std::vector<std::string> lost = {
      "not carried: extras of the asset: only an object of at most 64 KiB is carried"};
  CHECK(losses_with(R"({"author":)" + long_text + "}") == lost);
  CHECK(losses_with("[1]") == lost);
  for (const char* whole : {"{}", "null", R"({"sphparam":{"up":"x"}})", R"({"author":"Me"})"})
    CHECK(losses_with(whole).empty());
  // Ours may be as long as they like: they are not what is carried.
  Gltf gltf = tetrahedron_gltf();
  gltf.asset =
      R"({"version":"2.0","extras":{"author":"Me","sphparam":{"comments":)" + long_text + "}}}";
  const sphparam::MeshFile file = read(gltf.bytes());
  CHECK(sphparam::losses_among(file.notes).empty());
  CHECK(sphparam::noted_authorship(file).extras == R"({"author":"Me"})");
}

TEST_CASE("authorship: extras are an object that is neither long nor deep, else none") {
  using sphparam::plain_extras;
  CHECK(plain_extras(R"({"b": 1, "a": "x"})") == R"({"b":1,"a":"x"})");
  for (const char* none : {"", "{}", "[1]", "3", "{", R"({"sphparam":{}})"})
    CHECK(plain_extras(none).empty());
  CHECK(plain_extras(R"({"a":)" + std::string(5000, '[') + std::string(5000, ']') + "}").empty());
  CHECK(plain_extras(R"({"a":")" + std::string(1 << 16, 'x') + "\"}").empty());
}

TEST_CASE("gltf_reader: meshes that nodes scale to nothing are left out and told, unless all are") {
  Gltf gltf = tetrahedron_gltf();
  gltf.rest = R"("nodes":[{"mesh":0},{"mesh":0,"scale":[0,0,0],"children":[2]},{"mesh":0}],)"
              R"("scenes":[{"nodes":[0,1]}],"scene":0)";
  const sphparam::MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.triangles == tetrahedron().triangles);
  CHECK(file.notes ==
        std::vector<std::string>{"not carried: 2 meshes that nodes scale to nothing, as node 1"});
  CHECK(contains(complaint(with(R"("mesh":0)", R"("mesh":0,"scale":[0,0,0])")),
                 "node 0: its transform is singular"));
  CHECK(contains(complaint(with(R"("mesh":0)", R"("mesh":0,"scale":[1e200,1e200,1e200])")),
                 "node 0: its transform is not finite"));
}

TEST_CASE("gltf_reader: what nodes hide, with all below, is left out and told, unless all is") {
  const std::string hides = R"("extensions":{"KHR_node_visibility":{"visible":false}})";
  const std::string shows = R"("extensions":{"KHR_node_visibility":{"visible":true}})";
  Gltf gltf = tetrahedron_gltf();
  gltf.rest = R"("nodes":[{"mesh":0},{"mesh":0,"children":[2],)" + hides + R"(},{"mesh":0,)" +
              shows +
              R"(}],"scenes":[{"nodes":[0,1]}],"scene":0,)"
              R"("extensionsRequired":["KHR_node_visibility"])";
  const sphparam::MeshFile file = read(gltf.bytes());
  CHECK(file.mesh.triangles == tetrahedron().triangles);
  CHECK(file.notes == std::vector<std::string>{"not carried: 2 meshes that nodes hide, as node 1"});
  gltf.rest = replaced(gltf.rest, hides, shows);
  CHECK(read(gltf.bytes()).mesh.face_count() == 12);
  CHECK(contains(complaint(with(R"("mesh":0)", R"("mesh":0,)" + hides)), "node 0: it is hidden"));
}

TEST_CASE("gltf_reader: extensions of nodes that are not read are told, each once") {
  const std::string said = R"("extensions":{"VENDOR_foo":{},"OMI_seat":{},"MSFT_lod":{}})";
  Gltf gltf = tetrahedron_gltf();
  gltf.rest = R"("nodes":[{"mesh":0,)" + said + R"(},{)" + said +
              R"(}],"scenes":[{"nodes":[0,1]}],"scene":0)";
  CHECK(read(gltf.bytes()).notes ==
        std::vector<std::string>{"not carried: 'OMI_seat' and 'VENDOR_foo' of nodes"});
}

TEST_CASE("gltf_reader: colours and texture coordinates that morph targets move are told") {
  Gltf gltf = tetrahedron_gltf();
  gltf.add(floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}), 5126, 4, "VEC3");
  const auto told = [&](const std::string& weights) {
    gltf.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,)"
                  R"("targets":[{"POSITION":2,"COLOR_0":2},{"TEXCOORD_0":2}]}],"weights":)" +
                  weights + "}]";
    return sphparam::losses_among(read(gltf.bytes()).notes);
  };
  const std::string read_as =
      "not carried: 2 morph targets: the mesh is read as their weights stand";
  CHECK(told("[1,0]") ==
        std::vector<std::string>{read_as + ", but for COLOR_0, which are as without them"});
  CHECK(told("[1,1]") ==
        std::vector<std::string>{read_as +
                                 ", but for COLOR_0 and TEXCOORD_0, which are as without them"});
  CHECK(told("[0,0]") == std::vector<std::string>{"not carried: 2 morph targets"});
}

TEST_CASE("gltf_reader: of an image that is not read its kind is named") {
  for (const auto& [extension, kind] : {std::pair("KHR_texture_basisu", "KTX2"),
                                        {"EXT_texture_avif", "AVIF"},
                                        {"MSFT_texture_dds", "DDS"}}) {
    Gltf gltf = tetrahedron_gltf();
    gltf.meshes = replaced(gltf.meshes, R"("indices":1)", R"("indices":1,"material":0)");
    gltf.rest += R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                 R"("images":[{"uri":"a"}],"textures":[{"extensions":{")" +
                 std::string(extension) + R"(":{"source":0}}}])";
    CHECK(read(gltf.bytes()).base_colours.at(0).problem ==
          std::string("its image is ") + kind +
              ", which is not read: PNG, JPEG and WebP are, as which it can be written anew");
  }
}
