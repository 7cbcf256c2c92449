#include "bake/fields/heat_field.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace sphparam {
namespace {

HeatScale scale_for(const std::string& name, const std::pair<double, double>& range) {
  for (const Heat heat : {Heat::Area, Heat::Angle, Heat::Stretch}) {
    const HeatScale& known = heat_scale(heat);
    if (known.title == name + " ratio") return known;
  }
  std::string title = name;
  std::replace(title.begin(), title.end(), ':', ' ');
  return {title, range.first, range.second};
}

}  // namespace

SurfaceField as_heat(SurfaceField data) {
  if (data.channels != 1 || data.kind != FieldKind::Data || !data.range) {
    throw std::invalid_argument(data.name + " is not one number with a range");
  }
  SurfaceField field = {.name = data.name,
                        .channels = 3,
                        .kind = FieldKind::Colour,
                        .about = "colours of " + data.about,
                        .range = data.range};
  const HeatScale scale = scale_for(data.name, *data.range);
  if (data.evaluate_runs) {
    field.evaluate_runs = [scale, numbers_of = std::move(data.evaluate_runs)](
                              std::span<const SurfaceRun> runs, float* values) {
      size_t count = 0;
      for (const SurfaceRun& run : runs) count += static_cast<size_t>(run.count);
      std::vector<float> numbers(count);
      numbers_of(runs, numbers.data());
      for (const float number : numbers) {
        const Rgb colour = to_linear(heat_colour(scale, static_cast<double>(number)));
        values = std::copy_n(colour.data(), 3, values);
      }
    };
    return field;
  }
  field.evaluate = [scale, numbers_of = std::move(data.evaluate)](
                       std::span<const SurfaceSample> samples, float* values) {
    std::vector<float> numbers(samples.size());
    numbers_of(samples, numbers.data());
    for (const float number : numbers) {
      const Rgb colour = heat_colour(scale, static_cast<double>(number));
      values = std::copy_n(colour.data(), 3, values);
    }
  };
  return field;
}

std::optional<HeatScale> heat_scale_of(const SurfaceField& field) {
  if (field.kind != FieldKind::Colour || !field.range) return std::nullopt;
  return scale_for(field.name, *field.range);
}

}  // namespace sphparam
