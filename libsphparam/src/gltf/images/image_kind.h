#pragma once

#include <string_view>

namespace sphparam {

/// What an image file is, by its first bytes: "image/png" and ".png", or those of JPEG and WebP.
/// Empty for all others, which glTF does not take.
struct ImageKind {
  const char* mime = "";
  const char* extension = "";

  bool is_jpeg() const { return mime == std::string_view("image/jpeg"); }
  /// Takes EXT_texture_webp.
  bool is_webp() const { return mime == std::string_view("image/webp"); }
  /// "png", "jpeg", "webp".
  const char* name() const { return *mime ? mime + std::string_view("image/").size() : ""; }
};

inline ImageKind image_kind(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return {"image/png", ".png"};
  if (bytes.starts_with("\xFF\xD8\xFF")) return {"image/jpeg", ".jpg"};
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP"))
    return {"image/webp", ".webp"};
  return {};
}

}  // namespace sphparam
