#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/holed.h"
#include "support/joined.h"
#include "support/shaken.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"
#include "support/without_area.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  mesh.positions *= factor;
  return mesh;
}

/// A ball and, away from it, a coarser one whose first vertex is number 162.
TriangleMesh two_bodies(double size_of_other = 1) {
  const TriangleMesh ball = icosphere(2), other = scaled(icosphere(1), size_of_other);
  TriangleMesh mesh;
  mesh.positions.resize(ball.vertex_count() + other.vertex_count(), 3);
  mesh.positions << ball.positions, (other.positions.array() + 5).matrix();
  mesh.triangles.resize(ball.face_count() + other.face_count(), 3);
  mesh.triangles << ball.triangles,
      (other.triangles.array() + static_cast<int>(ball.vertex_count())).matrix();
  return mesh;
}

/// Quads 0 1 2 3 and 2 1 0 4 of a box-like surface share the edges 0-1 and 1-2.
const std::string doublet =
    "v 0 0 0\nv 0.5 0 0\nv 1 0 0\nv 0.5 1 0.2\nv 0.5 -1 0.2\nv 0.5 0 1\n"
    "f 1 2 3 4\nf 3 2 1 5\nf 1 4 6\nf 4 3 6\nf 3 5 6\nf 5 1 6\n";

}  // namespace

TEST_CASE("repair: a refusal says that --repair would mend it, and how, only where it would") {
  const Ended refused = sphparam_program({"map", "-", "-o", "-"}, obj_text(with_a_hole()));
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("3 boundary edges in 1 loop"));
  CHECK_THAT(refused.err, Contains("--repair would mend it") && Contains("1 hole filled"));

  // An octahedron and two of its faces: a second component, but no surface comes of one face.
  const Ended hopeless = sphparam_program({"map", "-", "-o", "-"}, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  CHECK(hopeless.code == 4);
  CHECK_THAT(hopeless.err, Contains("--repair cannot mend it"));
  CHECK_THAT(hopeless.err, !Contains("--repair would"));
}

TEST_CASE("repair: a refusal's hint keeps the options and the outputs that were typed") {
  const Folder folder;
  const std::string mesh = folder / "ring.obj", map = folder / "my own.sph.ply";
  write_bytes(mesh, obj_text(bumped_torus(8, 20, 0.4, 0, 1)));
  const Ended refused =
      sphparam_program({"map", mesh, "--repair", "--handles", "fill", "--max-handle=40%", "-o", map,
                        "--balance", "equal-area"});
  CHECK(refused.code == 4);
  INFO(refused.err);
  const std::string hint = " --balance equal-area --repair --handles fill --max-handle ";
  CHECK_THAT(refused.err, Contains("'" + map + "'" + hint) && !Contains("=40%"));
  const size_t at = refused.err.find(hint) + hint.size();
  const std::string length = refused.err.substr(at, refused.err.find('`', at) - at);
  CHECK(sphparam_program(
            {"map", mesh, "--repair", "--handles", "fill", "--max-handle", length, "-o", map})
            .code == 0);

  write_bytes(mesh, obj_text(two_bodies()));
  const Ended after = sphparam_program({"map", mesh, "--repair=components", "-o", map});
  CHECK(after.code == 4);
  CHECK_THAT(after.err, !Contains("after the repairs"));  // it did nothing
}

TEST_CASE(
    "repair: components that cannot be mapped say why, unrepaired ones are sent to --repair") {
  const Folder folder;
  const std::string mesh = folder / "m.obj", map = folder / "m.sph.ply";
  write_bytes(mesh, obj_text(with_a_hole()));
  const Ended refused = sphparam_program({"map", mesh, "--all-components", "-o", map});
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("cannot be mapped: not closed: 3 boundary edges") &&
                              Contains("--all-components -o " + map + " --repair`") &&
                              !Contains("--component 1"));
}

