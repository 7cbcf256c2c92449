#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

/// Maps that lie as the body does: `map --method radial`, `--align`, `--centre`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

std::string body(const Vector3& centre = Vector3::Zero()) {
  TriangleMesh mesh = icosphere(3);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    mesh.positions.row(v) = centre + (1 + 0.2 * x.x() * x.y()) * Vector3(2 * x.x(), x.y(), x.z());
  }
  return obj_text(mesh);
}

}  // namespace

TEST_CASE("map: --method radial says what it is, in a line, in --json and in the header") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  const Ended ended = sphparam_program(
      {"map", "-", "-o", map, "--method", "radial", "--json", folder / "map.json"}, body());
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("planetocentric: the surface is star-shaped about (0, 0, 0)"));
  const Json report = Json::parse(bytes_of(folder / "map.json"));
  CHECK(report["radial"]["folds"] == 0);
  CHECK(report["radial"]["largest_movement"] == 0);
  CHECK(report["options"]["method"] == "radial");
  CHECK(report["alignment"].is_null());
  const std::string header = bytes_of(map).substr(0, 1200);
  CHECK_THAT(header, Contains("sphparam radial-centre 0 0 0\n"));
  CHECK_THAT(header, Contains("sphparam radial-movement 0\n"));
  CHECK(sphparam_program({"verify", map}).code == 0);
}

TEST_CASE("map: --centre moves the centre, and none of the vertices may be there") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  const std::string moved = body({5, 6, 7});
  const Ended ended =
      sphparam_program({"map", "-", "-o", map, "--method", "radial", "--centre", "5,6,7"}, moved);
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("star-shaped about (5, 6, 7)"));
  const std::string first = moved.substr(2, moved.find('\n') - 2);
  std::string commas = first;
  for (char& c : commas) c = c == ' ' ? ',' : c;
  const Ended refused =
      sphparam_program({"map", "-", "-o", map, "--method", "radial", "--centre", commas}, moved);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("--centre: vertex 0 lies at the centre"));
}

