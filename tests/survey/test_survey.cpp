#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>

#include "sphparam/errors.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/survey/survey.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

/// A folder with a mesh of each end, gone at the end.
struct Meshes {
  fs::path folder;

  Meshes() {
    std::string name = (fs::temp_directory_path() / "sphparam_survey_XXXXXX").string();
    folder = ::mkdtemp(name.data());
    fs::create_directory(folder / "deeper");
    write("ball.ply", icosphere(2));
    TriangleMesh open = icosphere(2);
    open.triangles.conservativeResize(open.face_count() - 1, 3);
    write("deeper/open.obj", open);
    TriangleMesh nan = icosphere(2);
    nan.positions(5, 0) = std::numeric_limits<double>::quiet_NaN();
    write("nan.ply", nan);
    write("two.off", two_balls());
    std::ofstream(folder / "broken.ply") << "ply\nformat ascii 1.0\n";
    std::ofstream(folder / "triangle.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::ofstream(folder / "readme.txt") << "no mesh\n";
  }
  ~Meshes() { fs::remove_all(folder); }

  void write(const std::string& name, const TriangleMesh& mesh) const {
    MeshFile file;
    file.mesh = mesh;
    std::ofstream(folder / name, std::ios::binary) << serialise_mesh(name, file);
  }

  static TriangleMesh two_balls() {
    const TriangleMesh ball = icosphere(2);
    TriangleMesh mesh;
    mesh.positions.resize(2 * ball.vertex_count(), 3);
    mesh.positions << ball.positions, (ball.positions.array() + 5).matrix();
    mesh.triangles.resize(2 * ball.face_count(), 3);
    mesh.triangles << ball.triangles,
        (ball.triangles.array() + static_cast<int>(ball.vertex_count())).matrix();
    return mesh;
  }
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

}  // namespace

TEST_CASE("survey: every mesh of a folder comes to its end, with its reasons and its picture") {
  const Meshes meshes;
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 64});
  REQUIRE(survey.meshes.size() == 6);
  CHECK(named(survey, "ball.ply").end == SurveyEnd::Maps);
  CHECK(named(survey, "ball.ply").picture.empty());
  const SurveyedMesh& open = named(survey, "deeper/open.obj");
  CHECK(open.end == SurveyEnd::MapsMended);
  CHECK(contains(open.repairs.at(0), "1 hole filled"));
  CHECK(open.picture.starts_with("\x89PNG"));
  const SurveyedMesh& nan = named(survey, "nan.ply");
  CHECK(nan.end == SurveyEnd::MapsMended);
  CHECK(contains(nan.defects.at(0), "not finite"));
  const SurveyedMesh& two = named(survey, "two.off");
  CHECK(two.end == SurveyEnd::MapsIfAsked);
  CHECK(two.advice == "--repair --component 1");
  CHECK(named(survey, "broken.ply").end == SurveyEnd::Unreadable);
  CHECK(named(survey, "triangle.obj").end == SurveyEnd::CannotMap);
  CHECK(survey.count(SurveyEnd::MapsMended) == 2);
}

TEST_CASE("survey: the page and the report name every file, its end and what to type") {
  const Meshes meshes;
  const Survey survey = survey_folder(meshes.folder.string(), {.picture_size = 0});
  const std::string page = survey_page(survey), json = to_json(survey, 1.5);
  for (const SurveyedMesh& mesh : survey.meshes) {
    CHECK(mesh.picture.empty());
    CHECK(contains(page, mesh.name));
    CHECK(contains(json, "\"" + name_of(mesh.end) + "\""));
  }
  CHECK(contains(page, "3 of 6 files"));
  CHECK(contains(page, "--repair --component 1"));
  CHECK(contains(json, "\"counts\""));
}

TEST_CASE("survey: names and reasons cannot break the page") {
  const Meshes meshes;
  std::ofstream(meshes.folder / "<script>alert(1)<_script>.obj") << "quux <b>\n";
  CHECK_FALSE(contains(survey_page(survey_folder(meshes.folder.string(), {.picture_size = 0})),
                       "<script>alert"));
}

TEST_CASE("survey: a folder without meshes, or none at all, is an error; it can be stopped") {
  const Meshes meshes;
  CHECK_THROWS_AS(survey_folder((meshes.folder / "nowhere").string()), ReadError);
  fs::create_directory(meshes.folder / "empty");
  CHECK_THROWS_AS(survey_folder((meshes.folder / "empty").string()), ReadError);
  CHECK_THROWS_AS(
      survey_folder(meshes.folder.string(), {.progress = [](const auto&...) { return false; }}),
      Cancelled);
}
