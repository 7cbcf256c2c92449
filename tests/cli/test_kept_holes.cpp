#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

/// A ball, longer than wide, that is open at the top; without its unused vertices.
TriangleMesh bowl() {
  const TriangleMesh ball = icosphere(3);
  std::vector<Vertex> name(static_cast<size_t>(ball.vertex_count()), -1);
  TriangleMesh mesh{Points(ball.vertex_count(), 3), Triangles(ball.face_count(), 3)};
  Vertex vertices = 0;
  Face faces = 0;
  for (Face f = 0; f < ball.face_count(); ++f) {
    const Vector3 sum = ball.position(ball.triangles(f, 0)) + ball.position(ball.triangles(f, 1)) +
                        ball.position(ball.triangles(f, 2));
    if (sum.z() > 0.6) continue;
    for (int k = 0; k < 3; ++k) {
      const Vertex v = ball.triangles(f, k);
      if (name[static_cast<size_t>(v)] < 0) {
        name[static_cast<size_t>(v)] = vertices;
        mesh.positions.row(vertices++) << ball.positions(v, 0), ball.positions(v, 1),
            2 * ball.positions(v, 2);
      }
      mesh.triangles(faces, k) = name[static_cast<size_t>(v)];
    }
    ++faces;
  }
  mesh.positions.conservativeResize(vertices, 3);
  mesh.triangles.conservativeResize(faces, 3);
  return mesh;
}

/// The bowl with its map in a folder.
struct MappedBowl {
  Folder folder;
  std::string mesh = folder / "bowl.obj", map = folder / "bowl.sph.ply",
              json = folder / "bowl.json";
  Ended ended;

  MappedBowl() {
    write_bytes(mesh, obj_text(bowl()));
    ended = sphparam_program({"map", mesh, "-o", map, "--keep-holes", "--json", json});
  }
};

/// Bodies beside each other.
TriangleMesh together(const std::vector<TriangleMesh>& bodies) {
  TriangleMesh all;
  for (const TriangleMesh& body : bodies) {
    const Eigen::Index vertices = all.vertex_count(), faces = all.face_count();
    all.positions.conservativeResize(vertices + body.vertex_count(), 3);
    all.triangles.conservativeResize(faces + body.face_count(), 3);
    all.positions.bottomRows(body.vertex_count()) =
        (body.positions.array() + static_cast<double>(10 * faces)).matrix();
    all.triangles.bottomRows(body.face_count()) =
        (body.triangles.array() + static_cast<int>(vertices)).matrix();
  }
  return all;
}

}  // namespace

TEST_CASE("kept holes: map closes them, certifies, marks, and tells what they take") {
  const MappedBowl bowl;
  INFO(bowl.ended.err);
  REQUIRE(bowl.ended.code == 0);
  CHECK_THAT(bowl.ended.err, Contains("1 hole kept") && Contains("of the sphere"));
  const Json report = Json::parse(bytes_of(bowl.json));
  CHECK(report["filler_share"].get<double>() > 0);
  CHECK(report["filler_share"].get<double>() <= 0.02);
  CHECK_THAT(bytes_of(bowl.map), Contains("property uchar filler") && Contains("sphparam fillers"));
  const Ended verified = sphparam_program({"verify", bowl.map});
  CHECK(verified.code == 0);
  CHECK_THAT(verified.out, Contains("fillers, proved with the rest"));
  // Not the least change of the surface.
  const Ended same = sphparam_program({"measure", bowl.mesh, bowl.map, "--max-distance", "0"});
  CHECK(same.code == 0);
  CHECK_THAT(same.err, Contains("fillers left out"));
}

TEST_CASE("kept holes: a share that is asked for is kept to, without a map they are told") {
  const MappedBowl bowl;
  const std::string other = bowl.folder / "other.sph.ply", json = bowl.folder / "other.json";
  REQUIRE(
      sphparam_program({"map", bowl.mesh, "-o", other, "--keep-holes=12%", "--json", json, "-q"})
          .code == 0);
  const double share = Json::parse(bytes_of(json))["filler_share"];
  CHECK(share > 0.02);
  CHECK(share <= 0.12);
  const Ended refused = sphparam_program({"map", bowl.mesh, "-o", other});
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("With --keep-holes holes stay holes"));
}

