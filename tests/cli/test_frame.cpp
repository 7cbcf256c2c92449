#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/upright_frame.h"
#include "support/test_meshes.h"

/// Poles, meridian and pins of `sphparam map`, and what they cost.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

const std::string ball = obj_text(icosphere(3));

/// `sphparam map - -o FOLDER/map.sph.ply --json -` and the report it printed.
Json report_of(const Folder& folder, const std::vector<std::string>& options,
               const std::string& mesh = ball) {
  std::vector<std::string> arguments = {"map", "-", "-o", folder / "map.sph.ply", "--json", "-"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ended ended = sphparam_program(arguments, mesh);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  return Json::parse(ended.out);
}

/// The mesh behind two vertices that no face uses: 0 and 1.
std::string with_two_unused(const TriangleMesh& mesh) {
  std::string text = "v 9 9 9\nv 8 8 8\n";
  const std::string rest = obj_text(mesh);
  const size_t faces = rest.find("f ");
  text += rest.substr(0, faces);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    text += "f";
    for (int k = 0; k < 3; ++k) text.append(" ").append(std::to_string(mesh.triangles(f, k) + 3));
    text += "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("map: --poles none leaves the map without vertices at ±z, auto chooses two") {
  const Folder folder;
  CHECK(report_of(folder, {"--poles", "none"})["poles"].is_null());
  CHECK_THAT(bytes_of(folder / "map.sph.ply").substr(0, 1000), Contains("sphparam poles none"));
  const Json chosen = report_of(folder, {"--poles", "auto"});
  CHECK(chosen["poles"]["north"].is_number());
  CHECK(chosen["options"]["poles"] == "auto");
}

TEST_CASE("map: given poles are reached, and their cost in energy told") {
  const Folder folder;
  const std::string mesh = obj_text(tube(12, 8));
  const Json report = report_of(folder, {"--poles", "9,26"}, mesh);  // near each other
  CHECK(report["poles"]["north"] == 9);
  CHECK(report["energy_cost"].get<double>() > 0.01);
  const Ended ended = sphparam_program({"map", "-", "-o", "-", "--poles", "9,26"}, mesh);
  CHECK_THAT(ended.err, Contains("vertices 9 and 26 at ±z") && Contains("energy than before"));
}

TEST_CASE("map: the paper's poles are at ±z where its smoothing has not moved them") {
  const auto told = [](const char* sweeps) {
    return sphparam_program({"map", "-", "-o", "-", "--method", "paper", "--repair-map", "--poles",
                             "0,140", "--sweeps", sweeps},
                            obj_text(icosphere(3)))
        .err;
  };
  CHECK_THAT(told("0"), Contains("\n  vertices 0 and 140 at ±z\n"));
  CHECK_THAT(told("3"),
             Contains("\n  vertices 0 and 140 near ±z, at the ends of the date line\n") &&
                 Contains("has moved the poles"));
}

namespace {

/// An animal: longer than high, y up, a head with a nose at −z, a tail at +z; vertices in no order
/// of place.
TriangleMesh animal() {
  TriangleMesh mesh = icosphere(4);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    const double head = std::exp(-6 * (p - Vector3(0, 0.5, -0.8)).squaredNorm());
    mesh.positions.row(v) =
        Vector3(0.6 * p.x(), 0.7 * p.y() + 0.6 * head, 1.3 * p.z() - 0.5 * head);
  }
  return mesh;
}

Vertex farthest(const TriangleMesh& mesh, const Vector3& direction) {
  Eigen::Index found = 0;
  (mesh.positions * direction).maxCoeff(&found);
  return static_cast<Vertex>(found);
}

}  // namespace

