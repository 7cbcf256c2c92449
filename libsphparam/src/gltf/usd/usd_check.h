#pragma once

#include <string>
#include <string_view>

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// What a layer of ours says of itself.
std::string usd_creator();
/// What it is called in a package.
inline constexpr char usdz_layer[] = "model.usda";

/// Reads a .usda or .usdz back, a package by the reader of strangers' archives, and compares
/// points, triangles and texture coordinates with the asset, number by number: what was certified
/// of it holds for the file. Throws: std::runtime_error that names what differs; ReadError.
void check_written_usd(std::string_view bytes, const std::string& name, const Asset& asset);

}  // namespace sphparam
