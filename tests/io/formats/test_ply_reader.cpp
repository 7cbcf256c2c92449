#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "io/formats/ply/ply_writer.h"
#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "support/folder.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;

namespace {

/// Bytes of numbers in either order.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& put(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian_) std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }
  const std::string& get() const { return bytes_; }

 private:
  bool big_endian_;
  std::string bytes_;
};

const std::string binary_properties =
    "element vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty short "
    "flag\nelement face 2\nproperty uchar patch\nproperty list uint8 uint32 "
    "vertex_index\nproperty list uchar float texcoord\n";

std::string binary_quads(bool big_endian) {
  Bytes body(big_endian);
  const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int v = 0; v < 4; ++v)
    body.put<double>(corners[v][0])
        .put(corners[v][1])
        .put(0.1f)
        .put<std::int16_t>(static_cast<std::int16_t>(-300 * v));
  for (const bool mirrored : {false, true}) {
    body.put<std::uint8_t>(mirrored ? 9 : 8).put<std::uint8_t>(4);
    for (unsigned k = 0; k < 4; ++k) body.put<std::uint32_t>(mirrored ? 3 - k : k);
    body.put<std::uint8_t>(8);
    for (unsigned k = 0; k < 4; ++k)
      for (int axis = 0; axis < 2; ++axis) body.put(corners[mirrored ? 3 - k : k][axis]);
  }
  return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
         "_endian 1.0\ncomment made by hand\nobj_info two quads\n" + binary_properties +
         "end_header\n" + body.get();
}

void check_quads(const MeshFile& file) {
  REQUIRE(file.mesh.vertex_count() == 4);
  REQUIRE(file.mesh.face_count() == 4);
  CHECK(file.mesh.position(2) == Vector3(1, 1, static_cast<double>(0.1f)));
  CHECK(file.find_vertex_property("flag")->type == ScalarType::Int16);
  CHECK(values_of(file.find_vertex_property("flag")) == std::vector<double>{0, -300, -600, -900});
  CHECK(values_of(file.find_face_property("patch")) == std::vector<double>{8, 8, 9, 9});
  CHECK(values_of(file.find_face_property("source_face")) == std::vector<double>{0, 0, 1, 1});
  CHECK(file.comments == std::vector<std::string>{"made by hand", "two quads"});
  REQUIRE(file.corner_texcoords);
  CHECK(file.corner_texcoord_type == ScalarType::Float32);
  for (Eigen::Index i = 0; i < 12; ++i)
    CHECK(file.corner_texcoords->row(i) ==
          file.mesh.positions.row(file.mesh.triangles.data()[i]).head<2>());
}

std::string message_of(const std::string& from, const std::string& to) {
  return complaint(replaced(tetrahedron_ply, from, to), "a.ply");
}

/// With `from` turned into `to`, the file is refused at a line for the reason expected.
void refused(const std::string& from, const std::string& to, int line,
             const std::string& expected) {
  const std::string message = message_of(from, to);
  INFO(to << " -> " << message);
  CHECK(contains(message, "a.ply:" + std::to_string(line) + ": "));
  CHECK(contains(message, expected));
}

}  // namespace

TEST_CASE("ply_reader: an ASCII tetrahedron has its vertices and triangles") {
  const MeshFile file = read(tetrahedron_ply);
  CHECK(file.format == "PLY ASCII");
  CHECK(file.position_type == ScalarType::Float32);
  CHECK(file.mesh.position(1) == Vector3(-1, -1, 1));
  CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
  CHECK(file.notes.empty());
}

TEST_CASE("ply_reader: a text of floats that says more than these hold keeps its digits") {
  const auto with = [](const std::string& x) {
    return read(replaced(tetrahedron_ply, "-1 -1 1", x + " -1 0.1"));
  };
  for (const std::string x : {"500123.1234", "0.70710678", "16777217", "+5.001231234e5"}) {
    const MeshFile file = with(x);
    INFO(x);
    CHECK(file.position_type == ScalarType::Float64);
    CHECK(file.mesh.position(1) == Vector3(std::stod(x), -1, 0.1));
  }
  // What a float prints as, with six, nine, seventeen digits, exactly, or halfway between two
  // texts.
  for (const std::string x : {"0.333333", "0.100000001", "0.10000000149011612", "500123.125000",
                              "500123.12", "500123.13", "16777216", "1e-41", "-3.40282e+38"}) {
    const MeshFile file = with(x);
    INFO(x);
    CHECK(file.position_type == ScalarType::Float32);
    CHECK(file.mesh.position(1) == Vector3(static_cast<double>(std::strtof(x.c_str(), nullptr)), -1,
                                           static_cast<double>(0.1f)));
  }
}

