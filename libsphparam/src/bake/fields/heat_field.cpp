#include "bake/fields/heat_field.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "bake/fields/attribute_fields.h"
#include "render/value_paint.h"

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

using ColourOf = std::function<Rgb(double)>;

std::vector<float> numbers_at(const SurfaceField& data, std::span<const SurfaceRun> runs) {
  size_t count = 0;
  for (const SurfaceRun& run : runs) count += static_cast<size_t>(run.count);
  std::vector<float> numbers(count);
  data.evaluate_runs(runs, numbers.data());
  return numbers;
}

std::vector<float> numbers_at(const SurfaceField& data, std::span<const SurfaceSample> samples) {
  std::vector<float> numbers(samples.size());
  data.evaluate(samples, numbers.data());
  return numbers;
}

/// Evaluates numbers, and writes their colours.
template <class Places>
auto colours_at(const SurfaceField& data, const ColourOf& colour_of) {
  return [data, colour_of](Places places, float* values) {
    for (const float number : numbers_at(data, places)) {
      const Rgb colour = colour_of(static_cast<double>(number) + data.origin[0]);
      values = std::copy_n(colour.data(), 3, values);
    }
  };
}

/// `colour_of`: sRGB. Labels are stored so in integers; elsewhere as all colours, in linear light.
SurfaceField coloured(const SurfaceField& data, const ColourOf& colour_of, bool integers) {
  SurfaceField field = {.name = data.name, .channels = 3, .about = "colours of " + data.about};
  const bool labels = data.kind == FieldKind::Label;
  field.kind = labels ? FieldKind::Label : FieldKind::Colour;
  const ColourOf light = [colour_of](double number) { return to_linear(colour_of(number)); };
  if (data.evaluate_runs)
    field.evaluate_runs =
        colours_at<std::span<const SurfaceRun>>(data, labels && integers ? colour_of : light);
  else
    field.evaluate = colours_at<std::span<const SurfaceSample>>(data, colour_of);
  return field;
}

}  // namespace

SurfaceField as_heat(SurfaceField data, std::optional<std::pair<double, double>> extent) {
  if (data.channels != 1 || data.kind != FieldKind::Data || !data.range) {
    throw std::invalid_argument(data.name + " is not one number with a range");
  }
  HeatScale scale = scale_for(data.name, *data.range);
  if (extent) {
    scale.below = extent->first < scale.low;
    scale.above = extent->second > scale.high;
  }
  SurfaceField field = coloured(
      data, [scale](double number) { return heat_colour(scale, number); }, true);
  field.range = data.range;
  field.scale = std::make_shared<const HeatScale>(scale);
  return field;
}

SurfaceField make_scalar_or_heat(const BakeScene& scene, const std::string& name) {
  SurfaceField data = make_scalar(scene, name);
  if (!scene.options.heat) return data;
  const MeshFile& file = scene.source.file();
  const auto& range = scene.options.scalar_range;
  const ValueColours colours = file.find_vertex_property(name)
                                   ? vertex_value_colours(file, name, range)
                                   : face_value_colours(file, name, range);
  if (range && !colours.scale)
    throw FieldError(data.name + ": its labels have the colours of their table, of no range");
  if (colours.names) data.kind = FieldKind::Label;
  SurfaceField field = coloured(
      data, [colours](double number) { return colours.of(number); }, scene.ids_as_colours);
  if (!colours.scale) return field;
  field.range = std::pair(colours.scale->low, colours.scale->high);
  field.scale = std::make_shared<const HeatScale>(*colours.scale);
  return field;
}

}  // namespace sphparam
