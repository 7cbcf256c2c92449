#include <catch2/catch.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

/// `sphparam report`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

}  // namespace

TEST_CASE("report: a mesh without a map is mapped, and the page says how") {
  const Folder folder;
  const Ended ended = sphparam_program(
      {"report", "-", "-o", folder / "page.html", "--size", "64", "--json", folder / "page.json"},
      obj_text(random_sphere_mesh(300, 3)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("mapped now") && Contains("one-to-one"));
  const std::string page = bytes_of(folder / "page.html");
  CHECK_THAT(page, Contains("Spherical map of standard input") && Contains("progressive") &&
                       Contains("sphparam report - -o page.html --size 64"));
  CHECK(Json::parse(bytes_of(folder / "page.json"))["seconds"].is_number());
  CHECK(Json::parse(bytes_of(folder / "page.json"))["maps"][0]["certificate"]["one_to_one"] ==
        true);
  CHECK(folder.names().size() == 2);
}

TEST_CASE("report: maps of one mesh stand side by side, under names that differ") {
  const Folder folder;
  const TriangleMesh mesh = random_sphere_mesh(200, 5);
  write_bytes(folder / "one.obj", obj_text(mesh));
  fs::create_directories(folder / "more");
  for (const char* method : {"progressive", "curvilinear"}) {
    const bool first = method == std::string("progressive");
    const std::string path = folder / (first ? "one" : "more/one");
    REQUIRE(sphparam_program({"map", folder / "one.obj", "--method", method, "-o",
                              path + ".sph.ply", "--write-sphere", path + "-sphere.obj"})
                .code == 0);
  }
  const Ended ended = sphparam_program({"report", folder / "one.sph.ply",
                                        folder / "more/one.sph.ply", folder / "more/one-sphere.obj",
                                        "--size", "64", "--no-viewer", "-o", folder / "page.html"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const std::string page = bytes_of(folder / "page.html");
  CHECK_THAT(page, Contains("3 maps of one mesh") && Contains("<th>one</th><th>one (2)</th>") &&
                       Contains("curvilinear") && !Contains("<script"));
  CHECK(sphparam_program({"report", folder / "one.sph.ply", folder / "more/one.sph.ply",
                          folder / "more/one-sphere.obj", "--size", "64", "--no-viewer", "-o",
                          folder / "again.html", "--threads", "1"})
            .code == 0);
}

TEST_CASE(
    "report: what is no sphere about the origin is shown by its directions, and that is told") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);
  write_bytes(folder / "ball.obj", obj_text(ball));
  ball.positions *= 100;
  write_bytes(folder / "large.obj", obj_text(ball));
  ball.positions.col(0) *= 2;
  write_bytes(folder / "egg.obj", obj_text(ball));
  const auto report = [&](const char* map) {
    return sphparam_program({"report", folder / "ball.obj", folder / map, "--size", "64",
                             "--no-viewer", "-o", folder / "page.html", "--json",
                             folder / "page.json"});
  };
  const Ended egg = report("egg.obj");
  CHECK(egg.code == 0);
  CHECK_THAT(egg.err, Contains("egg: these points are not on a sphere about the origin") &&
                          Contains("their directions are judged"));
  CHECK_THAT(report("large.obj").err, !Contains("not on a sphere"));
  CHECK(Json::parse(bytes_of(folder / "page.json"))["command"] == "report");
}

TEST_CASE("report: a program without the viewer says so and how to get it") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  const std::string page = folder / "page.html";
  const Ended ended = sphparam_program({"report", folder / "ball.obj", "-o", page, "--size", "64"});
  REQUIRE(ended.code == 0);
  const bool has_viewer = bytes_of(page).find("<model-viewer") != std::string::npos;
  const bool told = ended.err.find("-DSPHPARAM_VIEWER=FOLDER") != std::string::npos;
  CHECK(has_viewer != told);
  const Ended unwanted =
      sphparam_program({"report", folder / "ball.obj", "-o", page, "--size", "64", "--no-viewer"});
  CHECK_THAT(unwanted.err, !Contains("SPHPARAM_VIEWER"));
}

TEST_CASE("report: one texture for a mesh of several materials, and none without coordinates") {
  const Folder folder;
  std::string text = obj_text(icosphere(1));
  write_bytes(folder / "bare.obj", text);
  std::string faces = "vt 0 0\nvt 1 0\nvt 0 1\n";
  long face = 0;
  for (size_t at = text.find("f "); at != std::string::npos; at = text.find("f ", at + 1)) {
    int a = 0, b = 0, c = 0;
    REQUIRE(std::sscanf(text.c_str() + at, "f %d %d %d", &a, &b, &c) == 3);
    faces += "usemtl m" + std::to_string(face++ % 3) + "\nf " + std::to_string(a) + "/1 " +
             std::to_string(b) + "/2 " + std::to_string(c) + "/3\n";
  }
  write_bytes(folder / "ball.obj", text.substr(0, text.find("f ")) + faces);
  REQUIRE(
      sphparam_program({"render", folder / "bare.obj", "-o", folder / "skin.png", "--size", "16"})
          .code == 0);
  const auto report = [&](const char* mesh) {
    return sphparam_program({"report", folder / mesh, "--texture", folder / "skin.png", "-o",
                             folder / "page.html", "--size", "64", "--no-viewer"});
  };
  const Ended ended = report("ball.obj");
  INFO(ended.err);
  CHECK(ended.code == 0);
  const Ended bare = report("bare.obj");
  CHECK(bare.code == 2);
  CHECK_THAT(bare.err, Contains("bare.obj has no texture coordinates"));
}

TEST_CASE("report: a page may have any name that is not of another kind") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  const Ended ended = sphparam_program(
      {"report", folder / "ball.obj", "-o", folder / "page.v2", "--size", "64", "--no-viewer"});
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(bytes_of(folder / "page.v2"), Contains("<html"));
}

TEST_CASE("report: what is wrong is named, and nothing is written") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(1)));
  write_bytes(folder / "other.obj", obj_text(icosphere(2)));
  const auto fails = [&](std::vector<std::string> arguments, int code, const std::string& words) {
    arguments.insert(arguments.begin(), "report");
    const Ended ended = sphparam_program(arguments);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(words));
  };
  const std::string ball = folder / "ball.obj", page = folder / "page.html";
  fails({ball}, 2, "--output");
  fails({ball, "-o", page, "--json", ball}, 2, "it would be replaced");
  fails({"-", "-", "-o", page}, 2, "only one");
  fails({ball, folder / "other.obj", "-o", page}, 3, "not a map of ball.obj");
  fails({ball, folder / "none.obj", "-o", page}, 3, "none.obj");
  fails({ball, "-o", page, "--texture", folder / "none.png"}, 3, "none.png");
  fails({ball, "-o", page, "--json", page}, 2, "the same file");
  fails({ball, "-o", folder / "page.glb"}, 2, "written as .html, not as .glb");
  fails({ball, "-o", folder / "page.pdf"}, 2, "written as .html, not as .pdf");
  fails({ball, "-o", folder / "no/page.html"}, 3, "no/page.html");
  CHECK(folder.names().size() == 2);
}

}  // namespace sphparam::tests
