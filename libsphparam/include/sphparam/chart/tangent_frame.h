#pragma once

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// #W×4 rows (tx, ty, tz, w): unit tangent, and w = ±1 so that the bitangent is w · N × T. glTF's
/// TANGENT.
using Tangents = RowTable<double, 4>;

/// The frame that a tangent-space normal map of a chart is written in and read with. One row a
/// wedge. Between wedges a viewer interpolates normals and tangents linearly, without making them
/// unit, and takes w · N × T as the bitangent; so does whoever bakes.
struct ShadingFrame {
  Points normals;     // #W×3, unit
  Tangents tangents;  // #W×4
};

/// The source's vertex normals, #V×3, at the refined vertices, #V′×3: interpolated, then made unit;
/// +z where they cancel.
/// Throws: std::invalid_argument if #V differs. Cost: one pass.
Points carry_normals(const SphericalChart& chart, const Triangles& source, const Points& normals,
                     int threads = 0);

/// The tangents of a chart along growing u.
///
/// Sums, over the triangles of a wedge, of the direction of growing u on the surface, weighted by
/// the angle, projected into the plane of the normal. The two copies of a seam vertex share one
/// sum, so that light does not break at the seam; a pole fan's wedge keeps its own. Seen from
/// outside u grows to the east and v to the south, so w = +1 and the bitangent points north: up in
/// the image. Who mirrors u negates tangents and w.
///
/// Where an edge is hard, a vertex has wedges with normals of their own: then each normal at a
/// vertex has a sum of its own, over the triangles that meet there with it.
/// Requires: `positions` #V′×3 of the refined vertices (`carry_vertex_attribute`); `normals` unit,
///           #V′×3 of the refined vertices (`carry_normals`) or #W×3 of the wedges.
/// Ensures: tangents are unit and orthogonal to the normals up to rounding, also where triangles
///          have no area or u does not grow.
/// Throws: std::invalid_argument if a size is wrong. Cost: one pass; a sort, with normals of
/// wedges. Same bytes for any number of threads. Source: our own; the format: glTF 2.0,
/// Section 3.7.2.1.
ShadingFrame tangent_frame(const SphericalChart& chart, const Points& positions,
                           const Points& normals, int threads = 0);

}  // namespace sphparam