TEST_CASE("ply_writer: colours from 0 to 1 are bytes, as other programs read them") {
  const MeshFile obj =
      read("v 0 0 0 1 0.501961 0\nv 1 0 0 0 0 0.2\nv 0 1 0 0 0 1\nf 1 2 3\n", "a.obj");
  const MeshFile ply = read(serialise_ply(obj));
  for (const char* name : {"red", "green", "blue"})
    CHECK(ply.find_vertex_property(name)->type == ScalarType::Uint8);
  CHECK(values_of(ply.find_vertex_property("red")) == std::vector<double>{255, 0, 0});
  CHECK(values_of(ply.find_vertex_property("green")) == std::vector<double>{128, 0, 0});
  CHECK(values_of(ply.find_vertex_property("blue")) == std::vector<double>{0, 51, 255});
  // Light beyond white, and numbers that are no colours, stay as they are.
  const MeshFile bright = read("v 0 0 0 1 1.5 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n", "a.obj");
  CHECK(values_of(read(serialise_ply(bright)).find_vertex_property("green")) ==
        std::vector<double>{1.5, 0, 0});
}

TEST_CASE("ply_reader: both byte orders hold the same mesh") {
  check_quads(read(binary_quads(false)));
  check_quads(read(binary_quads(true)));
  CHECK(read(binary_quads(true)).format == "PLY binary big-endian");
}

TEST_CASE("ply_reader: the header of a binary file may end its lines in LF or CRLF") {
  const std::string file = binary_quads(false);
  const std::size_t body = file.find("end_header\n") + 11;
  check_quads(read(replaced(file.substr(0, body), "\n", "\r\n") + file.substr(body)));
}

TEST_CASE("ply_reader: CR alone before a binary body is refused, as the body may start with LF") {
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\r"
      "property uchar y\rproperty uchar z\relement face 0\rproperty list uchar int "
      "vertex_index\rend_header\r";
  for (const char* body : {"\n\r\n", "\n\n\r\n", "abc"})
    CHECK(contains(complaint(header + body, "a.ply"), "a.ply:9: the header of a binary file"));
  CHECK(read(replaced(tetrahedron_ply, "\n", "\r")).mesh.face_count() == 4);
}

TEST_CASE("ply_reader: line ends and blank lines of text change nothing") {
  for (const std::string& text :
       {replaced(tetrahedron_ply, "\n", "\r\n"), replaced(tetrahedron_ply, "\n", "\r"),
        "\xef\xbb\xbf" + tetrahedron_ply, replaced(tetrahedron_ply, "1 -1 -1\n", "1 -1 -1\n\n"),
        tetrahedron_ply.substr(0, tetrahedron_ply.size() - 1)})
    CHECK(read(text).mesh.triangles == read(tetrahedron_ply).mesh.triangles);
}

TEST_CASE("ply_reader: a text number has the precision of its declared type") {
  const std::string tenth = replaced(tetrahedron_ply, "1 -1 -1\n", "0.1 -1 -1\n");
  CHECK(read(tenth).mesh.position(3).x() == static_cast<double>(0.1f));
  CHECK(read(replaced(tenth, "float", "double")).mesh.position(3).x() == 0.1);
}

TEST_CASE("ply_reader: faces may come first, other elements and lists are skipped") {
  const MeshFile file = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float weights\nelement none 0\nelement edge 2\nproperty int a\n"
      "property list char int b\nelement vertex 3\nproperty float x\nproperty list uchar int near\n"
      "property float y\nproperty float z\nend_header\n3 0 1 2 2 0.5 0.5\n1 0\n2 3 7 8 9\n0 0 0 0\n"
      "1 2 5 6 0 0\n0 1 4 1 0\n");
  CHECK(file.mesh.position(2) == Vector3(0, 1, 0));
  CHECK(file.mesh.face_count() == 1);
  CHECK(file.vertex_properties.empty());
  CHECK(file.notes.size() == 3);
}

