#include "vertex_colours.h"

#include <algorithm>
#include <cmath>

namespace sphparam::samples {

Colour mix(const Colour& a, const Colour& b, double t) { return a + t * (b - a); }

void add_vertex_colours(const std::vector<Colour>& colours, sphparam::MeshFile& file) {
  const char* names[] = {"red", "green", "blue"};
  for (int channel = 0; channel < 3; ++channel) {
    sphparam::Property property{names[channel], sphparam::ScalarType::Uint8, {}};
    property.values.reserve(colours.size());
    for (const Colour& colour : colours) {
      property.values.push_back(std::round(255 * std::clamp(colour[channel], 0.0, 1.0)));
    }
    file.vertex_properties.push_back(std::move(property));
  }
}

}  // namespace sphparam::samples
