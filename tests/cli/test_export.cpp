#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/image_codec.h"
#include "io/polygons/welding.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "support/glb_json.h"
#include "support/joined.h"
#include "support/test_meshes.h"

/// `sphparam export`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

/// A mesh and a file beside it for what is exported.
struct Egg {
  Folder folder;
  std::string mesh = folder / "egg.obj";

  Egg() {
    TriangleMesh egg = icosphere(2);
    egg.positions.col(2) *= 1.3;
    write_bytes(mesh, obj_text(egg));
  }

  Ended run(const std::string& output, Names more = {}) const {
    Names arguments = {"export", mesh, "-o", folder / output, "--image-size", "64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sphparam_program(arguments);
  }
};

}  // namespace

TEST_CASE("export: a mesh becomes a .glb with a checker, its report says what is certified") {
  const Egg egg;
  const Ended ended = egg.run("egg.glb", {"--json", egg.folder / "egg.json"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(egg.folder.names() == Names{"egg.glb", "egg.json", "egg.obj"});
  const Json gltf = json_of(bytes_of(egg.folder / "egg.glb"));
  CHECK(gltf["materials"][0]["name"] == "checker");
  CHECK(gltf["asset"]["extras"]["sphparam"]["chart_as_stored"] == "one-to-one");
  CHECK(gltf["asset"]["extras"]["sphparam"]["map_verdict"] == "one-to-one");
  const Json report = Json::parse(bytes_of(egg.folder / "egg.json"));
  CHECK(report["levels"][0]["certified_as_stored"] == true);
  CHECK(report["levels"][0]["triangles"] == gltf["accessors"].back()["count"].get<int>() / 3);
}

TEST_CASE("export: a square image is shown, with the warning that paint gives") {
  const Egg egg;
  write_image(egg.folder / "square.png", Image(16, 16, 3));
  for (const char* output : {"egg.glb", "square.obj", "egg.ply"}) {
    const Ended ended = egg.run(output, {"--image", egg.folder / "square.png"});
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, Contains("warning: ") && Contains("square.png: 16 × 16: ") &&
                              Contains("twice as wide as high"));
  }
}

TEST_CASE("export: materials that can be switched, each once") {
  const Egg egg;
  REQUIRE(egg.run("egg.glb", {"--variants", "checker,axes,area"}).code == 0);
  const Json gltf = json_of(bytes_of(egg.folder / "egg.glb"));
  Names names;
  for (const Json& variant : gltf["extensions"]["KHR_materials_variants"]["variants"])
    names.push_back(variant["name"]);
  CHECK(names == Names{"checker", "axes", "area"});
}

TEST_CASE("export: .gltf, .obj and .ply come with the files they name") {
  const Egg egg;
  REQUIRE(egg.run("a.gltf").code == 0);
  CHECK(egg.folder.names() == Names{"a.bin", "a.gltf", "a_checker.png", "egg.obj"});
  REQUIRE(egg.run("b.obj").code == 0);
  CHECK_THAT(bytes_of(egg.folder / "b.obj"), Contains("mtllib b.mtl\n"));
  CHECK_THAT(bytes_of(egg.folder / "b.mtl"), Contains("map_Kd b_checker.png\n"));
  REQUIRE(egg.run("c.ply").code == 0);
  CHECK_THAT(bytes_of(egg.folder / "c.ply"), Contains("comment TextureFile c_checker.png\n"));
}

TEST_CASE("export: .usda comes with its image, .usdz has it, levels are files of their own") {
  const Egg egg;
  REQUIRE(egg.run("a.usda", {"--json", egg.folder / "a.json"}).code == 0);
  CHECK(egg.folder.names() == Names{"a.json", "a.usda", "a_checker.png", "egg.obj"});
  CHECK(Json::parse(bytes_of(egg.folder / "a.json"))["levels"][0]["certified_as_stored"] == true);
  CHECK_THAT(bytes_of(egg.folder / "a.usda"),
             Contains("string chart_as_stored = \"one-to-one\"\n") &&
                 Contains("asset inputs:file = @./a_checker.png@\n"));
  REQUIRE(egg.run("b.usdz", {"--lods", "1", "--variants", "axes"}).code == 0);
  CHECK_THAT(bytes_of(egg.folder / "b.usdz"), Contains("model.usda") &&
                                                  Contains("textures/axes.png") &&
                                                  Contains("string look = \"checker\""));
  CHECK_THAT(bytes_of(egg.folder / "b_lod1.usdz"), Contains("string level_1_rms = "));
}

TEST_CASE("export: colours of vertices are primvars of a .usda, and an image of a .usdz") {
  const Egg egg;
  MeshFile file = read_mesh(egg.mesh);
  for (const char* name : {"red", "green", "blue"})
    file.set_vertex_property(
        {name, ScalarType::Uint8,
         std::vector<double>(static_cast<std::size_t>(file.mesh.vertex_count()), 255)});
  const std::string mesh = egg.folder / "c.ply";
  write_mesh(mesh, file);
  for (const char* name : {"c.usda", "c.usdz"})
    REQUIRE(
        sphparam_program({"export", mesh, "-o", egg.folder / name, "--image-size", "64"}).code ==
        0);
  CHECK_THAT(bytes_of(egg.folder / "c.usda"), Contains("displayColor = [(1, 1, 1), "));
  CHECK(egg.folder.names() == Names{"c.ply", "c.usda", "c.usdz", "egg.obj"});
  CHECK_THAT(bytes_of(egg.folder / "c.usdz"),
             Contains("@textures/baked.png@") && !Contains("displayColor"));
}

TEST_CASE("export: levels of detail, as files or in one") {
  const Egg egg;
  REQUIRE(egg.run("egg.glb", {"--lods", "2"}).code == 0);
  CHECK(egg.folder.names() == Names{"egg.glb", "egg.obj", "egg_lod1.glb", "egg_lod2.glb"});
  REQUIRE(egg.run("one.glb", {"--lods", "2", "--lod", "msft"}).code == 0);
  CHECK(json_of(bytes_of(egg.folder / "one.glb"))["nodes"].size() == 3);
  REQUIRE(egg.run("n{n}.glb", {"--lods", "1"}).code == 0);
  CHECK_FALSE(bytes_of(egg.folder / "n1.glb").empty());
}

TEST_CASE("export: how far each level is from the mesh is told, in the report and in the files") {
  const Egg egg;
  const std::string report = egg.folder / "r.json";
  const auto extras = [&](const char* name) {
    return json_of(bytes_of(egg.folder / name))["asset"]["extras"]["sphparam"];
  };
  const Ended files = egg.run("a.glb", {"--lods", "2", "--json", report});
  REQUIRE(files.code == 0);
  const Json levels = Json::parse(bytes_of(report))["levels"];
  CHECK_FALSE(levels[0].contains("rms"));
  for (std::size_t i = 1; i < 3; ++i) {
    const double rms = levels[i]["rms"], max = levels[i]["max"];
    CHECK(rms > 0);
    CHECK(rms < max);
    CHECK(max < 1);
    const std::string level = std::to_string(i);
    CHECK_THAT(files.out + files.err, Contains("  level " + level + ", "));
    const Json own = extras(("a_lod" + level + ".glb").c_str());
    CHECK(std::stod(own["level_" + level + "_rms"].get<std::string>()) == Approx(rms));
    CHECK(std::stod(own["level_" + level + "_max"].get<std::string>()) == Approx(max));
  }
  CHECK(levels[1]["rms"] < levels[2]["rms"]);
  CHECK_FALSE(extras("a.glb").contains("level_1_rms"));
  REQUIRE(egg.run("one.glb", {"--lods", "2", "--lod", "msft"}).code == 0);
  for (const char* level : {"1", "2"})
    CHECK(extras("one.glb")["level_" + std::string(level) + "_rms"] ==
          extras(("a_lod" + std::string(level) + ".glb")
                     .c_str())["level_" + std::string(level) + "_rms"]);
}

TEST_CASE("export: levels end where none is coarser, which is told, and none is there twice") {
  const Egg egg;
  const std::string report = egg.folder / "r.json";
  const Ended ended = egg.run("a.glb", {"--lods", "8", "--json", report});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json json = Json::parse(bytes_of(report));
  const int lods = json["lods"];
  CHECK(json["lods_wanted"] == 8);
  CHECK(lods > 1);
  CHECK(lods < 8);
  CHECK(json["levels"].size() == static_cast<size_t>(lods + 1));
  CHECK_THAT(ended.err, Contains("--lods 8: " + std::to_string(lods) + " coarser meshes are") &&
                            Contains("the last has 20 triangles"));
  const auto level = [&](int n) { return egg.folder / ("a_lod" + std::to_string(n) + ".glb"); };
  CHECK(bytes_of(level(lods)) != bytes_of(level(lods - 1)));
  CHECK_FALSE(fs::exists(level(lods + 1)));
  const Ended all = egg.run("b.glb", {"--lods", "1", "--json", report});
  CHECK_THAT(all.err, !Contains("none is coarser"));
  CHECK(Json::parse(bytes_of(report))["lods"] == 1);
}

TEST_CASE("export: levels of as many triangles as are named, at most") {
  const Egg egg;
  const std::string report = egg.folder / "r.json";
  const Ended ended = egg.run("a.glb", {"--lod-faces", "100,30", "--json", report});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, !Contains("warning"));
  const Json json = Json::parse(bytes_of(report));
  CHECK(json["lods_wanted"] == 2);
  CHECK(json["lods"] == 2);
  for (const int level : {1, 2}) {
    CHECK(json["levels"][level]["in_space"]["triangles"] == 0);
    CHECK(json["levels"][level]["certified_as_stored"] == true);
  }
  CHECK(json["levels"][1]["triangles"] >= 100);  // the chart cuts some
  CHECK(json["levels"][2]["triangles"] < json["levels"][1]["triangles"]);
  CHECK(std::filesystem::exists(egg.folder / "a_lod2.glb"));
}

