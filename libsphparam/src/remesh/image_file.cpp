#include "remesh/image_file.h"

#include <stdexcept>

#include "option_domain.h"
#include "sphparam/io/paths.h"

namespace sphparam {

const char* name_of(ImageDepth depth) {
  return depth == ImageDepth::Half ? "half" : depth == ImageDepth::Float ? "float" : "u16";
}

ImageDepth depth_in(const std::string& path, std::optional<ImageDepth> wanted) {
  const std::string extension = extension_of(path);
  const bool png = extension == ".png";
  if (!png && extension != ".exr")
    throw std::invalid_argument(path + ": images are written as .png or .exr");
  if (!wanted) return png ? ImageDepth::Uint16 : ImageDepth::Float;
  require_one_of("depth", *wanted, ImageDepth::Uint16);
  if ((*wanted == ImageDepth::Uint16) != png)
    throw std::invalid_argument(path + ": half and float go into .exr, u16 into .png");
  return *wanted;
}

}  // namespace sphparam
