#pragma once

#include "sphparam/chart/tangent_frame.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/up_axis.h"

namespace sphparam {

/// Where the wedges of a chart are in space, y up as glTF has it, and how they are lit. #W rows.
struct Shape {
  Points positions;
  ShadingFrame frame;
};

/// The mesh itself, turned upright; with z up, (x, y, z) becomes (x, z, −y). `mesh_normals`: #V×3,
/// unit (`shading_normals`).
Shape mesh_shape(const SphericalChart& chart, const TriangleMesh& mesh, const Points& mesh_normals,
                 const UprightAxes& up, int threads = 0);

/// The same with unit normals of the chart, as `tangent_frame` takes them.
Shape lit_shape(const SphericalChart& chart, const TriangleMesh& mesh, const Points& normals,
                const UprightAxes& up, int threads = 0);

/// Its image on the unit sphere, north up whatever the mesh's up is, and what is in front there.
Shape sphere_shape(const SphericalChart& chart, const Vector3& front = {0, -1, 0}, int threads = 0);

/// The (u, v) rectangle, 2 wide and 1 high about the origin, facing +z: north up, u to the right.
Shape flat_shape(const SphericalChart& chart);

/// Scaled and moved: the sphere of a mesh's area about its middle, say.
Shape placed(Shape shape, double scale, const Vector3& middle);

/// The middle of the bounding box, and the area of the chart's triangles in space.
Vector3 middle_of(const Shape& shape);
double area_of(const Shape& shape, const SphericalChart& chart, int threads = 0);

}  // namespace sphparam