TEST_CASE("repair: a component without area is left out of all, and the others are mapped") {
  const Folder folder;
  const std::string mesh = folder / "m.obj", map = folder / "m.sph.ply";
  write_bytes(mesh, obj_text(joined(icosphere(2), collapsed_tetrahedron(), {9, 0, 0})));
  for (const bool repairs : {false, true}) {
    std::vector<std::string> command = {"map", mesh, "--all-components", "-o", map};
    if (repairs) command.emplace_back("--repair");
    const Ended ended = sphparam_program(command);
    INFO(ended.err);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, Contains("component 2 of 2 (0 % of the area, 4 triangles) cannot be "
                                   "mapped: ") &&
                              Contains("no area that can be measured") &&
                              Contains("1 map written") && Contains("left out: component 2 of 2"));
  }
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "m_0001.sph.ply"});
}

TEST_CASE("repair: of all components a cavity stays a cavity") {
  const Folder folder;
  TriangleMesh cavity = icosphere(1);
  cavity.positions *= 0.5;
  cavity.triangles.col(1).swap(cavity.triangles.col(2));
  TriangleMesh hollow = joined(icosphere(2), cavity, {0.25, 0, 0});
  const double outer = inspect_mesh(icosphere(2)).volume;
  const double inner = inspect_mesh(cavity).volume;
  REQUIRE(inner < 0);
  const std::string mesh = folder / "hollow.obj", out = folder / "out.sph.ply";
  const auto run = [&](const std::string& repair) {
    write_bytes(mesh, obj_text(hollow));
    const Ended ended = sphparam_program({"map", mesh, repair, "--all-components", "-o", out});
    REQUIRE(ended.code == 0);
    CHECK(inspect_mesh(read_mesh(folder / "out_0001.sph.ply").mesh).volume == Approx(outer));
    CHECK(inspect_mesh(read_mesh(folder / "out_0002.sph.ply").mesh).volume == Approx(inner));
    return ended.err;
  };
  CHECK_THAT(run("--repair"), !Contains("turned over") && !Contains("inside out"));
  hollow.triangles.col(1).swap(hollow.triangles.col(2));  // all of it, the cavity too
  for (const char* repair : {"--repair", "--repair=orientation"}) {
    const std::string told = run(repair);
    const std::string line = "the whole surface turned over: it was inside out";
    CHECK(told.find(line) != told.rfind(line));  // of both
  }
}

TEST_CASE("repair: of several components all ways are told, and each that is typed works") {
  const Folder folder;
  const std::string mesh = folder / "ringed.obj", map = folder / "m.sph.ply";
  write_bytes(mesh, obj_text(joined(icosphere(2), bumped_torus(8, 20, 0.4, 0, 1), {9, 0, 0})));
  const Ended refused = sphparam_program({"map", mesh, "-o", map});
  INFO(refused.err);
  CHECK(refused.code == 4);
  const std::string way = "--repair --all-components --max-handle ";
  REQUIRE_THAT(refused.err, Contains(way) && Contains(" maps each into a file of its own.\n") &&
                                Contains("`sphparam wrap "));
  CHECK(type_advice(refused.err, folder / ".") >= 2);
  const size_t at = refused.err.find(way) + way.size();
  const std::string length = refused.err.substr(at, refused.err.find(' ', at) - at);
  CHECK(sphparam_program(
            {"map", mesh, "-o", map, "--repair", "--all-components", "--max-handle", length})
            .code == 0);
}

TEST_CASE("repair: rings stay rings beside others, and each way that is told works") {
  const Folder folder;
  const std::string mesh = folder / "rings.obj", map = folder / "m.sph.ply";
  const TriangleMesh ring = bumped_torus(12, 24, 0.3, 0.01, 1);
  write_bytes(mesh, obj_text(joined(ring, ring, {9, 0, 0})));
  const std::string kept = folder / "kept.obj";
  const std::vector<std::vector<std::string>> commands = {
      {"repair", mesh, "-o", kept, "--repair"},
      {"map", mesh, "-o", map},
      {"map", mesh, "-o", map, "--repair"},
      {"map", mesh, "-o", map, "--repair", "--all-components"}};
  for (const std::vector<std::string>& command : commands) {
    const Ended ended = sphparam_program(command);
    INFO(ended.err);
    CHECK(ended.code == 4);
    CHECK_THAT(ended.err, Contains("--max-handle"));
    if (command.front() == "repair")
      CHECK(read_mesh(kept).mesh.face_count() == 2 * ring.face_count());
    CHECK(type_advice(ended.err, folder / ".") >= 1);
  }
}

