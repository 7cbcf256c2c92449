#pragma once

#include <string>

#include "io/attributes/authorship.h"
#include "io/formats/gltf/gltf_document_model.h"

namespace sphparam {

/// Copyright and extras of a glTF file's `asset`.
Authorship authorship_of(const tinygltf::Model& model);

/// What else a file says beside what is shown, of which nothing is carried: XMP metadata, and
/// extras but for those of `asset` that `authorship_of` takes; in words, empty where there is
/// nothing. Names of morph targets and MSFT_screencoverage, which belong to other things, do not
/// count.
std::string other_metadata(const tinygltf::Model& model);

}  // namespace sphparam
