#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/topology.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const std::string vertices = "1 1 1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n";
const std::string numbered_vertices = "1 1 1 1\n2 -1 -1 1\n3 -1 1 -1\n4 1 -1 -1\n";
const std::string plates = "1 3 2\n1 2 4\n1 4 3\n2 3 4\n";
const std::string plates_from_zero = "0 2 1\n0 1 3\n0 3 2\n1 2 3\n";
const std::string numbered_plates = "1 1 3 2\n2 1 2 4\n3 1 4 3\n4 2 3 4\n";

/// A vector of ICQ: face 1 to 6 of the cube of edge 2, column i and row j from 0 to q. By the sides
/// of the faces as SHAPE.TXT draws them: 1 above with its row q at the front, where face 2 hangs,
/// and 3, 4, 5 follow to the left.
Eigen::Vector3d cube_point(int face, int i, int j, int q) {
  const double s = (q - 2.0 * i) / q, t = (q - 2.0 * j) / q;  // of either side the same bits
  switch (face) {
    case 1:
      return {s, -t, 1};
    case 2:
      return {s, 1, t};
    case 3:
      return {1, -s, t};
    case 4:
      return {-s, -1, t};
    case 5:
      return {-1, s, t};
    default:
      return {s, t, -1};
  }
}

/// A body of an odd shape, so that no two places of it are the same; `mirrored`: its mirror image,
/// of which all faces look inwards. `by_columns`: what runs first runs last.
std::string icq(int q, const std::string& end = "", bool mirrored = false,
                bool by_columns = false) {
  std::ostringstream text;
  text.precision(17);
  text << "          " << q << "\n";
  for (int face = 1; face <= 6; ++face) {
    for (int j = 0; j <= q; ++j) {
      for (int i = 0; i <= q; ++i) {
        const Eigen::Vector3d d =
            (by_columns ? cube_point(face, j, i, q) : cube_point(face, i, j, q)).normalized();
        const Eigen::Vector3d p = (1 + 0.2 * d.x() + 0.1 * d.x() * d.y()) * d;
        text << p.x() << ' ' << (mirrored ? -p.y() : p.y()) << ' ' << p.z() << end << "\n";
      }
    }
  }
  return text.str();
}

double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return mesh.positions.row(mesh.triangles(f, k)).transpose();
    };
    six += corner(0).dot(corner(1).cross(corner(2)));
  }
  return six / 6;
}

}  // namespace

TEST_CASE("plates: rows of longitude, latitude and radius are refused by what they are") {
  for (const char* row : {"-90.0 0.0 250.5\n", "-90 0 250 1\r\n", "0 0 1\n"})
    CHECK_THROWS_WITH(read(row + std::string("-90.0 30.0 250.5\n"), "a.tab"),
                      Catch::Contains("no rows of longitude, latitude and radius"));
  CHECK_THROWS_WITH(read("hello\n", "a.tab"), Catch::Contains("expected a whole number"));
}

TEST_CASE("plate tables: the same mesh, whichever way counts and numbers stand") {
  const MeshFile expected = read(tetrahedron_obj);
  for (const std::string& text :
       {"4 4\n" + vertices + plates, "4\n4\n" + vertices + plates,
        "4\n" + vertices + "4\n" + plates, "4\n" + numbered_vertices + "4\n" + numbered_plates,
        "4 4\n" + vertices + "3\n1 3 2\n3\n1 2 4\n3\n1 4 3\n3\n2 3 4\n",
        "4 4\n" + numbered_vertices + plates, "4 4\n" + vertices + numbered_plates,
        "# body\n\n 4 4 # counts\n" + replaced(vertices, "\n", "\r\n") + plates,
        replaced("4\n" + vertices + "4\n" + plates, "\n", "\r"),
        "4 4\n" + replaced(vertices, "1", "0.1D+01") + plates}) {
    for (const char* name : {"a.tab", "a.plt", "a.ver", "nameless", "a.txt"}) {
      INFO(name << "\n" << text);
      const MeshFile file = read(text, name);
      CHECK(file.format == "PDS plate table");
      CHECK(file.mesh.positions == expected.mesh.positions);
      CHECK(file.mesh.triangles == expected.mesh.triangles);
      CHECK(file.notes.empty());
    }
  }
}

