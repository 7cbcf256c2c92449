#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/correspondence/surface_map.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// `from` as it is written: with its map, and for every vertex its point on `to`: properties
/// target_face and target_0, target_1, target_2, the barycentric weights of its corners.
/// `numbers`: what the faces of `to` are called, of `rows_in_file`; none: by their rows.
MappedMesh with_targets(const SurfaceMap& map, int threads = 0,
                        const std::vector<long>& numbers = {});

/// The row that each face of a mesh has in its file, −1 for what mending added; empty where nothing
/// was done, so that rows are those of the file. Nothing where they cannot be told: mending cut or
/// turned faces, or the file has polygons or, mended once more, numbers of yet another.
std::optional<std::vector<long>> rows_in_file(const MeshSource& source);

/// The triangles of `from`, with what its vertices carry, in the shape of `to`; without normals and
/// tangents, which would be those of the other shape; the axis that points up and the volume of
/// FreeSurfer are those of `to`, whose coordinates these are.
MeshFile in_other_shape(const SurfaceMap& map, int threads = 0);

/// The names of what vertices of this file carry that has a meaning on another surface.
std::vector<std::string> names_of_values(const MeshFile& file);

/// `from` with the vertex properties of `to`, linear in its triangles, colours as light. Colours
/// and texture coordinates are replaced; other numbers of `from` that have a name of `to` are kept
/// under another: `I_a`, or `flow_a_0` of `flow_0`. Labels are those of the nearest corner.
/// Normals, which belong to the shape, and what says where vertices come from, or lie by another
/// match, are not carried.
MeshFile with_other_values(const SurfaceMap& map, int threads = 0);

/// The mesh reflected in the plane x = 0, its triangles turned round so that they look outward, and
/// its map with it. What corners carry goes along; a volume of FreeSurfer, which has no mirror
/// image, goes.
MappedMesh mirror_image(const MappedMesh& mapped, int threads = 0);

}  // namespace sphparam
