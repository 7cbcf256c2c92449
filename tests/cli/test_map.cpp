#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "program.h"
#include "support/coil.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

/// An icosphere with one deep, wide dent: the paper's method folds it, ours must not.
TriangleMesh folding_mesh() { return random_sphere_mesh(60, 7); }

}  // namespace

TEST_CASE("map: writes a certified map that verify confirms") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(3)));
  const Ended mapped =
      sphparam_program({"map", folder / "ball.obj", "-o", folder / "ball.sph.ply"});
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  CHECK(mapped.out.empty());
  CHECK_THAT(mapped.err, Contains("ball.obj: 1280 triangles, certified one-to-one"));
  CHECK(folder.names() == Names{"ball.obj", "ball.sph.ply"});
  CHECK(sphparam_program({"verify", folder / "ball.sph.ply"}).code == 0);
}

TEST_CASE("map: reads standard input and writes the same bytes to standard output") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(2));
  const Ended piped = sphparam_program({"map", "-", "-o", "-"}, ball);
  REQUIRE(piped.code == 0);
  const Ended filed = sphparam_program({"map", "-", "-o", folder / "ball.sph.ply"}, ball);
  REQUIRE(filed.code == 0);
  CHECK(piped.out == bytes_of(folder / "ball.sph.ply"));
  CHECK(sphparam_program({"verify", "-"}, piped.out).code == 0);
}

TEST_CASE("map: --balance trades angles against areas, and the report says so") {
  const std::string limb = obj_text(tube(12, 8));
  const auto distortion = [&](const std::string& balance) {
    const Folder folder;
    const Ended ended = sphparam_program(
        {"map", "-", "-o", folder / "limb.sph.ply", "--balance", balance, "--json", "-"}, limb);
    REQUIRE(ended.code == 0);
    const Json report = Json::parse(ended.out);
    CHECK(report["options"]["balance"] == balance);
    return report["distortion"];
  };
  const Json conformal = distortion("conformal"), balanced = distortion("balanced"),
             equal_area = distortion("equal-area");
  CHECK(conformal["mean_abs_ln_angle"] < balanced["mean_abs_ln_angle"]);
  CHECK(balanced["mean_abs_ln_angle"] < equal_area["mean_abs_ln_angle"]);
  CHECK(equal_area["weighted_abs_log2_area"] < balanced["weighted_abs_log2_area"]);
  CHECK(equal_area["weighted_abs_log2_area"] <= 0.1);
}

TEST_CASE("map: no output may replace the input, not even through a link") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(1));
  write_bytes(folder / "ball.ply", ball);
  std::filesystem::create_symlink("ball.ply", std::string(folder / "link.ply"));
  for (const char* name : {"ball.ply", "link.ply"}) {
    CHECK(sphparam_program({"map", folder / "ball.ply", "-o", folder / name}).code == 2);
    CHECK(sphparam_program(
              {"map", folder / "ball.ply", "-o", folder / "map.sph.ply", "--json", folder / name})
              .code == 2);
  }
  CHECK(bytes_of(folder / "ball.ply") == ball);
}

TEST_CASE("map: options of one method are refused with another") {
  const std::string ball = obj_text(icosphere(1));
  CHECK(sphparam_program({"map", "-", "-o", "-", "--rings", "3"}, ball).code == 2);
  const Ended ended =
      sphparam_program({"map", "-", "-o", "-", "--method", "paper", "--quality", "best"}, ball);
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("--quality is for --method progressive only"));
}

TEST_CASE("map: the same bytes for 1, 2 and 4 threads") {
  const std::string tube_text = obj_text(tube(60, 12));
  const std::string one =
      sphparam_program({"map", "-", "-o", "-", "--threads", "1"}, tube_text).out;
  CHECK(one.size() > 1000);
  for (const char* threads : {"2", "4"}) {
    CHECK(sphparam_program({"map", "-", "-o", "-", "--threads", threads}, tube_text).out == one);
  }
}

