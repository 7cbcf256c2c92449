#pragma once

#include "bake/field_registry.h"

namespace sphparam {

/// What the mesh file says at its vertices, corners and faces. All throw FieldError where it has
/// not what they need.
SurfaceField make_position(const BakeScene& scene, const std::string&);
/// Colours of vertices, or of their corners, linear light between them; and alpha where it says
/// more than 1.
SurfaceField make_vertex_colour(const BakeScene& scene, const std::string&);
/// The same without alpha, which only materials give a meaning.
SurfaceField make_opaque_vertex_colour(const BakeScene& scene);
/// Texture coordinates of the source: (s, t, 0), t upwards.
SurfaceField make_texcoords(const BakeScene& scene, const std::string&);
/// A property of vertices or faces, by its name, over the range that is asked for; that of heat is
/// of its scale.
SurfaceField make_scalar(const BakeScene& scene, const std::string& name);
/// How the points of the target found the surface that is baked on it: see `Found`.
SurfaceField make_found(const BakeScene& scene, const std::string&);
/// 1 on the surface, 0 on fillers.
SurfaceField make_mask(const BakeScene& scene, const std::string&);
inline constexpr char surface_mask[] = "mask";
/// What a point belongs to: "face", "component" or "material" (default: material where the file has
/// some, else face). As colours in integer images, in others as numbers. The colours of labels
/// below 2^24 − 1 all differ, in 8 bits too, and none of them is black.
SurfaceField make_id(const BakeScene& scene, const std::string& what);

}  // namespace sphparam