TEST_CASE("kept holes: a table of remesh marks rows that lie in them, or leaves them out") {
  const MappedBowl bowl;
  const std::string table = bowl.folder / "t.csv";
  std::vector<std::string> words = {"remesh", bowl.map, "--grid", "healpix:16", "--csv", table};
  const auto rows = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') - 1;
  };
  const Ended marked = sphparam_program(words);
  INFO(marked.err);
  REQUIRE(marked.code == 0);
  const std::string all = bytes_of(table);
  CHECK_THAT(all, Catch::StartsWith("vertex,theta,phi,x,y,z,filler\n"));
  CHECK(rows(all) == 3072);
  long in_holes = 0;
  for (size_t at = 0; (at = all.find(",1\n", at)) != std::string::npos; ++at) ++in_holes;
  CHECK(in_holes > 1);
  CHECK_THAT(marked.err, Contains("t.csv: " + std::to_string(in_holes) + " rows lie in holes: 1 "));
  words.insert(words.end(), {"--holes", "drop"});
  const Ended left = sphparam_program(words);
  CHECK(left.code == 0);
  CHECK_THAT(left.err, Contains(std::to_string(in_holes) + " rows lie in holes: left out"));
  CHECK(rows(bytes_of(table)) == 3072 - in_holes);
  CHECK_THAT(bytes_of(table), Catch::StartsWith("vertex,theta,phi,x,y,z\n"));
}

TEST_CASE("kept holes: bake leaves their texels transparent, and has a mask of them") {
  const MappedBowl bowl;
  const Ended baked = sphparam_program({"bake", bowl.map, "--map", "normal-object,area,mask",
                                        "--size", "64", "-o", bowl.folder / "b_{map}.png"});
  INFO(baked.err);
  REQUIRE(baked.code == 0);
  constexpr size_t colour_type = 25;  // in a PNG's header: 0 grey, 4 with alpha, 6 RGB with alpha
  CHECK(bytes_of(bowl.folder / "b_normal-object.png")[colour_type] == 6);
  CHECK(bytes_of(bowl.folder / "b_area.png")[colour_type] == 4);
  CHECK(bytes_of(bowl.folder / "b_mask.png")[colour_type] == 0);
  for (const std::string map : {"normal-object", "area", "ao"}) {
    INFO(map);
    const Ended jpeg = sphparam_program(
        {"bake", bowl.map, "--map", map, "--size", "64", "-o", bowl.folder / "b.jpg"});
    CHECK(jpeg.code == 2);
    CHECK_THAT(jpeg.err, Contains("jpeg images have no alpha, which " + map));
    for (const char* name : {"b.tif", "b.exr"})
      CHECK(sphparam_program(
                {"bake", bowl.map, "--map", map, "--size", "64", "-o", bowl.folder / name})
                .code == 0);
  }
  CHECK(sphparam_program(
            {"bake", bowl.map, "--map", "mask", "--size", "64", "-o", bowl.folder / "m.jpg"})
            .code == 0);
}

TEST_CASE("kept holes: paint colours the surface alone where a format has no place for the marks") {
  const MappedBowl bowl;
  const std::string image = bowl.folder / "axes.png";
  REQUIRE(sphparam_program({"bake", bowl.map, "--map", "axes", "--size", "64", "-o", image}).code ==
          0);
  const auto painted = [&](const std::string& file) {
    const Ended ended = sphparam_program({"paint", bowl.map, "--image", image, "-o", file});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const bool alone = ended.err.find("the surface alone: ") != std::string::npos &&
                       ended.err.find("of holes left out") != std::string::npos;
    return std::pair(alone, Json::parse(sphparam_program({"info", file, "--json", "-"}).out));
  };
  for (const char* name : {"p.obj", "p.off"}) {
    const auto [alone, info] = painted(bowl.folder / name);
    CHECK(alone);
    CHECK(info["inspection"]["boundary_loops"] == 1);
    CHECK(info["inspection"]["triangles"] == tests::bowl().face_count());
  }
  const auto [alone, info] = painted(bowl.folder / "p.ply");
  CHECK_FALSE(alone);
  CHECK(info["fillers"]["holes"] == 1);
}