TEST_CASE("ply_reader: only the map is read where only the map is wanted") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double sx\nproperty float x\n"
      "property float y\nproperty uchar red\nproperty float z\nproperty double sy\n"
      "property double sz\nelement face 1\nproperty uchar patch\n"
      "property list uchar float texcoord\nproperty list uchar int vertex_indices\nend_header\n"
      "1 0 0 7 0 2 3\n4 1 0 8 0 5 6\n7 0 1 9 0 8 9\n2 6 0 0 1 0 1 1 3 0 1 2\n";
  const MeshFile all = sphparam::read_mesh(text, "all.ply", {});
  const MeshFile map = sphparam::read_mesh(text, "map.ply", {.only_map = true});
  CHECK(all.vertex_properties.size() == 4);
  CHECK(map.mesh.positions == all.mesh.positions);
  CHECK(map.mesh.triangles == all.mesh.triangles);
  REQUIRE(map.vertex_properties.size() == 3);
  for (const char* ray : {"sx", "sy", "sz"}) {
    CHECK(map.find_vertex_property(ray)->values == all.find_vertex_property(ray)->values);
  }
  CHECK(map.face_properties.empty());
  CHECK(all.corner_texcoords);
  CHECK_FALSE(map.corner_texcoords);
}

TEST_CASE("ply_reader: files without faces are read") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n";
  CHECK(read(header + "end_header\n1 2 3\n").mesh.face_count() == 0);
}

namespace {

/// Six vertices and one element of strips: its lists.
std::string strips_ply(const std::string& type, const std::string& lists, int count = 1,
                       const std::string& more = "") {
  return "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty "
         "float z\n" +
         more + "element tristrips " + std::to_string(count) + "\nproperty list int " + type +
         " vertex_indices\nend_header\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n" + lists;
}

}  // namespace

TEST_CASE("ply_reader: strips are triangles, every other one turned over, anew after -1") {
  Triangles expected(5, 3);
  expected << 0, 2, 4, 4, 2, 1, 4, 1, 3, 5, 4, 3, 3, 4, 0;
  const MeshFile file = read(strips_ply("int", "10 0 2 4 1 3 -1 5 4 3 0\n"));
  CHECK(file.mesh.triangles == expected);
  CHECK(file.notes.empty());
  CHECK(read(strips_ply("int", "5 0 2 4 1 3\n4 5 4 3 0\n", 2)).mesh.triangles == expected);
  CHECK(read(strips_ply("uint", "10 0 2 4 1 3 4294967295 5 4 3 0\n")).mesh.triangles == expected);
  // A strip turns a corner by naming a vertex twice; the count goes on all the same.
  const MeshFile turning = read(strips_ply("int", "6 0 2 4 4 1 2\n"));
  CHECK(turning.mesh.face_count() == 2);
  CHECK(turning.mesh.triangles.row(1) == Eigen::RowVector3i(1, 4, 2));
  CHECK(turning.notes.size() == 1);
  CHECK(read(strips_ply("int", "2 0 1\n0\n3 -1 -1 -1\n", 3)).mesh.face_count() == 0);
}

TEST_CASE("ply_reader: strips that break the rules are refused, those beside faces are told") {
  CHECK(contains(complaint(strips_ply("int", "3 0 1 6\n")), "strip names vertex 6 of 6"));
  CHECK(contains(complaint(strips_ply("int", "3 0 1 -2\n")), "strip names vertex -2"));
  CHECK(contains(complaint(strips_ply("float", "3 0 1 2\n")), "floating-point"));
  CHECK(contains(complaint(strips_ply("int", "-1\n")), "negative length"));
  CHECK(contains(complaint(strips_ply("int", "9 0 1 2\n")), "a.ply") == false);
  CHECK_FALSE(complaint(strips_ply("int", "9 0 1 2\n")).empty());
  sphparam::ReadOptions two;
  two.max_faces = 2;
  CHECK(complaint(strips_ply("int", "4 0 1 2 3\n"), "a.ply", two).empty());
  CHECK(contains(complaint(strips_ply("int", "5 0 1 2 3 4\n"), "a.ply", two), "limit of 2"));
  const MeshFile both = read(strips_ply(
      "int", "3 0 1 2\n3 3 4 5\n", 1, "element face 1\nproperty list uchar int vertex_indices\n"));
  CHECK(both.mesh.triangles == Eigen::RowVector3i(0, 1, 2));
  CHECK(both.notes == std::vector<std::string>{"not carried: 1 record of element 'tristrips'"});
}

