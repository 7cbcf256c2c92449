#include <catch2/catch.hpp>
#include <cmath>

#include "io/attributes/remarks.h"
#include "io/reading.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;

namespace {

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Eigen::RowVector3i first_triangle(const std::string& text) {
  return read(text, "a.obj").mesh.triangles.row(0);
}

}  // namespace

TEST_CASE("obj_reader: a tetrahedron has its vertices and triangles") {
  const MeshFile file = read(tetrahedron_obj, "a.obj");
  CHECK(file.format == "OBJ");
  CHECK(file.mesh.vertex_count() == 4);
  CHECK(file.mesh.face_count() == 4);
  CHECK(file.mesh.position(1) == Vector3(-1, -1, 1));
  CHECK(file.mesh.triangles.row(0) == Eigen::RowVector3i(0, 2, 1));
  CHECK(file.polygons == 0);
  CHECK(file.notes.empty());
}

TEST_CASE("obj_reader: line ends, byte order mark and a missing final newline change nothing") {
  const Triangles expected = read(tetrahedron_obj).mesh.triangles;
  const std::string unended = tetrahedron_obj.substr(0, tetrahedron_obj.size() - 1);
  for (const std::string& text :
       {replaced(tetrahedron_obj, "\n", "\r\n"), replaced(tetrahedron_obj, "\n", "\r"), unended,
        "\xef\xbb\xbf" + tetrahedron_obj, replaced(tetrahedron_obj, " ", " \t "),
        replaced(tetrahedron_obj, "\n", " # comment\n\n"), replaced(tetrahedron_obj, " ", " \\\n "),
        // Where the first line ends in CRLF, a CR alone ends none.
        "# one line\r\n# another\rv 9 9 9\r\n" + replaced(tetrahedron_obj, "\n", "\r\n")}) {
    const MeshFile file = read(text, "a.obj");
    CHECK(file.mesh.triangles == expected);
    CHECK(file.mesh.position(3) == Vector3(1, -1, -1));
  }
}

TEST_CASE("obj_reader: numbers of all spellings") {
  const MeshFile file = read("v +1.5 -.5 1e-3\nv 1E2 0. -0\nv 1e-400 3 7\nf 1 2 3\n", "a.obj");
  CHECK(file.mesh.position(0) == Vector3(1.5, -0.5, 1e-3));
  CHECK(file.mesh.position(1) == Vector3(100, 0, 0));
  CHECK(file.mesh.position(2).x() == 0);  // underflow is zero
}

TEST_CASE("obj_reader: relative indices count from the vertices read so far") {
  CHECK(first_triangle(three_vertices + "f -3 -2 -1\nv 9 9 9\n") == Eigen::RowVector3i(0, 1, 2));
  CHECK(first_triangle(three_vertices + "vt 0 0\nvn 0 0 1\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n") ==
        Eigen::RowVector3i(0, 1, 2));
}

TEST_CASE("obj_reader: a face may name vertices of later lines") {
  CHECK(first_triangle("f 1 2 3\n" + three_vertices) == Eigen::RowVector3i(0, 1, 2));
  // The first index that stays out of range is reported, not the largest.
  CHECK(complaint("f 1 2 3\nf 1 2 4\nf 1 2 9\n" + three_vertices, "a.obj") ==
        "a.obj:2: face names vertex 4 of 3");
}

TEST_CASE("obj_reader: every form of a corner") {
  const std::string attributes = three_vertices + "vt 0.25 0.5\nvt 1 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/ 2/ 3/", "f 1// 2// 3//"}) {
    const MeshFile file = read(attributes + face, "a.obj");
    CHECK_FALSE(file.corner_texcoords);
    CHECK(file.vertex_properties.empty());
  }
  for (const char* face : {"f 1/1 2/2 3/1", "f 1/1/1 2/2/1 3/1/1"}) {
    const MeshFile file = read(attributes + face, "a.obj");
    REQUIRE(file.corner_texcoords);
    CHECK(file.corner_texcoords->row(0) == Eigen::RowVector2d(0.25, 0.5));
    CHECK(file.corner_texcoords->row(1) == Eigen::RowVector2d(1, 0));
  }
  for (const char* face : {"f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/1/1"})
    CHECK(values_of(read(attributes + face, "a.obj").find_vertex_property("nz")) ==
          std::vector<double>{1, 1, 1});
}

