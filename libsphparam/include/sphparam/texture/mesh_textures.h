#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The textures of a mesh, decoded. Made by `shown_textures`.
struct MeshTextures;

/// What a mesh is shown with in pictures and on pages.
struct ShownTextures {
  std::shared_ptr<const MeshTextures> textures;  // never null; may be none
  /// Why it is shown without those that its file has or should have, or opaque although its
  /// materials are not, or in other colours, for people; empty: nothing is wrong.
  std::string warning = {};
  bool left_behind = false;  // they are not in this file but in the glTF that it comes from
};

/// An image that was to be the texture of a mesh without texture coordinates.
class NoTexcoords : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The textures that a mesh is shown with: the image named, on all of it; else those of its file.
/// What stands against those of the file is a warning, and the mesh is shown without.
/// `name`: of the mesh, for messages; `image`: a file; empty: none. `threads`, 0: all cores.
/// Throws: for the image named, NoTexcoords where the mesh has no coordinates for it, ImageError
/// where it cannot be read. Cost: decoding, and a third more memory than the pixels.
ShownTextures shown_textures(const MeshFile& file, const std::string& name,
                             const std::string& image = "", int threads = 0);

}  // namespace sphparam