TEST_CASE("repair: pieces that small errors keep apart are sent to --weld, which mends them") {
  const Folder folder;
  const std::string mesh = folder / "soup.obj", map = folder / "m.sph.ply";
  write_bytes(mesh, obj_text(shaken_apart(icosphere(3), 1e-5)));
  const Ended refused = sphparam_program({"map", mesh, "-o", map});
  INFO(refused.err);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("--repair --weld 0.0") && !Contains("--component"));
  CHECK(type_advice(refused.err, folder / ".") >= 1);
  const Ended told = sphparam_program({"info", mesh, "--json", "-"});
  const Json repair = Json::parse(told.out)["repair"];
  CHECK(repair["mends"] == false);
  CHECK_THAT(repair["mends_with"].get<std::string>(), Contains("--repair --weld 0.0"));
}

TEST_CASE(
    "repair: what rounding tears is sent to --weld, also where --repair is enough or was done") {
  const Folder folder;
  const std::string mesh = folder / "torn.obj", map = folder / "m.sph.ply";
  for (const double share : {0.005, 0.1}) {
    INFO(share);
    write_bytes(mesh, obj_text(torn_by_rounding(icosphere(4), share)));
    const Ended refused = sphparam_program({"map", mesh, "-o", map});
    INFO(refused.err);
    CHECK(refused.code == 4);
    CHECK_THAT(refused.err, Contains("  --repair --weld ") && !Contains("--component"));
    CHECK(type_advice(refused.err, folder / ".") >= 1);
    const Ended repair = sphparam_program({"repair", mesh, "-o", folder / "r.obj", "--repair"});
    INFO(repair.err);
    CHECK_THAT(repair.err,
               Contains("  --repair --weld ") && Contains("drops 0 % of the area, not"));
    CHECK_THAT(repair.err, !Contains("--component"));
    if (share < 0.05) CHECK(repair.code == 0);
    const Json told = Json::parse(sphparam_program({"info", mesh, "--json", "-"}).out)["repair"];
    CHECK(told["mends"] == (repair.code == 0));
    CHECK_THAT(told["mends_with"].get<std::string>(), Contains("--repair --weld "));
  }
}

TEST_CASE("repair: what is one-sided is sent to wrap, which takes it") {
  const Folder folder;
  const std::string mesh = folder / "band.obj";
  write_bytes(mesh,
              "v 2 0 -1\nv 2 0 1\nv -1 1.7 -0.5\nv -1 1.7 0.5\nv -1 -1.7 0.5\nv -1 -1.7 -0.5\n"
              "f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 6 5\nf 5 6 2\nf 6 1 2\n");
  const Ended refused = sphparam_program({"map", mesh, "-o", folder / "m.sph.ply"});
  INFO(refused.err);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("--repair cannot mend it") && Contains("`sphparam wrap "));
  CHECK(type_advice(refused.err, folder / ".") == 1);
}

TEST_CASE("repair: faces without a place count among those lost, and are told to have no area") {
  const Folder folder;
  TriangleMesh mesh = icosphere(2);
  mesh.positions(5, 0) = std::numeric_limits<double>::quiet_NaN();
  const Ended mapped = sphparam_program(
      {"map", "-", "-o", folder / "m.sph.ply", "--repair", "--json", "-"}, obj_text(mesh));
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("kept 100 % of the area and 98.") && Contains(" of the faces") &&
                             Contains(" faces had no area that can be measured"));
  TriangleMesh speck = icosphere(0);
  speck.positions *= 0.01;
  const Ended dropped =
      sphparam_program({"map", "-", "-o", folder / "m.sph.ply", "--repair", "--json", "-"},
                       obj_text(joined(mesh, speck, {3, 0, 0})));
  REQUIRE(dropped.code == 0);
  CHECK(Json::parse(dropped.out)["components"]["faces_kept"] == Approx(315.0 / 340));
}

