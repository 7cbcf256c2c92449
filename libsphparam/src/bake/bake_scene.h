#pragma once

#include <optional>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"
#include "texture/source_texture.h"

namespace sphparam {

/// The mesh that images are baked of.
struct BakeSource {
  MeshFile file;
  SphereMap map;  // certified
  Topology topology;
  Points normals;  // #V×3, unit: those of the file, or the mean of the faces'
  // One a material of the file, or the first for all faces; empty: no textures.
  std::vector<SourceTexture> textures;
  bool one_texture_for_all = false;  // whatever the materials; else faces without one are white
};

/// The mesh that images are baked for, by its chart: the source itself, or another mesh on the same
/// sphere (`--for`), whose surface is the base of heights and whose frame that of tangent normals.
struct BakeTarget {
  SphericalChart chart;
  Points positions, normals;  // of the refined vertices, chart.points.rows()×3; normals unit
  // Unit, #W×3, where the mesh has hard edges; else `normals` light it.
  std::optional<Points> wedge_normals = std::nullopt;
  bool is_source = true;
};

/// What the user may ask of maps.
struct MapOptions {
  TextureFilter filter = TextureFilter::Bilinear;
  bool normal_y_down = false;     // DirectX
  bool mirrored = false;          // u of the image runs against longitude: see `Convention`
  bool height_radial = false;     // distance from the origin; else along the target's normal
  bool heat = false;              // distortion and curvature as colours instead of numbers
  bool ids_as_colours = false;    // in integer images, which cannot hold large numbers
  int rays = 64;                  // a sample, of ao, bent and thickness
  double max_ray_distance = 0.1;  // of the bounding box's diagonal
};

/// All that fields are made of. They refer to it: it must outlive them.
struct BakeScene {
  BakeSource source;
  BakeTarget target;
  MapOptions options;
  int threads = 0;
};

}  // namespace sphparam