TEST_CASE("kept holes: export has the surface alone") {
  const MappedBowl bowl;
  for (const char* name : {"e.glb", "e.obj", "e.ply"}) {
    const std::string file = bowl.folder / name;
    const Ended exported = sphparam_program({"export", bowl.map, "-o", file, "--up", "y"});
    INFO(name << "\n" << exported.err);
    REQUIRE(exported.code == 0);
    CHECK(sphparam_program({"measure", bowl.mesh, file, "--max-distance", "0.00001"}).code == 0);
  }
}

TEST_CASE(
    "kept holes: remesh keeps them marked in a map, and drops them elsewhere, or as is asked") {
  const MappedBowl bowl;
  const auto loops = [](const std::string& file) {
    return sphparam_program({"info", file, "--json", "-"}).out;
  };
  const std::string map = bowl.folder / "r.sph.ply", open = bowl.folder / "r.obj",
                    closed = bowl.folder / "k.obj", surface = bowl.folder / "d.ply";
  const auto remesh = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"remesh", bowl.map, "--grid", "ico:5"});
    return sphparam_program(arguments);
  };
  REQUIRE(remesh({"-o", map}).code == 0);
  CHECK_THAT(sphparam_program({"verify", map}).out, Contains("fillers, proved with the rest"));
  const Ended dropped = remesh({"-o", open});
  CHECK(dropped.code == 0);
  CHECK_THAT(dropped.err, Contains("the surface alone"));
  CHECK(Json::parse(loops(open))["inspection"]["boundary_loops"] == 1);
  CHECK(remesh({"-o", closed, "--holes", "keep"}).code == 0);
  CHECK(Json::parse(loops(closed))["inspection"]["boundary_loops"] == 0);
  CHECK(remesh({"-o", surface, "--holes", "drop", "--transfer", "none"}).code == 0);
  CHECK(Json::parse(loops(surface))["inspection"]["boundary_loops"] == 1);
}

TEST_CASE("kept holes: a remeshed sheet is one piece with one boundary, however jagged") {
  const MappedBowl bowl;
  const std::string open = bowl.folder / "r.obj", json = bowl.folder / "r.json";
  for (const std::string grid : {"ico:4", "ico:5", "ico:6", "uv:100x50"}) {
    INFO(grid);
    REQUIRE(sphparam_program({"remesh", bowl.map, "--grid", grid, "-o", open}).code == 0);
    sphparam_program({"info", open, "--json", json});
    const Json inspection = Json::parse(bytes_of(json))["inspection"];
    CHECK(inspection["boundary_loops"] == 1);
    CHECK(inspection["components"] == 1);
    CHECK(inspection["euler_characteristic"] == 1);  // touches itself nowhere
  }
}

TEST_CASE("kept holes: repair writes the surface alone where a format has no place for the marks") {
  const Folder folder;
  const std::string mesh = folder / "bowl.obj";
  write_bytes(mesh, obj_text(bowl()));
  for (const char* name : {"m.obj", "m.off"}) {
    const Ended ended = sphparam_program({"repair", mesh, "--keep-holes", "-o", folder / name});
    INFO(ended.err);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, Contains("the surface alone: ") && Contains("fillers of holes left out"));
    const Json info = Json::parse(sphparam_program({"info", folder / name, "--json", "-"}).out);
    CHECK(info["inspection"]["boundary_loops"] == 1);
    CHECK(info["inspection"]["triangles"] == bowl().face_count());
  }
}

TEST_CASE("kept holes: info leaves fillers out of the area, and says what they close") {
  const MappedBowl bowl;
  const auto info = [](const std::string& file) {
    return Json::parse(sphparam_program({"info", file, "--json", "-"}).out);
  };
  const Json closed = info(bowl.map), open = info(bowl.mesh);
  CHECK(closed["fillers"]["holes"] == 1);
  CHECK(closed["fillers"]["triangles"].get<long>() ==
        closed["input"]["triangles"].get<long>() - open["input"]["triangles"].get<long>());
  CHECK(open["fillers"].is_null());
  CHECK(closed["inspection"]["area"].get<double>() ==
        Approx(open["inspection"]["area"].get<double>()).epsilon(1e-9));
  CHECK_THAT(sphparam_program({"info", bowl.map}).out,
             Contains("closing 1 hole; no surface") && Contains(", fillers included\n") &&
                 Contains("With its fillers a closed genus-0 mesh: it can be mapped."));
}

