#include "arguments/texture_arguments.h"

namespace sphparam::cli {

void declare_textures(Declaration& command, TextureFormat& format, int& quality) {
  using enum TextureFormat;
  std::vector<std::pair<std::string, TextureFormat>> choices;
  for (const TextureFormat choice : {Given, Png, Jpeg, Webp, WebpLossless})
    choices.emplace_back(word_of(choice), choice);
  command
      .choice("--textures", format, choices,
              "What images are in the file; webp loses of colours only (default: given)")
      .number("--webp-quality", quality, "N", {1, 100}, "Of colours as webp");
}

}  // namespace sphparam::cli
