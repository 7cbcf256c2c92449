#include <catch2/catch.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::StartsWith;

}  // namespace

TEST_CASE("program: --version says the version on standard output") {
  const Ended ended = sphparam_program({"--version"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.out, StartsWith("sphparam 0."));
  CHECK(ended.err.empty());
}

TEST_CASE("program: --help shows examples before options and documents the exit codes") {
  const Ended ended = sphparam_program({"--help"});
  CHECK(ended.code == 0);
  CHECK(ended.out.find("Examples:") < ended.out.find("Usage:"));
  CHECK_THAT(ended.out, Contains("130  interrupted"));
}

TEST_CASE("program: every subcommand has examples before its options") {
  for (const char* command : {"info", "map", "verify", "render", "compare", "measure"}) {
    const Ended ended = sphparam_program({command, "--help"});
    CHECK(ended.code == 0);
    CHECK(ended.out.find("Examples:") < ended.out.find("Usage:"));
  }
}

TEST_CASE("program: help does what --help does, of a subcommand too") {
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{}, Words{"map"}, Words{"batch", "run"}}) {
    Words before = words, after = words;
    before.insert(before.begin(), "help");
    after.emplace_back("--help");
    const Ended ended = sphparam_program(before);
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    CHECK(ended.out == sphparam_program(after).out);
  }
}

TEST_CASE("program: help of no subcommand names the one that was meant") {
  const Ended ended = sphparam_program({"help", "mpa"});
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  CHECK_THAT(ended.err, Contains("unknown subcommand mpa; did you mean map?"));
  const Ended of_batch = sphparam_program({"help", "batch", "nosuch"});
  CHECK(of_batch.code == 2);
  CHECK(of_batch.out.empty());
  CHECK_THAT(of_batch.err,
             StartsWith("sphparam: error: batch has no subcommand nosuch; it has plan, run, "
                        "status, retry, table, report\n"));
  const Ended of_map = sphparam_program({"help", "map", "all"});
  CHECK(of_map.code == 2);
  CHECK(of_map.out.empty());
  CHECK_THAT(of_map.err, StartsWith("sphparam: error: map has no subcommand all: sphparam help map "
                                    "tells all of it\n"));
}

TEST_CASE("program: an option whose value is empty is no option that is not there") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj";
  write_bytes(mesh, obj_text(icosphere(1)));
  for (const char* option : {"--range", "--scalar", "--texture", "--from", "--sphere"}) {
    const Ended ended = sphparam_program({"render", mesh, "-o", folder / "out.png", option, ""});
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, StartsWith("sphparam: error: " + std::string(option) +
                                     ": its value is empty: give one, or leave the option out"));
  }
  CHECK(folder.names() == std::vector<std::string>{"ball.obj"});
}

TEST_CASE(
    "program: a file that is not there is told before a mesh is mapped, which may take minutes") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", nowhere = folder / "nowhere.ply";
  write_bytes(mesh, obj_text(icosphere(1)));
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"paint", mesh, "--image", nowhere, "-o", folder / "out.ply"},
        {"export", mesh, "--image", nowhere, "-o", folder / "out.glb"},
        {"export", mesh, "--orm-map", nowhere, "-o", folder / "out.glb"},
        {"bake", mesh, "--texture", nowhere, "-o", folder / "out.png"},
        {"bake", mesh, "--for", nowhere, "--map", "ao", "-o", folder / "out.png"},
        {"bake", mesh, "--from", nowhere, "-o", folder / "out.png"},
        {"remesh", mesh, "--grid", "like:" + nowhere, "-o", folder / "out.ply"},
        {"remesh", mesh, "--grid", "ico:2", "--sample", "adap-bary-area", "--areas",
         mesh + "," + nowhere, "-o", folder / "out.ply"},
        {"spharm", mesh, "--align", "--flip-template", nowhere},
        {"report", mesh, nowhere, "-o", folder / "out.html"},
        {"group", mesh, nowhere, "-o", folder / "out"},
        {"match", mesh, mesh, "--sphere-b", nowhere, "-o", folder / "out.ply"}}) {
    const Ended ended = sphparam_program(words);
    INFO(words.front() << ": " << ended.err);
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains("nowhere.ply: No such file") && !Contains("mapped now"));
    CHECK(folder.names() == Words{"ball.obj"});
  }
}

