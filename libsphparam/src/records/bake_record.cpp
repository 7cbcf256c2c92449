#include "sphparam/records/bake_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "range_digits.h"
#include "records/json_parts.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

Json images_json(const std::vector<BakedImage>& images) {
  Json result = Json::array();
  for (const BakedImage& image : images) {
    Json one = {{"map", image.field},
                {"about", image.about},
                {"file", image.path},
                {"sample_type", name_of(image.sample_type)},
                {"channels", image.channels}};
    if (!image.sidecar.empty()) one["sidecar"] = image.sidecar;
    if (image.range) {
      one["range"] = {image.range->first, image.range->second};
      if (!std::isnan(image.beyond)) one["beyond"] = image.beyond;
    }
    result.push_back(std::move(one));
  }
  return result;
}

Json body_json(const Body& body, const BakeReport& baked) {
  const Vector3& a = body.semi_axes;
  return {{"name", body.name},
          {"semi_axes_metres", {a.x(), a.y(), a.z()}},
          {"unit_metres", body.unit},
          {"positive_west", body.positive_west},
          {"coordinate_system", baked.coordinate_system}};
}

Json projection_json(const BakeRecord& record) {
  const ProjectionShares& shares = *record.baked.projection;
  return {{"file", record.from},
          {"triangles", record.settings.from->mesh.face_count()},
          {"back", shares.back},
          {"nearest", shares.nearest},
          {"median_distance", shares.median},
          {"farthest", shares.farthest}};
}

/// In as many digits as tell them, then without powers of ten if doubles have so many.
std::string ends_in_words(const std::pair<double, double>& range) {
  constexpr int few = 3, most = 17;
  const auto words = [&](int digits) {
    return short_number(range.first, digits) + " to " + short_number(range.second, digits);
  };
  int digits = range.first == range.second ? few : range_digits(range, few);
  if (digits > few)
    while (digits < most && words(digits).find("e+") != std::string::npos) ++digits;
  return words(digits);
}

std::string beyond_words(const BakedImage& image) {
  if (!(image.beyond > 0) || !image.range) return "";
  return "; " + percent(image.beyond) + " of the texels lie beyond " + ends_in_words(*image.range) +
         ", and end there";
}

}  // namespace

std::string to_json(const BakeRecord& record) {
  const BakeSettings& settings = record.settings;
  const std::optional<double>& distance = record.baked.target_distance;
  Json json = {
      {"sphparam", version},
      {"command", "bake"},
      {"source", {{"file", record.input}, {"triangles", record.source.mesh().face_count()}}},
      {"for", record.target.empty() ? Json() : Json(record.target)},
      {"for_distance", distance ? Json(*distance) : Json()},
      {"width", settings.width},
      {"height", settings.width / 2},
      {"samples", settings.samples},
      {"convention", info_of(settings.convention).name},
      {"refine_poles", settings.refine_poles},
      {"images", images_json(record.baked.images)},
      {"warnings", record.baked.warnings},
      {"seconds", record.seconds}};
  if (record.baked.projection) json["from"] = projection_json(record);
  if (settings.fields.body) json["body"] = body_json(*settings.fields.body, record.baked);
  return text_of(json);
}

std::string line_of(const ProjectionShares& shares, const BakeSettings& settings) {
  constexpr double rounding = 1e-9;
  const double most = std::max({shares.back, shares.nearest, shares.median, shares.farthest});
  if (most <= rounding) return settings.source_name + ": the mesh lies on it everywhere";
  const auto told = [](double share) { return percent(share > rounding ? share : 0); };
  return settings.source_name + ": found along the normals; " + told(shares.back) +
         " of the mesh shows its back, " + told(shares.nearest) +
         " no more than the nearest point; half is within " + told(shares.median) +
         " of the diagonal, all within " + told(shares.farthest);
}

std::string line_of(const BakedImage& image, const BakeSettings& settings) {
  return settings.source_name + ": " + image.field + ", " + std::to_string(settings.width) + " × " +
         std::to_string(settings.width / 2) + " " + name_of(image.sample_type) + " → " +
         output_name(image.path) +
         (image.sidecar.empty() ? "" : ", " + output_name(image.sidecar)) + beyond_words(image);
}

}  // namespace sphparam