TEST_CASE("obj_reader: normals go to the vertices when each has one, else to the corners") {
  const std::string vertices = four + "vn 0 0 1\nvn 0 0 1\nvn 1 0 0\n";
  // Different indices, same value: one normal.
  const MeshFile smooth = read(vertices + "f 1//1 2//1 3//2\nf 1//2 3//1 4//1\n", "a.obj");
  CHECK_FALSE(smooth.corner_normals);
  CHECK(values_of(smooth.find_vertex_property("nz")) == std::vector<double>{1, 1, 1, 1});
  // A vertex that no corner gives a normal has a zero.
  const MeshFile partly = read(vertices + "f 1//1 2//1 3//1\nf 1 3 4\n", "a.obj");
  CHECK_FALSE(partly.corner_normals);
  CHECK(values_of(partly.find_vertex_property("nz")) == std::vector<double>{1, 1, 1, 0});
  const MeshFile creased = read(vertices + "f 1//1 2//1 3//1\nf 1//3 3//3 4//3\n", "a.obj");
  CHECK_FALSE(creased.find_vertex_property("nx"));
  REQUIRE(creased.corner_normals);
  CHECK(creased.corner_normals->row(2) == Eigen::RowVector3d(0, 0, 1));
  CHECK(creased.corner_normals->row(3) == Eigen::RowVector3d(1, 0, 0));
}

