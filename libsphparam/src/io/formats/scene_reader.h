#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

bool looks_like_fbx(std::string_view bytes);
bool looks_like_collada(std::string_view bytes);
bool looks_like_3ds(std::string_view bytes);
bool looks_like_x3d(std::string_view bytes);

// Scenes that assimp reads, in a module that is opened for them. It makes glTF of them, which is
// read as `read_gltf` does: all meshes where their nodes put them, those with a skin as their
// joints stand at rest, y up, materials with their images, which may lie in `folder`. What assimp
// warns of is among the notes. Throws: ReadError, also where the module is missing.

MeshFile read_fbx(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder,
                  const ReadOptions& options = {});
MeshFile read_collada(std::string_view bytes, const std::string& name,
                      const std::optional<std::filesystem::path>& folder,
                      const ReadOptions& options = {});
MeshFile read_3ds(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder,
                  const ReadOptions& options = {});
MeshFile read_x3d(std::string_view bytes, const std::string& name,
                  const std::optional<std::filesystem::path>& folder,
                  const ReadOptions& options = {});

}  // namespace sphparam