TEST_CASE("plate tables: an albedo after three numbers is a property of vertices, of plates") {
  const std::string shaded_vertices = "1.0 1 1 .1\n-1. -1 1 .2\n-1.0 1 -1 3D-1\n1.0 -1 -1 .4\n";
  const std::string shaded_plates = "1 3 2 0.5\n1 2 4 0.6\n1 4 3 0.7\n2 3 4 0.8\n";
  const MeshFile expected = read("4 4\n" + vertices + plates, "a.plt");
  const MeshFile of_vertices = read("4 4\n" + shaded_vertices + plates, "a.plt");
  CHECK(of_vertices.mesh.positions == expected.mesh.positions);
  REQUIRE(of_vertices.find_vertex_property("albedo"));
  CHECK(of_vertices.find_vertex_property("albedo")->values ==
        std::vector<double>{0.1, 0.2, 0.3, 0.4});
  const MeshFile of_plates = read("4\n" + vertices + "4\n" + shaded_plates, "a.plt");
  CHECK(of_plates.mesh.triangles == expected.mesh.triangles);
  REQUIRE(of_plates.find_face_property("albedo"));
  CHECK(of_plates.find_face_property("albedo")->values == std::vector<double>{0.5, 0.6, 0.7, 0.8});
  CHECK(complaint("4 4\n" + vertices + replaced(shaded_plates, " 0.7", ""), "a.plt") ==
        "a.plt:8: expected a number, found the end of the line");
}

TEST_CASE("v/f tables: exponents may be of Fortran") {
  const MeshFile file = read(replaced(tetrahedron_obj, "v 1", "v 0.1D+01"), "a.obj");
  CHECK(file.mesh.positions == read(tetrahedron_obj).mesh.positions);
}

TEST_CASE("plate tables: vertices counted from 0 are told") {
  const MeshFile file = read("4 4\n" + vertices + plates_from_zero, "a.plt");
  CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
  CHECK(file.notes == std::vector<std::string>{"plates count vertices from 0"});
  CHECK(complaint("4 4\n" + vertices + "0 3 2\n1 2 4\n1 4 3\n2 3 4\n", "a.plt") ==
        "a.plt:6: plate names vertex 0, but the largest is 4 of 4: vertices are counted neither "
        "from 1 nor from 0");
}

TEST_CASE("plate tables: commas between all numbers of a row separate them, others are refused") {
  const MeshFile expected = read(tetrahedron_obj);
  const auto with_commas = [](std::string text) {
    for (const char* digits : {"0", "1", "2", "3", "4"})
      text = replaced(text, std::string(digits) + " ", std::string(digits) + ", ");
    return text;
  };
  const std::string spaced = with_commas("4\n" + numbered_vertices + "4\n" + numbered_plates);
  REQUIRE(contains(spaced, "2, -1, -1, 1\n"));
  for (const std::string& text :
       {spaced, replaced(spaced, ", ", ","), replaced(spaced, "\n", ",\r\n"),
        with_commas("4 4\n" + vertices + plates),
        "# a, b\n4 4\n" + vertices + with_commas(plates)}) {
    INFO(text);
    const MeshFile file = read(text, "a.tab");
    CHECK(file.format == "PDS plate table");
    CHECK(file.mesh.positions == expected.mesh.positions);
    CHECK(file.mesh.triangles == expected.mesh.triangles);
    CHECK(file.notes.empty());
  }
  CHECK(read("# a, b\n4 4\n" + vertices + plates, "a.tab").comments ==
        std::vector<std::string>{"a, b"});
  const std::string points = replaced("4 4\n" + vertices + plates, "1 1 1\n", "1,5 1 1\n");
  CHECK(contains(complaint(points, "a.tab"), "a.tab:2: expected a number, found '1,5' (numbers"));
}

TEST_CASE(
    "plate tables: a label before the counts is left out and told, lines keep their numbers") {
  const std::string label = "PDS_VERSION_ID = PDS3  \r\nROWS = 4, 4\r\nEND_OBJECT\r\nEND   \r\n";
  for (const char* name : {"a.tab", "a.lbl"}) {
    const MeshFile file = read(label + "4 4\n" + vertices + plates, name);
    CHECK(file.format == "PDS plate table");
    CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
    CHECK(file.notes ==
          std::vector<std::string>{"not carried: the PDS label before the table, 4 lines"});
  }
  CHECK(
      contains(complaint(label + "4 4\n" + vertices + replaced(plates, "2 3 4", "2 3 5"), "a.tab"),
               "a.tab:13: plate names vertex 5 of 4"));
  CHECK(
      contains(complaint(label + vertices + plates, "a.tab"),
               "this is a PDS label (its table is a file of its own, where it has one; one that "
               "comes after the label's END begins with the numbers of its vertices and plates)"));
  const MeshFile icq_file = read(label + icq(2), "a.icq");
  CHECK(icq_file.mesh.vertex_count() == 26);
  CHECK(icq_file.notes.size() == 1);
}

