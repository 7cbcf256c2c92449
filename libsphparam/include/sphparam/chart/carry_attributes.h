#pragma once

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Any number of columns, one item a row: of a vertex, a face, or a corner (3·face + corner).
using Attributes = RowTable<double, Eigen::Dynamic>;
using AttributesView = Eigen::Ref<const Attributes>;

/// Interpolates an attribute of the source's vertices, #V×k (positions, colours, a property), to
/// the refined vertices, #V′×k: Σ barycentricᵢ · value of corner i. A wedge has the value of its
/// vertex.
/// Ensures: rows of the source's own vertices are copied; a new vertex lies between its corners.
/// Requires: the mesh that the chart was made of. Same bytes for any number of threads.
/// Throws: std::invalid_argument if #V differs.
Attributes carry_vertex_attribute(const SphericalChart& chart, const Triangles& source,
                                  AttributesView values, int threads = 0);

/// The same for corners: #F·3 rows to #F′·3. Texture coordinates and normals that differ across an
/// edge of the source still do: a corner takes its values from its own source face.
/// Throws: std::invalid_argument if there are not 3·#F rows.
Attributes carry_corner_attribute(const SphericalChart& chart, const Triangles& source,
                                  AttributesView values, int threads = 0);

/// The same for faces, #F×k to #F′×k: each has the value of its source face.
Attributes carry_face_attribute(const SphericalChart& chart, const Triangles& source,
                                AttributesView values);

}  // namespace sphparam
