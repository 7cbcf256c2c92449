#pragma once

#include <vector>

#include "arguments/export_arguments.h"
#include "sphparam/io/mapped_mesh.h"
#include "gltf/asset.h"

namespace sphparam::cli {

/// The images of an export and the materials made of them, the one that is seen first.
struct ExportLook {
  std::vector<AssetImage> images;
  std::vector<Material> materials;
  bool normals_given = false;   // a map for the frame of one mesh
  bool vertex_colours = false;  // what is seen are the colours of the vertices

  bool has_normals() const { return !materials.empty() && materials.front().normal >= 0; }
};

/// The same for another mesh on the same sphere, whose tangent frame is another: no normal map
/// given.
ExportLook without_given_normals(ExportLook look);

/// What is seen: the images that the arguments name; else the mesh's own textures, baked; else the
/// colours of its vertices; else white under a normal or occlusion map, a checker without. The
/// variants asked for follow.
/// Throws: UsageMistake for unknown variants, and for a texture without texture coordinates;
/// ImageError; ReadError; Cancelled.
ExportLook make_export_look(const ExportArguments& arguments, const MappedMesh& mapped,
                            Console& console);

/// The words of --variants.
const std::vector<std::string>& export_variants();

}  // namespace sphparam::cli
