#include "texture/convention.h"

namespace sphparam::tools {

const std::vector<ConventionInfo>& all_conventions() {
  static const std::vector<ConventionInfo> conventions = {
      {Convention::Sphparam, "sphparam", 1, 0.0}, {Convention::Three, "three", 1, 0.5},
      {Convention::Gis, "gis", 1, 0.5},           {Convention::Envmap, "envmap", -1, 0.25},
      {Convention::Blender, "blender", -1, 0.5},
  };
  return conventions;
}

const ConventionInfo& info_of(Convention convention) {
  return all_conventions()[static_cast<size_t>(convention)];
}

std::optional<Convention> convention_named(std::string_view name) {
  for (const ConventionInfo& info : all_conventions()) {
    if (name == info.name) return info.convention;
  }
  return std::nullopt;
}

}  // namespace sphparam::tools