TEST_CASE("repair: a mesh without area has no shape, and is refused, the tiniest are mapped") {
  const Folder folder;
  const std::string map = folder / "m.sph.ply";
  TriangleMesh flat = icosphere(2);
  flat.positions.rightCols(2).setZero();
  for (const double size : {0.0, 1.0}) {
    const std::string text = obj_text(scaled(flat, size));
    for (const bool mends : {false, true}) {
      std::vector<std::string> line = {"map", "-", "-o", map};
      if (mends) line.emplace_back("--repair");
      const Ended refused = sphparam_program(line, text);
      INFO(refused.err);
      CHECK(refused.code == 4);
      CHECK_THAT(refused.err, Contains("the surface has no area") && !Contains("merged"));
    }
    const Ended told = sphparam_program({"info", "-"}, text);
    CHECK(told.code == 4);
    CHECK_THAT(told.out, Contains("without area: it has no shape that could be mapped"));
    CHECK(sphparam_program({"repair", "-", "-o", folder / "r.ply"}, text).code == 4);
  }
  CHECK_FALSE(std::filesystem::exists(map));
  CHECK(sphparam_program({"map", "-", "-o", map}, obj_text(scaled(icosphere(2), 1e-150))).code ==
        0);
  TriangleMesh partly = icosphere(2);
  for (Vertex v = 0; v < 60; ++v) partly.positions.row(v) = partly.positions.row(60);
  CHECK(sphparam_program({"map", "-", "-o", map}, obj_text(partly)).code == 0);
}

TEST_CASE("repair: map --repair mends, certifies, and tells what it did") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", json = folder / "map.json";
  const Ended mapped = sphparam_program({"map", "-", "-o", map, "--json", json, "--repair"},
                                        obj_text(with_a_hole()));
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("1 hole filled"));
  CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
  const Json repairs = Json::parse(bytes_of(json))["repairs"];
  REQUIRE(repairs.size() == 1);
  CHECK(repairs[0]["kind"] == "hole-filled");
  CHECK(repairs[0]["count"] == 1);
  CHECK(repairs[0]["first"].size() == 1);
}

TEST_CASE("repair: a mesh that needs none is mapped to the same bytes with and without") {
  const std::string ball = obj_text(icosphere(2));
  const Ended plain = sphparam_program({"map", "-", "-o", "-"}, ball);
  const Ended repaired = sphparam_program({"map", "-", "-o", "-", "--repair"}, ball);
  REQUIRE(plain.code == 0);
  CHECK(plain.out == repaired.out);
}

TEST_CASE("repair: single repairs do only what they say") {
  const std::string open = obj_text(with_a_hole()), two = obj_text(two_bodies());
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes"}, open).code == 0);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--max-hole", "3"}, open).code == 0);
  const Ended other =
      sphparam_program({"map", "-", "-o", "-", "--repair=components,orientation"}, open);
  CHECK(other.code == 4);
  CHECK_THAT(other.err, Contains("3 boundary edges"));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes"}, two).code == 4);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=components"}, two).code == 4);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=components"}, obj_text(two_bodies(0.1)))
            .code == 0);
}

TEST_CASE("repair: where a component is kept, the shares that are kept and lost are told") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  const Ended mended = sphparam_program({"map", "-", "-o", map, "--json", "-", "--repair"},
                                        obj_text(two_bodies(0.1)));
  INFO(mended.err);
  REQUIRE(mended.code == 0);
  CHECK_THAT(mended.err, Contains("1 component dropped: with vertices 162") &&
                             Contains("kept 99.063 % of the area and 80 % of the faces, lost "
                                      "0.94 % and 20 %") &&
                             Contains("\n    `sphparam asset - --keep 1` keeps that too"));
  const Json parts = Json::parse(mended.out)["components"];
  CHECK(parts["count"] == 2);
  CHECK(parts["area_kept"].get<double>() == Approx(0.9906).epsilon(1e-3));
  CHECK(parts["faces_kept"] == 0.8);
  CHECK(parts["largest"][1]["triangles"] == 80);
  CHECK(parts["largest"][1]["vertex"] == 162);
  const Ended whole =
      sphparam_program({"map", "-", "-o", map, "--json", "-", "--repair"}, obj_text(with_a_hole()));
  CHECK(Json::parse(whole.out)["components"].is_null());
}