TEST_CASE("kept holes: remesh tells where a grid is too coarse for them, and only there") {
  const Folder folder;
  const std::string mesh = folder / "m.obj", map = folder / "m.sph.ply";
  TriangleMesh two_holes = bowl();
  Face lowest = 0;
  const auto height = [&](Face f) {
    const auto corners = two_holes.triangles.row(f);
    return two_holes.positions(corners[0], 2) + two_holes.positions(corners[1], 2) +
           two_holes.positions(corners[2], 2);
  };
  for (Face f = 1; f < two_holes.face_count(); ++f) {
    if (height(f) < height(lowest)) lowest = f;
  }
  two_holes.triangles.row(lowest) = two_holes.triangles.row(two_holes.face_count() - 1);
  two_holes.triangles.conservativeResize(two_holes.face_count() - 1, 3);
  write_bytes(mesh, obj_text(two_holes));
  REQUIRE(sphparam_program({"map", mesh, "-o", map, "--keep-holes", "-q"}).code == 0);
  const auto told = [&](const std::string& grid) {
    const Ended ended =
        sphparam_program({"remesh", map, "--grid", grid, "-o", folder / "r.sph.ply"});
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told("ico:0"), Contains("2 holes before, ") && Contains("a finer grid"));
  CHECK_THAT(told("ico:7"), !Contains("a finer grid"));
}

TEST_CASE("kept holes: a body that is inside out is turned over, a sheet stays as it is") {
  const Folder folder;
  const auto turned = [&](TriangleMesh mesh) {
    mesh.triangles.col(0).swap(mesh.triangles.col(1));
    write_bytes(folder / "m.obj", obj_text(mesh));
    const Ended ended = sphparam_program(
        {"repair", folder / "m.obj", "--keep-holes", "--repair", "-o", folder / "m.ply"});
    CHECK(ended.code == 0);
    return ended.err.find("it was inside out") != std::string::npos;
  };
  CHECK(turned(bowl()));
  TriangleMesh sheet{Points(4, 3), Triangles(2, 3)};
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0;
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  const bool as_given = turned(sheet);
  CHECK_FALSE(as_given);
  sheet.triangles.col(0).swap(sheet.triangles.col(1));
  CHECK_FALSE(turned(sheet));
}

TEST_CASE("kept holes: what makes no sense is refused") {
  const MappedBowl bowl;
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"map", bowl.mesh, "-o", bowl.folder / "x.sph.ply"});
    return sphparam_program(arguments).code;
  };
  CHECK(refused({"--keep-holes", "--max-hole", "20"}) == 2);
  for (const char* share : {"0", "-1", "101%", "much"}) {
    CHECK(refused({std::string("--keep-holes=") + share}) == 2);
  }
}

TEST_CASE("parts: each is mapped into a file of its own, the largest first") {
  const Folder folder;
  const std::string mesh = folder / "two.obj", json = folder / "two.json";
  TriangleMesh large = icosphere(1);
  large.positions *= 3;
  write_bytes(mesh, obj_text(together({icosphere(2), large})));
  const Ended ended = sphparam_program(
      {"map", mesh, "-o", folder / "two.sph.ply", "--all-components", "--json", json});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(folder.names() ==
        std::vector<std::string>{"two.json", "two.obj", "two_0001.sph.ply", "two_0002.sph.ply"});
  for (const char* name : {"two_0001.sph.ply", "two_0002.sph.ply"}) {
    CHECK(sphparam_program({"verify", folder / name, "-q"}).code == 0);
  }
  const Json parts = Json::parse(bytes_of(json))["parts"];
  REQUIRE(parts.size() == 2);
  CHECK(parts[0]["input"]["triangles"] == 80);
  CHECK(parts[1]["input"]["triangles"] == 320);
  CHECK(parts[0]["poles"]["north"].get<int>() >= 162);  // by its number in the file
}