TEST_CASE(
    "map: --up and --front put top and bottom at the poles, the front at theta 0, and say so") {
  const Folder folder;
  const TriangleMesh mesh = animal();
  const Json report = report_of(folder, {"--up", "y", "--front", "-z"}, obj_text(mesh));
  const Vertex top = farthest(mesh, Vector3::UnitY()), bottom = farthest(mesh, -Vector3::UnitY()),
               nose = farthest(mesh, -Vector3::UnitZ());
  CHECK(report["poles"]["north"] == top);
  CHECK(report["poles"]["south"] == bottom);
  CHECK(report["meridian"] == nose);
  CHECK(report["upright"] == "y, front -z");
  CHECK(std::abs(report["energy_cost"].get<double>()) < 0.2);
  const MeshFile written = read_mesh(folder / "map.sph.ply");
  const SphereMap map = read_sphere(written).value();
  CHECK(map.point(top) == Vector3(0, 0, 1));
  CHECK(map.point(bottom) == Vector3(0, 0, -1));
  CHECK(map.point(nose).y() == 0);
  CHECK(map.point(nose).x() > 0);
  // What is right of who looks at the face is east of it.
  CHECK(map.point(farthest(mesh, -Vector3::UnitX())).y() > 0.5);
  CHECK(noted_up(written) == Up{Vector3::UnitY(), -Vector3::UnitZ()});
  CHECK(map_is_upright(written, upright_axes(written)));
  CHECK_FALSE(map_is_upright(written, upright_axes({})));
}

TEST_CASE("map: nothing is said of up where nobody asks, and what is given goes before it") {
  const Folder folder;
  const std::string mesh = obj_text(animal());
  const auto header = [&] { return bytes_of(folder / "map.sph.ply").substr(0, 1200); };
  CHECK_FALSE(report_of(folder, {}, mesh).contains("upright"));
  CHECK_THAT(header(), !Contains("up axis") && !Contains("upright"));
  const Json chosen = report_of(folder, {"--up", "y", "--poles", "auto"}, mesh);
  CHECK_FALSE(chosen.contains("upright"));
  CHECK_THAT(header(), Contains("comment up axis y\n") && Contains("comment front axis z\n"));
  const Json meridian = report_of(folder, {"--up", "y", "--meridian", "7"}, mesh);
  CHECK(meridian["meridian"] == 7);
  CHECK(meridian["poles"]["north"] == farthest(animal(), Vector3::UnitY()));
  const Json poles = report_of(folder, {"--up", "y", "--front", "-z", "--poles", "3,40"}, mesh);
  CHECK(poles["poles"]["north"] == 3);
  CHECK(poles["meridian"] == farthest(animal(), -Vector3::UnitZ()));
}

TEST_CASE("map: --poles up stands as the file says, and so do meshes made of the map") {
  const Folder folder;
  write_bytes(folder / "animal.obj", obj_text(animal()));
  const auto run = [&](std::vector<std::string> arguments) {
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended.out;
  };
  const std::string map = folder / "map.sph.ply", low = folder / "low.sph.ply";
  run({"map", folder / "animal.obj", "-o", map, "--up", "y", "--front", "-z"});
  run({"map", map, "-o", folder / "again.sph.ply", "--poles", "up"});
  CHECK(map_is_upright(read_mesh(folder / "again.sph.ply"), {Vector3::UnitY(), -Vector3::UnitZ()}));
  run({"remesh", map, "--grid", "ico:4", "-o", low});
  CHECK(map_is_upright(read_mesh(low), {Vector3::UnitY(), -Vector3::UnitZ()}));
  const auto drawn = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", file, "-o", "-", "--size", "32", "--view", "mesh"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  for (const std::string& file : {map, low})
    CHECK(drawn(file, {}) == drawn(file, {"--up", "y", "--front", "-z"}));
}

TEST_CASE("map: --meridian gives a vertex theta 0, with and without poles") {
  for (const char* poles : {"auto", "none", "5,40"}) {
    const Folder folder;
    const Json report = report_of(folder, {"--poles", poles, "--meridian", "77"});
    CHECK(report["meridian"] == 77);
    CHECK_THAT(bytes_of(folder / "map.sph.ply").substr(0, 1000), Contains("sphparam meridian 77"));
  }
}

