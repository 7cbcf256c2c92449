#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <set>

#include "program.h"

namespace sphparam::tests {

namespace {

/// The folder of real meshes, or nothing, said so, when it is not there.
fs::path real_meshes() {
  const char* given = std::getenv("SPHPARAM_MESHES");
  const fs::path folder = given ? given : SPHPARAM_DEFAULT_MESHES;
  if (fs::is_directory(folder)) return folder;
  std::cout << "skipped: no folder " << folder << " (set SPHPARAM_MESHES)\n";
  return {};
}

bool is_mesh(const fs::path& file) {
  return std::set<std::string>{".obj", ".ply", ".off", ".stl", ".glb", ".gii"}.contains(file.extension());
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void check_mapped(const fs::path& mesh, const std::string& method = "progressive") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  INFO(mesh << " by the method " << method);
  const Ended mapped = sphparam_program({"map", mesh, "-o", map, "--method", method});
  INFO(mapped.err);
  CHECK(mapped.code == 0);
  CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
}

}  // namespace

TEST_CASE("real meshes: every closed genus-0 mesh is certified") {
  const fs::path folder = real_meshes();
  if (folder.empty()) return;
  for (const fs::path& file : files_of(folder / "genus0")) {
    if (is_mesh(file)) check_mapped(file);
  }
}

TEST_CASE("real meshes: the paper's method made sound certifies every one too") {
  const fs::path folder = real_meshes();
  if (folder.empty()) return;
  for (const fs::path& file : files_of(folder / "genus0")) {
    if (is_mesh(file)) check_mapped(file, "curvilinear");
  }
}

}  // namespace sphparam::tests
