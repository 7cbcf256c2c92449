#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

// Data on the vertices of one sphere, brought to those of another, as surface-based neuroimaging
// does it.

/// For each sample, which vertices of a mesh it is a mean of: entry e of sample i, for
/// starts[i] ≤ e < starts[i + 1], has the vertex and its weight; weights of a sample sum to 1 up to
/// rounding.
struct Gather {
  std::vector<std::int64_t> starts;
  std::vector<Vertex> vertices;
  std::vector<double> weights;

  std::int64_t count() const { return static_cast<std::int64_t>(starts.size()) - 1; }
};

/// BARYCENTRIC, for data where the new sphere is as fine: each direction takes from the corners of
/// the triangle of the current sphere whose flat interior is nearest to it, by barycentric weights
/// there; no weight is 0. Directions may have any length but 0.
/// Source: method BARYCENTRIC of the Connectome Workbench, wb_command -metric-resample, whose
/// weights these are up to its rounding. `remesh` goes along the ray instead, which is exact for
/// the map, and differs by the curvature of a triangle.
/// Ensures: a direction of a vertex takes from it alone; the same weights for any number of
/// threads. Throws: std::invalid_argument for a direction that is zero or not finite. Cost: about 2
/// µs a direction.
Gather barycentric_weights(const MappedMesh& current, const Points& directions, int threads = 0);

/// ADAP_BARY_AREA, for data: nothing of the current sphere is left out where the new one is
/// coarser, and integrals over the surface are nearly kept. Each new vertex takes from the current
/// ones that lie in triangles about it, by their barycentric weights there; where these are none
/// but those that `barycentric_weights` names, as where the new sphere is finer, it takes from the
/// latter. Then weights are multiplied by the area of the new vertex, those of each current vertex
/// scaled to sum to its area, and those of each new vertex to 1. `current_areas`, `new_areas`: of
/// vertices on the anatomical surfaces (`vertex_areas`).
///
/// Which vertices have a weight at all decides which set is taken, so places are found as the
/// Workbench finds them, in numbers of 32 bits at the radius 100: weights are good to some 1e-5.
/// Source: method ADAP_BARY_AREA of the Connectome Workbench, wb_command -metric-resample, whose
/// weights these are (Glasser et al., "The minimal preprocessing pipelines for the Human Connectome
/// Project", 2013).
/// Requires: `topology` and `sphere` are those of the new sphere, one-to-one, of unit length or
/// any; areas not negative, one a vertex. Throws: std::invalid_argument where sizes differ.
/// Ensures: the same weights for any number of threads. Cost: that of locating the vertices of each
/// sphere in the other.
Gather adap_bary_area_weights(const MappedMesh& current, const Topology& topology,
                              const SphereMap& sphere, const VectorX& current_areas,
                              const VectorX& new_areas, int threads = 0);

/// Means of one number a vertex. Each lies between those it is a mean of; NaN among these gives
/// NaN. Requires: a number for each vertex that is named.
std::vector<double> weighted_means(const Gather& gather, const std::vector<double>& values,
                                   int threads = 0);

/// The label of the largest sum of weights, the lowest of several.
std::vector<double> weightiest_labels(const Gather& gather, const std::vector<double>& labels,
                                      int threads = 0);

/// All columns: labels by the sums of weights, all else by means. What the file says besides stays,
/// but for the number of triangles.
/// Throws: std::invalid_argument where the data has too few vertices.
VertexData resample_data(VertexData data, const Gather& gather, int threads = 0);

}  // namespace sphparam
