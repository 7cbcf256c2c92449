#pragma once

#include "console/session.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam::cli {

// Files of meshes seldom say what their unit is; glTF is in metres.

inline constexpr char about_scale[] =
    "Lengths become so many times as long: 0.001 where the file is in millimetres, as glTF is in "
    "metres";

/// All lengths of a mesh times a factor, which its comments and the notes of the report say.
void scale_by(double factor, MeshFile& file, Session& session);

/// A mesh of glTF that is longer than anybody models.
void tell_size(const TriangleMesh& mesh, Session& session);

}  // namespace sphparam::cli
