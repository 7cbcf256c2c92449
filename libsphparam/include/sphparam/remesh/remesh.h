#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/polygons.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

enum class SampleMode {
  Point,  // the surface at the direction
  /// Its mean over the cell, where the grid is coarser than the source. Of what faces measure, the
  /// mean over the source's faces whose middles lie in a face of the grid, by their areas.
  Cell,
  /// Positions, and what faces and corners have, as `Point`; what vertices have by
  /// `barycentric_weights` or `adap_bary_area_weights` (resample.h); with the latter faces as
  /// `Cell`.
  Barycentric,
  AdapBaryArea,
};

/// "point", "cell", "barycentric", "adap-bary-area".
std::string name_of(SampleMode mode);

/// A name that is none of what a mesh has, and what it has.
class NoSuchProperty : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

struct RemeshOptions {
  SampleMode sample = SampleMode::Point;
  /// With AdapBaryArea: the areas of vertices of the source and of the grid; empty: on the source,
  /// and on what becomes of it on the grid. None is below 0.
  VectorX source_areas = {}, grid_areas = {};
  /// What to carry besides positions: "all", "color", "normal", "uv", "material", where the source
  /// has it, or names of properties, which it must have; none: nothing.
  std::vector<std::string> transfer = {"all"};
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// A mesh on a grid: a mapped mesh whose map are the directions of the grid.
///
/// `polygons()` are the grid's faces, of which quads are cut in two for `mesh()`, as a reader of
/// the file would; `name()` is the grid's.
class Remeshed : public MappedMesh {
 public:
  struct Figures {
    long averaged = 0;                                // vertices that are means over cells
    double locate_seconds = 0, transfer_seconds = 0;  // of positions
  };

  /// Requires: polygons, those of the grid.
  Remeshed(MappedMesh mesh, std::optional<GridSpec> spec, const Figures& figures);

  const Polygons& faces() const { return *polygons(); }
  const std::optional<GridSpec>& spec() const { return spec_; }  // nothing for another sphere's
  const Figures& figures() const { return figures_; }
  SphereGrid grid() const;

 private:
  std::optional<GridSpec> spec_;
  Figures figures_;
};

/// Resamples a mapped mesh: each vertex of the grid gets the point of the surface that the map
/// takes to its direction, and what the surface has there: of a radial map, what a ray from its
/// centre in that direction meets, as near as its vertices are to theirs; not of one that was made
/// anew, or where mesh or map were moved since (`is_as_said`, planetocentric.h).
///
/// Floating numbers are interpolated, and colours as light, normals made unit again, whole numbers
/// are labels and never mixed. Texture coordinates and normals of corners come from the side of a
/// seam that the face's middle lies on. Faces have the material and the properties of the source at
/// their middle. Whatever is asked for, texture coordinates and properties of faces are point
/// samples. Data of vertices may be NaN: what is a mean of it is NaN. The result's provenance says
/// which grid and how, and how the source was mapped. Ensures: the same bytes for any number of
/// threads; a grid vertex in the direction of a source vertex gets that vertex's values, bit for
/// bit. Throws: NoSuchProperty for a name in `transfer` that the source has not; MeshError and
/// NotCertifiedError for a grid of one's own that is no sphere; std::invalid_argument for a
/// direction of it that is zero or not finite, for a spec as `make_grid`, for areas that are not
/// one a vertex, and for an option outside of its domain; Cancelled.
/// Cost: about 1 µs a vertex of the grid, one thread, and the source's locator, once.
Remeshed remesh(const MappedMesh& source, SphereGrid grid, const RemeshOptions& options = {});
Remeshed remesh(const MappedMesh& source, const GridSpec& grid, const RemeshOptions& options = {});

/// The angles of tables: theta and phi in radians; or longitude, above −180 to 180 to the east, and
/// latitude in degrees.
enum class TableAngles { Radians, Degrees };

/// Of each direction: 1 where it lies in a hole of the source that a filler closes, whose rim is
/// surface. Empty: the source has no fillers. Throws: std::invalid_argument for a direction that is
/// zero or not finite.
FillerMarks in_holes(const MappedMesh& source, const Points& directions, int threads = 0);

struct TableHoles {
  FillerMarks in_hole = {};  // of each vertex; empty: none is
  bool left_out = false;     // their rows; else a last column "filler" has 1 in them
};

/// Values separated by commas (or tabs), a row a vertex: its number, theta and phi (or lon and
/// lat), x y z, and every property of vertices; shortest text that reads back the same.
std::string sample_table(const MappedMesh& mesh, TableAngles angles = TableAngles::Radians,
                         const TableHoles& holes = {}, char separator = ',');

}  // namespace sphparam
