#pragma once

#include <optional>
#include <string>

#include "image/image_codec.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// What an image says of the chart that it was baked for, as texts of its metadata. Texels belong
/// to the triangles of one chart: on another one, with triangles at the poles cut otherwise, they
/// would stand on the wrong ones there. `pole_wedges`: as `refine_poles` takes them.
ImageTexts texts_of_chart(bool linear_in_uv, int pole_wedges);

/// The text that tells maps of one mesh apart: "3458 rays, 9f…", a hash of them as float32, in the
/// order of the vertices; and of the mesh that was baked, where that is another one on the same
/// sphere: "642 rays, 12…; 3458 rays, 9f…". Cost: O(#V).
ImageTexts texts_of_map(const MappedMesh& mapped, const MappedMesh* source = nullptr);

/// "ao.png is baked on another map …", where an image says one of as many rays, and none that is
/// this one; empty of images of strangers, and of meshes with another number of vertices, whose map
/// may be the same. `name`: of the image, for people.
std::string warning_of_other_map(const std::string& name, const ImageTexts& texts,
                                 const MappedMesh& mapped);

/// Into how many wedges the pole triangles are cut of the chart that an image was baked for;
/// nothing for images that suit any chart: those of strangers, and those baked by direction.
/// `texts`: all of the file's metadata.
std::optional<int> pole_wedges_of(const ImageTexts& texts);

}  // namespace sphparam