TEST_CASE("repair: more than specks is lost only where a component or a share is named") {
  const Folder folder;
  const std::string two = obj_text(two_bodies()), map = folder / "map.sph.ply";
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"--repair"}, {"--min-kept", "0.6"}, {"--min-kept=52%"}}) {
    std::vector<std::string> arguments = {"map", "-", "-o", map};
    arguments.insert(arguments.end(), asked.begin(), asked.end());
    const Ended refused = sphparam_program(arguments, two);
    INFO(refused.err);
    CHECK(refused.code == 4);
    CHECK_THAT(refused.err, Contains("2 separate components") &&
                                Contains("1: 51.4 % of the area, 80 % of the faces (320), with "
                                         "vertex 0") &&
                                Contains("2: 48.6 % of the area, 20 % of the faces (80), with "
                                         "vertex 162") &&
                                Contains("--component N keeps the N-th, --min-kept 0.51 the") &&
                                Contains("--repair --component 1 would mend it"));
    CHECK(folder.names().empty());
  }
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"--repair", "--component", "1"},
        {"--min-kept", "0.5"},
        {"--repair", "--min-kept=50%"}}) {
    std::vector<std::string> arguments = {"map", "-", "-o", map};
    arguments.insert(arguments.end(), asked.begin(), asked.end());
    const Ended kept = sphparam_program(arguments, two);
    INFO(kept.err);
    CHECK(kept.code == 0);
    CHECK_THAT(kept.err, Contains("320 triangles") && Contains("lost 49 % and 20 %") &&
                             !Contains("--keep 1"));
  }
  // `info` says the same before.
  const Json info = Json::parse(sphparam_program({"info", "-", "--json", "-"}, two).out)["repair"];
  CHECK(info["mends"] == false);
  CHECK(info["mends_with"] == "--repair --component 1");
  CHECK(info["components"]["largest"].size() == 2);
  for (const char* share : {"0.5x", "", "1.1", "101%", "-0.1", "nan"}) {
    CHECK(sphparam_program({"map", "-", "-o", map, "--min-kept", share}, two).code == 2);
  }
  CHECK(sphparam_program({"map", "-", "-o", map, "--component", "1", "--min-kept", "0.1"}, two)
            .code == 2);
}

TEST_CASE("repair: a hole over the limit is named with the option that closes it") {
  TriangleMesh open = uv_sphere(600, 3);  // without the triangles at its first pole
  Eigen::Index kept = 0;
  for (Face f = 0; f < open.face_count(); ++f) {
    const Eigen::RowVector3i face = open.triangles.row(f);
    if ((face.array() != 0).all()) open.triangles.row(kept++) = face;
  }
  open.triangles.conservativeResize(kept, 3);
  const std::string text = obj_text(open);
  const std::string with_option = "--repair --max-hole 600 would mend it";
  CHECK_THAT(sphparam_program({"info", "-"}, text).out, Contains(with_option));
  const Ended refused = sphparam_program({"map", "-", "-o", "-", "--repair"}, text);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains(with_option));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair", "--max-hole", "600"}, text).code == 0);
}

TEST_CASE("repair: other subcommands name their own command line with --repair") {
  const Folder folder;
  const std::string mesh = folder / "an open mesh.obj";
  write_bytes(mesh, obj_text(with_a_hole()));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", mesh, "-o", folder / "x.glb"},
        {"remesh", mesh, "--grid", "ico:1", "-o", folder / "x.ply"}}) {
    const Ended refused = sphparam_program(command);
    CHECK(refused.code == 4);
    std::string line = "`sphparam " + command.front() + " '" + mesh + "'";
    for (size_t i = 2; i < command.size(); ++i) line += " " + command[i];
    CHECK_THAT(refused.err, Contains(line + " --repair`"));
  }
}