TEST_CASE("ply_reader: strips in binary are those of text") {
  std::string bytes = strips_ply("int", "");
  bytes = replaced(bytes.substr(0, bytes.find("end_header")), "ascii", "binary_big_endian") +
          "end_header\n";
  const auto put = [&](std::uint32_t word) {
    for (int i = 3; i >= 0; --i) bytes.push_back(static_cast<char>(word >> (8 * i)));
  };
  for (int i = 0; i < 18; ++i) put(0);
  for (const std::uint32_t word : {5u, 0u, 1u, 2u, ~0u, 3u}) put(word);
  CHECK(read(bytes).mesh.triangles == Eigen::RowVector3i(0, 1, 2));
  CHECK(contains(complaint(bytes.substr(0, bytes.size() - 1)), "the file ends within tristrips 0"));
}

TEST_CASE("ply_reader: faces without texture coordinates or normals are zero and noted") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\nproperty list uchar float texcoord\nproperty list uchar int "
      "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n6 1 2 3 4 5 6 3 0 1 2\n0 3 0 2 1\n";
  const MeshFile file = read(text);
  CHECK((*file.corner_texcoords)(2, 1) == 6);
  CHECK((*file.corner_texcoords)(5, 1) == 0);
  REQUIRE(file.notes.size() == 1);
  CHECK(contains(file.notes[0], "have no texture coordinates: set to zero"));
  CHECK(contains(complaint(replaced(text, "\n0 3 0 2 1", "\n2 1 1 3 0 2 1"), "a.ply"),
                 "a.ply:15: face of 3 corners has 2 numbers"));
  const MeshFile shaded =
      read(replaced(replaced(text, "texcoord", "normal"), "6 1 2 3 4 5 6", "9 1 2 3 4 5 6 7 8 9"));
  CHECK((*shaded.corner_normals)(2, 2) == 9);
  CHECK((*shaded.corner_normals)(5, 2) == 0);
  REQUIRE(shaded.notes.size() == 1);
  CHECK(contains(shaded.notes[0], "have no normals: set to zero"));
}

TEST_CASE("ply_reader: a header that breaks the rules is refused at its line") {
  refused("ply\n", "plx\n", 1, "magic");
  refused(tetrahedron_ply, "plyx", 1, "magic");
  refused("ascii 1.0", "ascii 2.0", 2, "version '2.0'");
  refused("ascii 1.0", "utf8 1.0", 2, "unknown format");
  refused("format ascii 1.0\n", "", 8, "no format");
  refused("format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n", 3, "second format");
  refused("vertex 4", "vertex -4", 3, "count");
  refused("vertex 4", "vertex 4.0", 3, "count");
  refused("vertex 4", "vertex four", 3, "count");
  refused("vertex 4", "vertex 99999999999999999999", 3, "count");
  refused("vertex 4", "vertex 1000", 3, "do not fit");
  refused("vertex 4", "vertex 268435457", 3, "do not fit");
  refused("vertex 4", "vertex 4 4", 3, "unexpected '4'");
  refused("vertex 4", "point 4", 9, "no element vertex");
  refused("element face 4", "element vertex 4", 7, "second element");
  refused("float x", "quad x", 4, "unknown type 'quad'");
  refused("float x", "float w", 3, "no property x");
  refused("float x", "list uchar float x", 3, "x is a list");
  refused("float y", "float x", 5, "second property 'x'");
  refused("list uchar int", "list float int", 8, "list count");
  refused("list uchar int", "list uchar float", 7, "floating-point");
  refused("list uchar int", "int", 7, "no list");
  refused("vertex_indices", "corners", 7, "no list vertex_indices");
  refused("end_header", "start_body", 9, "unknown header statement");
  refused("element vertex 4\n", "", 3, "before the first element");
  refused("property float x\nproperty float y\nproperty float z\n", "", 3, "no properties");
  const std::string two_lists = "vertex_indices\nproperty list uchar int vertex_index";
  CHECK(contains(
      complaint(replaced(tetrahedron_ply, "vertex_indices", two_lists) + std::string(50, ' ')),
      "7: faces have two lists"));
  CHECK(contains(complaint(tetrahedron_ply.substr(0, 60), "a.ply"), "ends within the header"));
  CHECK(contains(complaint(std::string("ply\nformat\0", 11), "a.ply"), "a.ply:2: "));
}