TEST_CASE("map: pins are exactly at their points") {
  const Folder folder;
  write_bytes(folder / "pins.txt",  // with the byte order mark of Windows' editors
              "\xEF\xBB\xBF# vertex theta phi\n5 0.5 1.0\n\n40 2 2 # the other\n100 4 0.7\n");
  const Json report = report_of(folder, {"--pin", folder / "pins.txt"});
  REQUIRE(report["pins"].size() == 3);
  for (const Json& pin : report["pins"]) CHECK(pin["residual"] == 0);
  CHECK(report["pins"][1]["vertex"] == 40);
  CHECK(report["certificate"]["one_to_one"] == true);
  CHECK(report["energy_cost"].get<double>() > 0);
}

TEST_CASE("map: pins that cannot be reached end with 5, each residual told, no map written") {
  const Folder folder;
  // The corners of a triangle, the wrong way round.
  const TriangleMesh mesh = icosphere(1);
  const std::array<std::string, 3> points = {" 0.5 1.2\n", " 0 1.2\n", " 0.25 0.8\n"};
  std::string lines;
  for (size_t i = 0; i < 3; ++i) {
    lines += std::to_string(mesh.triangles(0, static_cast<Eigen::Index>(i))) + points[i];
  }
  write_bytes(folder / "pins.txt", lines);
  for (const bool keep : {false, true}) {
    std::vector<std::string> arguments = {"map",    "-",
                                          "-o",     folder / "map.sph.ply",
                                          "--pin",  folder / "pins.txt",
                                          "--json", folder / "map.json"};
    if (keep) arguments.push_back("--keep-folded");
    const Ended ended = sphparam_program(arguments, obj_text(mesh));
    CHECK(ended.code == 5);
    CHECK_THAT(ended.err, Contains("radians from its point") && Contains("no map written"));
    CHECK(folder.names() == std::vector<std::string>{"map.json", "pins.txt"});
    const Json pins = Json::parse(bytes_of(folder / "map.json"))["pins"];
    CHECK(std::ranges::any_of(pins, [](const Json& pin) { return pin["residual"] > 0.0; }));
  }
}

TEST_CASE("map: poles that cannot be reached end with 5, each residual told, no map written") {
  const Folder folder;
  const TriangleMesh mesh = icosphere(1);
  const std::string edge = std::to_string(mesh.triangles(0, 0)) + "," +
                           std::to_string(mesh.triangles(0, 1));  // no geodesic joins opposite ends
  for (const bool keep : {false, true}) {
    std::vector<std::string> arguments = {
        "map",     "-q", "-", "-o", folder / "map.sph.ply", "--json", folder / "map.json",
        "--poles", edge};
    if (keep) arguments.push_back("--keep-folded");
    const Ended ended = sphparam_program(arguments, obj_text(mesh));
    CHECK(ended.code == 5);
    CHECK_THAT(ended.err, Contains("the poles are not at ±z") && Contains("radians from +z") &&
                              Contains("no map written"));
    CHECK(folder.names() == std::vector<std::string>{"map.json"});
    const Json report = Json::parse(bytes_of(folder / "map.json"));
    CHECK(report["poles"].is_null());
    CHECK(report["pole_residuals"]["north"].get<double>() +
              report["pole_residuals"]["south"].get<double>() >
          0.5);
  }
  CHECK(report_of(folder, {"--poles", "5,40"})["pole_residuals"]["south"] == 0);
  CHECK(report_of(folder, {})["pole_residuals"].is_null());
}

TEST_CASE("map: a vertex that is to be the meridian is not chosen as a pole") {
  const Folder folder;
  const Json chosen = report_of(folder, {})["poles"];
  for (const char* end : {"north", "south"}) {
    const std::string vertex = std::to_string(chosen[end].get<int>());
    const Json report = report_of(folder, {"--meridian", vertex});
    CHECK(report["meridian"] == chosen[end]);
    CHECK(report["poles"]["north"].is_number());
  }
}