TEST_CASE(
    "export: levels as fine as the mesh are passed over, which is told, and coarser ones made") {
  const Egg egg;
  const std::string report = egg.folder / "r.json";
  const Ended ended = egg.run("a.glb", {"--lod-faces", "5000,320,100", "--json", report});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err,
             Contains("--lod-faces: 2 levels are left out: the mesh has no more than 320 "
                      "triangles\n"));
  CHECK_THAT(ended.err, !Contains("none is coarser") && !Contains("instead of"));
  const Json json = Json::parse(bytes_of(report));
  CHECK(json["lods_wanted"] == 3);
  CHECK(json["lods"] == 1);
  CHECK(std::filesystem::exists(egg.folder / "a_lod1.glb"));
  CHECK_FALSE(std::filesystem::exists(egg.folder / "a_lod2.glb"));
}

TEST_CASE("export: levels that cross themselves in space are told, and in the report") {
  const Egg egg;
  TriangleMesh spiked = icosphere(2);
  spiked.positions.row(0) *= -3;  // through what lies opposite
  write_bytes(egg.mesh, obj_text(spiked));
  write_bytes(egg.folder / "ball.obj", obj_text(icosphere(2)));
  const std::string report = egg.folder / "r.json";
  const Ended ended =
      egg.run("a.glb", {"--sphere", egg.folder / "ball.obj", "--lods", "1", "--json", report});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("warning: level 1: ") && Contains("cross others in space"));
  const Json found = Json::parse(bytes_of(report))["levels"][1]["in_space"];
  CHECK(found["crossings"]["pairs"] > 0);
  CHECK(found["crossings_of_mesh"] > 0);
}

