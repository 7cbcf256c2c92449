#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What comments of a file say of its materials, and no member of theirs does.

/// "base colour of wood: texture maps/wood.png", and of .mtl files the Kd beside it, which shows
/// where the image is not there.
void note_texture(MeshFile& file, const std::string& material, const std::string& image,
                  const std::array<double, 3>& diffuse);
/// The Kd that was noted; nothing where none was.
std::optional<std::array<double, 3>> diffuse_beside_texture(const MeshFile& file,
                                                            const std::string& material);

/// The comment that says which textures a mesh has that are not here, as its file was made of one
/// that has them; empty where they are here, or never were.
std::string left_behind_texture(const MeshFile& file);

/// Which textures of the material, by its number, have texels that are seen as they are where they
/// are larger than what is drawn of them: "base colour", "roughness", "metallic", "normal",
/// "occlusion", "emissive".
void note_nearest(MeshFile& file, std::size_t material, const std::vector<std::string>& textures);
bool is_noted_nearest(const MeshFile& file, std::size_t material, std::string_view texture);

}  // namespace sphparam