TEST_CASE("map: the chart of the report is a stage, where it is too much, the map is there") {
  const Folder folder;
  const std::string map = folder / "coil.sph.ply";
  for (const int turns : {3, 80}) {
    const Ended ended =
        sphparam_program({"map", "-", "-o", map, "--json", "-"}, obj_text(coil(turns)));
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", map}).code == 0);
    const Json report = Json::parse(ended.out);
    CHECK(report["stages"].back()["name"] == "chart");
    const Json& chart = report["chart"];
    CHECK(chart["certified"] == (turns == 3));
    CHECK(chart.contains("not_made") == (turns == 80));
    if (turns == 3) continue;
    CHECK_THAT(chart["not_made"].get<std::string>(), Contains("more than the 50"));
    CHECK_THAT(ended.err, Contains("warning: chart: not made: "));
  }
}

TEST_CASE(
    "map: without a report too it says of a chart that vertices moved, and nothing of others") {
  const Folder folder;
  const std::string map = folder / "coil.sph.ply";
  const Ended moved =
      sphparam_program({"map", "-", "-o", map, "--lambda", "0.1"}, obj_text(coil(19)));
  CHECK(moved.code == 0);
  CHECK_THAT(moved.err, Contains("warning: chart: certified") && Contains("vertices moved there"));
  const Ended quiet =
      sphparam_program({"map", "-", "-o", map, "--lambda", "0.1", "-q"}, obj_text(coil(19)));
  CHECK(quiet.err.empty());
  const Ended plain = sphparam_program({"map", "-", "-o", map}, obj_text(icosphere(3)));
  CHECK_THAT(plain.err, !Contains("chart"));
}

TEST_CASE("map: --json has the documented keys") {
  const Folder folder;
  const Ended ended = sphparam_program({"map", "-", "-o", folder / "ball.sph.ply", "--json", "-"},
                                       obj_text(icosphere(2)));
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  for (const char* key :
       {"sphparam", "command", "input", "inspection", "options", "stages", "made_by", "poles",
        "certificate", "distortion", "outputs", "warnings", "notes", "seconds"}) {
    CHECK(report.contains(key));
  }
  CHECK(report["input"]["triangles"] == 320);
  CHECK(report["input"]["vertex_properties"].empty());  // those of the output are not its input's
  CHECK(report["input"]["comments"].empty());
  CHECK(report["distortion"]["flat_faces"] == 0);
  CHECK(report["inspection"]["genus"] == 0);
  CHECK(report["certificate"]["one_to_one"] == true);
  CHECK(report["certificate"]["degree"] == 1);
  CHECK(report["chart"]["certified"] == true);
  CHECK(report["chart"]["splits"]["meridian"].is_number());
  CHECK(report["distortion"]["symmetric_dirichlet"].get<double>() >= 4);
  CHECK(report["outputs"]["map"] == folder / "ball.sph.ply");
}

TEST_CASE("map: --write-sphere writes the bare sphere, which verify certifies on its own") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(2)));
  for (const char* name : {"sphere.ply", "sphere.obj", "sphere.off", "SPHERE.PLY", "SPHERE.OBJ"}) {
    const Ended ended = sphparam_program({"map", folder / "ball.obj", "-o", folder / "ball.sph.ply",
                                          "--write-sphere", folder / name});
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", folder / name}).code == 0);
    CHECK(sphparam_program({"verify", folder / "ball.obj", folder / name}).code == 0);
  }
}

TEST_CASE("map: --plots writes SVG files into the folder") {
  const Folder folder;
  const Ended ended =
      sphparam_program({"map", "-", "-o", folder / "ball.sph.ply", "--plots", folder / "plots"},
                       obj_text(icosphere(2)));
  REQUIRE(ended.code == 0);
  long plots = 0;
  for (const auto& entry : fs::directory_iterator(folder / "plots")) {
    plots += entry.path().extension() == ".svg";
  }
  CHECK(plots >= 2);
}