TEST_CASE("repair: only map is told to map all components, others how map does") {
  const Folder folder;
  const std::string mesh = folder / "two.obj";
  write_bytes(mesh, obj_text(two_bodies()));
  const std::string by_map = "`sphparam map " + mesh + " --all-components -o parts.sph.ply` maps";
  const Ended map = sphparam_program({"map", mesh, "-o", folder / "x.sph.ply"});
  CHECK_THAT(map.err, Contains("  --all-components maps each") && !Contains(by_map));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", mesh, "-o", folder / "x.glb"},
        {"bake", mesh, "--map", "axes", "-o", folder / "x.png"},
        {"report", mesh, "-o", folder / "x.html"},
        {"repair", mesh, "-o", folder / "x.ply"}}) {
    const Ended refused = sphparam_program(command);
    INFO(refused.err);
    CHECK(refused.code == 4);
    CHECK_THAT(refused.err, Contains(by_map) && !Contains("  --all-components maps"));
  }
}

TEST_CASE("repair: what is true only after welding says so") {
  // An icosphere of loose triangles, two of whose corners lie in one place.
  TriangleMesh mesh = icosphere(1);
  mesh.positions.row(mesh.triangles(0, 0)) = mesh.positions.row(mesh.triangles(0, 1)).eval();
  std::string loose, faces;
  for (int i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 p = mesh.position(mesh.triangles(i / 3, i % 3));
    loose += "v";
    for (int k = 0; k < 3; ++k) loose.append(" ").append(std::to_string(p[k]));
    loose += "\n";
    faces.append(i % 3 ? " " : "\nf ").append(std::to_string(i + 1));
  }
  const Ended refused = sphparam_program({"map", "-", "-o", "-"}, loose + faces + "\n");
  INFO(refused.err);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("after welding, 2 faces name one vertex twice"));
}

TEST_CASE("repair: --component keeps the one that is asked for, with the numbers of the file") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply", sphere = folder / "map.json";
  const std::string two = obj_text(two_bodies());  // the coarser one has less area
  const Ended mapped =
      sphparam_program({"map", "-", "-o", map, "--json", sphere, "--component", "2"}, two);
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  const Json report = Json::parse(bytes_of(sphere));
  CHECK(report["input"]["triangles"] == 80);
  CHECK(report["input"]["vertex_properties"].empty());  // the file has no such numbers, …
  CHECK(report["input"]["face_properties"].empty());
  const std::string header = bytes_of(map).substr(0, 4000);  // … the map has
  CHECK_THAT(header, Contains("source_vertex") && Contains("source_face"));
  // Vertices of the coarser one are known by their numbers in the file.
  CHECK(sphparam_program({"map", "-", "-o", "-", "--component", "2", "--poles", "162,165"}, two)
            .code == 0);
  CHECK(
      sphparam_program({"map", "-", "-o", "-", "--component", "2", "--poles", "0,165"}, two).code ==
      2);
  const Ended absent = sphparam_program({"map", "-", "-o", "-", "--component", "3"}, two);
  CHECK(absent.code == 2);
  CHECK_THAT(absent.err, Contains("no component 3") && Contains("has 2"));
}

TEST_CASE("repair: polygons that share two edges in a row are refused, and mended") {
  const Ended refused = sphparam_program({"map", "-", "-o", "-"}, doublet);
  CHECK(refused.code == 4);
  CHECK_THAT(refused.err, Contains("1 edge has three or more faces") &&
                              Contains("1 face has the same three vertices as another") &&
                              Contains("--repair would mend it"));
  CHECK_THAT(sphparam_program({"info", "-"}, doublet).out,
             Contains("two polygons share two edges in a row about vertices 1"));
  const Ended mapped = sphparam_program({"map", "-", "-o", "-", "--repair"}, doublet);
  CHECK(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("1 diagonal turned"));
}