TEST_CASE("program: what a mesh lacks, and what is no word, is told before it is mapped") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", image = folder / "image.png";
  write_bytes(mesh, obj_text(icosphere(1)));
  write_bytes(image, "no image");
  using Words = std::vector<std::string>;
  for (const auto& [words, code, message] : std::vector<std::tuple<Words, int, std::string>>{
           {{"paint", mesh, "--image", image, "--atlas", "16", "-o", folder / "out.png"},
            2,
            "--atlas: the mesh has no texture coordinates"},
           {{"export", mesh, "--source-uv", "-o", folder / "out.glb"},
            2,
            "--source-uv: the mesh has no texture coordinates"},
           {{"export", mesh, "--variants", "cheker", "-o", folder / "out.glb"},
            2,
            "did you mean checker?"},
           {{"export", mesh, "--images", folder / "nowhere", "-o", folder / "out.glb"},
            3,
            "nowhere: No such file"},
           {{"spharm", mesh, "--scalar", "thicknes"}, 2, "have no property thicknes"},
           {{"remesh", mesh, "--grid", "ico:2", "--transfer", "thicknes", "-o", folder / "out.ply"},
            2,
            "--transfer: no property thicknes to transfer; there are position"},
           {{"match", mesh, mesh, "--features", "sulk,sulk", "-o", folder / "out.ply"},
            3,
            "sulk: is no file, and no property of the mesh's vertices, which have none"}}) {
    const Ended ended = sphparam_program(words);
    INFO(words.front() << ": " << ended.err);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(message) && !Contains("mapped now"));
    CHECK(folder.names() == Words{"ball.obj", "image.png"});
  }
}

TEST_CASE("program: no arguments give a short help and the usage code") {
  const Ended ended = sphparam_program({});
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  CHECK_THAT(ended.err, Contains("sphparam map"));
}

TEST_CASE("program: a mistyped subcommand or option is answered with the one that was meant") {
  const Ended command = sphparam_program({"mpa", "x.obj"});
  CHECK(command.code == 2);
  CHECK_THAT(command.err, Contains("unknown subcommand mpa") && Contains("did you mean map?"));

  const Ended option = sphparam_program({"map", "x.obj", "--tread", "2"});
  CHECK(option.code == 2);
  CHECK_THAT(option.err, Contains("unknown option --tread") && Contains("did you mean --threads?"));

  const Ended nonsense = sphparam_program({"map", "x.obj", "-o", "y.ply", "--xyzzy"});
  CHECK(nonsense.code == 2);
  CHECK_THAT(nonsense.err, !Contains("did you mean"));
}

TEST_CASE("program: what is meant for other subcommands is answered with what takes it") {
  const Folder folder;
  const std::string mesh = folder / "a b.off", scans = folder / "my scans";
  write_bytes(mesh, "OFF\n");
  fs::create_directory(scans);
  const auto told = [](const std::vector<std::string>& words, int code) {
    const Ended ended = sphparam_program(words);
    CHECK(ended.code == code);
    return ended.err;
  };
  CHECK_THAT(told({"map", scans, "-o", "x.ply"}, 3),
             Contains("my scans: is a directory: `sphparam survey '" + scans +
                      "' -o survey.html` looks at every mesh in it, `sphparam batch plan '" +
                      scans + "' -o WORK -- map` plans the maps of all"));
  CHECK_THAT(told({"group", scans, "-o", folder / "g"}, 3),
             Contains("a group takes files, as in `sphparam group '" + scans + "/*.ply' -o OUT`"));
  CHECK_THAT(told({"survey", mesh, "-o", folder / "s.html"}, 3),
             Contains("Not a directory: `sphparam info '" + mesh + "'` tells of one mesh"));
  CHECK_THAT(told({"map", mesh, "c.off", "-o", "x.ply"}, 2),
             Contains("unexpected argument c.off; one mesh is mapped: `sphparam batch plan FILES"));
  CHECK_THAT(told({"batch", "plan", scans, "-o", folder / "w", "map", "--repair"}, 2),
             Contains("unknown option --repair; the subcommand that is to run and its options come "
                      "last, behind --: `-- map --repair`"));
  CHECK_THAT(told({"map", mesh, "-o", "x.ply", "--lambda", "0,5"}, 2),
             Contains("--lambda: expected a number from 1e-10 to 1e6, with a point: 0.5\n"));
  CHECK_THAT(told({"map", mesh, "-o", "x.ply", "--lambda", "0,5,5"}, 2),
             Contains("--lambda: expected a number from 1e-10 to 1e6\n"));
  CHECK_THAT(told({"batch", "run", scans}, 3),
             Contains("`sphparam batch plan … -o '" + scans + "' -- map` makes one"));
}