TEST_CASE("obj_reader: corners of a split polygon keep their texture coordinates") {
  const MeshFile file = read(four + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 1/1 2/2 3/3\n", "a.obj");
  REQUIRE(file.mesh.face_count() == 2);
  CHECK(file.polygons == 1);
  CHECK(values_of(file.find_face_property("source_face")) == std::vector<double>{0, 0});
  for (Eigen::Index i = 0; i < 6; ++i) {
    const int v = file.mesh.triangles.data()[i];
    CHECK(file.corner_texcoords->row(i) == file.mesh.positions.row(v).head<2>());
  }
}

TEST_CASE("obj_reader: missing corner attributes are zero and noted") {
  const MeshFile file = read(four + "vt 1 1\nf 1 2 3\nf 1/1 3/1 4/1\n", "a.obj");
  REQUIRE(file.corner_texcoords);
  CHECK(file.corner_texcoords->row(0) == Eigen::RowVector2d(0, 0));
  CHECK(file.corner_texcoords->row(3) == Eigen::RowVector2d(1, 1));
  CHECK(file.notes ==
        std::vector<std::string>{"3 corners have no texture coordinates: set to zero"});
  const std::string normals = four + "v 5 5 5\nvn 0 0 1\nvn 1 0 0\n";  // a vertex of no face
  const MeshFile one = read(normals + "f 1//1 2//1 3//1\nf 1//1 3//1 4\n", "a.obj");
  CHECK(values_of(one.find_vertex_property("nz")) == std::vector<double>{1, 1, 1, 0, 0});
  CHECK(one.notes == std::vector<std::string>{"1 vertex has no normal: set to zero"});
  CHECK(read(normals + "f 1//1 2 3\n", "a.obj").notes ==
        std::vector<std::string>{"2 vertices have no normals: set to zero"});
  CHECK(read(normals + "f 1//1 2 3\nf 1//2 3 4\n", "a.obj").notes ==
        std::vector<std::string>{"4 corners have no normals: set to zero"});
}

TEST_CASE("obj_reader: colours after the coordinates") {
  const MeshFile file = read("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n", "a.obj");
  REQUIRE(file.find_vertex_property("green"));
  CHECK(file.find_vertex_property("green")->type == sphparam::ScalarType::Float32);
  CHECK(values_of(file.find_vertex_property("green")) == std::vector<double>{0.5, 0, 0});
  CHECK_FALSE(file.find_vertex_property("alpha"));

  const MeshFile partly = read("v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
  CHECK(partly.vertex_properties.empty());
  CHECK(partly.notes.size() == 1);

  const MeshFile weighted = read("v 0 0 0 2\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n", "a.obj");
  CHECK(weighted.notes.size() == 1);
}

TEST_CASE("obj_reader: colours of whole numbers up to 255 are bytes, where one is more than 1") {
  const MeshFile bytes = read("v 0 0 0 255 1 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n", "a.obj");
  REQUIRE(bytes.find_vertex_property("red"));
  CHECK(bytes.find_vertex_property("red")->type == sphparam::ScalarType::Uint8);
  CHECK(values_of(bytes.find_vertex_property("red")) == std::vector<double>{255, 0, 0});
  CHECK(values_of(bytes.find_vertex_property("blue")) == std::vector<double>{0, 0, 1});
  CHECK(bytes.notes == std::vector<std::string>{"colours of vertices are whole numbers up to 255"});
  for (const char* const first : {"1 1 0", "1 0.5 0", "2 0.5 0", "256 1 0", "2 -1 0"}) {
    INFO(first);
    const MeshFile fractions = read(
        "v 0 0 0 " + std::string(first) + "\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n", "a.obj");
    REQUIRE(fractions.find_vertex_property("red"));
    CHECK(fractions.find_vertex_property("red")->type == sphparam::ScalarType::Float32);
    CHECK(fractions.notes.empty());
  }
}

TEST_CASE("obj_reader: (null) takes the material back") {
  const MeshFile file = read(
      three_vertices + "usemtl a\nf 1 2 3\nusemtl (null)\nf 1 2 3\nusemtl b\nf 1 2 3\n", "a.obj");
  CHECK(file.materials == std::vector<std::string>{"a", "b"});
  CHECK(values_of(file.find_face_property("material")) == std::vector<double>{0, -1, 1});
  const MeshFile none = read(three_vertices + "usemtl (null)\nf 1 2 3\n", "a.obj");
  CHECK(none.materials.empty());
  CHECK_FALSE(none.find_face_property("material"));
}

TEST_CASE("obj_reader: materials are numbered in order of first use") {
  const MeshFile file = read(three_vertices +
                                 "mtllib no such file.mtl\nf 1 2 3\nusemtl red paint\n"
                                 "f 1 2 3\nusemtl b\nf 1 2 3\nusemtl red paint\nf 1 2 3\n",
                             "a.obj");
  CHECK(file.materials == std::vector<std::string>{"red paint", "b"});
  CHECK(values_of(file.find_face_property("material")) == std::vector<double>{-1, 0, 1, 0});
}

TEST_CASE(
    "obj_reader: what the material library holds is told, and what several groups are called") {
  const std::string text = "mtllib a.mtl\nmtllib a.mtl\no x\no y\ng p\ns off\ns 1\nusemtl red\n" +
                           three_vertices + "f 1 2 3\nusemtl blue\nf 3 2 1\n";
  CHECK(read(text, "a.obj").notes ==
        std::vector<std::string>{
            "not carried: colours and textures of 2 materials in 'a.mtl', which is not read; their "
            "names are kept",
            "not carried: the names of 2 objects, 1 group and 1 smoothing group"});
  CHECK(read("mtllib a.mtl\no Fox\ns off\ng default\n" + three_vertices + "f 1 2 3\n", "a.obj")
            .notes == std::vector<std::string>{"its object is called 'Fox'"});
}

TEST_CASE(
    "obj_reader: statements that OBJ does not have are left out and told, with the first's line") {
  const MeshFile file =
      read(three_vertices + "f 1 2 3\nquux 1 2\nv 9 9 9\nquux\n@ 1\nf 1 3 4\n", "a.obj");
  CHECK(file.mesh.face_count() == 2);
  CHECK(file.notes ==
        std::vector<std::string>{"not carried: 3 unknown statements, the first 'quux' in line 5"});
  // Without a face, or without a vertex for the faces, the text is no OBJ.
  CHECK(contains(complaint(three_vertices + "quux\nf3 1 2 3\n", "a.obj"),
                 "a.obj:4: unknown statement 'quux'"));
  CHECK(contains(complaint("V 1 2 3\nf 1 1 1\n", "a.obj", {.repeated_corners = true}),
                 "a.obj:1: unknown statement 'V'"));
}

TEST_CASE("obj_reader: other statements are ignored, lines and points told") {
  const MeshFile file =
      read("# made by\n#\n" + three_vertices + "o a\ng b c\ns off\nf 1 2 3\nl 1 2\nl 2 3\np 1\n",
           "a.obj");
  CHECK(file.comments == std::vector<std::string>{"made by", ""});
  CHECK(file.notes ==
        std::vector<std::string>{"its object is called 'a'", "not carried: the names of 1 group",
                                 "not carried: 2 'l' statements", "not carried: 1 'p' statement"});
}

TEST_CASE("obj_reader: what breaks the rules is refused at its line") {
  const auto refused = [](const std::string& line, const std::string& expected) {
    const std::string message = complaint(three_vertices + line + "\n" + three_vertices, "a.obj");
    INFO(line << " -> " << message);
    CHECK(contains(message, "a.obj:4: "));
    CHECK(contains(message, expected));
  };
  refused("f 1 2 0", "start at 1");
  refused("f 1 2 7", "vertex 7 of 6");
  refused("f 1 2 99999999999", "out of range");
  refused("f 1 2 99999999999999999999", "expected an index");
  refused("f -1 -2 -4", "before the first");
  refused("f 1/1 2/1 3/1", "texture coordinate 1 of 0");
  refused("f 1//1 2//1 3//1", "normal 1 of 0");
  refused("f 1 2 2", "twice");
  refused("f 1 2", "fewer than 3");
  refused("f", "fewer than 3");
  refused("f 1 2 3x", "expected an index");
  refused("f 1 2 1.5", "expected an index");
  refused("f 1/1/1/1 2 3", "three indices");
  refused("v 1 2", "found the end of the line");
  const std::string drops = "; `sphparam map --repair` drops such vertices with their faces";
  refused("v 1 2 nan", "'nan'" + drops);
  refused("v 1 2 -inf", "'-inf'" + drops);
  refused("v 1 2 -1.#IND", "'-1.#IND'" + drops);
  refused("v 1 2 1.#QNAN0", "'1.#QNAN0'");
  refused("v 1 2 0x10", "'0x10'");
  refused("v 1 2 1e999", "within range");
  refused("v 1,5 2 3", "decimal point");
  refused("v 1 2 3junk", "'3junk'");
  refused("v 1 2 +-3", "'+-3'");
  refused("v 1 2 3 4 5", "5 numbers");
  refused("v 1 2 3 4 5 6 7 8", "unexpected '8'");
  refused("vt", "expected a number");
  refused("vn 0 0", "expected a number");
  refused("vn 0 0 1 1", "unexpected");
  refused("w 1 2 3", "unknown statement 'w'");
  refused("f 1 2 \x01\x02",
          "'?"
          "?'");
  refused(std::string("v 1 2\0 3", 8), "NUL");
}

TEST_CASE("obj_reader: errors after continued lines name the right line") {
  CHECK(contains(complaint(three_vertices + "f 1 \\\n2 \\\n3\nf 1 2 x\n", "a.obj"), "a.obj:7: "));
  CHECK(contains(complaint(three_vertices + "f 1 \\\n2 \\\nx\n", "a.obj"), "a.obj:4: "));
  CHECK(contains(complaint(three_vertices + "f 1 2 \\", "a.obj"), "a.obj:4: face has fewer"));
}

TEST_CASE(
    "obj_reader: numbers that Microsoft's library calls none are none, and other # are comments") {
  const ReadOptions lenient{.non_finite = true};
  const MeshFile file =
      read("v 1 2 1.#INF\nv -1.#IND 0 0\nv 1 2 3#INFO\nv 1 2 3#\nf 1 2 3\n", "a.obj", lenient);
  CHECK(std::isnan(file.mesh.positions(0, 2)));
  CHECK(std::isnan(file.mesh.positions(1, 0)));
  CHECK(file.mesh.positions(1, 2) == 0);
  CHECK(file.mesh.positions(2, 2) == 3);
  CHECK(file.mesh.positions(3, 2) == 3);
}

TEST_CASE("obj_reader: comments between and behind the statements are kept, the first thousand") {
  const MeshFile file =
      read("# head\n" + three_vertices + "# ear restored\n\n  #\nf 1 2 3 # of a line\n# the end",
           "a.obj");
  CHECK(file.comments == std::vector<std::string>{"head", "ear restored", "the end"});
  std::string many = "# head\n" + three_vertices;
  for (int i = 0; i < 1002; ++i) many += "# no. " + std::to_string(i) + "\nf 1 2 3\n";
  const MeshFile first = read(many, "a.obj");
  CHECK(first.comments.size() == 1001);
  CHECK(first.comments.back() == "no. 999");
  CHECK(first.notes == std::vector<std::string>{"not carried: 2 comments behind the first 1000"});
  const MeshFile polypaint =
      read(three_vertices + "#MRGB ffff0000ffff0000\n#MRGB ffff0000\nf 1 2 3\n", "a.obj");
  CHECK(polypaint.comments.empty());
  CHECK(polypaint.notes == std::vector<std::string>{"not carried: 2 '#MRGB' statements"});
}

TEST_CASE("obj_reader: third texture coordinates are told where they say something") {
  const std::string faces = "vt 0 0 0\nvt 1 0 0\nvt 0 1 0.5\nf 1/1 2/2 3/3\n";
  CHECK(read(three_vertices + faces, "a.obj").notes ==
        std::vector<std::string>{"not carried: third texture coordinates"});
  CHECK(read(three_vertices + replaced(faces, "0.5", "0"), "a.obj").notes.empty());
}

TEST_CASE("remarks: what counts a file, or the parts of its text, is true of that file alone") {
  for (const char* tally : {"4537 vertices, 0 vertices normals", "Vertices: 3476", "End of File",
                            "Point/Line/Face list", "", "####", "9447 vertices, 18894 faces"})
    CHECK(is_tally(tally));
  for (const char* remark : {"1998", "Inv. 12", "end of excavation", "Face of a god", "unit mm"})
    CHECK_FALSE(is_tally(remark));
}

TEST_CASE("remarks: of comments those that say something of the object, of numbers the others") {
  MeshFile file = read(three_vertices + "f 1 2 3\n", "a.obj");
  file.comments = {"Inv. 12",
                   "sphparam verdict x",
                   "up axis y",
                   "front axis z",
                   "source_vertices 9",
                   "data 1 a",
                   "base colour of b: texture c",
                   "TextureFile d",
                   "material 0: unfiltered texels of e",
                   "material wood"};
  CHECK(remarks_of(file) == std::vector<std::string>{"Inv. 12", "material wood"});
  CHECK(numbers_not_shown(file).empty());
  for (const char* name :
       {"sx", "nx", "ny", "nz", "red", "green", "blue", "filler", "quality", "label", "t"})
    file.set_vertex_property({name, ScalarType::Float32, {0, 0, 0}});
  for (const char* name : {"texnumber", "patch", "corner_red_0"})
    file.set_face_property({name, ScalarType::Int32, {0}});
  CHECK(numbers_not_shown(file) ==
        std::vector<std::string>{"quality, label and t of vertices", "patch of faces"});
}