TEST_CASE("plate tables: what is wrong is said with its line") {
  const std::string whole = "4\n" + numbered_vertices + "4\n" + numbered_plates;
  CHECK(contains(complaint(replaced(whole, "3 -1 1 -1", "7 -1 1 -1"), "a.tab"),
                 "a.tab:4: expected vertex 3, found 7"));
  CHECK(contains(complaint(replaced(whole, "4 2 3 4", "4 2 3 5"), "a.tab"),
                 "a.tab:10: plate names vertex 5 of 4"));
  CHECK(contains(complaint(replaced(whole, "4 2 3 4\n", ""), "a.tab"), "ends before plate 4 of 4"));
  CHECK(contains(complaint(whole, "a.tab", {.max_vertices = 3}), "over the limit of 3"));
  CHECK(contains(complaint(whole, "a.tab", {.max_faces = 3}), "over the limit of 3"));
  CHECK(contains(complaint(replaced(whole, "2 -1 -1 1", "2 -1 -1 nan"), "a.tab"),
                 "a.tab:3: expected a number"));
  const MeshFile holed =
      read(replaced(whole, "2 -1 -1 1", "2 -1 -1 nan"), "a.tab", {.non_finite = true});
  CHECK_FALSE(holed.mesh.positions.allFinite());
}

TEST_CASE("plate tables: nothing of another format, and none without lines of plates") {
  CHECK(read(tetrahedron_obj, "a.tab").format == "OBJ");
  CHECK(read(tetrahedron_off, "a.tab").format == "OFF");
  CHECK(read("4 4\n" + vertices + plates, "a.obj").format == "PDS plate table");
  for (const std::string& text :
       {std::string("4\n") + vertices, "4 4\n" + vertices, "4 4 6\n" + vertices + plates,
        "4\n" + vertices + "4\n" + vertices, std::string("4 4\n1 2\n3 4\n5 6\n7 8\n1 2 3\n")}) {
    INFO(text);
    const std::string said = complaint(replaced(text, "1 1 1", "1.5 1 1"), "a.txt");
    CHECK(contains(said, "the format is not recognised"));
  }
  CHECK(contains(complaint("PDS_VERSION_ID = PDS3\n", "a.tab"), "PDS label"));
  CHECK(contains(complaint("DAS/DSK \0\0", "a.bds"), "DSK"));
}

TEST_CASE("ICQ: closed, outwards, one vertex a place, numbered as in the file") {
  for (const int q : {1, 2, 7}) {
    INFO(q);
    const MeshFile file = read(icq(q), "shape.txt");
    CHECK(file.format == "ICQ");
    CHECK(file.mesh.vertex_count() == 6 * q * q + 2);
    CHECK(file.mesh.face_count() == 12 * q * q);
    CHECK(file.polygons == 6 * q * q);
    CHECK(file.notes.empty());
    const Topology topology(file.mesh);
    CHECK(topology.vertex_count() - topology.edge_count() + topology.face_count() == 2);
    CHECK(volume(file.mesh) > 0);
  }
}

TEST_CASE("ICQ: where rows and columns run the other way, faces are turned, and that is told") {
  const MeshFile file = read(icq(3, "", true), "shape.txt");
  CHECK(file.notes == std::vector<std::string>{
                          "rows and columns run the other way than those of other ICQ: faces were "
                          "turned, to look outwards"});
  CHECK(inspect_mesh(file.mesh).is_sphere());
  CHECK(volume(file.mesh) == Approx(volume(read(icq(3), "shape.txt").mesh)).epsilon(1e-3));
}

TEST_CASE("ICQ: of grids that stand column after column no point is left apart") {
  const MeshFile file = read(icq(3, "", false, true), "shape.txt"), usual = read(icq(3), "a.icq");
  CHECK(file.mesh.vertex_count() == usual.mesh.vertex_count());
  CHECK(file.notes == std::vector<std::string>{
                          "rows and columns run the other way than those of other ICQ: faces were "
                          "turned, to look outwards"});
  CHECK(volume(file.mesh) == Approx(volume(usual.mesh)).epsilon(1e-3));
}

