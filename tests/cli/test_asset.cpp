#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "support/torus.h"

namespace sphparam::tests {

using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("asset: `sphparam FILE` fills a folder beside, all files together") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", out = folder / "made", json = folder / "r.json";
  write_bytes(mesh, obj_text(icosphere(3)));
  const Ended ended = sphparam_program({mesh, "-o", out, "--size", "64", "--json", json});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("One closed surface as it is, certified one-to-one"));
  for (const char* name : {"ball.glb", "ball.sph.ply", "ball_ao.png", "ball.html"})
    CHECK(fs::exists(fs::path(out) / name));
  const nlohmann::json report = nlohmann::json::parse(bytes_of(json));
  CHECK(report["surface"] == "itself");
  CHECK_THAT(ended.err,
             Contains("\n  in the .glb: " + report["chart"]["triangles"].dump() + " triangles, " +
                      report["chart"]["vertices"].dump() + " vertices\n"));
  CHECK(sphparam_program({"verify", out + "/ball.sph.ply"}).code == 0);
  CHECK(sphparam_program({mesh, "-o", out, "--size", "64", "--no-page"}).code == 0);  // once more
}

TEST_CASE("asset: --textures webp is of the .glb, whose size is told, images beside it are PNG") {
  const Folder folder;
  const std::string out = folder / "made", json = out + "/r.json";
  TriangleMesh cup = icosphere(3);  // its top pressed in, so that it has some occlusion
  constexpr double rim = 0.5;
  for (Vertex v = 0; v < cup.vertex_count(); ++v)
    cup.positions(v, 2) = std::min(cup.positions(v, 2), 2 * rim - cup.positions(v, 2));
  const Ended ended = sphparam_program(
      {"asset", "-", "-o", out, "--size", "64", "--textures", "webp", "--json", json},
      obj_text(cup));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("  mesh.glb 0.0") && Contains(" % of it images\n") &&
                            Contains(" as given: 2 webp"));
  CHECK(fs::exists(out + "/mesh_ao.png"));
  const nlohmann::json textures = nlohmann::json::parse(bytes_of(json))["textures"];
  REQUIRE(textures.size() == 2);
  for (const auto& texture : textures) CHECK(texture["kind"] == "webp");
}

TEST_CASE(
    "asset: where its file would replace the input, another folder is named before any work") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", made = folder / "made";
  write_bytes(mesh, obj_text(icosphere(2)));
  REQUIRE(sphparam_program({mesh, "-o", made, "--size", "64", "--no-page"}).code == 0);
  for (const char* name : {"/ball.glb", "/ball.sph.ply"}) {
    const std::string before = bytes_of(made + name);
    const Ended ended = sphparam_program({"asset", made + name, "-o", made});
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("-o: " + made + name + " is the input, and would be replaced") &&
                              Contains("as in -o " + made + "/made"));
    CHECK(bytes_of(made + name) == before);
    CHECK(sphparam_program({"asset", made + name, "-o", made + "/made", "--size", "64"}).code == 0);
  }
}

