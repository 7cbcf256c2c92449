#pragma once

#include "sphparam/correspondence/surface_map.h"
#include "sphparam/mesh/similarity.h"
#include "sphparam/progress.h"

namespace sphparam {

/// The triangles of one surface in the shape of another: as an end of a morph.
struct CarriedShape {
  TriangleMesh mesh;  // `SurfaceMap::from_on_to`
  Points normals;     // #V×3, unit: what the other surface is lit with at these points
};

/// Cost: that of `SurfaceMap::forth`.
CarriedShape carried_shape(const SurfaceMap& map, int threads = 0);

/// How another surface is put to where one is, so that both can be seen in one picture.
enum class Placement {
  AsItIs,  // in its own coordinates
  Moved,   // turned and shifted
  Scaled,  // to the same area, too
};

/// What puts `to` to where `from` is: of all turns and shifts that with the least Σ area ·
/// distance² between the vertices of `from` and their points. Placement::AsItIs: the identity.
/// Ensures: no mirror image; same bits for any number of threads.
/// Throws: UnmeasurableMesh where one has no area; std::invalid_argument for no placement. Source:
/// Kabsch (1976), as `nearest_rotation`.
Similarity placement_on(const SurfaceMap& map, Placement placement, int threads = 0);

/// How much of `to` the triangles of `from` show, whose corners lie on it. Lengths are parts of the
/// diagonal of the box about `to`.
struct CarriedFidelity {
  double farthest = 0;    // point of `to` from the carried triangles
  double rms = 0;         // of the points of `to`
  double area_share = 0;  // the area of the carried triangles, of that of `to`
};

/// Ensures: the same bits for any number of threads. Throws: UnmeasurableSurface; Cancelled.
/// Cost: 1 µs a sample, of which there are 200,000, and a vertex of `to`.
CarriedFidelity measure_carried(const SurfaceMap& map, int threads = 0,
                                const Progress& progress = {});

}  // namespace sphparam