TEST_CASE("ICQ: the vertices are the vectors of the file that source_vertex names") {
  const MeshFile file = read(icq(3), "a.icq");
  const std::vector<double>& source = values_of(file.find_vertex_property("source_vertex"));
  REQUIRE(source.size() == 56);
  CHECK(source[16] == 20);  // row 0 of face 2 repeats row q of face 1
  const MeshFile cut = read(icq(3, " 0.25"), "a.icq");
  CHECK(cut.mesh.positions == file.mesh.positions);
  CHECK(values_of(cut.find_vertex_property("albedo")) == std::vector<double>(56, 0.25));
}

TEST_CASE("ICQ: the body maps") {
  const Folder folder;
  std::ofstream(folder / "body.icq") << icq(6);
  const MappedMesh mapped = load_mapped(folder / "body.icq");
  CHECK(mapped.certificate().bijective());
}

TEST_CASE("ICQ: points that do not repeat one another are left apart and told") {
  std::string text = icq(2);
  const std::size_t first = text.find('\n') + 1;
  text.replace(first, text.find('\n', first) - first, "5 5 5");
  const MeshFile file = read(text, "a.icq");
  CHECK(file.mesh.vertex_count() == 27 + 1);
  REQUIRE(file.notes.size() == 1);
  CHECK(contains(file.notes[0], "2 points of the edges of faces left apart"));
  CHECK(contains(file.notes[0], "the first in line 20"));
  CHECK(contains(file.notes[0], "`--repair --weld LENGTH`"));
  const MeshFile albedo = read(replaced(icq(1, " 1"), "2 1\n", "2 1\n"), "a.icq");
  CHECK(losses_among(albedo.notes).empty());
}

TEST_CASE("ICQ: points that have no place are let through where options say so, never albedos") {
  const ReadOptions lenient{.non_finite = true};
  std::string text = icq(1, " 1");
  const std::size_t first = text.find('\n') + 1;
  const std::string point = text.substr(first, text.find('\n', first) - first);
  CHECK(read(replaced(text, point, "nan 0 0 1"), "a.icq", lenient).mesh.positions.hasNaN());
  CHECK_THROWS_AS(read(replaced(text, point, "0 0 0 nan"), "a.icq", lenient), ReadError);
  CHECK_THROWS_WITH(read(replaced(text, point, "nan 0 0 1"), "a.icq"),
                    Catch::Contains("found 'nan'; `sphparam map --repair` drops"));
}

TEST_CASE("ICQ: what is wrong is said with its line") {
  const std::string text = icq(2);
  CHECK(contains(complaint(text.substr(0, text.rfind('\n', text.size() - 2) + 1), "a.icq"),
                 "a.icq:54: the file ends before vector 54 of 54"));
  CHECK(contains(complaint(text, "a.icq", {.max_vertices = 53}), "54 vectors are over the limit"));
  CHECK(contains(complaint(text, "a.icq", {.max_faces = 47}), "more triangles than the limit"));
  CHECK(contains(complaint(replaced(text, "          2\n", "1000\n"), "a.icq"),
                 "which do not fit the"));
  CHECK(contains(complaint("0\n1 2 3\n", "a.icq"), "a.icq:1: q, the number of quads of an edge"));
}

TEST_CASE("v/f tables: faces counted from 0 are read and told, any other index 0 is refused") {
  const std::string points = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n";
  const std::string faces = "f 0 2 1\nf 0 1 3\nf 0 3 2\nf 1 2 3\n";
  for (const std::string& text : {points + faces, faces + points}) {
    const MeshFile file = read(text, "a.tab");
    CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
    CHECK(file.notes == std::vector<std::string>{"faces count vertices from 0"});
  }
  for (const auto& [from, to, line] :
       {std::tuple("f 0 3 2", "f 0 4 2", ":5:"), std::tuple("f 0 3 2", "f 0 -1 2", ":5:"),
        std::tuple("v 1 1 1\n", "v 1 1 1\nv 9 9 9\n", ":6:"),
        std::tuple("f 0 3 2", "vt 0 0\nf 0 3/1 2", ":5:")})
    CHECK(contains(complaint(replaced(points + faces, from, to), "a.obj"),
                   std::string(line) + " vertex index 0: indices start at 1"));
}