TEST_CASE("asset: a stream, a folder with a slash at its end, a report in it") {
  const Folder folder;
  const std::string out = folder / "made";
  const Ended ended = sphparam_program(
      {"-", "-o", out + "/", "--size", "64", "--no-page", "--json", out + "/r.json"},
      obj_text(icosphere(2)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(fs::exists(out + "/mesh.glb"));
  CHECK(fs::exists(out + "/r.json"));
  CHECK_THAT(ended.err, Contains("--up y where it lies on its side"));
}

TEST_CASE("asset: what stood in the way is told in plain words, with figures by -v") {
  const Folder folder;
  const TriangleMesh ball = icosphere(3);
  const TriangleMesh open{ball.positions, ball.triangles.bottomRows(ball.face_count() - 1)};
  const std::vector<std::string> line = {"asset",  "-",  "-o",       folder / "made",
                                         "--size", "64", "--no-page"};
  const Ended brief = sphparam_program(line, obj_text(open));
  REQUIRE(brief.code == 0);
  CHECK_THAT(brief.err,
             Contains("  it is open: 1 hole or border\n") && Contains("  1 hole filled"));
  CHECK_THAT(brief.err, !Contains("boundary edges") && !Contains("--keep"));
  std::vector<std::string> wordy = line;
  wordy.emplace_back("-v");
  CHECK_THAT(sphparam_program(wordy, obj_text(open)).err, Contains("3 boundary edges"));
}

TEST_CASE("asset: where repair drops a part, --keep 1 is told, which keeps it") {
  const Folder folder;
  TriangleMesh claw = icosphere(0);
  claw.positions *= 0.05;
  const std::string text = obj_text(joined(icosphere(3), claw, {1.2, 0, 0}));
  std::vector<std::string> line = {
      "asset", "-", "-o", folder / "made", "--size", "64", "--no-page", "--resolution", "24"};
  const Ended mended = sphparam_program(line, text);
  INFO(mended.err);
  REQUIRE(mended.code == 0);
  CHECK_THAT(mended.err, Contains("1 component dropped") && Contains("Mended to one") &&
                             Contains("with --keep 1 the parts that it dropped stay"));
  line.insert(line.end(), {"--keep", "1"});
  const Ended kept = sphparam_program(line, text);
  INFO(kept.err);
  REQUIRE(kept.code == 0);
  CHECK_THAT(kept.err, Contains("Wrapped in one closed surface") && !Contains("--keep 1"));
}

TEST_CASE("asset: a vertex without a place is left out, and what no number holds is refused") {
  const Folder folder;
  TriangleMesh open = icosphere(2);
  open.triangles.conservativeResize(open.face_count() / 2, 3);
  const auto made = [&](const TriangleMesh& mesh) {
    return sphparam_program(
        {"asset", "-", "-o", folder / "made", "--size", "64", "--resolution", "16", "--no-page"},
        obj_text(mesh));
  };
  TriangleMesh without = open, huge = icosphere(2);
  without.positions.row(without.triangles(0, 0)).setConstant(std::nan(""));
  const Ended wrapped = made(without);
  INFO(wrapped.err);
  CHECK(wrapped.code == 0);
  huge.positions *= 1e60;
  const Ended beyond_floats = made(huge);
  CHECK(beyond_floats.code == 4);
  CHECK_THAT(beyond_floats.err, Contains("float32") && !Contains("internal"));
  open.positions *= 1e150;
  const Ended beyond_doubles = made(open);
  CHECK(beyond_doubles.code == 4);
  CHECK_THAT(beyond_doubles.err, Contains("scale the mesh down") && !Contains("internal"));
}

TEST_CASE("asset: with --up and --front the map stands as the asset does, a wrap's too") {
  const Folder folder;
  TriangleMesh egg = icosphere(3);
  egg.positions.col(1) *= 1.5;
  const TriangleMesh open{egg.positions, egg.triangles.topRows(egg.face_count() / 2)};
  for (const TriangleMesh& mesh : {egg, open}) {
    const Ended ended =
        sphparam_program({"asset", "-", "-o", folder / "made", "--size", "64", "--up", "y",
                          "--front", "-x", "--resolution", "24", "--no-page"},
                         obj_text(mesh));
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const std::string map = bytes_of(folder / "made/mesh.sph.ply").substr(0, 1200);
    CHECK_THAT(map, Contains("comment up axis y\n") && Contains("comment front axis -x\n"));
    CHECK_THAT(map, Contains("comment sphparam upright y, front -x\n"));
  }
  const Ended clash = sphparam_program(
      {"asset", "-", "-o", folder / "none", "--size", "64", "--front", "z"}, obj_text(egg));
  CHECK(clash.code == 2);
  CHECK_THAT(clash.err, Contains("--front: the front, z"));
}

TEST_CASE("asset: what folds as 16-bit numbers is counted in the report as it is warned of") {
  const Folder folder;
  const std::string mesh = folder / "grown.obj";
  TriangleMesh grown = icosphere(4);
  // One vertex far out: triangles at it are smaller than a step of 16 bits.
  grown.positions.row(0) *= 1e7;
  write_bytes(mesh, obj_text(grown));
  const Ended ended = sphparam_program({"asset", mesh, "-o", folder / "made", "--size", "64",
                                        "--no-page", "--compress", "--json", "-"});
  REQUIRE(ended.code == 0);
  const nlohmann::json report = nlohmann::json::parse(ended.out);
  INFO(ended.err);
  CHECK(report["folds_as_stored"] == 2);
}

TEST_CASE(
    "asset: what a missing library of materials takes, and --faces of what is no wrap, is told") {
  const Folder folder;
  write_bytes(folder / "a.obj", "mtllib a.mtl\nusemtl p\n" + obj_text(icosphere(2)));
  const Ended ended = sphparam_program({"asset", folder / "a.obj", "-o", folder / "made", "--size",
                                        "64", "--no-page", "--faces", "100", "--json", "-"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("warning: the asset comes out bare: without the colours and "
                                 "textures of 1 material in 'a.mtl' (No such file or directory)"));
  CHECK_THAT(ended.err, Contains("warning: --faces is of wraps only, and this is none: it has all "
                                 "its 320 triangles; `sphparam remesh " +
                                 folder / "made/a.sph.ply --grid ico:5 -o light.sph.ply`"));
}

TEST_CASE("asset: of parts that lie far apart the share of what joins them is told") {
  const Folder folder;
  write_bytes(folder / "two.obj", obj_text(joined(icosphere(2), icosphere(2), {6, 0, 0})));
  const Ended ended =
      sphparam_program({"asset", folder / "two.obj", "-o", folder / "made", "--size", "64",
                        "--no-page", "--resolution", "64", "--faces", "2000"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("what joins and closes it so is ") &&
                            Contains(" of the map and ") &&
                            Contains("`map --all-components` gives each part a map of its own"));
}

TEST_CASE("asset: --clear-walls warns where no base colour could cut its walls out") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);
  ball.positions *= 0.3;
  ball.positions.col(0).array() += 2;
  write_bytes(folder / "ring.obj", obj_text(joined(torus(24, 12, 1, 0.3), ball)));
  const Ended ended = sphparam_program({"asset", folder / "ring.obj", "-o", folder / "made",
                                        "--size", "64", "--no-page", "--resolution", "48",
                                        "--faces", "2000", "--clear-walls", "--fail-on-warnings"});
  INFO(ended.err);
  CHECK(ended.code == 6);
  CHECK_THAT(ended.err, Contains("warning: --clear-walls: walls that close ways through it are ") &&
                            Contains("and stay: it has no base colour whose alpha could cut"));
}

TEST_CASE("asset: --scale is of all lengths, and without it what is too long for metres is told") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);
  ball.positions *= 150;  // millimetres
  write_bytes(folder / "ball.obj", obj_text(ball));
  const auto made = [&](std::vector<std::string> scale) {
    std::vector<std::string> words = {"asset", folder / "ball.obj", "-o", folder / "made", "--size",
                                      "64",    "--no-page"};
    words.insert(words.end(), scale.begin(), scale.end());
    const Ended ended = sphparam_program(words);
    REQUIRE(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(made({}), Contains("it is 300 m long in glTF") && Contains("--scale 0.001"));
  CHECK_THAT(made({"--scale", "0.001"}), !Contains(" m long in glTF"));
  CHECK_THAT(bytes_of(folder / "made/ball.sph.ply"), Contains("comment lengths times 0.001\n"));
  const Ended apart = sphparam_program({"measure", folder / "made/ball.sph.ply",
                                        folder / "made/ball.glb", "--upright", "--json", "-"});
  CHECK(nlohmann::json::parse(apart.out)["two_sided"]["max"] < 1e-7);
  CHECK(nlohmann::json::parse(apart.out)["first"]["diagonal"] < 0.53);
}

TEST_CASE("asset: a batch of some says which were mended and wrapped, and how they are distorted") {
  const Folder folder;
  fs::create_directory(folder / "in");
  TriangleMesh open = icosphere(2);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  write_bytes(folder / "in/ball.obj", obj_text(icosphere(2)));
  write_bytes(folder / "in/open.obj", obj_text(open));
  write_bytes(folder / "in/two.obj", obj_text(joined(icosphere(2), icosphere(2), {1, 0, 0})));
  const std::string work = folder / "work";
  REQUIRE(sphparam_program({"batch", "plan", folder / "in", "-o", work, "--chunk", "1", "--",
                            "asset", "{input}", "-o", "made", "--size", "64", "--no-page",
                            "--resolution", "16", "--faces", "500"})
              .code == 0);
  REQUIRE(sphparam_program({"batch", "run", work}).code == 0);
  const auto record = [&](const std::string& id) {
    return nlohmann::json::parse(bytes_of(work + "/results/" + id + "/record.json"));
  };
  CHECK(record("ball")["repairs"] == "");
  CHECK(record("open")["repairs"] == "hole-filled 1");
  CHECK(record("two")["repairs"] == "wrapped 1");
  const nlohmann::json ball = record("ball")["steps"][0]["report"];
  CHECK(ball["vertices"] == 162);
  CHECK(ball["distortion"]["mean_abs_ln_area"] > 0);
  CHECK_THAT(sphparam_program({"batch", "status", work}).out,
             Contains("of the done: 3 certified one-to-one, 1 repaired, 1 wrapped"));
  REQUIRE(sphparam_program({"batch", "report", work, "-o", folder / "all.html"}).code == 0);
  CHECK_THAT(bytes_of(folder / "all.html"), !Contains("no values"));
}

TEST_CASE("asset: what cannot be done is said, and leaves no folder") {
  const Folder folder;
  const std::string mesh = folder / "a.obj", out = folder / "made";
  write_bytes(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  const auto asset = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"asset", mesh, "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    return sphparam_program(words);
  };
  const Ended empty = asset({});
  INFO(empty.err);
  CHECK(empty.code == 3);
  CHECK_FALSE(fs::exists(out));
  CHECK(asset({"--resolution", "2"}).code == 2);
  CHECK(sphparam_program({folder / "missing.glb"}).code == 3);
  write_bytes(out, "a file");
  write_bytes(mesh, obj_text(icosphere(1)));
  fs::remove(out);
  CHECK(asset({"--size", "63"}).code == 2);
  write_bytes(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");  // a lattice about it is a cube
  const Ended fine = asset({"--resolution", "2000"});
  CHECK(fine.code == 2);
  CHECK_THAT(fine.err, Contains("--resolution is 2000: it must be about "));
  write_bytes(mesh, obj_text(icosphere(1)));
  CHECK_FALSE(fs::exists(out));
  for (const std::string& ending : {std::string(), std::string(".ply")}) {
    const Ended too_long =
        sphparam_program({"asset", mesh, "-o", folder / std::string(300, 'l') + ending});
    CHECK(too_long.code == 3);
    CHECK_THAT(too_long.err, !Contains("internal error"));
  }
  write_bytes(out, "a file");
  const Ended file = asset({});
  CHECK(file.code == 3);
  CHECK(bytes_of(out) == "a file");
  CHECK_THAT(sphparam_program({"asset", mesh, "-o", folder / "no/such"}).err,
             Contains("such: the folder that it is to be made in is not there: mkdir -p " +
                      (folder / "no") + " makes it"));
  CHECK_THAT(asset({"--keep", "2"}).err, Contains("--keep: expected a number from 0 to 1\n"));
  CHECK(sphparam_program({"nonsense"}).code == 2);
  CHECK(sphparam_program({"asset", mesh, "-o", folder / "x.glb"}).code == 2);
}

}  // namespace sphparam::tests