TEST_CASE("program: command lines that make no sense end with code 2 and touch nothing") {
  const std::vector<std::vector<std::string>> senseless = {
      {"map"},
      {"map", "x.obj"},
      {"map", "x.obj", "-o", "y.ply", "--method", "magic"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3,3"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3,4,5"},
      {"map", "x.obj", "-o", "y.ply", "--lambda", "-1"},
      {"map", "x.obj", "-o", "y.ply", "--lambda", "much"},
      {"map", "x.obj", "-o", "y.ply", "--epsilon", "0.1"},  // only the paper's method reads it
      {"map", "x.obj", "-o", "y.ply", "--method", "curvilinear", "--sweeps", "1"},
      {"map", "x.obj", "-o", "-", "--json", "-"},
      {"map", "x.obj", "-o", "y.obj"},
      {"map", "x.obj", "-o", "y.ply", "--write-sphere", "y.stl"},
      {"map", "x.obj", "-o", "y.ply", "--write-sphere", "y.ply"},
      {"info"},
      {"verify"},
      {"verify", "a", "b", "c"},
  };
  for (const auto& arguments : senseless) {
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    INFO(line);
    const Ended ended = sphparam_program(arguments);
    CHECK(ended.code == 2);
    CHECK(ended.out.empty());
    CHECK_THAT(ended.err, Contains("error:") && Contains("--help"));
  }
}

TEST_CASE("program: behind a double dash are files, and what is missing before it is said") {
  const Ended missing = sphparam_program({"remesh", "-o", "z.sph.ply", "--", "-p.stl"});
  CHECK(missing.code == 2);
  CHECK_THAT(missing.err, Contains("--grid") && !Contains("unknown option"));
  const Ended stray = sphparam_program({"wrap", "-o", "y.ply", "--", "-p.stl", "--json"});
  CHECK(stray.code == 2);
  CHECK_THAT(stray.err, Contains("unexpected argument --json"));
}

TEST_CASE("program: options that all subcommands have may stand before them") {
  const std::string ball = obj_text(icosphere(1));
  const Ended quiet = sphparam_program({"-q", "--threads", "1", "map", "-", "-o", "-"}, ball);
  CHECK(quiet.code == 0);
  CHECK(quiet.err.empty());
  CHECK(quiet.out == sphparam_program({"map", "-", "-o", "-", "-q", "--threads", "1"}, ball).out);
  const Ended told = sphparam_program({"--progress=json", "-v", "map", "-", "-o", "-"}, ball);
  CHECK(told.code == 0);
  CHECK_THAT(told.err, Contains("\"percent\":") && Contains("certificate: "));
  for (const char* command : {"info", "verify"}) {
    CHECK(sphparam_program({"-q", command, "-"}, ball).out.empty());
    CHECK(sphparam_program({"--progress", "none", command, "-"}, ball).code == 0);
  }
  CHECK(sphparam_program({"--threads", "1", "info", "-"}, ball).code == 0);
  CHECK(sphparam_program({"--threads", "1", "repair", "-", "-o", "-"}, ball).code == 0);
  CHECK(sphparam_program({"-q"}).code == 2);
  CHECK(sphparam_program({"-q", "mpa", "x.obj"}).code == 2);
}

TEST_CASE("program: numbers are decimal, and what is none is refused and named") {
  const std::vector<std::vector<std::string>> numbers = {
      {"map", "--lambda"},          {"map", "--meridian"},
      {"map", "--epsilon"},         {"map", "--iterations"},
      {"map", "--rings"},           {"map", "--sweeps"},
      {"map", "--component"},       {"map", "--max-hole"},
      {"map", "--min-kept"},        {"map", "--threads"},
      {"map", "--max-memory"},      {"render", "--size"},
      {"compare", "--size"},        {"spharm", "--degree"},
      {"remesh", "--lods"},         {"remesh", "--displace-size"},
      {"measure", "--samples"},     {"measure", "--seed"},
      {"measure", "--max-rms"},     {"measure", "--max-distance"},
      {"paint", "--atlas"},         {"paint", "--padding"},
      {"report", "--size"},         {"export", "--image-size"},
      {"export", "--refine-poles"}, {"export", "--lods"},
      {"bake", "--size"},           {"bake", "--samples"},
      {"wrap", "--voxel"},          {"wrap", "--resolution"},
      {"wrap", "--distance"},       {"bake", "--rays"},
      {"bake", "--max-dist"}};
  for (const std::vector<std::string>& number : numbers) {
    for (const char* garbage : {"abc", "1z", "0x10", "nan", "1e999", "true"}) {
      const Ended ended = sphparam_program({number[0], number[1] + "=" + garbage});
      INFO(number[0] << " " << number[1] << "=" << garbage << "\n" << ended.err);
      CHECK(ended.code == 2);
      CHECK_THAT(ended.err, Contains(number[1]));
    }
  }
  // It would be 8, as in C.
  CHECK_THAT(sphparam_program({"map", "x.obj", "-o", "y.ply", "--component", "010"}).err,
             Contains("--component: expected a number from 1 on"));
}

