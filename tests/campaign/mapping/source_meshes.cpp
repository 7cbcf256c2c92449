#include "mapping/source_meshes.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

#include "digest.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_source.h"
#include "wrap/simplification.h"

namespace sphparam::campaign {
namespace {

namespace fs = std::filesystem;

SourceMesh below(const fs::path& root, const fs::path& path) {
  const fs::path inside = path.lexically_relative(root);
  const bool deeper = std::distance(inside.begin(), inside.end()) > 1;
  SourceMesh mesh;
  mesh.path = path.string();
  mesh.folder = (deeper ? *inside.begin() : root.filename()).string();
  return mesh;
}

void add_folder(const fs::path& root, std::vector<SourceMesh>& meshes) {
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && is_mesh_name(entry.path().string()))
      meshes.push_back(below(root, entry.path()));
  }
}

fs::path common_folder(const std::vector<fs::path>& paths) {
  fs::path common = paths.front().parent_path();
  for (const fs::path& path : paths) {
    while (common.has_relative_path() && *path.lexically_relative(common).begin() == "..")
      common = common.parent_path();
  }
  return common;
}

void add_list(const fs::path& name, std::vector<SourceMesh>& meshes) {
  std::ifstream list(name);
  if (!list) throw std::runtime_error(name.string() + ": cannot be read");
  std::vector<fs::path> paths;
  for (std::string line; std::getline(list, line);) {
    const std::string path = line.substr(0, line.find('\t'));
    if (!path.empty() && path[0] != '#') paths.push_back(fs::absolute(path).lexically_normal());
  }
  for (const fs::path& path : paths) meshes.push_back(below(common_folder(paths), path));
}

/// How many triangles each simplification has.
void simplify(TriangleMesh read, SourceMesh& mesh) {
  mesh.triangles[0] = read.face_count();
  for (size_t size = 1; size < sizes.size(); ++size) {
    read = next_simplification(read, static_cast<int>(size));
    const long left = read.face_count();
    const bool smaller = left <= 4 * mesh.triangles[0] / 5 && left <= 3 * sizes[size] / 2;
    if (smaller && inspect_mesh(read).is_sphere()) mesh.triangles[size] = left;
  }
}

}  // namespace

std::string first_line(const std::exception& error) {
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

std::vector<SourceMesh> find_meshes(const std::vector<std::string>& places,
                                    const std::vector<std::string>& lists) {
  std::vector<SourceMesh> meshes;
  for (const std::string& place : places) {
    const fs::path path = fs::canonical(place);
    if (fs::is_directory(path)) {
      add_folder(path, meshes);
    } else {
      meshes.push_back(below(path.parent_path(), path));
    }
  }
  for (const std::string& list : lists) add_list(list, meshes);
  std::ranges::sort(meshes, {}, &SourceMesh::path);
  const auto twice = std::ranges::unique(meshes, {}, &SourceMesh::path);
  meshes.erase(twice.begin(), twice.end());
  return meshes;
}

TriangleMesh next_simplification(const TriangleMesh& mesh, int size) {
  return simplified(mesh, sizes[static_cast<size_t>(size)]);
}

MeshFile load(const SourceMesh& mesh) {
  MeshSource source =
      read_source(mesh.path, {.repeated_corners = mesh.mended, .non_finite = mesh.mended});
  if (mesh.mended) source = mended(std::move(source), {});
  if (!source.inspection.is_sphere()) throw MeshError(source.inspection.defects);
  return std::move(source.file);
}

SourceMesh inspected(SourceMesh mesh, bool repair) {
  TriangleMesh read;
  try {
    read = load(mesh).mesh;
  } catch (const std::exception& error) {
    mesh.refusal = first_line(error);
  }
  if (mesh.refusal.empty()) {
    Digest digest;
    digest.add(read.positions);
    digest.add(read.triangles);
    mesh.digest = digest.bits();
    simplify(std::move(read), mesh);  // throws: lost
  }
  if (mesh.refusal.empty() || !repair) return mesh;
  SourceMesh again = mesh;
  again.mended = true;
  again.refusal.clear();
  again = inspected(std::move(again), false);
  return again.refusal.empty() ? again : mesh;
}

void refuse_copies(std::vector<SourceMesh>& meshes) {
  std::map<std::uint64_t, std::string> seen;
  for (SourceMesh& mesh : meshes) {
    if (!mesh.refusal.empty()) continue;
    const auto [first, is_new] = seen.try_emplace(mesh.digest, mesh.path);
    if (!is_new) mesh.refusal = "the mesh of another file: " + first->second;
  }
}

}  // namespace sphparam::campaign