TEST_CASE("map: a folded map ends with 5, is not written, and its report is") {
  const Folder folder;
  write_bytes(folder / "crumpled.obj", obj_text(folding_mesh()));
  const Ended ended =
      sphparam_program({"map", folder / "crumpled.obj", "-o", folder / "map.sph.ply", "--method",
                        "paper", "--json", folder / "map.json"});
  INFO(ended.err);
  REQUIRE(ended.code == 5);
  CHECK(folder.names() == Names{"crumpled.obj", "map.json"});
  const Json report = Json::parse(bytes_of(folder / "map.json"));
  CHECK(report["certificate"]["one_to_one"] == false);
  CHECK(report["certificate"]["folds"].get<long>() > 0);
  CHECK_FALSE(report["outputs"].contains("map"));
}

TEST_CASE("map: --keep-folded writes a folded map, marked as such, still with code 5") {
  const Folder folder;
  const Ended ended = sphparam_program(
      {"map", "-", "-o", folder / "map.sph.ply", "--method", "paper", "--keep-folded"},
      obj_text(folding_mesh()));
  REQUIRE(ended.code == 5);
  CHECK_THAT(bytes_of(folder / "map.sph.ply").substr(0, 2000), Contains("folded "));
  CHECK(sphparam_program({"verify", folder / "map.sph.ply"}).code == 5);
}

TEST_CASE("map: what the paper's method folds, the default method and --repair-map certify") {
  const std::string crumpled = obj_text(folding_mesh());
  CHECK(sphparam_program({"map", "-", "-o", "-"}, crumpled).code == 0);
  const Ended mended =
      sphparam_program({"map", "-", "-o", "-", "--method", "paper", "--repair-map"}, crumpled);
  CHECK(mended.code == 0);
  CHECK_THAT(mended.err, Contains("warning: nothing is left of the map that was to be mended"));
  CHECK_THAT(mended.out.substr(0, 2000),
             Contains("comment sphparam anew nothing of the method's own map is left"));
}

TEST_CASE("map: a mesh that is no sphere ends with 4, all its defects named, in the report too") {
  const Folder folder;
  TriangleMesh open = icosphere(2);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  const Ended ended = sphparam_program(
      {"map", "-", "-o", folder / "map.sph.ply", "--json", folder / "a"}, obj_text(open));
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err, Contains("boundary"));
  CHECK(folder.names() == std::vector<std::string>{"a"});
  const Json told = Json::parse(bytes_of(folder / "a"));
  CHECK(told["command"] == "map");
  CHECK(told["input"]["file"] == "-");
  CHECK(told["error"]["code"] == 4);
  CHECK(told["inspection"]["mappable"] == false);
  REQUIRE(told["inspection"]["defects"].size() == 1);
  CHECK(told["inspection"]["defects"][0]["kind"] == "boundary-edge");
  CHECK(told["inspection"]["defects"][0]["count"] == 3);
  CHECK(told["repairs"].empty());
}

TEST_CASE("map: the report of a refusal is that of every subcommand, and lists the repairs") {
  const Folder folder;
  TriangleMesh open = icosphere(2);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  std::swap(open.triangles(20, 0), open.triangles(20, 1));
  const Ended ended = sphparam_program(
      {"bake", "-", "--map", "area", "--repair=orientation", "-o", folder / "x.png", "--json", "-"},
      obj_text(open));
  CHECK(ended.code == 4);
  const Json told = Json::parse(ended.out);
  CHECK(told["command"] == "bake");
  REQUIRE(told["repairs"].size() == 1);
  CHECK(told["repairs"][0]["kind"] == "face-turned");
  CHECK(told["repairs"][0]["first"] == Json{20});
  CHECK(folder.names().empty());
}

TEST_CASE("map: an unreadable file ends with 3 and says file and line") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(1));
  write_bytes(folder / "cut.obj", ball.substr(0, ball.size() - 8) + "\nf 1 2 x\n");
  const Ended cut = sphparam_program({"map", folder / "cut.obj", "-o", folder / "map.sph.ply"});
  CHECK(cut.code == 3);
  CHECK_THAT(cut.err, Contains("cut.obj:"));
  CHECK(sphparam_program({"map", folder / "none.obj", "-o", folder / "map.sph.ply"}).code == 3);
  CHECK(folder.names() == Names{"cut.obj"});
}

