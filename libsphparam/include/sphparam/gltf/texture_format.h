#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sphparam/gltf/export.h"

namespace sphparam {

/// What the images of a .glb or .gltf are.
enum class TextureFormat {
  Given,  // PNG and JPEG as they are
  Webp,   // EXT_texture_webp, which browsers and engines read, and many tools do not
};

struct TextureOptions {
  TextureFormat format = TextureFormat::Given;
  int quality = 90;       // 1 to 99 of colours; 100: nothing is lost
  bool fallback = false;  // the images as given too, for who reads no WebP
  int threads = 0;        // 0: all cores
};

/// What became of an image.
struct RecodedTexture {
  std::string name;
  std::size_t given_bytes = 0, bytes = 0;
  bool exact = false;  // every sample of 8 bits as it was
  bool sixteen_bits = false;  // it had more, which WebP has not
};

/// Makes the images of a look WebP. Base colour and emission lose what `quality` says, alpha is kept;
/// normals, occlusion, roughness and metallic lose nothing, as errors there are seen as light. An
/// image that would become larger stays as it is.
/// Ensures: the same bytes for any number of threads.
/// Throws: ImageError for images beyond 16,383 texels a side.
/// Cost: some 0.4 s a megatexel of colours, 2 s of others.
std::vector<RecodedTexture> recode_textures(Look& look, const TextureOptions& options);

/// "3 images as WebP: 4.2 MB of 9.1 MB": for people; empty where there is none.
std::string words_of(const std::vector<RecodedTexture>& recoded);

}  // namespace sphparam
