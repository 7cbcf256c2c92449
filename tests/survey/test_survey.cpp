#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "sphparam/errors.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/survey/survey.h"
#include "support/folder.h"
#include "support/holed.h"
#include "support/joined.h"
#include "support/one_sided.h"
#include "support/shaken.h"
#include "support/test_meshes.h"
#include "support/torus.h"
#include "support/without_area.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

/// A folder with a mesh of each end, gone at the end.
struct Meshes {
  const Folder own;
  const fs::path folder = own.path;

  Meshes() {
    fs::create_directory(folder / "deeper");
    write("ball.ply", icosphere(2));
    write("deeper/open.obj", with_a_hole());
    TriangleMesh nan = icosphere(2);
    nan.positions(5, 0) = std::numeric_limits<double>::quiet_NaN();
    write("nan.ply", nan);
    write("two.off", two_balls());
    std::ofstream(folder / "broken.ply") << "ply\nformat ascii 1.0\n";
    std::ofstream(folder / "triangle.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    write("torus.obj", long_ring());
    for (const char* other : {"readme.txt", "scans.tar.gz", "ct.nii.gz", "sulc.shape.gii",
                              "lobes.label.gii.gz", "bold.func.gii"})
      std::ofstream(folder / other) << "no mesh\n";
  }

  void write(const std::string& name, const TriangleMesh& mesh) const {
    MeshFile file;
    file.mesh = mesh;
    std::ofstream(folder / name, std::ios::binary) << serialise_mesh(name, file);
  }

  /// Its loops are longer than those that a repair cuts unasked.
  static TriangleMesh long_ring() { return torus(24, 12, 2, 1.2); }

  static TriangleMesh two_balls() { return joined(icosphere(2), icosphere(2), {5, 5, 5}); }
};

const SurveyedMesh& named(const Survey& survey, const std::string& name) {
  for (const SurveyedMesh& mesh : survey.meshes)
    if (mesh.name == name) return mesh;
  FAIL(name);
  return survey.meshes.front();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> certified_ways(const SurveyedMesh& mesh) {
  std::vector<std::string> ways;
  for (const SurveyedWay& way : mesh.ways)
    if (way.certified) ways.push_back(way.options);
  return ways;
}

using Words = std::vector<std::string>;

/// A glTF of a tetrahedron whose buffer is a file of its own.
void write_tetrahedron(const fs::path& path, const std::vector<std::uint16_t>& indices) {
  const float places[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
  std::ofstream buffer(path.parent_path() / "beside.bin", std::ios::binary);
  buffer.write(reinterpret_cast<const char*>(places), sizeof places);
  const auto bytes = static_cast<std::streamsize>(2 * indices.size());
  buffer.write(reinterpret_cast<const char*>(indices.data()), bytes);
  std::ofstream(path) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                         R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                         R"({"POSITION":0},"indices":1}]}],"buffers":[{"uri":"beside.bin",)"
                         R"("byteLength":72}],"bufferViews":[{"buffer":0,"byteLength":48},)"
                         R"({"buffer":0,"byteOffset":48,"byteLength":24}],"accessors":[)"
                         R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",)"
                         R"("min":[-1,-1,-1],"max":[1,1,1]},)"
                         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";
}

}  // namespace

TEST_CASE("survey: what maps as it is and yet is odd is told, in records and on the page") {
  const Folder folder;
  const Meshes meshes;
  TriangleMesh inside_out = icosphere(1);
  inside_out.triangles.col(1).swap(inside_out.triangles.col(2));
  meshes.write("turned.obj", inside_out);
  const SurveyOptions options{.picture_size = 0, .records = folder / ""};
  for (int time = 0; time < 2; ++time) {  // found, then taken from its record
    const Survey survey = survey_folder(meshes.folder.string(), options);
    const SurveyedMesh& turned = named(survey, "turned.obj");
    CHECK(turned.end == SurveyEnd::Maps);
    CHECK(turned.defects.empty());
    REQUIRE(turned.oddities.size() == 1);
    CHECK(contains(turned.oddities[0], "inside out"));
    CHECK(contains(survey_page(survey), "turned.obj: inside out"));
  }
}

TEST_CASE("survey: every mesh of a folder comes to its end, with its reasons and its pictures") {
  const Meshes meshes;
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 64});
  REQUIRE(survey.meshes.size() == 7);
  CHECK(named(survey, "ball.ply").end == SurveyEnd::Maps);
  CHECK(named(survey, "ball.ply").pictures.empty());
  const SurveyedMesh& open = named(survey, "deeper/open.obj");
  CHECK(open.end == SurveyEnd::MapsMended);
  CHECK(contains(open.repairs.at(0), "1 hole filled"));
  CHECK(certified_ways(open) == Words{"--repair", "--repair --keep-holes"});
  CHECK(open.boundaries == 1);
  REQUIRE(open.pictures.size() == 2);
  CHECK(open.pictures[0].png.starts_with("\x89PNG"));
  CHECK(open.pictures[1].png.starts_with("\x89PNG"));
  const SurveyedMesh& nan = named(survey, "nan.ply");
  CHECK(nan.end == SurveyEnd::MapsMended);
  CHECK(contains(nan.defects.at(0), "not finite"));
  const SurveyedMesh& two = named(survey, "two.off");
  CHECK(two.end == SurveyEnd::MapsIfAsked);
  CHECK(certified_ways(two) == Words{"--repair --component 1", "--repair --all-components"});
  CHECK(two.ways.at(0).told == "kept 50 % of the area and 50 % of the faces, lost 50 % and 50 %");
  CHECK(two.ways.at(0).area_share == Approx(0.5));
  CHECK(two.ways.at(0).drops_much());
  CHECK(two.ways.at(1).told == "2 of 2 components map");
  CHECK(two.ways.at(1).area_share == 1);
  CHECK(two.best_way() == &two.ways.at(1));
  const SurveyedMesh& torus = named(survey, "torus.obj");
  CHECK(torus.end == SurveyEnd::MapsIfAsked);
  CHECK(torus.genus == 1);
  REQUIRE(torus.ways.size() == 1);
  CHECK(torus.ways[0].options.starts_with("--repair --max-handle "));
  CHECK(named(survey, "broken.ply").end == SurveyEnd::Unreadable);
  CHECK(named(survey, "triangle.obj").end == SurveyEnd::CannotMap);
  CHECK(survey.count(SurveyEnd::MapsMended) == 2);
}