TEST_CASE("repair: faces that name a vertex twice go with duplicates, and are refused without") {
  const std::string faulty = obj_text(icosphere(1)) + "f 1 2 1\nf 3 4 5 4 6\n";
  for (const char* repair : {"", "--repair=holes,unused"}) {
    std::vector<std::string> arguments = {"map", "-", "-o", "-"};
    if (*repair) arguments.emplace_back(repair);
    const Ended refused = sphparam_program(arguments, faulty);
    CHECK(refused.code == 3);
    CHECK_THAT(refused.err,
               Contains(":123: face names a vertex twice; `sphparam map - --repair=duplicates "
                        "-o mended.sph.ply` removes such faces"));
  }
  const Ended asked = sphparam_program({"info", "-"}, faulty);
  CHECK(asked.code == 3);
  CHECK_THAT(asked.err, Contains("--repair=duplicates -o mended.sph.ply` removes such faces"));
  const Folder folder;
  const std::string map = folder / "map.ply", file = folder / "a b.obj";
  std::string placeless = obj_text(icosphere(1));
  placeless.insert(placeless.find('f'), "v nan 0 0\n");
  for (const std::string& bytes : {faulty, placeless}) {
    write_bytes(file, bytes);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"map", file, "-o", map}, {"info", file}}) {
      const Ended told = sphparam_program(words);
      CHECK(told.code == 3);
      const size_t from = told.err.find("`sphparam map '" + file + "' --repair");
      REQUIRE(from != std::string::npos);
      CHECK(type_advice(told.err.substr(0, told.err.find('`', from + 1) + 1), folder / ".") == 1);
    }
  }
  for (const char* repair : {"--repair", "--repair=duplicates"}) {
    const Ended mended = sphparam_program({"map", "-", "-o", map, "--json", "-", repair}, faulty);
    INFO(mended.err);
    REQUIRE(mended.code == 0);
    CHECK_THAT(mended.err, Contains("2 faces that named a vertex twice removed"));
    const Json report = Json::parse(mended.out);
    CHECK(report["repairs"][0]["kind"] == "invalid-face-removed");
    CHECK(report["repairs"][0]["count"] == 2);
    const bool all = std::string(repair) == "--repair";
    CHECK(report["options"]["repair"][all ? 1 : 0] == "duplicates");
    CHECK(report["options"]["repair"].size() == (all ? 10 : 2));
    CHECK(sphparam_program({"verify", map}).code == 0);
  }
  const Ended unasked =
      sphparam_program({"map", "-", "-o", map, "--json", "-"}, obj_text(icosphere(1)));
  const Json options = Json::parse(unasked.out)["options"];
  CHECK(options["repair"].empty());
  CHECK(options["repair_map"] == false);
}

TEST_CASE("repair: triangles that are written as quads stay") {
  const TriangleMesh ball = icosphere(1);
  std::string quads = obj_text(ball);
  quads.resize(quads.find("f "));
  for (Face f = 0; f < ball.face_count(); ++f) {
    quads += "f";
    for (const int k : {0, 1, 2, 2})
      quads.append(" ").append(std::to_string(ball.triangles(f, k) + 1));
    quads += "\n";
  }
  const Folder folder;
  CHECK(sphparam_program({"map", "-", "-o", folder / "map.ply"}, quads).code == 3);
  const Ended mended = sphparam_program(
      {"map", "-", "-o", folder / "map.ply", "--json", "-", "--repair=duplicates"}, quads);
  INFO(mended.err);
  REQUIRE(mended.code == 0);
  const Json report = Json::parse(mended.out);
  CHECK(report["input"]["triangles"] == ball.face_count());
  CHECK(report["repairs"].empty());
  CHECK_THAT(report["notes"].dump(), Contains("80 faces name a vertex twice in a row: taken once"));
}

TEST_CASE("repair: info says what --repair would do") {
  const Ended text = sphparam_program({"info", "-"}, obj_text(with_a_hole()));
  CHECK(text.code == 4);
  CHECK_THAT(text.out, Contains("--repair would mend it") && Contains("1 hole filled"));
  const Json json =
      Json::parse(sphparam_program({"info", "-", "--json", "-"}, obj_text(with_a_hole())).out);
  CHECK(json["repair"]["mends"] == true);
  CHECK(json["repair"]["mends_with"] == "--repair");
  CHECK(json["repair"]["actions"][0]["kind"] == "hole-filled");
  CHECK(Json::parse(
            sphparam_program({"info", "-", "--json", "-"}, obj_text(icosphere(1))).out)["repair"]
            .is_null());
}

