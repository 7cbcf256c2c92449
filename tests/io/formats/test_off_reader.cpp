#include <catch2/catch.hpp>

#include "io/reading.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;

namespace {

/// A triangle whose vertex lines and face line end in what is given.
std::string triangle(const std::string& keyword, const std::string& vertex_end,
                     const std::string& face_end = "") {
  return keyword + "\n3 1 0\n0 0 0" + vertex_end + "\n1 0 0" + vertex_end + "\n0 1 0" + vertex_end +
         "\n3 0 1 2" + face_end + "\n";
}

}  // namespace

TEST_CASE("off_reader: a tetrahedron has its vertices and triangles") {
  const MeshFile file = read(tetrahedron_off);
  CHECK(file.format == "OFF");
  CHECK(file.mesh.vertex_count() == 4);
  CHECK(file.mesh.triangles.row(3) == Eigen::RowVector3i(1, 2, 3));
  CHECK(file.notes.empty());
}

TEST_CASE("off_reader: counts may stand on the first line, edges may be missing") {
  for (const std::string& text :
       {replaced(tetrahedron_off, "OFF\n4 4 6", "OFF 4 4 6"),
        replaced(tetrahedron_off, "4 4 6", "4 4"),
        replaced(tetrahedron_off, "OFF\n", "# a\n\nOFF # b\n# c\n\n"),
        replaced(tetrahedron_off, "\n", "\r\n"), replaced(tetrahedron_off, "\n", "\r"),
        "\xef\xbb\xbf" + tetrahedron_off, replaced(tetrahedron_off, "\n", " # x\n\n"),
        tetrahedron_off.substr(0, tetrahedron_off.size() - 1)})
    CHECK(read(text).mesh.triangles == read(tetrahedron_off).mesh.triangles);
}

TEST_CASE("off_reader: the keyword tells what follows the coordinates") {
  const MeshFile normals = read(triangle("NOFF", " 0 0 1"));
  CHECK(values_of(normals.find_vertex_property("nz")) == std::vector<double>{1, 1, 1});

  const MeshFile bytes = read(triangle("COFF", " 255 128 0 64"));
  CHECK(bytes.find_vertex_property("red")->type == ScalarType::Uint8);
  CHECK(values_of(bytes.find_vertex_property("green")) == std::vector<double>{128, 128, 128});
  CHECK(values_of(bytes.find_vertex_property("alpha")) == std::vector<double>{64, 64, 64});

  const MeshFile fractions = read(triangle("COFF", " 1.0 0.5 0"));
  CHECK(fractions.find_vertex_property("green")->type == ScalarType::Float32);
  CHECK_FALSE(fractions.find_vertex_property("alpha"));

  const MeshFile texture = read(triangle("STOFF", " 0.25 0.75"));
  CHECK(values_of(texture.find_vertex_property("t")) == std::vector<double>{0.75, 0.75, 0.75});

  const MeshFile all = read(triangle("STCNOFF", " 0 0 1 10 20 30 0.5 0.25"));
  CHECK(values_of(all.find_vertex_property("nz"))[0] == 1);
  CHECK(values_of(all.find_vertex_property("blue"))[0] == 30);
  CHECK(values_of(all.find_vertex_property("s"))[0] == 0.5);
}

TEST_CASE("off_reader: a keyword that promises too much is noted, not refused") {
  const MeshFile file = read(triangle("COFF", "", " 1 60 -78"));
  CHECK(file.mesh.face_count() == 1);
  CHECK(file.vertex_properties.empty());
  CHECK(file.face_properties.empty());
  CHECK(file.notes.size() == 2);
  const MeshFile extra = read(triangle("OFF", " 7 8"));
  CHECK(extra.vertex_properties.empty());
  CHECK(extra.notes.size() == 1);
}

TEST_CASE("off_reader: one colour a face is kept") {
  const MeshFile bytes = read(triangle("OFF", "", " 255 0 7"));
  CHECK(values_of(bytes.find_face_property("blue")) == std::vector<double>{7});
  CHECK(bytes.find_face_property("blue")->type == ScalarType::Uint8);
  const MeshFile fractions = read(triangle("OFF", "", " 0.5 0.5 0.5 1"));
  CHECK(values_of(fractions.find_face_property("alpha")) == std::vector<double>{1});
  CHECK(read(triangle("OFF", "", " 3")).face_properties.empty());  // index into a colour map
}

TEST_CASE("off_reader: other kinds are refused by name") {
  CHECK(contains(complaint(triangle("4OFF", " 1")), "4OFF"));
  CHECK(contains(complaint(triangle("nOFF", "")), "nOFF"));
  CHECK(contains(complaint(std::string("OFF BINARY\n\0\0\0\3", 15)), "binary OFF"));
  CHECK(contains(complaint(triangle("XOFF", ""), "a.off"), "a.off:1: expected the keyword OFF"));
}

TEST_CASE("off_reader: what breaks the rules is refused at its line") {
  const auto refused = [](const std::string& from, const std::string& to, int line,
                          const std::string& expected) {
    const std::string message = complaint(replaced(tetrahedron_off, from, to), "a.off");
    INFO(to << " -> " << message);
    CHECK(contains(message, "a.off:" + std::to_string(line) + ": "));
    CHECK(contains(message, expected));
  };
  refused("4 4 6", "-4 4 6", 2, "negative");
  refused("4 4 6", "4 4.0 6", 2, "whole number");
  refused("4 4 6", "4 4 6 7", 2, "unexpected");
  refused("4 4 6", "4", 2, "whole number");
  refused("4 4 6", "4 1000000 6", 2, "do not fit");
  refused("3 1 2 3\n", "# long enough", 10, "ends before face 4 of 4");
  refused("4 4 6", "5 4 6", 7, "unexpected '1'");
  refused("-1 -1 1", "-1 -1", 4, "end of the line");
  refused("-1 -1 1", "-1 -1 nan", 4, "nan");
  refused("-1 -1 1", "-1 -1 1,", 4, "decimal point");
  refused("-1 -1 1", "-1 -1 1 1", 4, "unexpected '1'");
  refused("3 0 1 3", "3 0 1 4", 8, "vertex 4 of 4");
  refused("3 0 1 3", "3 0 1 -1", 8, "vertex -1 of 4");
  refused("3 0 1 3", "3 0 1 1", 8, "twice");
  refused("3 0 1 3", "2 0 1", 8, "fewer than 3");
  refused("3 0 1 3", "-3 0 1 3", 8, "fewer than 3");
  refused("3 0 1 3", "3 0 1", 8, "end of the line");
  refused("3 0 1 3", "3 0 1 3 x", 8, "'x'");
}

TEST_CASE("off_reader: data after the last face is noted") {
  CHECK(read(tetrahedron_off + "3 0 1 2\n").notes.size() == 1);
  CHECK(read(tetrahedron_off + "# the end\n\n").notes.empty());
}

TEST_CASE("off_reader: comments are kept in front of the counts and after the last face") {
  const MeshFile file =
      read(replaced(tetrahedron_off, "OFF\n", "# a\nOFF\n# b\n") + "# c\n\n# d\n");
  CHECK(file.comments == std::vector<std::string>{"a", "b", "c", "d"});
  CHECK(file.notes.empty());
}
