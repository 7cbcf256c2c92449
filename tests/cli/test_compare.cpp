#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

/// `sphparam compare`, and `map` with the methods of others.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

const std::vector<std::string> rivals = {"tangential",    "hemispheres", "brechbuehler",
                                         "stereographic", "conformal",   "flow"};

}  // namespace

TEST_CASE("compare: every method is in the table, the charts and the report") {
  const Folder folder;
  const std::string out = folder / "page";
  const Ended ended = sphparam_program({"compare", "-", "-o", out, "--size", "24"},
                                       obj_text(random_sphere_mesh(300, 3)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const std::string page = bytes_of(out + "/index.html");
  const Json report = Json::parse(bytes_of(out + "/compare.json"));
  Names names = {"progressive", "curvilinear", "paper"};
  names.insert(names.end(), rivals.begin(), rivals.end());
  REQUIRE(report["maps"].size() == names.size());
  for (size_t i = 0; i < names.size(); ++i) {
    INFO(names[i]);
    const Json& map = report["maps"][i];
    CHECK(map["name"] == names[i]);
    CHECK(map["certificate"]["folds"].is_number());
    CHECK(map["distortion"]["symmetric_dirichlet"] >= 4);
    CHECK_THAT(page, Contains("<th scope=\"row\">" + names[i] + "</th>"));
    if (i == 0) continue;
    CHECK_FALSE(bytes_of(out + "/chart-" + names[i] + "-area.svg").empty());
    CHECK_FALSE(bytes_of(out + "/sphere-" + names[i] + ".png").empty());
  }
}

TEST_CASE("compare: spheres of peers are added, the first method is the blue one") {
  const Folder folder;
  const TriangleMesh mesh = icosphere(2);
  write_bytes(folder / "ball.obj", obj_text(mesh));
  const Names arguments = {"compare",      folder / "ball.obj",
                           "-o",           folder / "page",
                           "--methods",    "curvilinear",
                           "--add",        "one=" + folder / "ball.obj",
                           "--add",        "two=" + (folder / "ball.obj"),
                           "--no-pictures"};
  const Ended ended = sphparam_program(arguments);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json maps = Json::parse(bytes_of(folder / "page/compare.json"))["maps"];
  REQUIRE(maps.size() == 3);
  CHECK(maps[1]["name"] == "one");
  CHECK(maps[1]["certificate"]["one_to_one"] == true);
  CHECK(maps[1]["seconds"].is_null());
  CHECK_THAT(bytes_of(folder / "page/index.html"), Contains("curvilinear against two"));
}

TEST_CASE("compare: a sphere that is none is told, and a run that cannot write leaves no folder") {
  const Folder folder;
  TriangleMesh egg = icosphere(2);
  write_bytes(folder / "ball.obj", obj_text(egg));
  egg.positions.col(0) *= 2;
  write_bytes(folder / "egg.obj", obj_text(egg));
  const auto compare = [&](const std::string& name, const char* out) {
    return sphparam_program({"compare", folder / "ball.obj", "--methods", "curvilinear", "--add",
                             name + "=" + (folder / "egg.obj"), "--no-pictures", "-o",
                             folder / out});
  };
  const Ended told = compare("egg", "page");
  CHECK(told.code == 0);
  CHECK_THAT(told.err, Contains("warning") &&
                           Contains("egg: these points are not on a sphere about the origin"));
  CHECK(Json::parse(bytes_of(folder / "page/compare.json"))["command"] == "compare");
  CHECK(compare(std::string(250, 'x'), "new/page").code == 3);  // chart-… is no name of a file
  CHECK(folder.names() == Names{"ball.obj", "egg.obj", "page"});
}

TEST_CASE("compare: what is wrong is said before any method runs, and nothing is written") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(1));
  write_bytes(folder / "other.obj", obj_text(icosphere(2)));
  const auto code = [&](const Names& more, const std::string& words) {
    Names arguments = {"compare", "-", "-o", folder / "page"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(arguments, ball);
    CHECK_THAT(ended.err, Contains(words));
    return ended.code;
  };
  CHECK(code({"--methods", "paper,tangental"}, "did you mean tangential?") == 2);
  CHECK(code({"--methods", "paper,paper"}, "twice") == 2);
  CHECK(code({"--methods", ""}, "--methods") == 2);
  CHECK(code({"--add", "noname"}, "NAME=FILE") == 2);
  CHECK(code({"--add", "../x=" + folder / "other.obj"}, "NAME=FILE") == 2);
  CHECK(code({"--add", "paper=" + folder / "other.obj"}, "taken") == 2);
  CHECK(code({"--add", "a=" + folder / "other.obj"}, "not a sphere of") == 3);
  CHECK(folder.names() == Names{"other.obj"});
}

TEST_CASE("map: methods of others are reported as they are, and mended when asked") {
  const std::string limb = obj_text(tube(60, 5));
  for (const std::string& method : rivals) {
    INFO(method);
    const Folder folder;
    const Ended kept = sphparam_program({"map", "-", "-o", folder / "map.sph.ply", "--method",
                                         method, "--keep-folded", "--json", "-"},
                                        limb);
    const Json report = Json::parse(kept.out);
    CHECK(report["options"]["method"] == method);
    CHECK(report["account"]["statement"].is_string());
    CHECK_FALSE(report["account"]["source"].get<std::string>().empty());
    CHECK(kept.code == (report["certificate"]["one_to_one"] == true ? 0 : 5));
    if (report["account"]["end"] == "no-result") continue;
    CHECK(report["made_by"] == method);
    CHECK_THAT(bytes_of(folder / "map.sph.ply").substr(0, 600),
               Contains("comment sphparam method " + method + "\n") &&
                   Contains("comment sphparam after "));
    CHECK(
        sphparam_program({"map", "-", "-o", "-", "--method", method, "--repair-map"}, limb).code ==
        0);
  }
}

TEST_CASE("map: a folded map of others is not written unless asked") {
  const std::string limb = obj_text(tube(60, 5));
  int folded = 0;
  for (const std::string& method : rivals) {
    INFO(method);
    const Folder folder;
    const Ended ended =
        sphparam_program({"map", "-", "-o", folder / "map.sph.ply", "--method", method}, limb);
    if (ended.code == 0) continue;
    ++folded;
    CHECK(ended.code == 5);
    CHECK_THAT(ended.err, Contains("--repair-map mends it"));
    CHECK(folder.names().empty());
  }
  CHECK(folded > 0);
}

TEST_CASE("map: methods of others take no frame and no options of ours") {
  const std::string ball = obj_text(icosphere(1));
  for (const Names& more : {Names{"--poles", "0,5"},
                            {"--meridian", "3"},
                            {"--lambda", "2"},
                            {"--quality", "best"},
                            {"--rings", "2"},
                            {"--poles", "none"}}) {
    Names arguments = {"map", "-", "-o", "-", "--method", "flow"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    INFO(more.front());
    const Ended ended = sphparam_program(arguments, ball);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(more.front()));
  }
}

}  // namespace sphparam::tests