TEST_CASE("survey: the page and the report name every file, its end and what to type") {
  const Meshes meshes;
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 0});
  const std::string page = survey_page(survey);
  CHECK(contains(page, "5 of 7 files map onto the sphere: 1 as they are, 2 after --repair, 2 "));
  const std::size_t all = page.find("two.off --repair --all-components -o two.sph.ply: certified");
  const std::size_t one =
      page.find("two.off --repair --component 1 -o two.sph.ply: certified; kept");
  CHECK(all < one);
  CHECK(one != std::string::npos);
  CHECK(contains(page, "open.obj --repair -o deeper_open.sph.ply"));
  CHECK(contains(page, "<td>--repair --all-components</td>"));
  CHECK(contains(page, "<a href=\"#file-7\">two.off</a>"));
  CHECK(contains(page, "<h3 id=\"file-7\">two.off</h3>"));
  CHECK_FALSE(contains(page, ">ball.ply</a>"));
  const auto json = nlohmann::json::parse(to_json(survey, 1.5));
  CHECK(json["counts"]["maps-mended"] == 2);
  CHECK(json["meshes"][6]["needs"] == "--repair --all-components");
  CHECK(json["meshes"][6]["ways"][0]["area_share"].get<double>() == Approx(0.5));
  CHECK(json["meshes"][0]["needs"].is_null());
  CHECK(json["counts"]["unreadable"] == 1);
  REQUIRE(json["meshes"].size() == survey.meshes.size());
  for (std::size_t i = 0; i < survey.meshes.size(); ++i) {
    const SurveyedMesh& mesh = survey.meshes[i];
    CHECK(mesh.pictures.empty());
    CHECK(contains(page, mesh.name));
    CHECK(json["meshes"][i]["name"] == mesh.name);
    CHECK(json["meshes"][i]["end"] == name_of(mesh.end));
    CHECK(json["meshes"][i]["ways"].size() == mesh.ways.size());
  }
}