TEST_CASE("parts: all are baked and exported in one go, each with what is its own") {
  const Folder folder;
  const std::string mesh = folder / "two.obj", map = folder / "two.sph.ply";
  write_bytes(mesh, obj_text(together({icosphere(2), icosphere(1)})));
  REQUIRE(sphparam_program({"map", mesh, "-o", map, "--all-components"}).code == 0);
  fs::remove(mesh);
  const Ended baked =
      sphparam_program({"bake", map, "--all-components", "--map", "axes,position", "-o",
                        folder / "two_{map}.png", "--size", "32", "--json", folder / "two.json"});
  INFO(baked.err);
  REQUIRE(baked.code == 0);
  CHECK(Json::parse(bytes_of(folder / "two.json"))["parts"].size() == 2);
  fs::remove(folder / "two.json");
  const Ended exported = sphparam_program({"export", map, "--all-components", "--image",
                                           folder / "two_axes.png", "-o", folder / "two.glb"});
  INFO(exported.err);
  REQUIRE(exported.code == 0);
  CHECK(folder.names() ==
        std::vector<std::string>{"two_0001.glb", "two_0001.sph.ply", "two_0002.glb",
                                 "two_0002.sph.ply", "two_axes_0001.png", "two_axes_0002.png",
                                 "two_position_0001.png", "two_position_0002.png"});
  CHECK(bytes_of(folder / "two_0001.glb") != bytes_of(folder / "two_0002.glb"));
  fs::create_directory(folder / "images");
  CHECK(sphparam_program({"bake", map, "--all-components", "--map", "axes", "-o",
                          folder / "images/", "--size", "32"})
            .code == 0);
  CHECK(fs::exists(folder / "images/two_0002_axes.png"));
  fs::remove(folder / "two_0001.sph.ply");
  const Ended lone = sphparam_program(
      {"bake", map, "--all-components", "--map", "axes", "-o", folder / "images/", "--size", "32"});
  CHECK(lone.code == 0);
  CHECK_THAT(lone.err, Contains("--all-components: 1 of 2 parts are there: no " +
                                (folder / "two_0001.sph.ply")));
}

TEST_CASE("parts: where there are none, or one of them is broken, nothing is written") {
  const Folder folder;
  const std::string map = folder / "two.sph.ply";
  for (const char* command : {"bake", "export"}) {
    const Ended none =
        sphparam_program({command, map, "--all-components", "-o",
                          folder / (command == std::string("bake") ? "a.png" : "a.glb")});
    CHECK(none.code == 2);
    CHECK_THAT(none.err, Contains("two_0001.sph.ply") && Contains("map MESH --all-components"));
  }
  write_bytes(folder / "one.obj", obj_text(icosphere(1)));
  REQUIRE(sphparam_program({"map", folder / "one.obj", "-o", folder / "two_0001.sph.ply"}).code ==
          0);
  write_bytes(folder / "two_0003.sph.ply", "ply\n");
  const Ended broken = sphparam_program(
      {"bake", map, "--all-components", "--map", "axes", "-o", folder / "a.png", "--size", "16"});
  CHECK(broken.code == 3);
  CHECK_THAT(broken.err, Contains("two_0003.sph.ply"));
  CHECK(folder.names() ==
        std::vector<std::string>{"one.obj", "two_0001.sph.ply", "two_0003.sph.ply"});
  CHECK(sphparam_program({"export", map, "--all-components", "-o", "-"}).code == 2);
}

TEST_CASE("parts: files of an earlier run are told, and not taken for parts of this one") {
  const Folder folder;
  const std::string map = folder / "m.sph.ply", three = folder / "three.obj",
                    two = folder / "two.obj";
  TriangleMesh large = icosphere(1);
  large.positions *= 2;
  write_bytes(three, obj_text(together({icosphere(2), icosphere(1), icosphere(0)})));
  write_bytes(two, obj_text(together({icosphere(1), large})));
  REQUIRE(sphparam_program({"map", three, "-o", map, "--all-components"}).code == 0);
  CHECK_THAT(bytes_of(folder / "m_0002.sph.ply"), Contains("sphparam component 2 of 3 of "));
  const Ended second = sphparam_program({"map", two, "-o", map, "--all-components"});
  CHECK(second.code == 0);
  CHECK_THAT(second.err, Contains("m_0003.sph.ply is of an earlier run"));
  const std::vector<std::string> before = folder.names();
  for (const char* command : {"bake", "export"}) {
    const std::string output = folder / (command == std::string("bake") ? "a.png" : "a.glb");
    const Ended mixed = sphparam_program({command, map, "--all-components", "-o", output});
    CHECK(mixed.code == 2);
    CHECK_THAT(mixed.err, Contains("m_0003.sph.ply is of another run of map than"));
  }
  CHECK(folder.names() == before);
  fs::remove(folder / "m_0003.sph.ply");
  CHECK(sphparam_program({"export", map, "--all-components", "-o", folder / "a.glb"}).code == 0);
  CHECK(fs::exists(folder / "a_0002.glb"));
}

