#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/asset/remake_asset.h"

namespace sphparam {

/// The page of an asset that was made whole, for people: itself first, turning, with its channels
/// to switch and a place to drop an image of one's own; what was done in words; it beside what it
/// was; its images, which lie beside the page; all figures behind a fold. `look`: of its .glb;
/// `shown`: how its model is made; `base_colour`: that image now, may be empty. Throws: ImageError;
/// Cancelled.
std::string asset_page(const MeshSource& asset, const RemadeAsset& remade, const Look& look,
                       const ExportOptions& shown, const std::string& base_colour,
                       const std::vector<std::pair<std::string, std::string>>& facts);

/// Whether pages of this program have models; else pictures.
bool has_viewer();

}  // namespace sphparam
