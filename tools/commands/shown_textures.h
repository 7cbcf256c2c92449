#pragma once

#include <string>

#include "console/console.h"
#include "sphparam/io/mesh_file.h"
#include "texture/source_texture.h"

namespace sphparam::cli {

/// The textures that a mesh is shown with in pictures and on pages: the image asked for, on all of
/// it; else those of its file. Those of the file that cannot be shown, and one that a .sph.ply had
/// to leave behind in its glTF file, are told in one line, and the mesh is shown without.
/// `path`: of the mesh, for messages; `image`: empty where none was asked for.
/// Throws: for the image asked for, UsageMistake where the mesh has no texture coordinates for it,
/// ImageError where it cannot be read.
MeshTextures shown_textures(const MeshFile& file, const std::string& path, const std::string& image,
                            int threads, Console& console);

}  // namespace sphparam::cli
