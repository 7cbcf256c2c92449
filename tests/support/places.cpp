#include "support/places.h"

#include <cstdlib>

namespace sphparam::tests {

std::filesystem::path source_folder() { return SPHPARAM_SOURCE_DIR; }

std::filesystem::path meshes_folder() {
  const char* const given = std::getenv("SPHPARAM_MESHES");
  return given ? given : SPHPARAM_DEFAULT_MESHES;
}

}  // namespace sphparam::tests
