#pragma once

#include <string>
#include <vector>

#include "render/render.h"
#include "sphparam/image/image.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct PictureOptions {
  Vector3 view{1, -1.6, 0.5};  // from the mesh towards the eye
  Vector3 up{0, 0, 1};         // of the mesh
  bool wireframe = false;      // the triangles
  bool transparent = false;    // behind it; else white
  int size = 360;              // pixels
  int threads = 0;
};

/// Looks at a mesh that stands so from in front, a little from the right and from above.
PictureOptions seen_upright(const UprightAxes& axes);

/// Colours that say where a part of the shape went: `own_paint`, with `red` faces in red.
Paint shape_paint(const MeshFile& file, const std::vector<Face>& red,
                  const MeshTextures& textures = {});

/// The mesh, and the sphere of a map with the same paint, seen from the corresponding side.
Image mesh_picture(const MeshFile& file, const Paint& paint, const PictureOptions& options);
Image sphere_picture(const MeshFile& file, const SphereMap& map, const Paint& paint,
                     const PictureOptions& options);

/// As the bytes of a PNG. Throws: ImageError.
std::string png(const Image& image);

}  // namespace sphparam
