#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::StartsWith;
using Json = nlohmann::json;

/// A ball without a face, a face twice, one turned over, a vertex that nobody uses.
TriangleMesh scan() {
  TriangleMesh mesh = icosphere(2);
  const Eigen::Index faces = mesh.face_count(), vertices = mesh.vertex_count();
  mesh.triangles.row(7) = mesh.triangles.row(faces - 1);
  mesh.triangles.row(faces - 1) = mesh.triangles.row(3);
  std::swap(mesh.triangles(20, 0), mesh.triangles(20, 1));
  mesh.positions.conservativeResize(vertices + 1, 3);
  mesh.positions.row(vertices) << 9, 9, 9;
  return mesh;
}

/// A ring of triangles about nothing: it has no inside and one edge too long a hole to fill.
std::string moebius_band() {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const double turn = 3.14159265358979323846 * i / 4;
    for (const double side : {-0.4, 0.4}) {
      const double r = 2 + side * std::cos(turn / 2);
      text += "v " + std::to_string(r * std::cos(turn)) + " " + std::to_string(r * std::sin(turn)) +
              " " + std::to_string(side * std::sin(turn / 2)) + "\n";
    }
  }
  for (int i = 0; i < 8; ++i) {
    const bool last = i == 7;
    const int a = 2 * i + 1, b = 2 * i + 2, c = last ? 2 : 2 * i + 3, d = last ? 1 : 2 * i + 4;
    text += "f " + std::to_string(a) + " " + std::to_string(c) + " " + std::to_string(b) + "\nf " +
            std::to_string(c) + " " + std::to_string(d) + " " + std::to_string(b) + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("repair command: a scan is mended, told, and can be mapped then") {
  const Folder folder;
  const std::string out = folder / "mended.ply";
  const Ended ended = sphparam_program({"repair", "-", "-o", out}, obj_text(scan()));
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("1 duplicate face removed") && Contains("hole filled") &&
                            Contains("can be mapped → mended.ply"));
  const MeshFile mended = read_mesh(out);
  CHECK(mended.find_vertex_property("source_vertex"));
  CHECK(mended.find_face_property("source_face"));
  CHECK(sphparam_program({"map", out, "-o", folder / "map.sph.ply"}).code == 0);
}

TEST_CASE("repair command: mended once, a mesh is mended, in every format that is written") {
  const Folder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.vtk", "a.vtp", "a.gii", "a.mz3",
                           "lh.white", "a.ply.gz", "a.vtp.gz"}) {
    INFO(name);
    const std::string once = folder / ("1" + std::string(name)),
                      twice = folder / ("2" + std::string(name));
    REQUIRE(sphparam_program({"repair", "-", "-o", once}, obj_text(scan())).code == 0);
    const Ended again = sphparam_program({"repair", once, "-o", twice, "--json", "-"});
    REQUIRE(again.code == 0);
    CHECK(Json::parse(again.out)["repairs"].empty());
    CHECK(bytes_of(twice) == bytes_of(once));
  }
}

TEST_CASE("repair command: what cannot be mended is written too, and ends with 4") {
  const Folder folder;
  const std::string out = folder / "band.off";
  const Ended ended = sphparam_program({"repair", "-", "-o", out}, moebius_band());
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err, Contains("still no closed genus-0 mesh") && Contains("→ band.off"));
  CHECK(read_mesh(out).mesh.face_count() >= 16);
  const Ended quiet = sphparam_program({"repair", "-q", "-", "-o", out}, moebius_band());
  CHECK(quiet.code == 4);
  CHECK_THAT(quiet.err, Contains("error:") && Contains("still no closed genus-0 mesh"));
}

TEST_CASE("repair command: what is left is answered with what would mend it") {
  const Folder folder;
  const std::string out = folder / "ring.off", mesh = folder / "ring.obj";
  write_bytes(mesh, obj_text(bumped_torus(8, 20, 0.4, 0, 1)));
  const Ended ended = sphparam_program({"repair", mesh, "-o", out, "--max-handle", "1%"});
  CHECK(ended.code == 4);
  INFO(ended.err);
  CHECK_THAT(ended.err, Contains("would mend it, as in `sphparam repair " + mesh + " --repair") &&
                            Contains(" -o " + out + "`"));
}