TEST_CASE("survey: components that cannot be mapped are left out as map leaves them out") {
  const Meshes meshes;
  const auto with_plane = [](double size) {
    TriangleMesh plane = projective_plane();
    plane.positions *= size;
    return joined(icosphere(2), plane, {20, 20, 20});
  };
  meshes.write("half.off", with_plane(0.5));
  meshes.write("flat.off", joined(Meshes::two_balls(), collapsed_tetrahedron(), {20, 20, 20}));
  meshes.write("specks.off", joined(with_plane(0.02), with_plane(0.02), {50, 50, 50}));
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 0});
  const SurveyedMesh& specks = named(survey, "specks.off");
  REQUIRE(specks.best_way());
  CHECK(specks.best_way()->options == "--repair --all-components");
  CHECK(contains(specks.best_way()->told, "2 of 4 components map, with 99."));
  CHECK(contains(specks.best_way()->told, "left out: component 4 ("));
  CHECK(contains(specks.best_way()->told, "one-sided"));
  CHECK_FALSE(specks.best_way()->drops_much());
  const SurveyedMesh& flat = named(survey, "flat.off");
  REQUIRE(flat.best_way());
  CHECK(flat.best_way()->options == "--repair --all-components");
  CHECK(contains(flat.best_way()->told, "2 of 3 components map"));
  CHECK(contains(flat.best_way()->told, "left out: component 3 (0 % of the area): "));
  CHECK(contains(flat.best_way()->told, "no area that can be measured"));
  const SurveyedMesh& half = named(survey, "half.off");
  CHECK_FALSE(half.ways.back().certified);
  CHECK(half.ways.back().drops_much());
}

TEST_CASE("survey: components are tried with what all of them take, pieces of a soup with a weld") {
  const Meshes meshes;
  meshes.write("ringed.off", joined(icosphere(2), Meshes::long_ring(), {20, 20, 20}));
  meshes.write("soup.ply", shaken_apart(icosphere(3), 1e-5));
  meshes.write("torn.obj", torn_by_rounding(icosphere(4), 0.005));
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 0});
  const SurveyedMesh& ringed = named(survey, "ringed.off");
  REQUIRE(ringed.best_way());
  CHECK(ringed.best_way()->options.starts_with("--repair --all-components --max-handle "));
  CHECK(ringed.best_way()->told == "2 of 2 components map");
  const SurveyedMesh& soup = named(survey, "soup.ply");
  CHECK(soup.end == SurveyEnd::MapsIfAsked);
  REQUIRE(soup.best_way());
  CHECK(soup.best_way()->options.starts_with("--repair --weld 0.0"));
  CHECK(soup.best_way()->area_share == 1);
  // What a repair mends unasked it mends, though a weld spares most of what it puts in.
  const SurveyedMesh& torn = named(survey, "torn.obj");
  CHECK(torn.end == SurveyEnd::MapsMended);
  REQUIRE(torn.ways.size() >= 2);
  CHECK(torn.ways[0].options.starts_with("--repair --weld "));
  CHECK(torn.ways[1].options == "--repair");
  CHECK(torn.ways[1].certified);
}

TEST_CASE("survey: of what cannot be mapped, or not as a whole, the page says how to wrap it") {
  const Meshes meshes;
  meshes.write("plane.off", projective_plane());
  TriangleMesh point = icosphere(1);
  point.positions.setConstant(3);
  meshes.write("point.ply", point);
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 0});
  CHECK(named(survey, "plane.off").end == SurveyEnd::CannotMap);
  CHECK(named(survey, "point.ply").end == SurveyEnd::CannotMap);
  CHECK(contains(named(survey, "point.ply").reasons.at(0), "point.ply: the surface has no area"));
  const std::string page = survey_page(survey);
  CHECK(contains(page, "plane.off -o plane_wrap.ply"));
  CHECK(contains(page, "two.off -o two_wrap.ply"));
  for (const char* whole : {"open_wrap", "torus_wrap", "point_wrap", "ball_wrap", "broken_wrap"})
    CHECK_FALSE(contains(page, whole));
}

TEST_CASE(
    "survey: names and reasons cannot break the page, nor the shell that a line is typed to") {
  const Meshes meshes;
  std::ofstream(meshes.folder / "<script>alert(1)<_script>.obj") << "quux <b>\n";
  std::ofstream(meshes.folder / "\xff\xfe.obj") << "v 0 0 0\n";
  fs::copy(meshes.folder / "deeper/open.obj", meshes.folder / "a b'$(id).obj");
  const Survey survey =
      survey_folder(meshes.folder.string(), {.picture_size = 0, .isolated = true});
  REQUIRE(survey.meshes.size() == 10);
  const std::string page = survey_page(survey);
  CHECK_FALSE(contains(page, "<script>alert"));
  CHECK(contains(page, "/a b'\\''$(id).obj' --repair"));
  CHECK(nlohmann::json::accept(to_json(survey, 0)));
}

