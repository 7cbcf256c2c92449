#pragma once

#include <string>
#include <vector>

#include "sphparam/gltf/export.h"

namespace sphparam {

/// A statement of a .mtl that names an image.
struct MapStatement {
  const char* keyword;  // "norm"
  AssetImage image;
  TextureFigures figures;
};

/// What a material library has room for beside the base colour, by the statements for physically
/// based materials that Blender, Maya and Houdini write too: normals, roughness and metallic, which
/// are images of their own there, grey, and emission.
std::vector<MapStatement> map_statements(const Look& look);

/// The lines of its numbers: Pr, Pm and Ke where the material says something of them; else none.
std::string library_numbers(const Material& material);

/// What of the look's images these statements, and the base colour, leave out, in words.
std::vector<std::string> beyond_library(const Look& look);

}  // namespace sphparam
