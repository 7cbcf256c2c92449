#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam {

/// What is drawn: a mesh and, where it is known, its map.
struct DrawnMesh {
  MeshFile file;
  std::optional<SphereMap> map;
  std::string warning = {};  // of a sphere that is named: `roundness_warning`, with its name
};

/// Reads a mesh as its file has its vertices, with the map that it carries; where a sphere is
/// named, welded as maps need it, with that sphere's map, which may have any radius and is made of
/// unit rays here. Ensures: it can be drawn, see `draw_png`.
/// Throws: ReadError, also for a mesh without triangles, and for a sphere of other connectivity or
/// with a vertex at its centre.
DrawnMesh load_drawn(const std::string& path, const std::string& sphere = "",
                     const ReadOptions& options = {});

/// The same of a mesh that was read already, or mended. Throws: likewise.
DrawnMesh drawn_mesh(MeshSource source, const std::string& sphere = "",
                     const ReadOptions& options = {});

/// What a picture shows: the mesh, its sphere, or both in a row.
enum class View { Mesh, Sphere, Both };

/// The colours of both, so that one sees where each part of the shape went.
enum class Colouring {
  Own,      // textures; else the colours of vertices; else of materials; else directions
  Plain,    // one colour
  Normals,  // each direction of the surface in a pastel colour of its own
  Checker,  // fields of longitude and latitude
  Area,     // red grows on the sphere, blue shrinks, full at a factor of 8
  Angle,    // the factor by which angles are off in the mean, dark 1 to yellow 8
};

struct DrawingOptions {
  std::optional<View> view = std::nullopt;  // nothing: both where there is a map
  Colouring colouring = Colouring::Own;
  // A number a vertex, else a face, shown instead of the colouring; empty: none.
  std::string scalar = {};
  // The scale of what is measured; nothing: its 2nd to its 98th percentile. Numbers, the first the
  // smaller one; where they are −x and x, colours go from blue by white to red.
  std::optional<std::pair<double, double>> range = std::nullopt;
  std::optional<Vector3> from = std::nullopt;  // where the eye is, finite, not 0; nothing: a little
                                               // to the right, and above
  Up up = {};                                  // of the mesh; nothing: as its file says
  std::shared_ptr<const MeshTextures> textures = nullptr;  // see `shown_textures`; null: none
  bool wireframe = false;                                  // the edges of the triangles
  bool repairs = false;    // outlines of what repair has closed, instead of the edges of triangles
  bool graticule = false;  // lines of longitude and latitude
  bool occlusion = false;  // darken what little light reaches
  bool legend = true;      // below area, angle and what is measured
  bool transparent = false;  // where nothing is drawn; else white. There is no legend then
  int size = 800;            // pixels, of each side of a picture; 16 to 16384
  double height = 0;  // of the world that a picture of the mesh shows; 0: so much that all is seen
  int threads = 0;    // 0: all cores
};

/// Does nothing of it need a map? Views of the sphere, some colourings and the graticule do.
bool draws_without_map(const DrawingOptions& options);

/// How much of the world, from bottom to top, a picture of the mesh shows where all of it is to be
/// seen: `DrawingOptions::height` of pictures to one scale is the largest of theirs. The mesh is in
/// the middle of each. Requires, throws: as `draw_png` of such a picture. Cost: one pass.
double height_to_see(const MeshFile& file, const DrawingOptions& options = {});

/// A mesh and its map as the bytes of a PNG. The map may have folds, and rays of any length.
/// Requires: triangles; positions within doubles' powers (`at_drawing_size`); a ray a vertex.
/// Ensures: the same bytes for any number of threads.
/// Throws: std::invalid_argument for an option outside of its domain, where a map is needed and
/// missing, for `from` along the axis that is up, and for a `scalar` that is no property of
/// vertices or faces; ImageError. Cost: some seconds at 800 pixels.
std::string draw_png(const MeshFile& file, const std::optional<SphereMap>& map,
                     const DrawingOptions& options = {});

}  // namespace sphparam
