#pragma once

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// How a sphere map distorts, per triangle and per corner. Ratios are result / input; 1 is perfect.
///
/// Total areas are made equal first (the source's that of the whole sphere, also where the map of a
/// surface without its fillers covers less), as the paper does ("scaled accordingly by the ratio of
/// total areas", Section 6). Angles are those of chord triangles, areas those of spherical
/// triangles; singular values are of the linear map from the source triangle (total source area 4π)
/// to the chord triangle. Source areas are floored at 1e-9 of their mean. Triangles without area
/// (as an inspection counts them, `ZeroAreaFace`) have the share 0, and the ratios of that floor.
struct Distortion {
  VectorX area_ratio;               // #F: |Ω| / A
  RowTable<double, 3> angle_ratio;  // #F×3, corner by corner
  VectorX sigma_max;                // #F: larger singular value
  VectorX sigma_min;                // #F: smaller singular value
  VectorX source_area;              // #F: share of the total source area; 0: the triangle has none
};

/// Figures of a distortion. Each measure has one name; those that differ differ in name. Triangles
/// without area are in none of them.
struct DistortionSummary {
  // The paper's measures (Section 6): every triangle, every angle counts the same.
  double mean_abs_ln_area = 0;
  double mean_abs_ln_angle = 0;
  double area_within_two = 0;  // share of triangles with area ratio in [1/2, 2]
  double area_ratio_p01 = 1, area_ratio_p50 = 1, area_ratio_p99 = 1;
  double area_ratio_min = 1, area_ratio_max = 1;
  double angle_ratio_max = 1;  // of max(ratio, 1/ratio)
  // What other systems report: weighted by source area.
  double weighted_abs_log2_area = 0;
  double symmetric_dirichlet = 4;  // Σ A(σ1² + σ2² + σ1⁻² + σ2⁻²) / ΣA; 4 is isometry
  double quasi_conformal_mean = 1;  // Σ A σ1/σ2 / ΣA
  double quasi_conformal_max = 1;
  double stretch_l2 = 1;    // Sander et al. 2001: √(Σ A (σ1⁻² + σ2⁻²)/2 / ΣA)
  double stretch_linf = 1;  // largest 1/σ_min
  // Triangles whose image has an angle of 0 in doubles: the mean of angles is that of the others.
  long flat_images = 0;
  long flat_faces = 0;  // triangles of the source without area: they are left out of all figures
};

/// How a map distorts each triangle: angles, areas, stretch, against the mesh in space.
/// Requires: one unit ray a vertex, finite. Ensures: same bits for any number of threads; finite
/// values, but that an angle or σ_min of a collapsed image triangle may be 0.
/// Throws: std::invalid_argument for another number of rays. Cost: one pass; 0.15 µs a triangle.
Distortion measure_distortion(const TriangleMesh& mesh, const SphereMap& map, int threads = 0);

/// Means and extremes of the distortion of all triangles.
/// Ensures: never NaN; a mean that a collapsed triangle makes infinite is infinite, but for that of
/// angles, which leaves such triangles out and counts them; of a mesh without any area all are
/// infinite; same bits for any number of threads.
DistortionSummary summarise(const Distortion& distortion, int threads = 0);

/// The same of a mesh and its map, to the bit, in 8 bytes a triangle, not the 56 of a `Distortion`.
/// Requires, Throws, Cost: as `measure_distortion`.
DistortionSummary summarise_distortion(const TriangleMesh& mesh, const SphereMap& map,
                                       int threads = 0);

}  // namespace sphparam