TEST_CASE("map: an output that cannot be written ends with 3") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(1));
  const std::string nowhere = folder / "nowhere/map.sph.ply";
  CHECK(sphparam_program({"map", "-", "-o", nowhere}, ball).code == 3);
  const std::string there = folder / "map.sph.ply";
  CHECK(sphparam_program({"map", "-", "-o", there, "--json", nowhere}, ball).code == 3);
  CHECK(sphparam_program({"map", "-", "-o", there, "--write-sphere", nowhere}, ball).code == 3);
  CHECK(folder.names().empty());
}

TEST_CASE("map: a failure leaves the older output as it was") {
  const Folder folder;
  write_bytes(folder / "map.sph.ply", "older");
  const std::string map = folder / "map.sph.ply";
  CHECK(sphparam_program({"map", "-", "-o", map, "--method", "paper"}, obj_text(folding_mesh()))
            .code == 5);
  CHECK(sphparam_program({"map", "-", "-o", map}, "v 0 0 0\n").code != 0);
  CHECK(bytes_of(map) == "older");
  CHECK(folder.names() == Names{"map.sph.ply"});
}

TEST_CASE("map: SIGINT and SIGTERM end with 130 and leave no file") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(6)));
  for (const int number : {SIGINT, SIGTERM}) {
    Running running(
        {"map", folder / "ball.obj", "-o", folder / "map.sph.ply", "--progress", "json"}, "");
    while (running.err_so_far().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    running.signal(number);
    const Ended ended = running.wait();
    CHECK(ended.code == 130);
    CHECK_THAT(ended.err, Contains("interrupted"));
    CHECK(folder.names() == Names{"ball.obj"});
  }
}

TEST_CASE("map: a refusal names the file, also with -q") {
  const Folder folder;
  TriangleMesh open = icosphere(1);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  write_bytes(folder / "open.obj", obj_text(open));
  const Ended ended =
      sphparam_program({"map", folder / "open.obj", "-o", folder / "map.sph.ply", "-q"});
  CHECK(ended.code == 4);
  CHECK_THAT(ended.err,
             Catch::StartsWith("sphparam: error: open.obj: this is not a closed genus-0 mesh:\n"));
}

TEST_CASE("map: signals that who starts it has it ignore stay ignored, as for a script's jobs") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(6)));
  for (const std::string name : {"INT", "TERM", "HUP"}) {
    const std::string script = "cd '" + (folder / "") + "' && trap '' " + name + " && { '" +
                               program_file() +
                               "' map ball.obj -o map.sph.ply --progress json 2> err & } && "
                               "until [ -s err ]; do sleep 0.01; done; kill -" +
                               name + " $!; wait $!";
    CHECK(std::system(script.c_str()) == 0);
    CHECK(folder.names() == Names{"ball.obj", "err", "map.sph.ply"});
    fs::remove(folder / "map.sph.ply");
    fs::remove(folder / "err");
  }
}

TEST_CASE("map: --progress json tells each percent of a stage once") {
  const Folder folder;
  const Ended ended = sphparam_program(
      {"map", "-", "-o", folder / "map.sph.ply", "--progress", "json"}, obj_text(icosphere(5)));
  REQUIRE(ended.code == 0);
  std::istringstream lines(ended.err);
  std::string before;
  int told = 0;
  for (std::string line; std::getline(lines, line); before = line) {
    if (!line.starts_with("{\"stage\"")) continue;
    ++told;
    if (line == before) FAIL_CHECK(line);
  }
  CHECK(told > 1);
}

TEST_CASE("map: -q is silent, and nothing but messages goes to standard error") {
  const Ended quiet = sphparam_program({"map", "-", "-o", "-", "-q"}, obj_text(icosphere(1)));
  CHECK(quiet.code == 0);
  CHECK(quiet.err.empty());
}

TEST_CASE("map: poles that are given are used") {
  const Folder folder;
  const Ended ended =
      sphparam_program({"map", "-", "-o", folder / "map.sph.ply", "--json", "-", "--poles", "5,40"},
                       obj_text(icosphere(3)));
  REQUIRE(ended.code == 0);
  const Json poles = Json::parse(ended.out)["poles"];
  CHECK(poles["north"] == 5);
  CHECK(poles["south"] == 40);
}

