#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>

#include "io/reading.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;

namespace {

std::string ascii_stl(const TriangleMesh& mesh, const std::string& name = "thing") {
  std::string text = std::string("solid ") + name + "\n";
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    text += "  facet normal 0 0 1\n    outer loop\n";
    for (int corner = 0; corner < 3; ++corner) {
      text += "      vertex";
      for (int axis = 0; axis < 3; ++axis)
        text.append(" ").append(std::to_string(mesh.positions(mesh.triangles(f, corner), axis)));
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

void append_word(std::string& bytes, std::uint32_t word, int width = 4) {
  for (int i = 0; i < width; ++i) bytes.push_back(static_cast<char>(word >> (8 * i)));
}

std::string binary_stl(const TriangleMesh& mesh, std::string header = "made by a test",
                       std::uint32_t attribute = 0) {
  header.resize(80, '\0');
  append_word(header, static_cast<std::uint32_t>(mesh.face_count()));
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) append_word(header, 0);
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        append_word(header, std::bit_cast<std::uint32_t>(static_cast<float>(
                                mesh.positions(mesh.triangles(f, corner), axis))));
    append_word(header, attribute, 2);
  }
  return header;
}

}  // namespace

TEST_CASE("stl_reader: a closed surface comes out of the soup closed, whatever the encoding") {
  const TriangleMesh sphere = icosphere(2);
  for (const std::string& bytes : {ascii_stl(sphere), binary_stl(sphere)}) {
    const MeshFile file = read(bytes);
    CHECK(file.mesh.vertex_count() == sphere.vertex_count());
    CHECK(file.mesh.face_count() == sphere.face_count());
    CHECK(inspect_mesh(file.mesh).is_sphere());
    CHECK(file.face_properties.empty());
    CHECK(file.notes.empty());
  }
  CHECK(read(ascii_stl(sphere)).format == "STL ASCII");
  CHECK(read(binary_stl(sphere)).format == "STL binary");
  CHECK(read(binary_stl(sphere)).position_type == ScalarType::Float32);
}

TEST_CASE("stl_reader: corners are one vertex when their coordinates are equal, and only then") {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.row(0).setZero();
  const std::string with_zero = ascii_stl(mesh);
  const std::size_t first = with_zero.find("0.000000 0.000000 0.000000");
  std::string negative = with_zero;
  negative.insert(first, 1, '-');
  CHECK(read(negative).mesh.vertex_count() == 4);  // −0 = +0
  std::string near = with_zero;
  near.replace(first, 8, "1e-300  ");
  CHECK(read(near).mesh.vertex_count() == 5);  // no tolerance
}

TEST_CASE("stl_reader: a facet that welding makes degenerate stays and is listed") {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.row(1) = mesh.positions.row(0);
  const MeshFile file = read(binary_stl(mesh));
  CHECK(file.mesh.vertex_count() == 3);
  CHECK(file.mesh.face_count() == 4);
  CHECK_FALSE(inspect_mesh(file.mesh).is_sphere());
}

TEST_CASE("stl_reader: the length decides, not the word solid") {
  const std::string bytes = binary_stl(tetrahedron(), "solid but binary");
  const MeshFile file = read(bytes);
  CHECK(file.format == "STL binary");
  CHECK(file.comments == std::vector<std::string>{"solid but binary"});
  CHECK(contains(complaint(bytes + bytes.substr(84, 50), "a.stl"), "byte 80"));
  CHECK(contains(complaint(bytes.substr(0, bytes.size() - 1), "a.stl"), "byte 80"));
  CHECK(contains(complaint(std::string("solid\0", 6), "a.stl"), "long enough"));
}