TEST_CASE("repair command: a sheet that is closed back to back is warned of, a body is not") {
  const Folder folder;
  const std::string mesh = folder / "sheet.obj", out = folder / "sheet.ply",
                    json = folder / "r.json";
  write_bytes(
      mesh, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const Ended sheet = sphparam_program({"repair", mesh, "-o", out, "--json", json});
  INFO(sheet.err);
  CHECK(sheet.code == 0);
  CHECK_THAT(sheet.err, Contains("warning: it encloses nothing: two sheets") &&
                            Contains("`sphparam wrap " + mesh + " -o wrapped.ply` makes a body"));
  const Json report = Json::parse(bytes_of(json));
  REQUIRE(report["warnings"].size() == 1);
  CHECK(report["shape"]["volume"] == 0);
  CHECK(report["shape"]["volume_before"].is_null());
  CHECK(report["shape"]["bounding_box"] == report["shape"]["bounding_box_before"]);
  const Ended body = sphparam_program({"repair", "-", "-o", out, "--json", json}, obj_text(scan()));
  CHECK_THAT(body.err, !Contains("encloses nothing"));
}

TEST_CASE(
    "repair command: what STL would weld again is told where repair split something, only there") {
  const Folder folder;
  const std::string mesh = folder / "ring.obj", out = folder / "ring.ply",
                    stl = folder / "ring.stl";
  write_bytes(mesh, obj_text(bumped_torus(8, 20, 0.4, 0, 1)));
  const Ended ended = sphparam_program({"repair", mesh, "-o", out, "--max-handle", "300%"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains(" vertices lie exactly on others: .ply and .obj keep them apart, STL welds "
                      "them (") &&
                 Contains("edges with more than two faces then), and `sphparam wrap " + mesh +
                          " -o wrapped.ply`"));
  CHECK(sphparam_program({"map", out, "-o", folder / "ring.sph.ply"}).code == 0);
  // So it is: the same triangles as STL are not what was mended.
  const TriangleMesh mended = read_mesh(out).mesh;
  std::string text = "solid ring\n";
  for (Face f = 0; f < mended.face_count(); ++f) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      text += "vertex";
      for (const double x : mended.position(mended.triangles(f, k)))
        text += " " + std::to_string(x);
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  write_bytes(stl, text + "endsolid ring\n");
  const Ended welded = sphparam_program({"map", stl, "-o", folder / "stl.sph.ply"});
  CHECK(welded.code == 4);
  CHECK_THAT(welded.err, Contains("edges have three or more faces"));
  CHECK(sphparam_program({"wrap", mesh, "-o", folder / "wrapped.ply"}).code == 0);

  CHECK_THAT(sphparam_program({"repair", "-", "-o", out}, obj_text(scan())).err,
             !Contains("exactly on"));
}

TEST_CASE("repair command: options are advised before a double dash, not among the files") {
  const Folder folder;
  const std::string mesh = folder / "open.obj", out = folder / "open.sph.ply";
  const std::string text = obj_text(icosphere(2));
  write_bytes(mesh, text.substr(0, text.rfind('f')));
  const Ended ended = sphparam_program({"map", "-o", out, "--", mesh});
  INFO(ended.err);
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err, Contains("`sphparam map -o " + out + " --repair -- " + mesh + "`"));
}

TEST_CASE("repair command: the report says what was done, and what the format has no place for") {
  const Folder folder;
  const Ended ended = sphparam_program(
      {"repair", "-", "-o", folder / "a.off", "--json", "-", "--repair=duplicates"},
      obj_text(scan()));
  CHECK(ended.code == 4);
  const Json report = Json::parse(ended.out);
  CHECK(report["command"] == "repair");
  CHECK(report["wanted"] == Json::array({"duplicates", "unused"}));
  CHECK(report["repairs"].size() == 1);  // the vertex that nobody uses goes on reading
  CHECK(report["inspection"]["mappable"] == false);
  CHECK(report["losses"].size() == 1);  // with the file's name, as of other subcommands
  CHECK_THAT(report["losses"][0].get<std::string>(),
             StartsWith("a.off: not carried: source_vertex"));
  CHECK_THAT(ended.err, Contains("a.off: not carried: source_vertex"));
  CHECK(report["outputs"]["mesh"] == folder / "a.off");
}

TEST_CASE("repair command: faces of more corners are cut into triangles, which is told") {
  const Folder folder;
  const std::string cube =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const Ended ended = sphparam_program({"repair", "-", "-o", folder / "a.obj"}, cube);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("6 faces of more than three corners, which are cut into"));
  CHECK(read_mesh(folder / "a.obj").mesh.face_count() == 12);
  const Ended again = sphparam_program({"repair", folder / "a.obj", "-o", folder / "b.obj"});
  CHECK_THAT(again.err, !Contains("corners"));
}

TEST_CASE("repair command: a map stays with a mesh that needs nothing, and with no other") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", same = folder / "same.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(icosphere(2))).code == 0);
  REQUIRE(sphparam_program({"repair", map, "-o", same}).code == 0);
  CHECK(bytes_of(same) == bytes_of(map));
  MeshFile hurt = read_mesh(map);
  hurt.mesh.triangles.conservativeResize(hurt.mesh.face_count() - 1, 3);
  write_bytes(folder / "hurt.ply", serialise_ply(hurt));
  const Ended ended = sphparam_program({"repair", folder / "hurt.ply", "-o", same});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("not carried: its map"));
  CHECK_FALSE(read_sphere(read_mesh(same)).has_value());
}

