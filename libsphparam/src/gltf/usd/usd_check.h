#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// What a layer of ours says of itself.
std::string usd_creator();
/// What it is called in a package.
inline constexpr char usdz_layer[] = "model.usda";

/// What a mesh of USD is made of.
struct UsdArrays {
  FloatRows points;                    // #V×3
  std::vector<std::uint32_t> counts;   // of corners of a face
  std::vector<std::uint32_t> indices;  // of vertices at corners
  FloatRows st;                        // v upwards, of vertices or corners; empty: there are none
};

/// Reads a .usda or .usdz back, a package by the reader of strangers' archives, and compares
/// points, faces and texture coordinates, number by number. Throws: std::runtime_error that names
/// what differs; ReadError.
void check_written_usd(std::string_view bytes, const std::string& name, const UsdArrays& arrays);

/// The same of an asset: what was certified of it holds for the file.
void check_written_usd(std::string_view bytes, const std::string& name, const Asset& asset);

}  // namespace sphparam
