#include "reports/bake_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam::cli {

std::string to_json(const BakeTold& told) {
  using Json = nlohmann::ordered_json;
  const BakeSettings& settings = told.settings;
  const auto& distance = told.baked.target_distance;
  Json images = Json::array();
  for (const BakedImage& image : told.baked.images) {
    Json one = {{"map", image.field},
                {"about", image.about},
                {"file", image.path},
                {"sample_type", name_of(image.sample_type)},
                {"channels", image.channels}};
    if (image.range) one["range"] = {image.range->first, image.range->second};
    images.push_back(std::move(one));
  }
  const Json json = {{"version", version},
                     {"source", {{"file", told.input}, {"triangles", told.triangles}}},
                     {"for", told.target.empty() ? Json() : Json(told.target)},
                     {"for_distance", distance ? Json(*distance) : Json()},
                     {"width", settings.width},
                     {"height", settings.width / 2},
                     {"samples", settings.samples},
                     {"convention", info_of(settings.convention).name},
                     {"refine_poles", settings.refine_poles},
                     {"images", std::move(images)},
                     {"seconds", told.seconds}};
  return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

std::string line_of(const BakedImage& image, const BakeSettings& settings) {
  return settings.source_name + ": " + image.field + ", " + std::to_string(settings.width) + " × " +
         std::to_string(settings.width / 2) + " " + name_of(image.sample_type) + " → " +
         output_name(image.path);
}

}  // namespace sphparam::cli