TEST_CASE("stl_reader: attribute bytes and several solids become face properties") {
  const MeshFile coloured = read(binary_stl(tetrahedron(), "", 0x801f));
  REQUIRE(coloured.find_face_property("attribute"));
  CHECK(values_of(coloured.find_face_property("attribute")) == std::vector<double>(4, 0x801f));

  TriangleMesh other = tetrahedron();
  other.positions.array() += 10;
  const MeshFile two = read(ascii_stl(tetrahedron(), "one") + ascii_stl(other, "two"));
  CHECK(two.mesh.vertex_count() == 8);
  CHECK(values_of(two.find_face_property("solid")) == std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(two.comments == std::vector<std::string>{"solid one", "solid two"});
}

TEST_CASE("stl_reader: attributes that are colours become colours of faces, of either convention") {
  using Values = std::vector<double>;
  const auto colours = [](const MeshFile& file) {
    std::vector<Values> channels;
    for (const char* name : {"red", "green", "blue"})
      channels.push_back(values_of(file.find_face_property(name)));
    return channels;
  };
  constexpr std::uint32_t orange = 0x8000 | 31 << 10 | 16 << 5 | 1;
  std::string bytes = binary_stl(tetrahedron(), "", orange);
  CHECK(colours(read(bytes)) == std::vector{Values(4, 255), Values(4, 132), Values(4, 8)});
  CHECK(read(bytes).notes.empty());
  bytes.replace(84 + 48, 2, std::string(2, '\0'));
  const MeshFile partly = read(bytes);
  CHECK(colours(partly) ==
        std::vector{Values(4, 255), Values{255, 132, 132, 132}, Values{255, 8, 8, 8}});
  CHECK(partly.notes == std::vector<std::string>{"1 triangle has no colour, and became white"});
  CHECK(values_of(partly.find_face_property("attribute")) == Values{0, orange, orange, orange});
  // Magics: the colour of the whole in the header, the highest bit clear for other colours.
  const std::string header = "COLOR=\x0a\x14\x1e\xff,MATERIAL=";
  bytes = binary_stl(tetrahedron(), header, 1 << 10 | 16 << 5 | 31);
  bytes.replace(84 + 48, 2, std::string("\xff\xff"));
  const MeshFile magics = read(bytes);
  CHECK(colours(magics) ==
        std::vector{Values{10, 255, 255, 255}, Values{20, 132, 132, 132}, Values{30, 8, 8, 8}});
  CHECK(magics.notes.empty());
  // Other numbers are no colours.
  CHECK_FALSE(read(binary_stl(tetrahedron(), "", 7)).find_face_property("red"));
}

TEST_CASE("stl_reader: a length that is not that of the count says what to do") {
  const std::string bytes = binary_stl(tetrahedron());
  CHECK(contains(complaint(bytes.substr(0, 84 + 50 + 7), "a.stl"),
                 "has 284 bytes, this file has 141: it ends after 1 whole triangle, so copy, "
                 "download or export it again"));
  CHECK(contains(complaint(bytes + bytes.substr(84, 50), "a.stl"),
                 "this file has 334: its count leaves out what comes after, so export it again"));
}

TEST_CASE("stl_reader: lines, case and blanks may be as they like") {
  const std::string text = ascii_stl(tetrahedron());
  for (const std::string& other :
       {replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"),
        std::string("\xef\xbb\xbf") + text, replaced(text, "facet", "FACET"),
        replaced(text, "outer loop\n", "outer\nloop "), replaced(text, "solid thing", "solid"),
        std::string("\n ") + text})
    CHECK(read(other).mesh.triangles == read(text).mesh.triangles);
}

TEST_CASE("stl_reader: what breaks the rules is refused at its line") {
  const std::string text = ascii_stl(tetrahedron());
  const auto refused = [&](const std::string& from, const std::string& to, int line,
                           const std::string& expected) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    const std::string message = complaint(changed, "a.stl");
    INFO(to << " -> " << message);
    CHECK(contains(message, "a.stl:" + std::to_string(line) + ": "));
    CHECK(contains(message, expected));
  };
  refused("facet normal", "face normal", 2, "expected 'facet'");
  refused("normal 0 0 1", "normal 0 0", 2, "end of the line");
  refused("normal 0 0 1", "normal one 0 1", 2, "one");
  refused("outer", "inner", 3, "expected 'outer'");
  refused("vertex ", "vertex 1e999 ", 4, "range");
  refused("vertex ", "vertex 0x1p3 ", 4, "0x1p3");
  refused("vertex ", "vertex 1,5 ", 4, "decimal point");
  refused("    endloop", "      vertex 0 0 0\n    endloop", 7, "more than 3 corners");
  refused("    endloop\n", "", 7, "expected 'endloop'");
  refused("endsolid thing\n", "", 29, "end of the file");
  CHECK(contains(complaint("solid\0 a", "a.stl"), "end of the file"));
}

