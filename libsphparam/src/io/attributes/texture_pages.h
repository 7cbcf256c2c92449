#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Comments of PLY files begin so that name an image of their texture, as MeshLab, Metashape and
/// RealityCapture write them.
inline constexpr char texture_page_comment[] = "TextureFile ";

bool has_texture_pages(const MeshFile& file);

/// Their names, as the comments have them; the number of a face's counts them from 0.
std::vector<std::string> texture_pages(const MeshFile& file);

/// Where the comments of a mesh name images of its texture and it has texture coordinates: these
/// become base colours of materials. Each image is one, by the face property `texnumber`, else all
/// faces are of the first; of a file that we wrote, materials are there, and each has the image of
/// its name, or the only one. Vertex properties texture_u and texture_v are s and t then. The
/// images are looked for below `folder` (`file_below`), and not opened; without a folder nothing
/// changes. Images of our own files that are not there were left where the mesh comes from: then
/// neither. What was taken for what, and images of a mesh without texture coordinates, are noted.
void take_texture_pages(MeshFile& file, const std::optional<std::filesystem::path>& folder);

}  // namespace sphparam