TEST_CASE("ply_reader: a text body that breaks the rules is refused at its line") {
  refused("-1 -1 1", "-1 -1", 11, "end of the line");
  refused("-1 -1 1", "-1 -1 1 1", 11, "unexpected '1'");
  refused("-1 -1 1", "-1 -1 inf", 11, "'inf'");
  refused("-1 -1 1", "-1 -1 1e39", 11, "within range");
  refused("-1 -1 1", "-1 -1 1,0", 11, "decimal point");
  refused("3 0 1 3", "3 0 1 4", 15, "vertex 4 of 4");
  refused("3 0 1 3", "3 0 1 -1", 15, "vertex -1 of 4");
  refused("3 0 1 3", "3 0 1 0", 15, "twice");
  refused("3 0 1 3", "2 0 1", 15, "fewer than 3");
  refused("3 0 1 3", "-3 0 1 3", 15, "no number of type uchar");
  refused("3 0 1 3", "259 0 1 3", 15, "no number of type uchar");
  refused("3 0 1 3", "3.0 0 1 3", 15, "whole number");
  refused("3 1 2 3\n", "# 1 2 3\n", 17, "ends before face 3 of 4");
  refused("3 1 2 3\n", "", 7, "4 records of element 'face' do not fit");
  CHECK(contains(complaint(replaced(replaced(tetrahedron_ply, "list uchar", "list char"), "3 0 1 3",
                                    "-3 0 1 3"),
                           "a.ply"),
                 "negative length"));
  CHECK(read(tetrahedron_ply + "3 0 1 2\n").notes.size() == 1);
}

TEST_CASE("ply_reader: a binary body cut anywhere is refused with the byte") {
  const std::string file = binary_quads(false);
  const std::size_t body = file.find("end_header\n") + 11;
  for (std::size_t size = body; size < file.size(); ++size)
    CHECK_FALSE(complaint(file.substr(0, size)).empty());
  CHECK(
      contains(complaint(file.substr(0, file.size() - 1), "a.ply"),
               "a.ply: byte " + std::to_string(file.size() - 4) + ": the file ends within face 1"));
  const std::vector<std::string> notes = read(file + "x").notes;
  CHECK(std::count(notes.begin(), notes.end(), "data after the last element ignored") == 1);
}

TEST_CASE("ply_reader: numbers of a binary body must be finite") {
  std::string file = binary_quads(false);
  const std::size_t body = file.find("end_header\n") + 11;
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(&file[body + 8], &infinite, 4);
  CHECK(contains(complaint(file), "not finite in vertex 0"));
}

TEST_CASE("ply_reader: a property with values that are not finite is left out and told") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float depth\nproperty double kept\nelement face 4\n"
      "property list uchar int vertex_indices\nproperty float quality\nend_header\n"
      "0 0 0 nan 1\n1 0 0 -inf 2\n0 1 0 1.#QNAN0 3\n0 0 1 4 4\n"
      "3 0 2 1 1\n3 0 1 3 inf\n3 1 2 3 1\n3 0 3 2 1\n";
  const MeshFile file = read(text);
  REQUIRE(file.vertex_properties.size() == 1);
  CHECK(file.vertex_properties[0].name == "kept");
  CHECK(file.vertex_properties[0].values == std::vector<double>{1, 2, 3, 4});
  CHECK(file.face_properties.empty());
  REQUIRE(file.notes.size() == 2);
  CHECK(contains(file.notes[0],
                 "'depth' of element 'vertex': 3 of its 4 numbers (75 %) are not finite"));
  CHECK(contains(file.notes[1],
                 "'quality' of element 'face': 1 of its 4 numbers (25 %) are not finite"));
  CHECK(contains(complaint(replaced(text, "1 0 0 -inf", "1 nan 0 -inf")), "expected a number"));
  CHECK(contains(complaint(replaced(text, "float depth", "float sx")), "'sx'"));
  const MeshFile normals =
      read(replaced(replaced(text, "float depth", "float nz"), "double kept", "double nx"));
  CHECK(normals.vertex_properties.empty());
  CHECK(contains(normals.notes[0], "'nz'"));
  CHECK(contains(normals.notes[0], "nx, ny, nz go together"));
}

