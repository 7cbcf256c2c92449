#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/formats/gltf/scene_origin.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the bytes start as a GLB or as a JSON object.
bool looks_like_gltf(std::string_view bytes);

/// Reads the default scene of a glTF 2.0 file, text or binary (GLB): all meshes of all nodes,
/// transformed, as one mesh; those with a skin as their joints stand in the file, those with
/// instances (EXT_mesh_gpu_instancing) once for each, unless these are broken or far too many.
///
/// Vertices are those of the file: where normals or texture coordinates split them,
/// `prepare_for_mapping` welds them by position and keeps both at the corners. Kept: NORMAL,
/// the texture coordinates of the base colour's image, or of the first that a material has,
/// transformed as it says (t upwards, as in OBJ: 1 − v; TEXCOORD_0 where no material says another),
/// COLOR_0 (its linear light as sRGB in [0, 1], Float32; of whole numbers, normalised or not, the
/// largest is 1), scalars named _…, the angles of _THETA_PHI as theta and phi, the material of each
/// face and what it says (materials.h); textures are named in comments too, and never decoded here;
/// one says that y is up. Told as not carried: extensions of materials but unlit and emissive
/// strength, textures on other coordinates than a material's first, other attributes, skins and
/// morph targets, of which the mesh has the shape that the file leaves it in, animations, cameras,
/// lights, other scenes, points and lines.
/// Triangles, strips and fans, with or without indices; triangles that name a vertex twice are
/// dropped and counted in a note. Refused by name: a file of points and lines alone, glTF 1.0,
/// required extensions other than KHR_mesh_quantization, EXT_mesh_gpu_instancing,
/// EXT_meshopt_compression, KHR_draco_mesh_compression and those of materials, textures and lights.
/// `folder` is where buffers in files of their own may be; without it they are refused. `origin`
/// says what the scene was before it was glTF. Throws: ReadError that names the accessor, mesh or
/// node.
MeshFile read_gltf(std::string_view bytes, const std::string& name,
                   const std::optional<std::filesystem::path>& folder,
                   const ReadOptions& options = {}, const SceneOrigin& origin = {});

}  // namespace sphparam