TEST_CASE("map: --align turns a map to the body, or to another map of the mesh") {
  const Folder folder;
  write_bytes(folder / "body.obj", body());
  const std::string mesh = folder / "body.obj", to_body = folder / "a.sph.ply";
  const Ended ended =
      sphparam_program({"map", mesh, "-o", to_body, "--align", "body", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("are left (RMS over the surface)"));
  const Json report = Json::parse(ended.out);
  CHECK(report["alignment"] > 0);
  CHECK(report["alignment"] < 0.3);
  CHECK(report["radial"].is_null());
  CHECK_THAT(bytes_of(to_body).substr(0, 1200), Contains("sphparam alignment 0."));
  const Ended again = sphparam_program(
      {"map", mesh, "-o", folder / "b.sph.ply", "--align", to_body, "--json", "-"});
  INFO(again.err);
  REQUIRE(again.code == 0);
  CHECK(Json::parse(again.out)["alignment"] < 1e-9);
  const Ended other = sphparam_program({"map", "-", "-o", folder / "c.sph.ply", "--align", to_body},
                                       obj_text(icosphere(2)));
  CHECK(other.code == 3);
}

TEST_CASE("map: --method radial --keep-folded writes the directions as they are, folds and all") {
  const Folder folder;
  const std::string map = folder / "folds.sph.ply";
  const Ended ended = sphparam_program(
      {"map", "-", "-o", map, "--method", "radial", "--keep-folded", "--json", "-"},
      obj_text(random_sphere_mesh(200, 4)));
  INFO(ended.err);
  CHECK(ended.code == 5);
  const Json report = Json::parse(ended.out);
  CHECK(report["radial"]["folds"] > 0);
  CHECK(report["radial"]["folds"] == report["certificate"]["folds"]);
  CHECK(report["radial"]["moved"] == 0);
  CHECK(sphparam_program({"verify", map}).code == 5);
}

TEST_CASE("map, bake: a centre outside of the surface is told, --centre centroid is inside") {
  const Folder folder;
  const std::string mesh = folder / "body.obj", map = folder / "a.sph.ply";
  write_bytes(mesh, body({5, 6, 7}));
  const auto told = [&](std::vector<std::string> words) {
    const Ended ended = sphparam_program(words);
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err;
  };
  const std::string outside =
      "the centre 0,0,0 lies outside of the surface: --centre centroid is 5,6,7, that of what it "
      "encloses";
  const std::vector<std::string> align = {"map", mesh, "-o", map, "--align", "body"};
  CHECK_THAT(told(align), Contains("warning: body.obj: " + outside));
  std::vector<std::string> inside = align;
  inside.insert(inside.end(), {"--centre", "centroid"});
  CHECK_THAT(told(inside), !Contains("lies outside"));
  CHECK_THAT(told({"map", mesh, "-o", map, "--method", "radial", "--centre", "centroid"}),
             Contains("star-shaped about (5, 6, 7)") && !Contains("lies outside"));
  REQUIRE(sphparam_program({"map", mesh, "-o", map}).code == 0);
  const auto bake = [&](const std::string& field, std::vector<std::string> more) {
    std::vector<std::string> words = {"bake",   map,  "--map", field,
                                      "--size", "32", "-o",    folder / "a.tif"};
    words.insert(words.end(), more.begin(), more.end());
    return told(words);
  };
  for (const char* field : {"radius", "slope", "lon"}) {
    CHECK_THAT(bake(field, {}), Contains("warning: " + outside));
    CHECK_THAT(bake(field, {"--centre", "centroid"}), !Contains("lies outside"));
  }
  CHECK_THAT(bake("height", {}), Contains("the origin, from which it is measured, lies outside of "
                                          "the surface: --map radius --centre centroid is "));
  CHECK_THAT(bake("position", {}), !Contains("lies outside"));
}

TEST_CASE("map: what radial, --align and --centre may not be said with ends with 2") {
  const Folder folder;
  write_bytes(folder / "pins.txt", "5 0.5 1.0\n");
  const std::vector<std::vector<std::string>> senseless = {
      {"--method", "radial", "--poles", "3,40"},
      {"--method", "radial", "--poles", "none"},
      {"--method", "radial", "--meridian", "3"},
      {"--method", "radial", "--pin", folder / "pins.txt"},
      {"--method", "radial", "--align", "body"},
      {"--method", "radial", "--quality", "best"},
      {"--method", "radial", "--centre", "1,2"},
      {"--method", "radial", "--centre", "1,2,x"},
      {"--method", "radial", "--centre", "1,2,inf"},
      {"--align", "body", "--poles", "3,40"},
      {"--align", "body", "--meridian", "3"},
      {"--align", "body", "--method", "tangential"},
      {"--align", "-"},
      {"--centre", "0,0,0"},
  };
  for (const auto& options : senseless) {
    std::vector<std::string> arguments = {"map", "-", "-o", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    const Ended ended = sphparam_program(arguments, body());
    INFO(line << ended.err);
    CHECK(ended.code == 2);
    CHECK(ended.out.empty());
  }
}

TEST_CASE("bake --convention gis: how far a map is from the body's is told of bodies only") {
  const Folder folder;
  const auto told = [&](const std::string& mesh, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"bake", "-",  "--map",          "position",     "--size",
                                      "32",   "-o", folder / "a.png", "--convention", "gis"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(words, mesh);
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err.find("° from those of the body") != std::string::npos;
  };
  CHECK(told(body(), {}));
  CHECK_FALSE(told(body({5, 6, 7}), {}));  // seen from the origin it is none
  CHECK(told(body({5, 6, 7}), {"--body", "1"}));
  CHECK(told(body({5, 6, 7}), {"--centre", "5,6,7"}));
}

TEST_CASE(
    "remesh --csv --degrees: longitudes of another map than the body's are told as bake does") {
  const Folder folder;
  const auto told = [&](const std::string& mesh) {
    const Ended ended = sphparam_program(
        {"remesh", mesh, "--grid", "ico:1", "--csv", folder / "a.csv", "--degrees"}, body());
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err.find("° from those of the body") != std::string::npos;
  };
  CHECK(told("-"));
  const std::string map = folder / "map.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial"}, body()).code == 0);
  CHECK_FALSE(told(map));
}

TEST_CASE(
    "bake: how far a map is from the body's is told about the given centre, as map tells it") {
  const Folder folder;
  const std::string mesh = folder / "body.obj", map = folder / "a.sph.ply",
                    report = folder / "a.json";
  write_bytes(mesh, body({5, 6, 7}));
  REQUIRE(sphparam_program(
              {"map", mesh, "-o", map, "--align", "body", "--centre", "5,6,7", "--json", report})
              .code == 0);
  const auto told = [&](const std::string& centre) {
    const Ended ended = sphparam_program({"bake", map, "--body", "1", "--centre", centre, "--map",
                                          "lon", "--size", "32", "-o", folder / "a.tif"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK_THAT(ended.err, Contains("with --centre " + centre));
    const std::string before = "longitudes and latitudes are ";
    const size_t at = ended.err.find(before);
    REQUIRE(at != std::string::npos);
    return std::stod(ended.err.substr(at + before.size()));
  };
  const double left = Json::parse(bytes_of(report))["alignment"];
  CHECK(told("5,6,7") == Approx(left * 180 / 3.14159265358979).epsilon(0.01));
  CHECK(told("5,6,7.5") > told("5,6,7"));
}

TEST_CASE("bake: a radial map about another centre than --centre is told, with how far it is off") {
  const Folder folder;
  const std::string map = folder / "r.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial", "--centre", "5,6,7"},
                           body({5, 6, 7}))
              .code == 0);
  const Ended ended = sphparam_program({"bake", map, "--body", "eros", "--centre", "5.2,6,7",
                                        "--map", "lon", "--size", "32", "-o", folder / "a.tif"});
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("it is radial about another centre") &&
                            Contains("radial about (5, 6, 7), not about") &&
                            Contains("longitude and latitude: sphparam map of Eros"));
}

