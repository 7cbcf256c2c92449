#include "sphparam/render/coloured_values.h"

#include <cmath>

#include "io/attributes/texture_pages.h"
#include "number_text.h"
#include "render/colour.h"

namespace sphparam {

namespace {

/// Blue at −reach, white at 0, red at reach.
std::vector<Rgb> signed_colours(const VectorX& values, double reach) {
  std::vector<Rgb> colours;
  for (const double value : values) colours.push_back(diverging(value / reach));
  return colours;
}

}  // namespace

MeshFile with_coloured_values(MeshFile file, const std::string& name, const VectorX& values,
                              const std::string& about) {
  const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
  const bool is_signed = values.size() > 0 && values.minCoeff() < 0;
  const std::vector<Rgb> colours = is_signed ? signed_colours(values, largest)
                                             : value_colours(values, 0, largest > 0 ? largest : 1);
  remove_textures(file);
  int channel = 0;
  for (const char* colour_name : {"red", "green", "blue"}) {
    Property property = {colour_name, ScalarType::Uint8, {}};
    for (const Rgb& colour : colours) {
      property.values.push_back(std::round(255 * static_cast<double>(colour[channel])));
    }
    file.set_vertex_property(std::move(property));
    ++channel;
  }
  file.set_vertex_property(
      {name, ScalarType::Float64, std::vector<double>(values.begin(), values.end())});
  if (!about.empty()) {
    file.comments.push_back(name + ": " + one_line(about) + ", colours from " +
                            short_number(is_signed ? -largest : 0, 6) + " to " +
                            short_number(largest, 6));
  }
  return file;
}

}  // namespace sphparam