TEST_CASE("map: a pole that is no vertex ends with 2 and says which there are") {
  const Ended ended =
      sphparam_program({"map", "-", "-o", "-", "--poles", "5,99999"}, obj_text(icosphere(2)));
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("no vertex 99999; they are 0 to 161"));
  CHECK(ended.out.empty());
}

TEST_CASE("map: poles are named by their numbers in the file, also where vertices were dropped") {
  const Folder folder;
  const std::string unused = "v 9 9 9\nv 8 8 8\n";  // vertices 0 and 1 of the file, in no face
  std::string text = unused;
  const TriangleMesh ball = icosphere(2);
  for (Eigen::Index v = 0; v < ball.vertex_count(); ++v) {
    text += "v " + std::to_string(ball.positions(v, 0)) + " " +
            std::to_string(ball.positions(v, 1)) + " " + std::to_string(ball.positions(v, 2)) +
            "\n";
  }
  for (Eigen::Index f = 0; f < ball.face_count(); ++f) {
    text += "f";
    for (int k = 0; k < 3; ++k) text.append(" ").append(std::to_string(ball.triangles(f, k) + 3));
    text += "\n";
  }
  const Ended ended = sphparam_program(
      {"map", "-", "-o", folder / "map.sph.ply", "--json", "-", "--poles", "7,42"}, text);
  REQUIRE(ended.code == 0);
  const Json poles = Json::parse(ended.out)["poles"];
  CHECK(poles["north"] == 7);
  CHECK(poles["south"] == 42);
  CHECK(sphparam_program({"map", "-", "-o", "-", "--poles", "0,42"}, text).code == 2);
}

TEST_CASE("map: what a file carries and no output does is told unasked, in bake and info too") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", map = folder / "ball.sph.ply";
  write_bytes(mesh, "mtllib paint.mtl\nusemtl red\n" + obj_text(icosphere(2)) + "quux\n");
  const Ended mapped = sphparam_program({"map", mesh, "-o", map});
  REQUIRE(mapped.code == 0);
  CHECK_THAT(mapped.err, Contains("ball.obj: not carried: colours and textures of 1 material in "
                                  "'paint.mtl'") &&
                             Contains("1 unknown statement, the first 'quux'"));
  CHECK(sphparam_program({"map", mesh, "-o", map, "-q"}).err.empty());
  CHECK_THAT(sphparam_program({"map", map, "-o", folder / "again.sph.ply"}).err,
             !Contains("not carried") &&
                 Contains("ball.sph.ply: carries a map, which is left: it gets another one; all "
                          "subcommands but this take the one that it carries\n"));
  CHECK_THAT(mapped.err, !Contains("carries a map"));
  CHECK_THAT(sphparam_program({"info", mesh}).out, Contains("not carried: colours and textures"));
  CHECK_THAT(
      sphparam_program({"bake", mesh, "--map", "area", "--size", "64", "-o", folder / "a.exr"}).err,
      Contains("not carried: colours and textures"));
}

TEST_CASE("map: a GIFTI sphere holds floats at radius 100, and is certified as such") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(3)));
  const Ended mapped = sphparam_program({"map", folder / "ball.obj", "-o", folder / "ball.sph.ply",
                                         "--write-sphere", folder / "ball.gii"});
  INFO(mapped.err);
  REQUIRE(mapped.code == 0);
  CHECK_THAT(bytes_of(folder / "ball.gii"), Contains("NIFTI_TYPE_FLOAT32"));
  const Ended verified = sphparam_program({"verify", folder / "ball.gii", "--json", "-"});
  CHECK(verified.code == 0);
  CHECK(Json::parse(verified.out)["mean_length"].get<double>() == Approx(100));
  const Ended baked =
      sphparam_program({"bake", folder / "ball.obj", "--sphere", folder / "ball.gii", "--map",
                        "area", "--size", "64", "-o", folder / "a.exr"});
  INFO(baked.err);
  CHECK(baked.code == 0);
}

}  // namespace sphparam::tests
