#pragma once

#include <string>
#include <vector>

#include "gltf/images/material_images.h"
#include "sphparam/gltf/export.h"

namespace sphparam {

/// Why it is no normal map of glTF: an image of fewer than three channels, or one that says of
/// itself that it shows other things or has y down. Empty: it is one.
std::string complaint_of_normals(const std::string& path, const GivenImage& image);

/// The warning that normals are in the frame of another mesh than any of these names, by the names
/// that `bake` notes; empty: they are not, or it is not known.
std::string warning_of_other_mesh(const std::string& path, const ImageTexts& texts,
                                  const std::vector<std::string>& names);

}  // namespace sphparam
