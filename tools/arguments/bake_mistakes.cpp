#include "arguments/bake_mistakes.h"

#include <map>

#include "arguments/words.h"

namespace sphparam::cli {

UsageMistake as_mistake(const BakeSettingError& error) {
  static const std::map<std::string, std::string> options = {
      {"path", "-o"},
      {"width", "--size"},
      {"samples", "--samples"},
      {"convention", "--size: --convention "},  // the message goes on with its name
      {"depth", "--depth"},
      {"mip", "--mip"},
      {"refine_poles", "--refine-poles"},
      {"rays", "--rays"},
      {"max_ray_distance", "--max-dist"}};
  const std::string& option = options.at(error.setting());
  return UsageMistake(option + (option.ends_with(' ') ? "" : ": ") + error.what());
}

void require_possible(const BakeRequest& image, const BakeSettings& settings) {
  try {
    require_bakeable({image}, settings);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    if (error.unknown().empty()) throw UsageMistake(std::string("--map: ") + error.what());
    const std::string meant = did_you_mean(error.unknown(), error.known());
    throw UsageMistake("--map: there is no map " + error.unknown() +
                       (meant.empty() ? "; there are " + joined(error.known()) : meant));
  }
}

UsageMistake as_mistake(const FieldError& error, const BakeSettings& settings) {
  const bool bare = dynamic_cast<const NoColoursError*>(&error) != nullptr;
  return UsageMistake(settings.source_name + ": " + error.what() +
                      (bare ? "; --texture IMAGE names its texture" : "") +
                      did_you_mean(error.unknown(), error.known()));
}

UsageMistake as_mistake(const OtherSphereError& error, const MappedMesh& source,
                        const BakeSettings& settings) {
  return UsageMistake(std::string("--for: ") + error.what() + "; `sphparam remesh " +
                      settings.source_name +
                      " --grid ico:6 -o LOW.sph.ply` makes a mesh on its sphere" +
                      (source.mapped_here() ? ", of a map that is kept (`sphparam map`)" : ""));
}

}  // namespace sphparam::cli