TEST_CASE("export: levels of a mesh without area are written, how far they are is left out") {
  const Egg egg;
  TriangleMesh needle = icosphere(2);
  needle.positions.leftCols(2).setZero();
  const std::string mesh = egg.folder / "needle.obj", report = egg.folder / "r.json";
  write_bytes(mesh, obj_text(needle));
  write_bytes(egg.folder / "ball.obj", obj_text(icosphere(2)));
  const Ended ended = sphparam_program({"export", mesh, "--sphere", egg.folder / "ball.obj", "-o",
                                        egg.folder / "n.glb", "--image-size", "64", "--lods", "1",
                                        "--json", report});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("--lods: how far 1 coarser mesh is from the mesh cannot be told"));
  CHECK_THAT(ended.out + ended.err, !Contains("level 1, "));
  const Json levels = Json::parse(bytes_of(report))["levels"];
  REQUIRE(levels.size() == 2);
  CHECK_FALSE(levels[1].contains("rms"));
  const Json extras = json_of(bytes_of(egg.folder / "n_lod1.glb"))["asset"]["extras"]["sphparam"];
  CHECK_FALSE(extras.contains("level_1_rms"));
}

TEST_CASE("export: with a kept topology and poles at vertices torn edges are listed") {
  const Egg egg;
  const std::string report = egg.folder / "r.json";
  for (const char* name : {"a.glb", "a.obj"}) {
    const Ended ended = egg.run(name, {"--keep-topology", "--json", report});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Json torn = Json::parse(bytes_of(report))["levels"][0]["torn_as_stored"];
    REQUIRE_FALSE(torn.empty());
    CHECK_THAT(ended.err, Contains(std::to_string(torn.size()) + " edges torn, of triangles: "));
    int least = torn[0].get<int>() / 3;
    for (const Json& side : torn) least = std::min(least, side.get<int>() / 3);
    CHECK_THAT(ended.err, Contains("of triangles: " + std::to_string(least) + " "));
  }
}

TEST_CASE("export: with a kept topology what folds is told, and marked in the file") {
  Egg egg;
  const std::string map = egg.folder / "egg.sph.ply";  // ±z within faces
  REQUIRE(sphparam_program({"map", egg.mesh, "-o", map, "--poles", "none"}).code == 0);
  egg.mesh = map;
  const Ended ended = egg.run("egg.glb", {"--keep-topology"});
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("fold in (u, v)"));
  const Json extras = json_of(bytes_of(egg.folder / "egg.glb"))["asset"]["extras"]["sphparam"];
  CHECK_THAT(extras["topology"].get<std::string>(), Contains("kept"));
  CHECK_THAT(extras["chart_as_stored"].get<std::string>(), Contains("not one-to-one"));
}

