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

/// Whether an image is seen on the mesh, of its materials or of its pages.
bool has_textures(const MeshFile& file);

/// Takes away what is seen of a mesh instead of the colours of its vertices, or lies on other
/// texture coordinates than it has now: its pages, and what its materials say. Texture coordinates
/// and names of materials stay.
void remove_textures(MeshFile& file);

/// Where the comments of a mesh name images of its texture and it has texture coordinates: these
/// become base colours of materials. Each image is one, by the face property `texnumber`, else all
/// faces are of the first; of a file that we wrote, materials are there, and each has the image of
/// its name, or the only one. Vertex properties texture_u and texture_v are s and t then. The
/// images are looked for below `folder` (`file_below`), and not opened; without a folder nothing
/// changes. Images of our own files that are not there were left where the mesh comes from: then
/// neither. What was taken for what, and images of a mesh without texture coordinates, are noted.
void take_texture_pages(MeshFile& file, const std::optional<std::filesystem::path>& folder);

}  // namespace sphparam