TEST_CASE("parts: one that cannot be mapped ends it, but for specks, which are told") {
  const Folder folder;
  const std::string mesh = folder / "m.obj", map = folder / "m.sph.ply";
  TriangleMesh ring = bumped_torus(8, 20, 0.4, 0, 1);
  write_bytes(mesh, obj_text(together({icosphere(2), ring})));
  const Ended refused = sphparam_program({"map", mesh, "-o", map, "--all-components", "--repair"});
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("component 1 of 2") && Contains("m_0002.sph.ply, once all") &&
                              Contains("cannot be mapped: nothing is written, not even"));
  CHECK(folder.names() == std::vector<std::string>{"m.obj"});

  ring.positions *= 0.05;
  write_bytes(mesh, obj_text(together({icosphere(2), ring})));
  const Ended told = sphparam_program({"map", mesh, "-o", map, "--all-components", "--repair"});
  INFO(told.err);
  CHECK(told.code == 0);
  CHECK_THAT(told.err, Contains("left out: component 2 of 2") && Contains("  1 map written\n"));
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "m_0001.sph.ply"});
  CHECK(sphparam_program({"map", mesh, "-o", map, "--all-components"}).code == 4);
  CHECK(sphparam_program({"map", mesh, "-o", "-", "--all-components"}).code == 2);
  CHECK(sphparam_program({"map", mesh, "-o", map, "--all-components", "--component", "1"}).code ==
        2);
}

TEST_CASE(
    "kept holes: a pole in the middle of what closes one is called so, one rim for two is told") {
  const Folder folder;
  const std::string mesh = folder / "bowl.obj", map = folder / "bowl.sph.ply";
  write_bytes(mesh, obj_text(bowl()));
  const Ended open = sphparam_program({"map", mesh, "-o", map, "--keep-holes", "--up", "z"});
  INFO(open.err);
  CHECK(open.code == 0);
  CHECK_THAT(open.err, Contains("  a vertex that closes a hole and vertex ") &&
                           Contains(" at ±z: ") && !Contains("-1") && !Contains("one hole"));
  // What is left of a ball above the middle has both sides on its rim.
  TriangleMesh cap = bowl();
  std::string text, faces;
  for (const auto& x : cap.positions.rowwise())
    text += "v " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) +
            "\n";
  for (const auto& f : cap.triangles.rowwise())
    if (cap.positions(f[0], 2) < -0.5)
      text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " +
              std::to_string(f[2] + 1) + "\n";
  write_bytes(mesh, text);
  const Ended both = sphparam_program({"map", mesh, "-o", map, "--keep-holes", "--up", "x"});
  INFO(both.err);
  CHECK(both.code == 0);
  CHECK_THAT(both.err, Contains("warning: top and bottom both lie on the rim of one hole that is "
                                "kept: ") &&
                           Contains("--poles auto"));
}

TEST_CASE("kept holes: what is advised for --sphere keeps them too, and can be typed") {
  const MappedBowl bowl;
  const std::string low = bowl.folder / "low.obj";
  std::vector<std::string> words = {"remesh", bowl.mesh, "--sphere", bowl.map,
                                    "--grid", "ico:2",   "-o",       low};
  const Ended refused = sphparam_program(words);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("  --sphere has a map of this mesh with its holes kept: "
                                   "`sphparam remesh ") &&
                              Contains(low + " --repair --keep-holes`") && !Contains("max-hole"));
  words.insert(words.end(), {"--repair", "--keep-holes"});
  const Ended done = sphparam_program(words);
  INFO(done.err);
  CHECK(done.code == 0);
}

}  // namespace sphparam::tests