TEST_CASE("export: an .obj is certified as read back, and a kept topology is told there too") {
  Egg egg;
  const std::string report = egg.folder / "r.json";
  REQUIRE(egg.run("a.obj", {"--json", report}).code == 0);
  CHECK(Json::parse(bytes_of(report))["levels"][0]["certified_as_stored"] == true);
  const std::string map = egg.folder / "egg.sph.ply";  // ±z within faces
  REQUIRE(sphparam_program({"map", egg.mesh, "-o", map, "--poles", "none"}).code == 0);
  egg.mesh = map;
  const Ended kept = egg.run("b.obj", {"--keep-topology", "--json", report});
  REQUIRE(kept.code == 0);
  CHECK_THAT(kept.err, Contains("fold in (u, v)"));
  const Json level = Json::parse(bytes_of(report))["levels"][0];
  CHECK(level["certified_as_stored"] == false);
  CHECK(level["folded_as_stored"].size() + level["around_pole"].size() > 0);
}

TEST_CASE("export: --scale is of all lengths, and without it what is too long for metres is told") {
  const Folder folder;
  TriangleMesh ball = icosphere(2);
  ball.positions *= 150;  // millimetres
  write_bytes(folder / "ball.obj", obj_text(ball));
  const auto exported = [&](const char* option) {
    const Ended ended = sphparam_program({"export", folder / "ball.obj", "-o", folder / "ball.glb",
                                          "--up=y", "--image-size=32", option, "--json", "-"});
    REQUIRE(ended.code == 0);
    return ended;
  };
  CHECK_THAT(exported("--unlit").err, Contains("it is 300 m long in glTF"));
  const Ended scaled = exported("--scale=0.001");
  CHECK_THAT(scaled.err, !Contains("m long"));
  CHECK(Json::parse(scaled.out)["notes"] == Json::array({"lengths times 0.001"}));
  ball.positions /= 1000;
  write_bytes(folder / "small.obj", obj_text(ball));
  const Ended apart = sphparam_program(
      {"measure", folder / "ball.glb", folder / "small.obj", "--samples", "1000", "--json", "-"});
  CHECK(Json::parse(apart.out)["two_sided"]["max"] < 1e-7);
}

TEST_CASE("export: --scalar is seen as colours, which is told, and what it may not go with") {
  Egg egg;
  MeshFile file;
  file.mesh = icosphere(1);
  Property height{"height", ScalarType::Float64, {}};
  for (const double z : file.mesh.positions.col(2)) height.values.push_back(z);
  file.set_vertex_property(height);
  egg.mesh = egg.folder / "ball.ply";
  write_mesh(egg.mesh, file);
  const Ended bare = egg.run("bare.glb");
  CHECK_THAT(bare.err, Contains("a number of its vertices is seen as colours with --scalar NAME"));
  CHECK(json_of(bytes_of(egg.folder / "bare.glb"))["materials"][0]["name"] == "checker");
  const Ended seen = egg.run("seen.glb", {"--scalar", "height", "--range", "-2,2"});
  INFO(seen.err);
  REQUIRE(seen.code == 0);
  CHECK_THAT(seen.err, Contains("colours of height: from -2 (blue) by 0 (white) to 2 (red)") &&
                           !Contains("with --scalar NAME"));
  const Json gltf = json_of(bytes_of(egg.folder / "seen.glb"));
  CHECK(gltf["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  CHECK_THAT(gltf["asset"]["extras"]["sphparam"]["comments"].get<std::string>(),
             Contains("colours of height: from -2"));
  const auto refused = [&](const Names& words, const char* why) {
    const Ended ended = egg.run("x.glb", words);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(why));
  };
  refused({"--scalar", "depth"}, "--scalar: vertices have no 'depth'; there are height");
  refused({"--range", "0,1"}, "--range is the scale of --scalar");
  refused({"--scalar", "height", "--images", egg.folder / "."}, "leave out --image and --images");
}

TEST_CASE("export: parts get the images that bake made of each in one folder") {
  const Folder folder;
  TriangleMesh two = joined(icosphere(2), icosphere(1), {3, 0, 0});
  write_bytes(folder / "two.obj", obj_text(two));
  const std::string map = folder / "two.sph.ply", images = folder / "img";
  REQUIRE(sphparam_program({"map", folder / "two.obj", "--all-components", "-o", map}).code == 0);
  const auto exported = [&] {
    return sphparam_program(
        {"export", map, "--all-components", "--images", images, "-o", folder / "two.glb"});
  };
  std::filesystem::create_directory(images);
  CHECK_THAT(exported().err, Contains("holds no image of two_0001"));
  REQUIRE(sphparam_program(
              {"bake", map, "--all-components", "--map", "ao", "--size", "32", "-o", images + "/"})
              .code == 0);
  CHECK(std::filesystem::exists(images + "/two_0002_ao.png"));
  const Ended ended = exported();
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK(std::filesystem::exists(folder / "two_0002.glb"));
}

