#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "sphparam/errors.h"
#include "sphparam/survey/survey.h"
#include "support/folder.h"
#include "survey/mesh_files.h"

using namespace sphparam;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

/// scans/, a folder elsewhere beside it, and a file that is a mesh by its name; gone at the end.
struct Place {
  const tests::Folder folder;
  const fs::path scans = folder / "scans";

  Place() {
    fs::create_directories(scans / "inner");
    fs::create_directories(folder / "elsewhere");
    for (const char* mesh : {"scans/b.off", "scans/inner/c.off", "elsewhere/e.off"})
      std::ofstream(folder / mesh) << "OFF\n";
  }
};

}  // namespace

TEST_CASE("mesh_files: folders that are linked to are looked into, each once") {
  const Place place;
  CHECK(mesh_files(place.scans.string()) == Names{"b.off", "inner/c.off"});
  fs::create_directory_symlink("../elsewhere", place.scans / "y");
  CHECK(mesh_files(place.scans.string()) == Names{"b.off", "inner/c.off", "y/e.off"});
  fs::create_directory_symlink("../../elsewhere", place.scans / "inner/z");
  fs::create_directory_symlink("inner", place.scans / "a");  // it has a name of its own here
  CHECK(mesh_files(place.scans.string()) == Names{"b.off", "inner/c.off", "inner/z/e.off"});
  CHECK(mesh_files((place.scans / "a").string()) == Names{"c.off", "z/e.off"});
}

TEST_CASE("mesh_files: links in a circle, and to what holds the folder, lead nowhere new") {
  const Place place;
  fs::create_directory_symlink(".", place.scans / "self");
  fs::create_directory_symlink("../..", place.scans / "inner/up");
  fs::create_directory_symlink("../elsewhere", place.scans / "y");
  fs::create_directory_symlink("../scans/y", place.folder / "elsewhere/again");
  CHECK(mesh_files(place.scans.string()) == Names{"b.off", "inner/c.off", "y/e.off"});
}

TEST_CASE("mesh_files: a link to nothing is told in the survey as a file that cannot be read") {
  const Place place;
  fs::create_symlink("gone.off", place.scans / "d.off");
  fs::create_symlink("round.off", place.scans / "round.off");
  fs::create_symlink("gone.txt", place.scans / "d.txt");
  fs::create_symlink("../elsewhere/e.off", place.scans / "e.off");
  CHECK(mesh_files(place.scans.string()) ==
        Names{"b.off", "d.off", "e.off", "inner/c.off", "round.off"});
  const Survey survey = survey_folder(place.scans.string(), {.picture_size = 0});
  CHECK(survey.meshes.at(1).name == "d.off");
  CHECK(survey.meshes.at(1).end == SurveyEnd::Unreadable);
  CHECK(survey.meshes.at(1).reasons.at(0).find("d.off") != std::string::npos);
  CHECK_THROWS_AS(mesh_files((place.scans / "d.txt").string()), ReadError);
}
