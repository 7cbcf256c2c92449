#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mapped.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "support/glb_json.h"
#include "support/test_meshes.h"

/// `sphparam remesh` and `sphparam unimage`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("remesh: every grid is written certified, and reported") {
  const Mapped mapped;
  for (const std::string& grid : Names{"ico:3", "ico:f=5", "octa:17", "cube:6", "uv:16x9",
                                       "healpix:4", "like:" + mapped.path}) {
    INFO(grid);
    const std::string out = mapped.folder / "new.sph.ply", json = mapped.folder / "new.json";
    const Ended ended = mapped.remesh({"--grid", grid, "-o", out, "--json", json});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", out}).code == 0);
    CHECK(Json::parse(bytes_of(json))["grid"]["name"] == grid);
  }
}

TEST_CASE("remesh: floats that may be labels are told to be averaged, and labels are not") {
  const Folder folder;
  const TriangleMesh ball = icosphere(2);
  const auto told = [&](ScalarType type, double step) {
    Property classes{"scalar_Class", type, {}};
    for (Vertex v = 0; v < ball.vertex_count(); ++v)
      classes.values.push_back(ball.positions(v, 2) > 0 ? step : 2);
    MeshFile file;
    file.mesh = ball;
    file.set_vertex_property(std::move(classes));
    write_mesh(folder / "ball.ply", file);
    const Ended ended = sphparam_program(
        {"remesh", folder / "ball.ply", "--grid", "octa:9", "-o", folder / "new.ply"});
    REQUIRE(ended.code == 0);
    return ended.err;
  };
  const std::string hint = "scalar_Class: whole numbers in floats are averaged, ";
  CHECK_THAT(told(ScalarType::Float32, 5),
             Contains(hint) && Contains("`property int scalar_Class` in a PLY"));
  CHECK_THAT(told(ScalarType::Float32, 5.5), !Contains(hint));
  CHECK_THAT(told(ScalarType::Int32, 5), !Contains(hint));
}