TEST_CASE("ply_reader: values of a binary body that are not finite are left out and told") {
  for (const bool big_endian : {false, true}) {
    Bytes body(big_endian);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& corner : corners)
      body.put(corner[0]).put(corner[1]).put(corner[2]).put(std::nanf("")).put<double>(7);
    for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
      body.put<std::uint8_t>(3).put(face[0]).put(face[1]).put(face[2]).put(HUGE_VAL);
    const MeshFile file =
        read(std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
             "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "property float depth\nproperty double kept\nelement face 4\nproperty list uchar int "
             "vertex_indices\nproperty double quality\nend_header\n" +
             body.get());
    REQUIRE(file.vertex_properties.size() == 1);
    CHECK(file.vertex_properties[0].name == "kept");
    CHECK(file.face_properties.empty());
    CHECK(file.notes.size() == 2);
  }
}

TEST_CASE("ply_reader: huge counts are refused before memory is spent") {
  const std::string header = binary_quads(false);
  for (const char* count : {"face 4000000000", "face 200000000", "face 99"})
    CHECK(contains(complaint(replaced(header, "face 2", count), "a.ply"), "do not fit"));
  const std::string of_one_byte = "element mark 99999\nproperty uchar a\nelement face 2";
  CHECK(contains(complaint(replaced(header, "element face 2", of_one_byte), "a.ply"),
                 "99999 records of element 'mark' do not fit"));
  // A list that claims more entries than there are bytes.
  std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty list uint double tags\nelement face 0\nproperty list uchar int "
      "vertex_indices\nend_header\n" +
      std::string(12, '\0') + "\xff\xff\xff\xff";
  CHECK(contains(complaint(list), "ends within vertex 0"));
}

TEST_CASE("ply_reader: a face is budgeted with three corners, in text and in bytes") {
  const std::string header =
      "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 2\nproperty list uchar ushort vertex_indices\nend_header\n";
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + header;
  const std::string body(
      "\0\0\0\1\0\0\0\1\0"
      "\3\0\0\1\0\2\0"
      "\3\0\0\2\0\1\0",
      23);
  CHECK(read(binary + body).mesh.face_count() == 2);
  CHECK(contains(complaint(binary + body.substr(0, 22)), "2 records of element 'face' do not fit"));
  const std::string text = "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(read(text + "3 0 2 1").mesh.face_count() == 2);
  CHECK(contains(complaint(text + "3 0 2 "), "2 records of element 'face' do not fit"));
}

// --- Images that comments name ---

