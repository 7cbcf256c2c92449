#pragma once

#include <string>
#include <vector>

#include "gltf/usd/layer_text.h"

namespace sphparam {

/// The materials of an asset as prims of a layer.
class UsdMaterials {
 public:
  /// `scope`: the path of the prim that they are in. `files[i]`: what the i-th image is called.
  UsdMaterials(const Asset& asset, std::string scope, std::vector<std::string> files);

  /// A word for each that no other has.
  const std::vector<std::string>& names() const { return names_; }
  std::string path_of(std::size_t material) const { return scope_ + "/" + names_[material]; }

  void write(LayerText& text) const;

 private:
  const Asset& asset_;
  std::string scope_;
  std::vector<std::string> files_, names_;
};

/// Numbers of the images that the materials show, each once, as they come.
std::vector<int> images_of_usd(const Asset& asset);

/// What of a finish UsdPreviewSurface has no input for: extensions of glTF by their names.
std::vector<std::string> finish_beyond_usd(const Material& material);

}  // namespace sphparam
