#pragma once

#include "render/render.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What a mesh looks like by itself, for pictures and pages alike: its textures, of glTF times the
/// colours of its vertices; where none has an image, the colours of its vertices; else those of its
/// materials; else `direction_paint`. Requires: textures of the file's materials, or one for all;
/// texture coordinates where one has an image.
Paint own_paint(const MeshFile& file, const MeshTextures& textures = {});

/// Each direction of the surface in a pastel colour of its own: features stay recognisable wherever
/// they are mapped to. Where the file has normals at corners, edges are as hard as these say.
VertexPaint direction_paint(const MeshFile& file);

}  // namespace sphparam
