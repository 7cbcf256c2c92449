#pragma once

#include <memory>
#include <string>

#include "console/session.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam::cli {

/// `shown_textures` with --texture IMAGE, if it is not empty; what stands against those of the file
/// is told. `path`: of the mesh. Throws: UsageMistake where there is no place for the image.
std::shared_ptr<const MeshTextures> read_shown_textures(const MeshFile& file,
                                                        const std::string& path,
                                                        const std::string& image, Session& session);

}  // namespace sphparam::cli