TEST_CASE(
    "repair: handles of a surface out of a volume go, all is told, and the map is certified") {
  const TriangleMesh mesh = noisy_ball(16, 0.2, 3);
  const long genus = inspect_mesh(mesh).genus;
  REQUIRE(genus > 1);
  const Folder folder;
  const std::string map = folder / "map.sph.ply", json = folder / "map.json";
  for (const char* name : {"loops.obj", "loops.ply"}) {
    const std::string loops = folder / name;
    const Ended mapped = sphparam_program({"map", "-", "-o", map, "--json", json, "--repair",
                                           "--max-handle", "90%", "--loops", loops},
                                          obj_text(mesh));
    INFO(mapped.err);
    REQUIRE(mapped.code == 0);
    CHECK_THAT(mapped.err, Contains(" long (") && Contains("% of the diagonal), about ("));
    CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
    const Json report = Json::parse(bytes_of(json));
    REQUIRE(report["handles"].size() == static_cast<size_t>(genus));
    CHECK(report["outputs"]["loops"] == loops);
    size_t edges = 0;
    long told = 0;
    for (const Json& loop : report["handles"]) {
      CHECK((loop["kind"] == "cut" || loop["kind"] == "fill"));
      CHECK(loop["length"].get<double>() > 0);
      CHECK(loop["area_added"].get<double>() > 0);
      edges += loop["vertices"].size();
    }
    for (const Json& repair : report["repairs"]) told += repair["count"].get<long>();
    CHECK(told == genus);
    const std::string text = bytes_of(loops);
    if (std::string(name) == "loops.ply") {
      CHECK_THAT(text, Contains("element edge " + std::to_string(edges) + "\n"));
    } else {
      CHECK(std::count(text.begin(), text.end(), 'l') > genus);
      CHECK_THAT(text, Contains("\nv ") && Contains("\nl 1 2 3"));
    }
  }
}

TEST_CASE("repair: a torus stays refused, with what would open it, cut or closed as one likes") {
  const std::string torus = obj_text(bumped_torus(16, 40, 0.3, 0.02, 1));
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  const Ended refused = sphparam_program({"map", "-", "-o", map, "--repair"}, torus);
  INFO(refused.err);
  CHECK(refused.code == 4);
  CHECK(folder.names().empty());
  const std::string option = "--repair --max-handle ";
  const size_t at = refused.err.find(option);
  REQUIRE(at != std::string::npos);
  CHECK_THAT(refused.err, Contains("% would mend it") && Contains("1 handle cut through") &&
                              Contains("cut along 16 edges"));
  const size_t from = at + option.size();
  const std::string limit = refused.err.substr(from, refused.err.find('%', from) + 1 - from);
  CHECK(sphparam_program({"map", "-", "-o", map, "--repair", "--max-handle", limit}, torus).code ==
        0);
  const Json info =
      Json::parse(sphparam_program({"info", "-", "--json", "-"}, torus).out)["repair"];
  CHECK(info["mends"] == false);
  CHECK(info["mends_with"] == "--repair --max-handle " + limit);
  CHECK(info["handles"].size() == 1);
  const Ended closed =
      sphparam_program({"map", "-", "-o", map, "--handles", "fill", "--max-handle", "6"}, torus);
  CHECK(closed.code == 0);
  CHECK_THAT(closed.err, Contains("1 tunnel closed") && Contains("closed along 40 edges"));
}

TEST_CASE("repair: what makes no sense is a usage error with a suggestion") {
  const std::string ball = obj_text(icosphere(1));
  const Ended misspelt = sphparam_program({"map", "-", "-o", "-", "--repair=hole"}, ball);
  CHECK(misspelt.code == 2);
  CHECK_THAT(misspelt.err, Contains("did you mean holes?"));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair="}, ball).code != 1);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--component", "0"}, ball).code == 2);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--max-hole", "2"}, ball).code == 2);
  for (const char* length : {"0", "-1", "x", "nan", "inf", "-5%"}) {
    CHECK(sphparam_program({"map", "-", "-o", "-", "--max-handle", length}, ball).code == 2);
  }
  CHECK(sphparam_program({"map", "-", "-o", "-", "--handles", "both"}, ball).code == 2);
  const Folder folder;
  const std::string loops = folder / "loops.obj";
  CHECK(sphparam_program({"map", "-", "-o", "-", "--loops", loops}, ball).code == 2);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair=holes", "--loops", loops}, ball).code ==
        2);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--repair", "--loops", folder / "l.txt"}, ball)
            .code == 2);
  CHECK(folder.names().empty());
}

}  // namespace sphparam::tests
