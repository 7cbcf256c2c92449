#pragma once

#include <optional>

#include "render/render.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The loops and rims where repair has closed a surface: lines between faces that the file's own
/// numbers do not know (`source_face` −1) and all others. Nothing where there are no such faces.
/// Requires: a mesh without fillers.
std::optional<Wireframe> added_outline(const MeshFile& surface);

}  // namespace sphparam
