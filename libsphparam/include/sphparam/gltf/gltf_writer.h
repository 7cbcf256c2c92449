#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// How a glTF file holds its buffers and images.
enum class GltfContainer {
  Binary,    // one .glb
  Separate,  // .gltf beside a .bin and the images
  Embedded,  // one .gltf with everything in data URIs
};

struct GltfOptions {
  GltfContainer container = GltfContainer::Binary;
  std::string stem = "mesh";  // of the names of files beside a .gltf
  // KHR_mesh_quantization, 16 bits. Only an asset made with `ExportOptions::quantise` has (u, v)
  // that are certified so, and is always written so; `add_asset` refuses another one that folds.
  bool quantise = false;
  // EXT_meshopt_compression, which few viewers lack and many tools do; where quantised, normals and
  // tangents in 8 bits a component, off by 1° at most.
  bool compress = false;
};

/// The animation of morph targets: the mesh rests, changes into the first target, rests, …
inline constexpr double morph_rest_seconds = 1, morph_change_seconds = 2;

/// Names and bytes; the first is the .glb or .gltf itself, with an empty name.
using GltfFiles = std::vector<std::pair<std::string, std::string>>;

/// A glTF 2.0 file of an asset.
///
/// Levels after the first hang on the first one's node by MSFT_lod; materials after the first are
/// variants (KHR_materials_variants), each named by its material. Morph targets get an animation
/// that shows one after the other. Textures repeat in u and are clamped in v.
/// Requires: a level, each with a triangle; finite numbers, unit normals and tangents; indices in
/// range; levels share materials.
/// Ensures: min and max are exact for the numbers stored; 16-bit indices for up to 65,535 vertices;
/// the same bytes for the same asset.
/// Throws: std::length_error where a .glb would be beyond 4 GiB; std::invalid_argument for a
/// container that there is not, and for an asset without levels or triangles.
/// Source: glTF 2.0 and the extensions named, as the Khronos validator reads them.
GltfFiles write_gltf(const Asset& asset, const GltfOptions& options = {});

/// The same, as the one file of GltfContainer::Binary.
std::string glb_bytes(const Asset& asset, GltfOptions options = {});

}  // namespace sphparam
