#include "sphparam/render/coloured_values.h"

#include <cmath>

#include "io/attributes/corner_colours.h"
#include "io/attributes/texture_pages.h"
#include "number_text.h"
#include "range_digits.h"
#include "render/colour.h"
#include "render/value_paint.h"

namespace sphparam {

namespace {

HeatScale scale_of(const std::string& name, const VectorX& values, const ColourScale& wanted) {
  if (wanted.range) return {name, wanted.range->first, wanted.range->second};
  const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
  const bool diverges = wanted.diverges || (values.size() > 0 && values.minCoeff() < 0);
  const double reach = largest > 0 ? largest : 1;
  return {name, diverges ? -reach : 0, reach};
}

std::vector<Rgb> colours_of(const VectorX& values, const HeatScale& scale) {
  std::vector<Rgb> colours;
  for (const double value : values) colours.push_back(heat_colour(scale, value));
  return colours;
}

void set_colours(MeshFile& file, const std::vector<Rgb>& colours) {
  int channel = 0;
  for (const char* colour_name : {"red", "green", "blue"}) {
    Property property = {colour_name, ScalarType::Uint8, {}};
    for (const Rgb& colour : colours) {
      property.values.push_back(std::round(255 * static_cast<double>(colour[channel])));
    }
    file.set_vertex_property(std::move(property));
    ++channel;
  }
}

std::string words_of(const std::optional<HeatScale>& scale) {
  if (!scale) return "of its table";
  const int digits = range_digits({scale->low, scale->high}, 6);
  return "from " + short_number(scale->low, digits) +
         (scale->diverges() ? " (blue) by 0 (white) to " : " (dark) to ") +
         short_number(scale->high, digits) + (scale->diverges() ? " (red)" : " (yellow)");
}

}  // namespace

MeshFile with_coloured_values(MeshFile file, const std::string& name, const VectorX& values,
                              const std::string& about, const ColourScale& wanted) {
  const HeatScale scale = scale_of(name, values, wanted);
  remove_textures(file);
  set_colours(file, colours_of(values, scale));
  file.set_vertex_property(
      {name, ScalarType::Float64, std::vector<double>(values.begin(), values.end())});
  if (!about.empty()) {
    const int digits = range_digits({scale.low, scale.high}, 6);
    file.comments.push_back(name + ": " + one_line(about) + ", colours from " +
                            short_number(scale.low, digits) + " to " +
                            short_number(scale.high, digits));
  }
  return file;
}

MeshFile with_scalar_colours(MeshFile file, const std::string& name,
                             const std::optional<std::pair<double, double>>& range) {
  const ValuePaint seen = value_paint(file, name, range);
  remove_textures(file);
  remove_corner_colours(file);
  std::erase_if(file.vertex_properties, [](const Property& p) { return p.name == "alpha"; });
  set_colours(file, seen.paint.colours);
  file.comments.push_back("colours of " + one_line(name) + ": " + words_of(seen.scale));
  return file;
}

}  // namespace sphparam
