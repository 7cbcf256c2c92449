#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam::campaign {

/// About how many triangles simplifications leave; 0: the mesh as it is. Each is made of the one
/// before.
inline constexpr std::array<long, 5> sizes{0, 20000, 5000, 1000, 200};

/// A mesh file, and what came of reading it.
struct SourceMesh {
  std::string path;
  std::string folder;                             // the first one below the folder that was given
  std::array<long, sizes.size()> triangles = {};  // of it and its simplifications; 0: none is made
  std::uint64_t digest = 0;                       // of positions and triangles
  bool mended = false;                            // it maps only after a repair
  std::string refusal;  // a line: why it is no mesh to map; empty: it is one
  bool lost = false;    // reading it crashed or took too long, which nothing excuses
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SourceMesh, path, folder, triangles, digest, mended, refusal,
                                   lost)

std::string first_line(const std::exception& error);

/// Files by path, each once, not read yet. A place is a folder (all meshes in it and below, told by
/// their names) or a mesh. A list has a path at the beginning of each line, before a tab.
/// Throws: std::runtime_error for a list that cannot be read.
std::vector<SourceMesh> find_meshes(const std::vector<std::string>& places,
                                    const std::vector<std::string>& lists);

/// The mesh at the next size. Requires: a closed mesh of genus 0.
TriangleMesh next_simplification(const TriangleMesh& mesh, int size);

/// As the map takes it. Throws: what reading throws; MeshError unless it is closed and of genus 0.
MeshFile load(const SourceMesh& mesh);

/// With what is found by reading and simplifying it; `repair`: mended, where it cannot be mapped as
/// it is. No simplification is one that leaves out less than a fifth, stops half as far again above
/// its size, or is no closed mesh of genus 0.
SourceMesh inspected(SourceMesh mesh, bool repair);

/// Refuses those whose mesh another one, before them, has as well.
void refuse_copies(std::vector<SourceMesh>& meshes);

}  // namespace sphparam::campaign