TEST_CASE("repair command: vertices without a place are read to be dropped, in text and in bytes") {
  const Folder folder;
  TriangleMesh mesh = icosphere(2);
  std::string text = obj_text(mesh);
  const size_t first = text.find('\n');
  text = "v nan 0 inf" + text.substr(first);
  CHECK(sphparam_program({"map", "-", "-o", "-"}, text).code == 3);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes"}, text).code == 3);
  CHECK(sphparam_program({"map", "-", "-o", folder / "map.sph.ply", "--repair"}, text).code == 0);
  const Ended ended = sphparam_program({"repair", "-", "-o", folder / "a.ply"}, text);
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("1 vertex dropped whose coordinates were no finite numbers"));
  mesh.positions(0, 1) = std::numeric_limits<double>::infinity();
  MeshFile file;
  file.mesh = mesh;
  write_bytes(folder / "b.ply", serialise_ply(file));
  write_bytes(folder / "b.vtp", serialise_mesh("b.vtp", file));
  for (const char* name : {"b.ply", "b.vtp"}) {
    CHECK(sphparam_program({"repair", folder / name, "-o", folder / "c.ply"}).code == 0);
    CHECK(read_mesh(folder / "c.ply").mesh.triangles == read_mesh(folder / "a.ply").mesh.triangles);
  }
}

TEST_CASE("repair command: --weld takes what is near for what is there, and only where asked") {
  TriangleMesh mesh = icosphere(2);
  const int copy = static_cast<int>(mesh.vertex_count());
  mesh.positions.conservativeResize(copy + 1, 3);
  mesh.positions.row(copy) = mesh.positions.row(mesh.triangles(0, 0)) * 1.0001;
  mesh.triangles(0, 0) = copy;
  const Folder folder;
  const Ended asked =
      sphparam_program({"repair", "-", "-o", folder / "a.ply", "--weld", "0.1%"}, obj_text(mesh));
  CHECK(asked.code == 0);
  CHECK_THAT(asked.err, Contains("1 boundary vertex welded"));
  CHECK(read_mesh(folder / "a.ply").mesh.vertex_count() == copy);
  CHECK_THAT(sphparam_program({"repair", "-", "-o", folder / "b.ply"}, obj_text(mesh)).err,
             !Contains("welded"));
  for (const char* wrong : {"-1", "nan", "x", "inf"})
    CHECK(sphparam_program({"repair", "-", "-o", folder / "c.ply", "--weld", wrong}).code == 2);
}

TEST_CASE("repair command: a name of no format, or one that is read, is refused before work") {
  const Ended ended = sphparam_program({"repair", "-", "-o", "a.fbx"}, "");
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("written as .ply") || Contains("written as .obj"));
  CHECK(sphparam_program({"repair", "-", "-o", "a.ply", "--loops", "a.ply"}, "").code == 2);
}

TEST_CASE("repair command: an STL is written for printers, and what it does not hold is told") {
  using Names = std::vector<std::string>;
  const Folder folder;
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  const std::string stl = folder / "a.stl";
  const Ended ended = sphparam_program({"repair", "-", "-o", stl}, obj_text(mesh));
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("not carried: numbers of vertices: triangles there have corners of "
                      "their own"));
  CHECK(bytes_of(stl).size() == 84 + 50 * 80);
  const MeshFile read = read_mesh(stl);
  CHECK(read.format == "STL binary");
  CHECK(read.mesh.vertex_count() == 42);
  CHECK(sphparam_program({"map", stl, "-o", folder / "a.sph.ply"}).code == 0);
  for (const Names& words :
       {Names{"remesh", folder / "a.sph.ply", "--grid", "ico:2"}, Names{"wrap", stl}}) {
    Names arguments = words;
    arguments.insert(arguments.end(), {"-o", folder / "b.stl"});
    CHECK(sphparam_program(arguments).code == 0);
    CHECK(read_mesh(folder / "b.stl").format == "STL binary");
    CHECK(sphparam_program({"info", folder / "b.stl"}).code == 0);
  }
}

TEST_CASE("repair: an OBJ keeps the name of its material library, as it is called from there") {
  const Folder folder;
  std::filesystem::create_directory(folder / "out");
  write_bytes(folder / "a.mtl", "newmtl p\nKd 1 0 0\n");
  write_bytes(folder / "a.obj", "mtllib a.mtl\nusemtl p\n" + obj_text(icosphere(1)));
  for (const auto& [made, line] :
       {std::pair("b.obj", "mtllib a.mtl\n"), std::pair("out/b.obj", "mtllib ../a.mtl\n")}) {
    const Ended ended = sphparam_program({"repair", folder / "a.obj", "-o", folder / made});
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, !Contains("colours and textures"));
    CHECK_THAT(bytes_of(folder / made), Contains(line) && Contains("usemtl p\n"));
  }
}

TEST_CASE(
    "repair: a material library that is a link is called by the link, not by where it leads") {
  const Folder folder;
  std::filesystem::create_directory(folder / "store");
  write_bytes(folder / "store/5f3a.mtl", "newmtl p\nKd 1 0 0\n");
  std::filesystem::create_symlink("store/5f3a.mtl", folder / "a.mtl");
  write_bytes(folder / "a.obj", "mtllib a.mtl\nusemtl p\n" + obj_text(icosphere(1)));
  CHECK(sphparam_program({"repair", folder / "a.obj", "-o", folder / "b.obj"}).code == 0);
  CHECK_THAT(bytes_of(folder / "b.obj"), Contains("mtllib a.mtl\n"));
}

}  // namespace sphparam::tests