TEST_CASE("program: --json is a file in every subcommand, - for standard output") {
  const Folder folder;
  const std::string ball = folder / "ball.obj", json = folder / "a.json";
  write_bytes(ball, obj_text(icosphere(1)));
  for (const char* command : {"info", "verify"}) {
    const Ended both = sphparam_program({command, ball, "--json", json});
    CHECK(both.code == 0);
    CHECK_THAT(both.out, Contains("ball.obj"));
    const std::string report = bytes_of(json);
    CHECK_THAT(report, Contains("\"command\": \"" + std::string(command) + "\""));
    CHECK(sphparam_program({command, ball, "--json", "-"}).out.substr(0, 60) ==
          report.substr(0, 60));
    // As it was once written, without a file.
    for (const std::vector<std::string>& former :
         {std::vector<std::string>{command, ball, "--json"}, {command, "--json", "a.txt"}}) {
      const Ended ended = sphparam_program(former);
      CHECK(ended.code == 2);
      CHECK_THAT(ended.err, Contains("`--json -` is standard output"));
    }
  }
  const std::string before = bytes_of(ball);
  for (const std::string& mesh : {ball, folder / "other.ply"}) {
    const Ended ended = sphparam_program({"verify", ball, "--json", mesh});
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(mesh == ball ? "would be replaced" : "is the name of a mesh"));
  }
  CHECK(bytes_of(ball) == before);
}

TEST_CASE("program: map --sphere, which once wrote, ends with 2 and names what writes now") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  write_bytes(folder / "sphere.obj", "mine");
  const Ended ended = sphparam_program(
      {"map", folder / "ball.obj", "-o", folder / "m.ply", "--sphere", folder / "sphere.obj"});
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("--write-sphere FILE writes it"));
  CHECK(bytes_of(folder / "sphere.obj") == "mine");
}

TEST_CASE("program: an option that had two meanings ends with 2 and names what it is now") {
  const std::vector<std::vector<std::string>> former = {
      {"map", "--charts", "--plots FOLDER"},
      {"remesh", "--normals", "--normal-image FILE"},
      {"export", "--texture", "--image IMAGE"},
      {"export", "--textures", "--images FOLDER"},
      {"export", "--normal", "--normal-map IMAGE"},
      {"export", "--occlusion", "--occlusion-map IMAGE"}};
  for (const std::vector<std::string>& option : former) {
    const Ended ended = sphparam_program({option[0], "mesh.obj", "-o", "x.glb", option[1], "y"});
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(option[0] + ": ") && Contains(option[2]));
  }
}

TEST_CASE("program: -q leaves errors, also where a mesh or a map is refused") {
  TriangleMesh open = icosphere(1), folded = icosphere(1);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  folded.positions.row(3) *= -1;
  const Ended info = sphparam_program({"info", "-q", "-"}, obj_text(open));
  CHECK(info.code == 4);
  CHECK(info.out.empty());
  CHECK_THAT(info.err, Contains("error:") && Contains("not a closed genus-0 mesh"));
  const Ended verify = sphparam_program({"verify", "-q", "-"}, obj_text(folded));
  CHECK(verify.code == 5);
  CHECK(verify.out.empty());
  CHECK_THAT(verify.err, Contains("error:") && Contains("folded"));
  const Ended map = sphparam_program({"map", "-q", "-", "-o", "-", "--method", "paper"},
                                     obj_text(random_sphere_mesh(60, 7)));
  CHECK(map.code == 5);
  CHECK_THAT(map.err, Contains("error:") && Contains("no map written"));
}

TEST_CASE("program: standard output that cannot be written ends with 3") {
  if (!fs::exists("/dev/full")) return;
  const std::string ball = obj_text(icosphere(1));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "-"},
                                                    {"verify", "-"},
                                                    {"map", "-", "-o", "-"},
                                                    {"--help"},
                                                    {"map", "--help"},
                                                    {"--version"},
                                                    {"manual"}}) {
    INFO(arguments.front());
    CHECK(sphparam_program(arguments, ball, "/dev/full").code == 3);
  }
}

TEST_CASE("usage: where a format cannot keep a map, what is said to write it does") {
  const auto told = [](const std::string& name) {
    const Ended refused = sphparam_program({"map", "x.obj", "-o", name});
    CHECK(refused.code == 2);
    return refused.err;
  };
  CHECK_THAT(told("y.stl"), Contains(".stl cannot keep one; the sphere alone is written as .obj") &&
                                !Contains("--write-sphere"));
  CHECK_THAT(told("y.obj"), Contains("--write-sphere FILE writes the sphere alone as .obj"));
  CHECK_THAT(told("y.glb"), Contains("`sphparam export` of the map writes .glb"));
  const Ended repair = sphparam_program({"repair", "x.obj", "-o", "y.usdz"});
  CHECK(repair.code == 2);
  CHECK_THAT(repair.err,
             Contains("not as y.usdz: `sphparam export` writes that, of a mapped mesh"));
}

}  // namespace sphparam::tests
