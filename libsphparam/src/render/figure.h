#pragma once

#include <optional>

#include "render/render.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct FigureOptions {
  std::optional<Paint> paint = std::nullopt;     // none: `own_paint`, without textures
  bool with_mesh = true, with_sphere = true;     // what the row shows
  bool graticule = true;                         // lines of θ and ϕ every 15°, the date line red
  bool wireframe = false;                        // the triangles
  int size = 800;                                // pixels, of each picture in the row
  int samples = 3;                               // samples² a pixel
  bool both_sides = false;                       // a third picture: the sphere from behind
  Vector3 view{1, -1.6, 0.5};                    // from the mesh towards the eye
  Vector3 up{0, 0, 1};                           // of the mesh
  std::optional<Rgb> background = Rgb(1, 1, 1);  // none: transparent
};

/// The standard picture of a map, after the paper's Figures 1 and 8: left the mesh, right the
/// sphere with the same triangles in the same colours, seen from the side that the mesh shows.
/// Requires: one ray a vertex; the map may have folds. Cost: some seconds at 800 pixels.
Image map_figure(const MeshFile& file, const SphereMap& map, const FigureOptions& options = {},
                 int threads = 0);

/// From where the sphere of a map shows what a mesh shows that is seen from `view`.
struct SphereView {
  Vector3 direction;  // the mean ray of the triangles that face the eye on the mesh
  Vector3 up;         // the way that this mean moves with height
};
SphereView corresponding_view(const TriangleMesh& mesh, const SphereMap& map, const Vector3& view,
                              const Vector3& up);

/// Pictures of the same height, side by side.
Image in_a_row(const std::vector<Image>& images);

}  // namespace sphparam
