#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/chart/chart_certificate.h"
#include "sphparam/io/materials.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Rows of float32 numbers, as a vertex buffer holds them. They pass between the library and its
/// users, so they come from malloc (`RowTable`).
using FloatRows = RowTable<float, Eigen::Dynamic>;

/// What a morph target adds to the vertices. `tangents` is empty where the surface has none.
struct MorphTarget {
  std::string name;
  FloatRows positions, normals, tangents;  // #N×3
};

/// A vertex attribute of our own; its name starts with an underscore.
struct CustomAttribute {
  std::string name;
  FloatRows values;  // #N×1 … #N×4
};

/// The vertex and index buffers of one primitive. What a mesh does not have is empty.
struct Surface {
  FloatRows positions;                                // #N×3, y up, from the origin
  FloatRows normals;                                  // #N×3, unit
  FloatRows tangents;                                 // #N×4
  std::vector<FloatRows> texcoords;                   // #N×2 each, v downwards
  std::vector<std::array<std::uint16_t, 4>> colours;  // #N, linear light, alpha not multiplied in
  std::vector<CustomAttribute> custom;
  std::vector<std::uint32_t> indices;  // three a triangle
  std::vector<MorphTarget> targets;
  /// Zero, but for shapes that are far from it for their size, of which float32 would leave little:
  /// where their positions begin, as its node's translation. Exact: origin + what was rounded.
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();

  std::size_t vertex_count() const { return static_cast<std::size_t>(positions.rows()); }
};

/// An image file, PNG, JPEG or WebP; its first bytes say which.
struct AssetImage {
  std::string name;
  std::string bytes;
};

/// Numbers of images; −1: none. What glTF 2.0, Section 3.9 has.
struct Material {
  std::string name;
  int base_colour = -1, normal = -1;
  int occlusion = -1;                  // in red
  int metallic_roughness = -1;         // roughness in green, metallic in blue; −1: as numbers:
  double roughness = 1, metallic = 0;  // the same all over
  int emissive = -1;
  double emissive_strength = 1;  // times the image
  AlphaMode alpha_mode = AlphaMode::Opaque;
  double alpha_cutoff = 0.5;  // of Mask
  bool double_sided = false;
  bool unlit = false;
  MaterialFinish finish = {};

  /// Those of its images that do not depend on the tangent frame of a mesh.
  std::array<int*, 4> frameless_images() {
    return {&base_colour, &occlusion, &metallic_roughness, &emissive};
  }
};

/// What is proved of the (u, v) of a level.
struct ChartFigures {
  long triangles = 0, vertices = 0;  // of the chart; vertices as buffers count them: a (u, v) each
  long splits = 0;                   // of edges and faces, so that nothing folds
  ChartCertificate chart;            // with (u, v) as doubles
  ChartCertificate stored;           // as the file has them; what folds is less than a texel
  long sphere_folds = -1;  // of a sphere: triangles that float32 turns over; −1: it is no sphere
};

/// Everything that a glTF file of one object holds.
struct Asset {
  std::string name;
  std::vector<Surface> levels;  // of detail, finest first; at least one
  std::vector<AssetImage> images;
  bool coarse_levels_have_normal_maps = true;  // false where one was baked for the finest alone
  std::vector<Material> materials;  // the first is the one that is seen; the others are variants
  std::vector<std::pair<std::string, std::string>> extras;  // of the asset, below "sphparam"
  std::string copyright = {};                               // of the asset
  std::string source_extras = {};  // of the asset, beside "sphparam": a JSON object, else none

  // What `make_asset` says besides, which no file holds.
  bool quantised = false;                  // its (u, v) are certified as 16-bit numbers
  bool upward_v = false;                   // they are certified as (u, 1 − v), as USD has them
  std::vector<ChartFigures> charts = {};   // of the levels
  std::vector<std::string> warnings = {};  // for people: what folds as stored, what is left out
};

}  // namespace sphparam
