#pragma once

#include "gltf/asset.h"
#include "gltf/shape.h"
#include "gltf/stored_chart.h"
#include "mesh_io/mesh_file.h"

namespace sphparam::tools {

/// What goes into the vertex buffers beside positions, normals and the spherical (u, v).
struct SurfaceOptions {
  UvStorage uv = {};
  bool tangents = false;
  bool colours = false;           // COLOR_0, where the mesh has colours
  bool theta_phi = false;         // _THETA_PHI, radians; continuous on every triangle
  bool position_lo = false;       // _POSITION_LO: what float32 leaves of the positions
  bool source_texcoords = false;  // TEXCOORD_1: the mesh's own
};

/// A shape that the mesh can be morphed into.
struct NamedShape {
  std::string name;
  Shape shape;
};

/// The vertex buffers of a chart in a shape: a vertex a wedge, and more only where the mesh's own
/// texture coordinates, if asked for, differ between the corners of one.
///
/// Colours of meshes read from glTF are linear, all others sRGB.
/// `theta_offset`: the θ of u = 0, radians.
/// Throws: std::range_error where a position is beyond float32.
Surface chart_surface(const SphericalChart& chart, const Shape& shape,
                      const std::vector<NamedShape>& targets, const MeshFile& mesh,
                      const SurfaceOptions& options, double theta_offset = 0);

}  // namespace sphparam::tools