TEST_CASE("map: a meridian is kept where no poles can be chosen, else the map is refused") {
  const Folder folder;
  // Each two vertices share an edge: none can be opposite.
  const std::string mesh = obj_text(tetrahedron());
  const Json report = report_of(folder, {"--meridian", "2"}, mesh);
  CHECK(report["poles"].is_null());
  CHECK(report["meridian"] == 2);
  // Where poles are where the paper puts them, the meridian may be one of them.
  const Json curvilinear = report_of(folder, {"--method", "curvilinear"});
  const std::string pole = std::to_string(curvilinear["poles"]["north"].get<int>());
  const Ended refused = sphparam_program(
      {"map", "-", "-o", folder / "none.ply", "--method", "curvilinear", "--meridian", pole}, ball);
  CHECK(refused.code == 5);
  CHECK_THAT(refused.err, Contains("vertex " + pole + " is not at theta = 0") &&
                              Contains("a pole has no longitude"));
  CHECK_FALSE(fs::exists(folder / "none.ply"));
}

TEST_CASE("map: vertices are named by their numbers in the file, also where some were dropped") {
  const Folder folder;
  const std::string mesh = with_two_unused(icosphere(3));
  write_bytes(folder / "pins.txt", "7 0.5 1.0\n42 2 2\n");
  const Json pinned = report_of(folder, {"--pin", folder / "pins.txt"}, mesh);
  CHECK(pinned["pins"][0]["vertex"] == 7);
  CHECK(pinned["pins"][1]["residual"] == 0);
  CHECK(report_of(folder, {"--meridian", "79"}, mesh)["meridian"] == 79);

  write_bytes(folder / "pins.txt", "7 0.5 1.0\n1 2 2\n");
  const Ended ended = sphparam_program({"map", "-", "-o", "-", "--pin", folder / "pins.txt"}, mesh);
  CHECK(ended.code == 3);
  CHECK_THAT(ended.err, Contains("pins.txt:2: the mesh has no vertex 1 (it was merged"));
}

TEST_CASE("map: a file of pins that makes no sense ends with 3 and its line") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> senseless = {
      {"5 1\n", "pins.txt:1"},
      {"5 1 2 3\n", "nothing"},
      {"# c\n5 1 7\n", "pins.txt:2: phi"},
      {"5 1 -0.1\n", "phi"},
      {"5 nan 1\n", "pins.txt:1"},
      {"5.5 1 1\n", "whole number"},
      {"-1 1 1\n", "no vertex -1"},
      {"99999 1 1\n", "they are 0 to 641"},
      {"5 1 1\n6 1 2\n5 2 2\n", "pins.txt:3: vertex 5 is pinned twice, first in line 1"},
      {"5 1 1\n6 1 1\n", "pins.txt:2: vertex 6 is pinned where that of line 1 is"},
      {"# nothing\n", "no pin"},
  };
  for (const auto& [text, complaint] : senseless) {
    write_bytes(folder / "pins.txt", text);
    const Ended ended =
        sphparam_program({"map", "-", "-o", "-", "--pin", folder / "pins.txt"}, ball);
    INFO(text << ended.err);
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains(complaint));
    CHECK(ended.out.empty());
  }
  CHECK(sphparam_program({"map", "-", "-o", "-", "--pin", folder / "none"}, ball).code == 3);
}

TEST_CASE("map: a pin where a pole goes is told before any work") {
  const Folder folder;
  write_bytes(folder / "pins.txt", "6 0.3 0\n");
  const Ended ended = sphparam_program(
      {"map", "-", "-o", "-", "--poles", "5,9", "--pin", folder / "pins.txt"}, ball);
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("--pin: vertex 6 is pinned where one of the --poles is"));
}

