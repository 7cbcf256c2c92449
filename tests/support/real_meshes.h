#pragma once

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

/// Meshes of others, for tests that want them: in SPHPARAM_MESHES, or beside the project.
namespace sphparam::tests {

/// Their folder "genus0" or "bad"; nothing, said so, where it is not there.
inline std::filesystem::path real_mesh_folder(const std::string& name) {
  const std::filesystem::path folder = meshes_folder() / name;
  if (std::filesystem::is_directory(folder)) return folder;
  std::cout << "skipped: no folder " << folder << " (set SPHPARAM_MESHES)\n";
  return {};
}

/// The closed ones of genus 0, by name; none, said so, where they are not there.
inline std::vector<std::filesystem::path> real_meshes() {
  const std::set<std::filesystem::path> formats{".obj", ".off", ".ply", ".stl", ".glb", ".gii"};
  const std::filesystem::path folder = real_mesh_folder("genus0");
  std::vector<std::filesystem::path> meshes;
  if (folder.empty()) return meshes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (formats.contains(entry.path().extension())) meshes.push_back(entry.path());
  }
  std::sort(meshes.begin(), meshes.end());
  return meshes;
}

}  // namespace sphparam::tests
