#pragma once

#include <memory>
#include <string>

#include "bake/surface_field.h"
#include "rays/ray_scene.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

struct BakeScene;

struct RayFieldOptions {
  int rays = 64;       // a sample; an odd number becomes the next even one
  double reach = 0.1;  // of the bounding box's diagonal; beyond, nothing is met
  // Of the corners, #3F×3, unit, for meshes with hard edges; none: those of the vertices.
  std::shared_ptr<const CornerNormals> corner_normals = nullptr;
};

/// What of the sky a point of the surface sees, weighted by the cosine: 0 none of it, 1 all of it.
///
/// Rays are spread about the smooth normal (`normals`, or those of the corners, interpolated), so
/// that facets do not show.
/// One that would start into its own triangle stands for light that only the coarse mesh keeps away
/// and is mirrored at the triangle's plane: a convex mesh is nowhere dark. Both sides of a triangle
/// block. Our own choices; the rays are those of Substance's baker (cosine, 64, a tenth of the
/// box). Requires: normals #V×3, unit; the mesh, its normals and the scene's mesh outlive the
/// field.
SurfaceField occlusion_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                             const Points& normals, const RayFieldOptions& options);

/// The mean direction in which the same rays are not blocked, in the coordinates of the mesh; on a
/// convex mesh the smooth normal; where all rays are blocked, the smooth normal too.
SurfaceField bent_normal_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                               const Points& normals, const RayFieldOptions& options);

/// The mean way of such rays inwards, about the opposite of the normal, to the next surface, at
/// most `reach`: 4/3 of its radius in a ball, twice its thickness in a wide slab. Its remark says
/// how many met nothing, where those are more than one in a hundred.
SurfaceField thickness_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                             const Points& normals, const RayFieldOptions& options);

/// The same of a scene, as `FieldMaker` wants them. Thickness reaches through the whole mesh, the
/// other two as far as the scene's options say. Throws: FieldError where there is an argument.
SurfaceField make_occlusion(const BakeScene& scene, const std::string& argument);
SurfaceField make_bent_normal(const BakeScene& scene, const std::string& argument);
SurfaceField make_thickness(const BakeScene& scene, const std::string& argument);

}  // namespace sphparam