TEST_CASE("remesh --within: the coarsest grid that measure finds near enough") {
  const Folder folder;
  TriangleMesh egg = icosphere(3);
  egg.positions.col(2) *= 1.5;
  const std::string mesh = folder / "egg.obj", map = folder / "egg.sph.ply";
  const std::string out = folder / "new.sph.ply";
  write_bytes(mesh, obj_text(egg));
  REQUIRE(sphparam_program({"map", mesh, "-o", map}).code == 0);
  const auto remesh = [&](Names words) {
    words.insert(words.begin(), {"remesh", map, "-o", out});
    return sphparam_program(words);
  };
  const Ended ended = remesh({"--grid", "ico", "--within", "2%", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json json = Json::parse(ended.out);
  CHECK(json["within"]["held"] == true);
  CHECK(json["grid"]["name"] == "ico:2");
  CHECK_THAT(ended.err, Contains("  ico:2: at most ") && Contains(": ico:2, 162 vertices"));
  const auto measured = [&] {
    return sphparam_program({"measure", map, out, "--max-distance", "2%"}).code;
  };
  CHECK(measured() == 0);
  REQUIRE(remesh({"--grid", "ico:1"}).code == 0);
  CHECK(measured() == 6);
  const std::vector<Names> refused = {{"--grid", "ico:3"},
                                      {"--grid", "ico", "--lods", "1"},
                                      {"--grid", "ico", "--adaptive"},
                                      {"--grid", "ico", "--uv", "grid"}};
  for (Names words : refused) {
    words.insert(words.end(), {"--within", "2%"});
    CHECK(remesh(words).code == 2);
  }
}

TEST_CASE("remesh: a .glb holds the grid's chart, one-to-one, and the colours carried") {
  const Folder folder;
  const std::string mesh = folder / "shape.ply", glb = folder / "new.GLB";
  write_bytes(mesh,
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
              "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 9 9 9\n"
              "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const auto gltf = [&](const std::string& grid, const std::string& carried) {
    const Ended ended =
        sphparam_program({"remesh", mesh, "--grid", grid, "--transfer", carried, "-o", glb});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return json_of(bytes_of(glb));
  };
  for (const char* grid : {"ico:2", "octa:9", "cube:4", "uv:8x5", "healpix:2"}) {
    INFO(grid);
    const Json file = gltf(grid, "all");
    CHECK(file["asset"]["extras"]["sphparam"]["chart_as_stored"] == "one-to-one");
    CHECK(file["asset"]["extras"]["sphparam"]["map_grid"] == grid);
    const Json& attributes = file["meshes"][0]["primitives"][0]["attributes"];
    CHECK(attributes.contains("TEXCOORD_0"));
    CHECK(attributes.contains("COLOR_0"));
  }
  const Json bare = gltf("ico:2", "none");
  CHECK_FALSE(bare["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  CHECK(bare["materials"][0]["name"] == "checker");
}

TEST_CASE("remesh: as USD the grid's chart too, levels in files of their own") {
  const Mapped mapped;
  const std::string out = mapped.folder / "u.usda";
  REQUIRE(mapped.remesh({"--grid", "ico:2", "--lods", "1", "-o", out}).code == 0);
  CHECK_THAT(bytes_of(out), Contains("string map_grid = \"ico:2\"\n") &&
                                Contains("string chart_as_stored = \"one-to-one\"\n") &&
                                Contains("@./u_checker.png@"));
  CHECK_THAT(bytes_of(mapped.folder / "u_lod1.usda"),
             Contains("string map_grid = \"ico:1\"\n") && Contains("@./u_lod1_checker.png@"));
}

TEST_CASE("remesh: the same bytes for one thread and three") {
  const Mapped mapped;
  for (const std::string& kind : Names{".ply", ".glb", ".usdz"}) {
    INFO(kind);
    for (const std::string& threads : Names{"1", "3"}) {
      const std::string out = mapped.folder / (threads + kind);
      CHECK(mapped.remesh({"--grid", "octa:33", "-o", out, "--threads", threads}).code == 0);
    }
    CHECK(bytes_of(mapped.folder / ("1" + kind)) == bytes_of(mapped.folder / ("3" + kind)));
  }
}

TEST_CASE("remesh: a geometry image turns back into the mesh in float32") {
  const Mapped mapped;
  for (const std::string& grid : Names{"octa:33", "cube:8"}) {
    INFO(grid);
    const std::string mesh = mapped.folder / "mesh.sph.ply", image = mapped.folder / "image.exr",
                      back = mapped.folder / "back.sph.ply";
    REQUIRE(mapped.remesh({"--grid", grid, "-o", mesh, "--geometry-image", image}).code == 0);
    const Ended ended = sphparam_program({"unimage", image, "-o", back});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", back}).code == 0);
  }
}

TEST_CASE("remesh: an .obj has the quads and the words of the .ply, levels and unimage too") {
  const Mapped mapped;
  const std::string ply = mapped.folder / "a.ply", obj = mapped.folder / "a.obj",
                    image = mapped.folder / "a.exr", back = mapped.folder / "b.obj";
  for (const std::string& grid : Names{"cube:4", "uv:8x6"}) {
    INFO(grid);
    REQUIRE(mapped.remesh({"--grid", grid, "-o", ply}).code == 0);
    REQUIRE(mapped.remesh({"--grid", grid, "-o", obj}).code == 0);
    const sphparam::MeshFile one = sphparam::read_mesh(ply), other = sphparam::read_mesh(obj);
    CHECK(other.polygons > 0);
    CHECK(other.polygons == one.polygons);
    CHECK(other.mesh.triangles == one.mesh.triangles);
    CHECK(other.mesh.positions == one.mesh.positions);
    CHECK(one.comments.back() == "sphparam verdict one-to-one");
    CHECK(other.comments == std::vector<std::string>(one.comments.begin(), one.comments.end() - 1));
    CHECK_THAT(sphparam_program({"info", obj}).out, !Contains("map method"));
    CHECK_THAT(sphparam_program({"info", ply}).out, Contains("map method"));
    CHECK(other.comments.at(1) == "sphparam method remesh");
    CHECK(other.comments.at(2) == "sphparam grid " + grid);
  }
  REQUIRE(mapped.remesh({"--grid", "cube:4", "-o", obj, "--lods", "1", "--geometry-image", image})
              .code == 0);
  CHECK(sphparam::read_mesh(mapped.folder / "a_lod1.obj").polygons == 24);
  REQUIRE(sphparam_program({"unimage", image, "-o", back}).code == 0);
  CHECK(sphparam::read_mesh(back).polygons == 96);
}

TEST_CASE("remesh: two outputs at one place are refused, however they are spelled") {
  const Mapped mapped;
  fs::create_directory(mapped.folder / "deep");
  const std::string out = mapped.folder / "new.ply", again = mapped.folder / "deep/../new.ply";
  for (const Names& more :
       {Names{"-o", out, "--csv", again}, Names{"-o", out, "--json", out},
        Names{"-o", "-", "--csv", "-"},
        Names{"-o", out, "--subdiv-fit", "loop", "--limit-mesh", again},
        Names{"-o", out, "--lods", "1", "--csv", mapped.folder / "deep/../new_lod1.ply"}}) {
    Names arguments = {"--grid", "ico:2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = mapped.remesh(arguments);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("the same file, "));
  }
  CHECK(mapped.folder.names() == Names{"deep", "shape.sph.ply"});
}

TEST_CASE("remesh: two outputs may be one device") {
  const Mapped mapped;
  CHECK(mapped
            .remesh({"--grid", "ico:2", "-o", mapped.folder / "a.ply", "--csv", "/dev/null",
                     "--json", "/dev/null"})
            .code == 0);
}

TEST_CASE("remesh: what makes no sense is refused, and nothing is written") {
  const Mapped mapped;
  const Ended nameless = mapped.remesh({"--grid", "like:", "-o", mapped.folder / "new.ply"});
  CHECK(nameless.code == 2);
  CHECK_THAT(nameless.err, Contains("--grid like: names no mesh"));
  const std::string out = mapped.folder / "new.ply";
  CHECK(mapped.remesh({"--grid", "octa:8", "-o", out}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3"}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "-o", mapped.path}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "-o", out, "--transfer", "thicknes"}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "--geometry-image", mapped.folder / "gi.exr"}).code == 2);
  CHECK(mapped.remesh({"--grid", "like:" + (mapped.folder / "none.ply"), "-o", out}).code == 3);
  CHECK(sphparam_program({"unimage", mapped.path, "-o", out}).code == 3);
  CHECK(sphparam_program({"verify", out}).code == 3);
}

TEST_CASE("remesh: an image of what vertices have not is refused before the mesh is mapped") {
  const Folder folder;
  const auto refused = [&](const std::string& image, const std::string& transfer) {
    const Ended ended = sphparam_program({"remesh", "-", "--grid", "octa:9", "--transfer", transfer,
                                          "--attribute-image", image + "=" + (folder / "a.exr")},
                                         obj_text(icosphere(1)));
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, !Contains("mapped now"));
    return ended.err;
  };
  CHECK_THAT(refused("height", "all"), Contains("--attribute-image: vertices have no height; there "
                                                "are position, normal\n"));
  CHECK_THAT(refused("color", "all"), Contains("--attribute-image: vertices have no color"));
  CHECK_THAT(refused("height", "tall"), Contains("--transfer: no property tall"));
  CHECK(folder.names().empty());
}

TEST_CASE("remesh: what faces have is in no table, which is told") {
  const Folder folder;
  const std::string mesh = folder / "shape.ply";
  write_bytes(mesh,
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nproperty float heat\nelement face 4\n"
              "property list uchar int vertex_indices\nproperty float flux\nproperty int part\n"
              "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n"
              "3 0 2 1 5 0\n3 0 1 3 6 0\n3 1 2 3 7 1\n3 0 3 2 8 1\n");
  const auto told = [&](const std::string& carried) {
    const Ended ended = sphparam_program(
        {"remesh", mesh, "--grid", "ico:1", "--transfer", carried, "--csv", folder / "t.csv"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told("all"), Contains("not carried: flux and part of faces: rows are of vertices"));
  CHECK_THAT(told("heat"), !Contains("not carried"));
}

TEST_CASE("remesh: --csv has tabs in a .tsv, and no name of another kind of table") {
  const Mapped mapped;
  const std::string commas = mapped.folder / "t.csv", tabs = mapped.folder / "t.tsv",
                    sheet = mapped.folder / "t.xlsx";
  REQUIRE(mapped.remesh({"--grid", "ico:1", "--csv", commas}).code == 0);
  REQUIRE(mapped.remesh({"--grid", "ico:1", "--csv", tabs}).code == 0);
  std::string expected = bytes_of(commas);
  std::ranges::replace(expected, ',', '\t');
  CHECK(bytes_of(tabs) == expected);
  for (const Ended& ended :
       {mapped.remesh({"--grid", "ico:1", "--csv", sheet}),
        sphparam_program({"spharm", mapped.path, "--degree", "2", "--csv", sheet})}) {
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("--csv: the table is written as .csv or .tsv, not as .xlsx"));
  }
}

TEST_CASE("remesh: --degrees has longitude and latitude in the table of --csv") {
  const Mapped mapped;
  const std::string radians = mapped.folder / "r.csv", degrees = mapped.folder / "d.csv";
  REQUIRE(mapped.remesh({"--grid", "ico:1", "--csv", radians}).code == 0);
  REQUIRE(mapped.remesh({"--grid", "ico:1", "--csv", degrees, "--degrees"}).code == 0);
  CHECK(mapped.remesh({"--grid", "ico:1", "-o", mapped.folder / "x.ply", "--degrees"}).code == 2);
  std::istringstream ours(bytes_of(radians)), theirs(bytes_of(degrees));
  std::string line, other;
  std::getline(ours, line);
  std::getline(theirs, other);
  CHECK_THAT(line, Catch::StartsWith("vertex,theta,phi,x,y,z"));
  CHECK_THAT(other, Catch::StartsWith("vertex,lon,lat,x,y,z"));
  int rows = 0;
  for (; std::getline(ours, line) && std::getline(theirs, other); ++rows) {
    double theta = 0, phi = 0, lon = 0, lat = 0;
    REQUIRE(std::sscanf(line.c_str(), "%*d,%lf,%lf", &theta, &phi) == 2);
    REQUIRE(std::sscanf(other.c_str(), "%*d,%lf,%lf", &lon, &lat) == 2);
    constexpr double degree = 180 / 3.14159265358979323846;
    CHECK(std::abs(std::remainder(lon - theta * degree, 360)) < 1e-10);
    CHECK(lat == Approx(90 - phi * degree).margin(1e-10));
    CHECK(lon > -180);
    CHECK(lon <= 180);
  }
  CHECK(rows == 42);
}

}  // namespace sphparam::tests