TEST_CASE("export: triangles that rounding folds are told without being asked") {
  const Egg egg;
  TriangleMesh ball = icosphere(2);
  const int v = ball.triangles(0, 0), near = ball.triangles(0, 1);
  const Vector3 moved =
      ball.positions.row(near) + 1e-7 * (ball.positions.row(v) - ball.positions.row(near));
  ball.positions.row(v) = moved.normalized();
  write_bytes(egg.folder / "ball.obj", obj_text(ball));
  const Ended ended = egg.run("x.glb", {"--sphere", egg.folder / "ball.obj", "--quantize"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("fold in (u, v) as stored"));
}

TEST_CASE(
    "export: where triangles are thinner than (u, v) can tell, vertices move, which is told") {
  const Egg egg;
  // Two apexes over a ring, of which so many vertices stand closer below θ = 2π than u can tell.
  for (const int crowd : {6, 300}) {
    std::string ball = "v 0 0 1\nv 0 0 -1\nv 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\n";
    for (int i = crowd; i > 0; --i)
      ball += "v 1 -0.0000010000000" + std::to_string(1000000 + i) + " 0\n";
    const int ring = 4 + crowd;
    for (int i = 0; i < ring; ++i) {
      const std::string one = std::to_string(3 + i), next = std::to_string(3 + (i + 1) % ring);
      ball += "f 1 " + one + " " + next + "\nf 2 " + next + " " + one + "\n";
    }
    const std::string path = egg.folder / "ball.obj";
    write_bytes(path, ball);
    for (const Names& more : {Names{}, Names{"--variants", "area"}}) {
      Names arguments = {"export", path, "--sphere", path, "-o", egg.folder / "x.glb"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Ended ended = sphparam_program(arguments);
      INFO(ended.err);
      CHECK(ended.code == 0);
      CHECK_THAT(ended.err,
                 Contains("thinner than (u, v) can tell, ") && Contains("moved there, by up to"));
    }
  }
}

TEST_CASE("export: no output replaces an input or another output") {
  const Egg egg;
  const std::string ball = egg.folder / "ball.obj", image = egg.folder / "image.png";
  write_bytes(ball, obj_text(icosphere(2)));
  REQUIRE(egg.run("a.gltf").code == 0);
  write_bytes(image, bytes_of(egg.folder / "a_checker.png"));
  const Names before = egg.folder.names();
  const std::vector<std::pair<std::string, Names>> mistakes = {
      {"ball.obj", {"--sphere", ball}},
      {"x.glb", {"--json", egg.mesh}},
      {"x.glb", {"--sphere", ball, "--json", ball}},
      {"x.glb", {"--image", image, "--json", image}},
      {"x.glb", {"--normal-map", image, "--json", image}},
      {"x.glb", {"--json", egg.folder / "x.glb"}},
      {"x.gltf", {"--json", egg.folder / "x.bin"}},
      {"x.gltf", {"--json", egg.folder / "x_checker.png"}},
      {"x.glb", {"--lods", "1", "--json", egg.folder / "x_lod1.glb"}},
      {"a.gltf",
       {"--image", egg.folder / "a_basecolor.png", "--occlusion-map", egg.folder / "a.bin"}}};
  for (const auto& [output, more] : mistakes) {
    const Ended ended = egg.run(output, more);
    INFO(output << " " << more[0] << ": " << ended.err);
    CHECK(ended.code == 2);
    CHECK(egg.folder.names() == before);
  }
  CHECK(bytes_of(ball) == obj_text(icosphere(2)));
}

TEST_CASE("export: a normal map is of the finest mesh alone") {
  const Egg egg;
  REQUIRE(egg.run("a.gltf").code == 0);
  const Names normal = {"--normal-map", egg.folder / "a_checker.png", "--variants", "axes"};
  Names files = normal, one = normal;
  files.insert(files.end(), {"--lods", "1"});
  one.insert(one.end(), {"--lods", "1", "--lod", "msft"});
  const Ended ended = egg.run("x.glb", files);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("coarser levels are without"));
  const Json fine = json_of(bytes_of(egg.folder / "x.glb"));
  CHECK(fine["materials"][0].contains("normalTexture"));
  const Json coarse = json_of(bytes_of(egg.folder / "x_lod1.glb"));
  CHECK(coarse["images"].size() == fine["images"].size() - 1);
  for (const Json& material : coarse["materials"]) {
    CHECK_FALSE(material.contains("normalTexture"));
    CHECK(material["pbrMetallicRoughness"]["baseColorTexture"]["index"] < coarse["images"].size());
  }
  REQUIRE(egg.run("y.glb", one).code == 0);
  const Json both = json_of(bytes_of(egg.folder / "y.glb"));
  const Json& far = both["meshes"][1]["primitives"][0];
  CHECK_FALSE(both["materials"][far["material"].get<size_t>()].contains("normalTexture"));
  CHECK_FALSE(far["attributes"].contains("TANGENT"));
  const Json& variants = far["extensions"]["KHR_materials_variants"]["mappings"];
  CHECK(variants[1]["material"] == 3);
  CHECK(variants[1]["variants"][0] == 1);
}

TEST_CASE(
    "export: under a normal or occlusion map a mesh without colours is white, not a checker") {
  const Egg egg;
  REQUIRE(egg.run("a.gltf").code == 0);
  for (const char* map : {"--normal-map", "--occlusion-map"}) {
    REQUIRE(egg.run("x.glb", {map, egg.folder / "a_checker.png"}).code == 0);
    const Json gltf = json_of(bytes_of(egg.folder / "x.glb"));
    CHECK(gltf["materials"][0]["name"] == "plain");
    CHECK(gltf["images"][0]["name"] == "white");
    CHECK(gltf["images"].size() == 2);
  }
}

TEST_CASE("export: all channels of an asset arrive, as its materials have them") {
  const Egg egg;
  const std::string asset = egg.folder / "asset.obj";
  write_bytes(asset, "mtllib asset.mtl\nusemtl glow\n" + bytes_of(egg.mesh));
  write_bytes(egg.folder / "asset.mtl",
              "newmtl glow\nKd 0.5 0.25 1\nKe 4 2 0\nPr 0.25\nPm 0.75\nd 0.5\n");
  const std::string map = egg.folder / "asset.sph.ply", folder = egg.folder / "channels";
  fs::create_directory(folder);
  REQUIRE(sphparam_program({"map", asset, "-o", map}).code == 0);
  const Ended baked = sphparam_program(
      {"bake", asset, "--sphere", map, "--map", "channels", "--size", "64", "-o", folder + "/"});
  INFO(baked.err);
  REQUIRE(baked.code == 0);
  const std::string out = egg.folder / "all.glb";
  const Ended ended = sphparam_program({"export", map, "--images", folder, "-o", out});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json material = json_of(bytes_of(out))["materials"][0];
  const Json& pbr = material["pbrMetallicRoughness"];
  // The same all over, so that they are numbers: bytes, to six digits.
  CHECK(pbr["metallicFactor"] == 0.74902);
  CHECK(pbr["roughnessFactor"] == 0.25098);
  CHECK_FALSE(pbr.contains("metallicRoughnessTexture"));
  CHECK_FALSE(material.contains("occlusionTexture"));
  CHECK(pbr["baseColorTexture"]["index"] != material["emissiveTexture"]["index"]);
  CHECK_THAT(ended.err, Contains("  the image orm is one colour: roughness 0.251 and metallic "
                                 "0.749, without an image\n"));
  CHECK(material["emissiveFactor"] == Json({1, 1, 1}));
  CHECK(material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] == 4);
  CHECK(material["alphaMode"] == "BLEND");
  const MeshFile read = read_mesh(out);
  REQUIRE(read.channels.size() == 1);
  CHECK(read.channels[0].emission.factor[0] == Approx(4));
  CHECK(read.channels[0].alpha_mode == AlphaMode::Blend);
}

