#include <algorithm>

#include "io/attributes/source_attributes.h"
#include "sphparam/bake/fields.h"

namespace sphparam {
namespace {

bool shines(const MaterialChannels& said) {
  return std::any_of(said.emission.factor.begin(), said.emission.factor.begin() + 3,
                     [](double x) { return x > 0; });
}

}  // namespace

const std::vector<std::string>& all_channels() {
  static const std::vector<std::string> names = {"basecolor", "normal-tangent", "orm", "emissive"};
  return names;
}

std::vector<std::string> channels_of(const MeshFile& file, bool on_another_mesh) {
  const auto any = [&](auto&& says) { return std::ranges::any_of(file.channels, says); };
  std::vector<std::string> names;
  if (!file.base_colours.empty() || linear_colours(file)) names.emplace_back("basecolor");
  if (on_another_mesh ||
      any([](const MaterialChannels& said) { return !said.normal.image.empty(); }))
    names.emplace_back("normal-tangent");
  if (!file.channels.empty()) names.emplace_back("orm");
  if (any(shines)) names.emplace_back("emissive");
  return names;
}

}  // namespace sphparam
