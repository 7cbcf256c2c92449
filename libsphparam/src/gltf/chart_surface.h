#pragma once

#include "gltf/shape.h"
#include "gltf/stored_chart.h"
#include "sphparam/gltf/asset.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What goes into the vertex buffers beside positions, normals and the spherical (u, v).
struct SurfaceOptions {
  UvStorage uv = {};
  bool tangents = false;
  bool colours = false;           // COLOR_0, where the mesh has colours
  bool theta_phi = false;         // _THETA_PHI, radians; θ in [0, 2π), ϕ in [0, π]
  bool position_lo = false;       // _POSITION_LO: what float32 leaves of the positions
  bool source_texcoords = false;  // TEXCOORD_1: the mesh's own
  int threads = 0;                // 0: all cores
};

/// A shape that the mesh can be morphed into.
struct NamedShape {
  std::string name;
  Shape shape;
};

/// The vertex buffers of a chart in a shape: a vertex a wedge, and more only where the mesh's own
/// texture coordinates, if asked for, differ between the corners of one.
///
/// Where u = 0 is θ = 0, the copies of the seam at u = 1 have θ = 2π, so that θ is continuous on
/// every triangle; with another `theta_offset` it jumps within those that lie across θ = 0.
/// `theta_offset`: the θ of u = 0, radians.
/// Throws: std::range_error where a position is beyond float32; UnmeasurableMesh where the shape is
/// too small for it.
Surface chart_surface(const SphericalChart& chart, const Shape& shape,
                      const std::vector<NamedShape>& targets, const MeshFile& mesh,
                      const SurfaceOptions& options, double theta_offset = 0);

/// Near the middle of what is farther from the origin than is good for float32; else the origin.
Eigen::RowVector3d origin_for_float32(const Points& positions);

}  // namespace sphparam