TEST_CASE("stl_reader: binary coordinates must be finite, counts within the limits") {
  std::string bytes = binary_stl(tetrahedron());
  bytes.replace(84 + 12, 4, std::string("\0\0\xc0\x7f", 4));
  CHECK(contains(complaint(bytes, "a.stl"), "byte 96: coordinate"));

  sphparam::ReadOptions options;
  options.max_faces = 4;
  options.max_vertices = 4;
  for (const std::string& good : {binary_stl(tetrahedron()), ascii_stl(tetrahedron())}) {
    CHECK(complaint(good, "a.stl", options).empty());
    sphparam::ReadOptions fewer = options;
    fewer.max_faces = 3;
    CHECK(contains(complaint(good, "a.stl", fewer), "limit of 3"));
    fewer = options;
    fewer.max_vertices = 3;
    CHECK(contains(complaint(good, "a.stl", fewer), "limit of 3"));
  }
}

TEST_CASE("stl_reader: normals need not be finite, nobody reads them") {
  const std::string text = ascii_stl(tetrahedron());
  for (const char* none : {"nan", "-nan(ind)", "-1.#IND", "1.#QNAN0", "inf", "-INF"}) {
    INFO(none);
    const std::string word(none);
    const MeshFile file = read(replaced(text, "normal 0 0 1", "normal " + word + " 0 " + word));
    CHECK(file.mesh.triangles == read(text).mesh.triangles);
    CHECK(file.notes.empty());
  }
  CHECK(contains(complaint(replaced(text, "vertex ", "vertex nan "), "a.stl"), "nan"));
}

TEST_CASE("stl_reader: what fills a file up behind its mesh is noted, and the mesh is read") {
  const std::string text = ascii_stl(tetrahedron()), bytes = binary_stl(tetrahedron());
  for (const std::string& more :
       {std::string("x"), std::string(49, '\1'), std::string(1000, '\0'), std::string(77, '\0')}) {
    const MeshFile file = read(bytes + more, "a.stl");
    CHECK(file.mesh.triangles == read(bytes).mesh.triangles);
    REQUIRE(file.notes.size() == 1);
    CHECK(contains(file.notes[0], "data after the last triangle ignored: " +
                                      std::to_string(more.size()) + " byte"));
  }
  // There is room for a triangle: noise is no mesh, and the last one may be cut off.
  for (const std::size_t more : {50, 51, 99, 10007}) {
    INFO(more);
    CHECK(contains(complaint(bytes + std::string(more, '\1'), "a.stl"),
                   "this file has " + std::to_string(bytes.size() + more)));
  }
  const MeshFile padded = read(text + std::string(50, '\0'), "a.stl");
  CHECK(padded.mesh.triangles == read(text).mesh.triangles);
  CHECK(padded.notes == std::vector<std::string>{"zero bytes after the text ignored"});
}

TEST_CASE("stl_reader: data after the last solid is noted") {
  CHECK(read(ascii_stl(tetrahedron()) + "hello\n").notes.size() == 1);
  CHECK(read(ascii_stl(tetrahedron()) + "\n# the end\n").notes.empty());
}