TEST_CASE("map: a radial map of what glTF has turned has the body's north, as bake names it") {
  const Folder folder;
  write_bytes(folder / "body.obj", body());
  const std::string glb = folder / "body.glb", map = folder / "a.sph.ply";
  REQUIRE(sphparam_program({"export", folder / "body.obj", "-o", glb}).code == 0);
  const Ended ended = sphparam_program({"map", glb, "-o", map, "--method", "radial"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("y points up in the file: it is north"));
  const auto baked = [&](const std::string& of) {
    const Ended bake = sphparam_program({"bake", of, "--body", "1", "--map", "radius", "--depth",
                                         "float", "--size", "32", "-o", folder / "a.tif"});
    CHECK_THAT(bake.err, Contains("- Sphere / Ocentric") && !Contains("from those of the body"));
    return bytes_of(folder / "a.tif");
  };
  baked(map);
  const auto shape = [&](const std::string& of) {
    const Ended shadr = sphparam_program({"spharm", of, "--degree", "2", "--shadr", "-"});
    CHECK_THAT(shadr.err, !Contains("warning"));
    return shadr.out;
  };
  // The same from the mesh as it was, and from the file with y up and nothing that says so.
  REQUIRE(sphparam_program(
              {"map", folder / "body.obj", "-o", folder / "b.sph.ply", "--method", "radial"})
              .code == 0);
  const std::string first = shape(map).substr(0, 24), plain = shape(folder / "b.sph.ply");
  CHECK(std::stod(first) == Approx(std::stod(plain.substr(0, 24))).epsilon(1e-3));
  REQUIRE(sphparam_program({"map", folder / "body.obj", "-o", folder / "y.sph.ply", "--method",
                            "radial", "--up", "y"})
              .code == 0);
  CHECK_THAT(bytes_of(folder / "y.sph.ply").substr(0, 400), Contains("up axis y"));
  baked(folder / "y.sph.ply");
}

TEST_CASE("map: a mesh that is inside out is told what turns it") {
  const Folder folder;
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  const std::string map = folder / "a.sph.ply";
  const Ended ended =
      sphparam_program({"map", "-", "-o", map, "--method", "radial"}, obj_text(mesh));
  CHECK_THAT(ended.err, Contains("the faces point inwards: --repair=orientation turns them"));
  const Ended bake = sphparam_program(
      {"bake", map, "--body", "Eros", "--map", "lon", "--size", "32", "-o", folder / "a.tif"});
  CHECK_THAT(bake.err, Contains("it was made anew") &&
                           Contains("longitude and latitude: sphparam map of Eros"));
  const Ended turned = sphparam_program(
      {"map", "-", "-o", map, "--method", "radial", "--repair=orientation"}, obj_text(mesh));
  CHECK(turned.code == 0);
  CHECK_THAT(turned.err, Contains("planetocentric: the surface is star-shaped"));
}

TEST_CASE("spharm, bake: a header that says radial is measured before it is believed") {
  const Folder folder;
  const std::string map = folder / "r.sph.ply", moved = folder / "moved.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial"}, body()).code == 0);
  const auto said = [&](const std::string& of, const std::string& centre) {
    const Ended ended = sphparam_program(
        {"spharm", of, "--degree", "2", "--centre", centre, "--shadr", folder / "a.sha"});
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(said(map, "0,0,0"), !Contains("warning"));
  CHECK_THAT(said(map, "0.1,0,0"),
             Contains("the map's, not the body's") && Contains("radial about another centre"));
  REQUIRE(sphparam_program({"spharm", map, "--degree", "1", "--reconstruct", moved}).code == 0);
  CHECK_THAT(said(moved, "0,0,0"),
             Contains("° from those of the body") && Contains("moved since it was made"));
  const Ended bake = sphparam_program(
      {"bake", moved, "--body", "Eros", "--map", "lon", "--size", "32", "-o", folder / "a.tif"});
  CHECK_THAT(bake.err, Contains("moved since it was made") && !Contains("it moved what folds") &&
                           Contains("longitude and latitude: sphparam map of Eros"));
}

}  // namespace sphparam::tests