TEST_CASE("map: a GIFTI sphere that is mapped anew claims no poles, and may not lose a meridian") {
  const Folder folder;
  const std::string mesh = obj_text(gathered_sphere());
  const std::string map = folder / "map.sph.ply", sphere = folder / "sphere.gii";
  const std::vector<std::string> words{"map",  "-",        "-o", map, "--write-sphere",
                                       sphere, "--lambda", "0.1"};
  const Ended free = sphparam_program(words, mesh);
  REQUIRE(free.code == 0);
  CHECK_THAT(free.err, Contains("mapped anew"));
  CHECK_THAT(bytes_of(map), Contains("poles"));
  CHECK_THAT(bytes_of(sphere), !Contains("poles"));
  fs::remove(sphere);
  std::vector<std::string> with_meridian = words;
  with_meridian.insert(with_meridian.end(), {"--meridian", "0"});
  const Ended refused = sphparam_program(with_meridian, mesh);
  CHECK(refused.code == 5);
  CHECK_THAT(refused.err, Contains("32 bits cannot hold this map"));
  CHECK_FALSE(fs::exists(sphere));
}

TEST_CASE("map: what poles, meridian, pins and balance may not say together ends with 2") {
  const Folder folder;
  write_bytes(folder / "pins.txt", "5 0.5 1.0\n");
  const std::string pins = folder / "pins.txt";
  const std::vector<std::vector<std::string>> senseless = {
      {"--poles", "none", "--method", "paper"},
      {"--poles", "none", "--method", "curvilinear"},
      {"--meridian", "5", "--poles", "5,40"},
      {"--meridian", "5", "--method", "paper"},
      {"--meridian", "-5"},
      {"--meridian", "99999"},
      {"--meridian", "7", "--pin", pins},
      {"--pin", pins, "--method", "paper"},
      {"--pin", pins, "--poles", "5,40"},
      {"--pin", "-"},
      {"--pin", pins, "--poles", "up"},
      {"--up", "y", "--front", "-y"},
      {"--poles", "upwards"},
      {"--poles", "up", "--method", "radial"},
      {"--pin", pins, "--json", pins},
      {"--balance", "conformal", "--lambda", "2"},
      {"--balance", "2", "--lambda", "2"},
      {"--balance", "0"},
      {"--balance", "1e7"},
      {"--balance", "2x"},
  };
  for (const auto& options : senseless) {
    std::vector<std::string> arguments = {"map", "-", "-o", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    const Ended ended = sphparam_program(arguments, ball);
    INFO(line << ended.err);
    CHECK(ended.code == 2);
    CHECK(ended.out.empty());
  }
  CHECK(bytes_of(pins) == "5 0.5 1.0\n");
}

TEST_CASE("map: a number as --balance is the lambda, and a mistyped word is answered") {
  const Folder folder;
  const std::string limb = obj_text(tube(12, 8));
  const Json report = report_of(folder, {"--balance", "3.5"}, limb);
  CHECK(report["options"]["lambda"] == 3.5);
  const std::string balanced = bytes_of(folder / "map.sph.ply");
  report_of(folder, {"--lambda", "3.5"}, limb);
  CHECK(bytes_of(folder / "map.sph.ply") == balanced);
  const Ended ended = sphparam_program({"map", "-", "-o", "-", "--balance", "conformel"}, limb);
  CHECK_THAT(ended.err, Contains("did you mean conformal?"));
}

TEST_CASE("map: the lambda that a balance found is in the report and in the file's header") {
  const Folder folder;
  const Json report = report_of(folder, {"--balance", "equal-area"}, obj_text(tube(12, 8)));
  CHECK(report["balance"]["lambda"] > 1);
  CHECK(report["balance"]["mean_abs_log2_area"] <= 0.1);
  CHECK_THAT(bytes_of(folder / "map.sph.ply"),
             Contains("comment sphparam lambda " + shortest(report["balance"]["lambda"]) + "\n"));
}

TEST_CASE("map: a mesh inside out is told unasked") {
  TriangleMesh inside_out = icosphere(2);
  inside_out.positions *= -1;
  const Ended ended = sphparam_program({"map", "-", "-o", "-"}, obj_text(inside_out));
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("warning: inside out"));
}

}  // namespace sphparam::tests