TEST_CASE("survey: files in processes of their own, and on other threads, end as all do") {
  const Meshes meshes;
  const std::string folder = meshes.folder.string();
  const Survey survey = survey_folder(folder, {.picture_size = 48, .threads = 1});
  const std::string page = survey_page(survey);
  CHECK(survey_page(survey_folder(folder, {.picture_size = 48, .isolated = true})) == page);
  CHECK(survey_page(survey_folder(folder, {.picture_size = 48, .threads = 3})) == page);
}

TEST_CASE("survey: a file that takes too long is stopped, and the others go on") {
  const Meshes meshes;
  meshes.write("slow.ply", icosphere(7));
  const Survey survey = survey_folder(
      meshes.folder.string(), {.picture_size = 0, .isolated = true, .longest = 0.05, .threads = 1});
  CHECK(named(survey, "slow.ply").end == SurveyEnd::Stopped);
  CHECK(named(survey, "slow.ply").reasons == Words{"it took more than 0.05 s"});
  CHECK(named(survey, "two.off").end != SurveyEnd::Unreadable);
}

TEST_CASE("survey: stopped, it goes on from its records, what has changed is tried again") {
  const Meshes meshes;
  const std::string folder = meshes.folder.string();
  const fs::path records = meshes.folder / "records";
  fs::create_directory(records);
  const SurveyOptions plain{.picture_size = 48};
  const std::string page = survey_page(survey_folder(folder, plain));
  SurveyOptions kept = plain;
  kept.records = records.string();
  int asked = 0;
  kept.progress = [&](auto, double) { return ++asked < 4; };  // three files
  CHECK_THROWS_AS(survey_folder(folder, kept), Cancelled);
  const auto count = [&] {
    return std::distance(fs::directory_iterator(records), fs::directory_iterator());
  };
  CHECK(count() == 2);  // the third is broken.ply, of which there is no record
  kept.progress = {};
  CHECK(survey_page(survey_folder(folder, kept)) == page);
  CHECK(count() == 6);

  // A record that is there is believed; one that is damaged is not.
  for (const auto& entry : fs::directory_iterator(records)) {
    std::ifstream in(entry.path());
    std::string text((std::istreambuf_iterator<char>(in)), {});
    if (contains(text, "\"name\": \"ball.ply\"")) {
      text.replace(text.find("\"maps\""), 6, "\"cannot-map\"");
    } else {
      text.resize(text.size() / 2);
    }
    std::ofstream(entry.path()) << text;
  }
  kept.read.max_vertices = 20;  // other limits are another question
  CHECK(named(survey_folder(folder, kept), "ball.ply").end == SurveyEnd::Unreadable);
  kept.read = {};
  const Survey again = survey_folder(folder, kept);
  CHECK(named(again, "ball.ply").end == SurveyEnd::CannotMap);
  CHECK(named(again, "deeper/open.obj").end == SurveyEnd::MapsMended);
  meshes.write("ball.ply", icosphere(1));
  CHECK(named(survey_folder(folder, kept), "ball.ply").end == SurveyEnd::Maps);
}

TEST_CASE("survey: what a file names beside it is looked at, too, before a record is believed") {
  const Meshes meshes;
  const fs::path scans = meshes.folder / "scans", records = meshes.folder / "records";
  for (const fs::path& folder : {scans, records}) fs::create_directory(folder);
  const SurveyOptions kept{.picture_size = 0, .records = records.string()};
  const auto end = [&] { return survey_folder(scans.string(), kept).meshes.at(0).end; };
  write_tetrahedron(scans / "a.gltf", {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2});
  CHECK(end() == SurveyEnd::Maps);
  write_tetrahedron(scans / "a.gltf",
                    {0, 1, 2, 0, 3, 1, 0, 2, 3, 0, 2, 3});  // a face twice, a hole
  CHECK(end() == SurveyEnd::MapsMended);
}

TEST_CASE("survey: a folder without meshes, or none at all, is an error, it can be stopped") {
  const Meshes meshes;
  const std::string folder = meshes.folder.string();
  CHECK_THROWS_AS(survey_folder((meshes.folder / "nowhere").string()), ReadError);
  fs::create_directory(meshes.folder / "empty");
  CHECK_THROWS_AS(survey_folder((meshes.folder / "empty").string()), ReadError);
  CHECK_THROWS_AS(survey_folder(folder, {.records = folder + "/nowhere"}), WriteError);
  CHECK_THROWS_AS(survey_folder(folder, {.picture_size = 15}), std::invalid_argument);
  CHECK_THROWS_AS(survey_folder(folder, {.longest = -1}), std::invalid_argument);
  CHECK_THROWS_AS(survey_folder(folder, {.progress = [](const auto&...) { return false; }}),
                  Cancelled);
}
