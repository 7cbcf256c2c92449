#pragma once

#include <string>
#include <vector>

#include "io/formats/gltf/gltf_document.h"
#include "io/formats/gltf/gltf_document_model.h"

namespace sphparam {

/// The materials of a model whose buffers and views are in the document already: their base
/// colours, with the bytes of images inside the file, and in words what else they say.
/// Throws: ReadError for an image outside of its buffer.
std::vector<GltfDocument::Material> materials_of(const tinygltf::Model& model,
                                                 const GltfDocument& document,
                                                 const std::string& name,
                                                 const SceneOrigin& origin);

}  // namespace sphparam