namespace {

const std::string two_pages =
    "ply\nformat ascii 1.0\ncomment TextureFile p0.png\ncomment scanned\n"
    "comment TextureFile  maps\\p1.png\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 3\nproperty list uchar int vertex_indices\n"
    "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1 1\n3 2 1 0 6 0 1 1 0 0 0 0\n"
    "3 1 0 2 6 1 0 0 0 0 1 2\n";

struct PlyFolder : Folder {
  MeshFile read(const std::string& text) const {
    write("a.ply", text);
    return read_mesh(*this / "a.ply");
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
  }
};

std::vector<std::string> images_of(const MeshFile& file) {
  std::vector<std::string> images;
  for (const MaterialTexture& colour : file.base_colours) images.push_back(colour.image);
  return images;
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("ply_reader: TextureFile comments are materials, a face's by its texnumber") {
  const PlyFolder folder;
  const MeshFile file = folder.read(two_pages);
  CHECK(file.materials == Words{"p0.png", "maps\\p1.png"});
  CHECK(images_of(file) == Words{"p0.png", "maps/p1.png"});
  CHECK(file.base_colours[1].path == "maps/p1.png");
  CHECK(file.base_colours[1].folder == folder.path.string());
  REQUIRE(file.channels.size() == 2);
  CHECK(file.channels[0].metallic.factor[0] == 0);
  CHECK(values_of(file.find_face_property("material")) == std::vector<double>{1, 0, -1});
  CHECK(values_of(file.find_face_property("texnumber")) == std::vector<double>{1, 0, 2});
  CHECK(file.comments == Words{"TextureFile p0.png", "scanned", "TextureFile  maps\\p1.png"});
  CHECK(file.notes.empty());
  // All faces are of the first without numbers; where no folder is known, nothing is.
  const MeshFile one = folder.read(replaced(two_pages, "texnumber", "other"));
  CHECK(values_of(one.find_face_property("material")) == std::vector<double>{0, 0, 0});
  CHECK(read(two_pages).materials.empty());
  CHECK(read(two_pages).base_colours.empty());
}

TEST_CASE("ply_reader: coordinates of vertices do for images, and without any they are told") {
  const PlyFolder folder;
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile p0.png\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float texture_u\nproperty float texture_v\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0.25 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  const MeshFile file = folder.read(text);
  CHECK(images_of(file) == Words{"p0.png"});
  CHECK(values_of(file.find_vertex_property("s")) == std::vector<double>{0.25, 1, 0});
  const MeshFile none = folder.read(replaced(text, "texture_", "other_"));
  CHECK(none.materials.empty());
  CHECK(none.notes == Words{"not carried: the texture p0.png: there are no coordinates for it"});
}

TEST_CASE("ply_reader: images of our own files are those of the materials, where they are there") {
  const PlyFolder folder;
  folder.write("p0.png", "");
  folder.write("maps/p1.png", "");
  const MeshFile read_first = folder.read(two_pages);
  write_mesh(folder / "b.ply", read_first);
  const MeshFile again = read_mesh(folder / "b.ply");
  CHECK(again.comments == read_first.comments);
  CHECK(again.materials == read_first.materials);
  CHECK(images_of(again) == images_of(read_first));
  CHECK(values_of(again.find_face_property("material")) == std::vector<double>{1, 0, -1});
  CHECK(losses_of_writing(read_first, read(serialise_mesh("c.ply", read_first))).empty());
  CHECK(losses_of_writing(read_first, read(serialise_mesh("c.obj", read_first), "c.obj")) ==
        Words{"not carried: texnumber of faces", "not carried: colours and textures of materials"});
  std::filesystem::remove(folder.path / "p0.png");
  CHECK(read_mesh(folder / "b.ply").base_colours.empty());
  CHECK(images_of(folder.read(two_pages)) == Words{"p0.png", "maps/p1.png"});
}

TEST_CASE("ply_reader: obj_info lines are comments, which is noted") {
  const MeshFile file =
      read(replaced(tetrahedron_ply, "ascii 1.0\n", "ascii 1.0\nobj_info by x\n"));
  CHECK(file.comments == Words{"by x"});
  CHECK(file.notes == Words{"1 obj_info line is kept as a comment"});
}

TEST_CASE("ply_reader: colours are read as programs write them") {
  const auto with_colours = [](const std::string& head, const std::string& type,
                               const std::string& a, const std::string& b) {
    const std::string property = "property " + type + " " + head;
    return read(
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\n" +
        property + "red\n" + property + "green\n" + property + "blue\nend_header\n0 0 0 " + a +
        "\n1 0 0 " + b + "\n");
  };
  const auto of = [](const MeshFile& file, const char* name) {
    const Property* const colour = file.find_vertex_property(name);
    return std::pair(colour ? colour->type : ScalarType::Int8, values_of(colour));
  };
  using Values = std::vector<double>;
  const MeshFile diffuse = with_colours("diffuse_", "uchar", "200 30 0", "1 0 255");
  CHECK(of(diffuse, "red") == std::pair(ScalarType::Uint8, Values{200, 1}));
  CHECK(of(diffuse, "blue") == std::pair(ScalarType::Uint8, Values{0, 255}));
  CHECK(diffuse.notes ==
        Words{"diffuse_red, diffuse_green and diffuse_blue are the colours of vertices"});
  const MeshFile whole = with_colours("", "float", "200 30.0 0", "1 0 0");
  CHECK(of(whole, "red") == std::pair(ScalarType::Uint8, Values{200, 1}));
  CHECK(of(whole, "blue") == std::pair(ScalarType::Uint8, Values{0, 0}));
  CHECK(whole.notes == Words{"colours of vertices are real numbers up to 255"});
  const MeshFile halves = with_colours("", "float", "127.5 51 0", "1 0 255");
  CHECK(of(halves, "red") ==
        std::pair(ScalarType::Float32,
                  Values{0.5, static_cast<double>(static_cast<float>(1.0 / 255))}));
  CHECK(of(halves, "blue") == std::pair(ScalarType::Float32, Values{0, 1}));
  // Brighter than white in one channel, in all of them, and beyond what a byte says.
  for (const MeshFile& file : {with_colours("", "float", "1.5 0.5 0", "1 0 1"),
                               with_colours("", "float", "1.02 1.01 1.25", "1 0 16"),
                               with_colours("", "float", "300 30 2", "1 0 0"),
                               with_colours("", "float", "1 0 1", "1 0 0")}) {
    CHECK(file.find_vertex_property("red")->type == ScalarType::Float32);
    CHECK(file.notes.empty());
  }
}
