#include "reports/bake_report.h"

#include <nlohmann/json.hpp>

#include "sphparam/version.h"

namespace sphparam::cli {

std::string to_json(const BakeReport& report) {
  using Json = nlohmann::ordered_json;
  Json images = Json::array();
  for (const BakeReport::Image& image : report.images) {
    Json one = {{"map", image.map},
                {"about", image.about},
                {"file", image.path},
                {"sample_type", image.sample_type},
                {"channels", image.channels}};
    if (image.range) one["range"] = {image.range->first, image.range->second};
    images.push_back(std::move(one));
  }
  const Json json = {
      {"version", version},
      {"source", {{"file", report.input}, {"triangles", report.triangles}}},
      {"for", report.target.empty() ? Json() : Json(report.target)},
      {"for_distance", report.target_distance ? Json(*report.target_distance) : Json()},
      {"width", report.width},
      {"height", report.height},
      {"samples", report.samples},
      {"convention", report.convention},
      {"refine_poles", report.refine_poles},
      {"images", std::move(images)},
      {"seconds", report.seconds}};
  return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

}  // namespace sphparam::cli