TEST_CASE("export: names in Latin-1, and images in capitals") {
  Egg egg;
  fs::create_directory(egg.folder / "bake");
  REQUIRE(egg.run("a.gltf").code == 0);
  write_bytes(egg.folder / "bake/basecolor.PNG", bytes_of(egg.folder / "a_checker.png"));
  const std::string latin = egg.folder / "caf\xE9.obj";
  write_bytes(latin, bytes_of(egg.mesh));
  egg.mesh = latin;
  const Ended ended = egg.run("x.glb", {"--images", egg.folder / "bake"});
  INFO(ended.err);
  CHECK(ended.code == 0);
}

TEST_CASE("export: a texture without texture coordinates is refused with the reason") {
  Egg egg;
  REQUIRE(egg.run("egg.glb", {"--refine-poles", "1"}).code == 0);
  std::string bytes = bytes_of(egg.folder / "egg.glb");
  const size_t at = bytes.find("TEXCOORD_0");
  REQUIRE(at != std::string::npos);
  bytes[at] = '_';
  egg.mesh = egg.folder / "bare.glb";
  write_bytes(egg.mesh, bytes);
  const Ended ended = egg.run("x.glb");
  INFO(ended.err);
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Contains("no texture coordinates"));
}

TEST_CASE("export: baked images go with the chart they were baked for, others with any") {
  const Egg egg;
  REQUIRE(egg.run("foreign.gltf").code == 0);
  const auto bake = [&](const std::string& name, Names more) {
    const std::string path = egg.folder / name;
    Names arguments = {"bake", egg.mesh, "--map", "normal-object", "--size", "64", "-o", path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(sphparam_program(arguments).code == 0);
    return path;
  };
  struct Case {
    std::string image;
    int wedges;  // 0: suits any
  };
  for (const auto& [image, wedges] :
       {Case{bake("plain.png", {}), 1}, Case{bake("cut.png", {"--refine-poles", "5"}), 5},
        Case{bake("cut.jpg", {"--refine-poles", "5"}), 5},
        Case{bake("round.png", {"--interp", "sphere"}), 0},
        Case{egg.folder / "foreign_checker.png", 0}}) {
    for (const int wanted : {1, 5}) {
      const Ended ended = egg.run(
          "x.glb", {"--image", image, "--refine-poles", std::to_string(wanted), "--lods", "1"});
      INFO(image << " for " << wanted << ": " << ended.err);
      const bool fits = wedges == 0 || wedges == wanted;
      CHECK(ended.code == (fits ? 0 : 2));
      if (fits) continue;
      CHECK_THAT(ended.err, Contains("is baked for --refine-poles " + std::to_string(wedges)));
      CHECK_THAT(ended.err, Contains("bake --refine-poles " + std::to_string(wanted)));
    }
  }
}

TEST_CASE("export: the hard edges of a cube stay hard, in .obj and .glb") {
  const Egg egg;
  const std::string cube = egg.folder / "cube.obj";
  write_bytes(cube,
              "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
              "v -1 1 1\nvn 0 0 -1\nvn 0 0 1\nvn 0 -1 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\n"
              "f 4//1 3//1 2//1 1//1\nf 5//2 6//2 7//2 8//2\nf 1//3 2//3 6//3 5//3\n"
              "f 2//4 3//4 7//4 6//4\nf 3//5 4//5 8//5 7//5\nf 4//6 1//6 5//6 8//6\n");
  for (const char* name : {"x.obj", "x.glb"}) {
    const std::string output = egg.folder / name;
    const Ended ended =
        sphparam_program({"export", cube, "-o", output, "--up", "y", "--image-size", "64"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    sphparam::MeshFile file = sphparam::read_mesh(output, sphparam::ReadOptions{});
    if (!file.corner_normals) file = sphparam::weld_exact(file).file;
    REQUIRE(file.corner_normals);
    const TriangleMesh& mesh = file.mesh;
    for (Eigen::Index corner = 0; corner < file.corner_normals->rows(); ++corner) {
      const auto triangle = mesh.triangles.row(corner / 3);
      const Vector3 a = mesh.position(triangle[0]), b = mesh.position(triangle[1]),
                    c = mesh.position(triangle[2]);
      const Vector3 flat = (b - a).cross(c - a).normalized();
      CHECK((flat.transpose() - file.corner_normals->row(corner)).norm() < 1e-6);
    }
  }
}

TEST_CASE("export: --textures says what images are, sizes are told, and .obj takes them too") {
  const Egg egg;
  const Ended plain = egg.run("egg.glb");
  REQUIRE(plain.code == 0);
  CHECK_THAT(plain.err, Contains("  egg.glb 0.0") && Contains(" % of it images\n"));
  CHECK_THAT(plain.err, !Contains("as given"));
  const Ended webp =
      egg.run("webp.glb", {"--textures", "webp", "--json", egg.folder / "egg.json", "--compress"});
  INFO(webp.err);
  REQUIRE(webp.code == 0);
  CHECK_THAT(webp.err, Contains("  1 image of ") && Contains(" as given: 1 webp"));
  const Json gltf = json_of(bytes_of(egg.folder / "webp.glb"));
  CHECK(gltf["extensionsRequired"] ==
        Json({"EXT_meshopt_compression", "EXT_texture_webp", "KHR_mesh_quantization"}));
  const Json textures = Json::parse(bytes_of(egg.folder / "egg.json"))["textures"];
  REQUIRE(textures.size() == 1);
  CHECK(textures[0]["kind"] == "webp");
  CHECK(textures[0]["bytes"] < textures[0]["bytes_as_given"]);
  REQUIRE(egg.run("egg.gltf", {"--textures", "webp-lossless"}).code == 0);
  CHECK(std::filesystem::exists(egg.folder / "egg_checker.webp"));
  REQUIRE(egg.run("two.obj", {"--textures", "webp"}).code == 0);
  CHECK_THAT(bytes_of(egg.folder / "two.mtl"), Contains("two_checker.webp"));
}

TEST_CASE("export: images that an .obj has no place for are told, and not counted") {
  const Egg egg;
  REQUIRE(egg.run("egg.obj.obj").code == 0);
  std::filesystem::create_directory(egg.folder / "in");
  for (const char* image : {"in/a_basecolor.png", "in/a_orm.png"})
    std::filesystem::copy_file(egg.folder / "egg.obj_checker.png", egg.folder / image);
  const Ended left = egg.run("left.obj", {"--images", egg.folder / "in", "--textures", "png"});
  INFO(left.err);
  REQUIRE(left.code == 0);
  CHECK_THAT(left.err, Contains("warning: not carried: occlusion of the image orm: ") &&
                           Contains("  3 images of "));
  const Ended ply = egg.run("left.ply", {"--images", egg.folder / "in", "--textures", "png"});
  CHECK_THAT(ply.err,
             Contains("warning: not carried: the image orm: ") && Contains("  1 image of "));
}

TEST_CASE(
    "export: an .obj takes no normal map with y down, and of a folder it is left out and told") {
  const Egg egg;
  const std::string normals = egg.folder / "in/egg_normal-tangent.png";
  REQUIRE(egg.run("a.obj").code == 0);
  std::filesystem::create_directory(egg.folder / "in");
  std::filesystem::copy_file(egg.folder / "a_checker.png", egg.folder / "in/egg_basecolor.png");
  REQUIRE(sphparam_program({"bake", egg.mesh, "--map", "normal-tangent", "--normal-y", "dx",
                            "--size", "64", "-o", normals})
              .code == 0);
  const Ended left = egg.run("x.obj", {"--images", egg.folder / "in"});
  INFO(left.err);
  REQUIRE(left.code == 0);
  CHECK_THAT(left.err, Contains("not carried: ") && Contains("is baked with +Y down (DirectX)"));
  CHECK_THAT(bytes_of(egg.folder / "x.mtl"), !Contains("norm "));
  CHECK(egg.run("x.glb", {"--images", egg.folder / "in"}).code == 2);
  CHECK(egg.run("y.obj", {"--normal-map", normals}).code == 2);
  CHECK(egg.run("y.ply", {"--orm-map", egg.folder / "in/egg_basecolor.png"}).code == 2);
  CHECK(egg.run("y.obj", {"--orm-map", egg.folder / "in/egg_basecolor.png"}).code == 0);
  CHECK_THAT(bytes_of(egg.folder / "y.mtl"), Contains("map_Pr y_roughness.png\n"));
}

TEST_CASE("export: the same bytes for any number of threads") {
  const Egg egg;
  REQUIRE(egg.run("one.glb", {"--threads", "1", "--variants", "area"}).code == 0);
  REQUIRE(egg.run("three.glb", {"--threads", "3", "--variants", "area"}).code == 0);
  CHECK(bytes_of(egg.folder / "one.glb") == bytes_of(egg.folder / "three.glb"));
}

TEST_CASE("export: what makes no sense is refused with a reason, and nothing is written") {
  const Egg egg;
  const std::vector<std::tuple<std::string, Names, int, std::string>> mistakes = {
      {"x.fbx", {}, 2, ".glb, .gltf, .usda, .usdz, .obj or .ply"},
      {"x.usda", {"--morph", "sphere"}, 2, "--morph is for .glb and .gltf, not for .usda"},
      {"x.usdz", {"--tangents"}, 2, "--tangents"},
      {"x.usdz", {"--quantize"}, 2, "--quantize"},
      {"x.usdz", {"--compress"}, 2, "--compress"},
      {"x.usda", {"--lods", "1", "--lod", "msft"}, 2, "--lod msft"},
      {"x.usda", {"--textures", "webp"}, 2, "PNG or JPEG"},
      {"x.usda", {"--textures", "webp-lossless"}, 2, "PNG or JPEG"},
      {"x.glb", {"--variants", "chekcer"}, 2, "did you mean checker?"},
      {"x.glb", {"--keep-topology", "--refine-poles", "3"}, 2, "--keep-topology"},
      {"x.obj", {"--quantize"}, 2, "--quantize"},
      {"x.obj", {"--lods", "2"}, 2, "--lods"},
      {"x.obj", {"--lod-faces", "20"}, 2, "--lod-faces"},
      {"x.glb", {"--lods", "1", "--lod-faces", "20"}, 2, "--lods and --lod-faces"},
      {"x.glb", {"--lod-faces", "20,20"}, 2, "numbers of triangles that fall"},
      {"x.glb", {"--lod-faces", "3"}, 2, "numbers of triangles that fall"},
      {"x.glb", {"--image-size", "30"}, 2, "multiple of 4"},
      {"x.glb", {"--unlit", "--tangents"}, 2, "--unlit"},
      {"x.glb", {"--textures", "wepb"}, 2, "did you mean webp?"},
      {"x.glb", {"--webp-quality", "0"}, 2, "--webp-quality"},
      {"x.glb", {"--source-uv"}, 2, "texture coordinates"},
      {"x.glb", {"--image", egg.mesh}, 3, "egg.obj"},
      {"x.glb", {"--image", egg.folder / "none.png"}, 3, "none.png"},
      {"x.glb", {"--images", egg.folder / "."}, 3, "basecolor"},
      {"egg.obj", {}, 2, "-o"}};
  for (const auto& [output, more, code, reason] : mistakes) {
    const Ended ended = egg.run(output, more);
    INFO(output << " " << (more.empty() ? "" : more.front()) << ": " << ended.err);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(reason));
    CHECK(egg.folder.names() == Names{"egg.obj"});
  }
}

}  // namespace sphparam::tests
