#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/gltf/asset.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

/// Names and bytes; the first is the layer itself, with an empty name.
using UsdFiles = std::vector<std::pair<std::string, std::string>>;

/// A layer of USD as text, and the images beside it, which are called "STEM_basecolor.png".
///
/// The first level as a mesh of triangles that nothing subdivides, y up, a unit a metre, and its
/// materials as UsdPreviewSurface; those after the first are variants of the set "look". Texture
/// coordinates are (u, 1 − v) in float32: certified where the asset was made with
/// `ExportOptions::upward_v`. Numbers read back as they are. Where vertices have colours
/// these are `displayColor`, and seen instead of a base colour.
/// Requires: a level with a triangle; finite numbers; images that are PNG or JPEG.
/// Ensures: the same bytes for the same asset.
/// Throws: std::invalid_argument for an asset without triangles, one whose (u, v) are certified as
/// 16-bit numbers, and for WebP.
/// Source: UsdGeom, UsdShade and the specification of UsdPreviewSurface, of OpenUSD.
UsdFiles write_usd(const Asset& asset, const std::string& stem = "mesh");

/// The same in one package: a ZIP archive of the layer and the images, nothing compressed, each
/// from a multiple of 64 bytes on. Throws: likewise; std::length_error beyond 4 GiB.
std::string usdz_bytes(const Asset& asset);

/// Adds a control mesh as a .usda or .usdz: its polygons, quads as they are, to be subdivided by
/// Catmull-Clark or Loop; y up; its texture coordinates at corners, straight over the faces, which
/// nothing smooths; its comments. What is on the disk is read back and compared. Returns what is
/// not carried (losses.h). Throws: WriteError; std::runtime_error where what was read back differs;
/// std::length_error as `usdz_bytes`.
std::vector<std::string> add_usd_cage(PendingFiles& files, const std::string& path,
                                      const MappedMesh& cage, bool is_loop);

/// What an asset has that these files do not carry, for people: a line, or none.
std::vector<std::string> beyond_usd(const Asset& asset);

}  // namespace sphparam
