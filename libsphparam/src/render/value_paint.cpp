#include "render/value_paint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/formats/gifti/gifti_labels.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {
namespace {

const Rgb unknown(0.62F, 0.62F, 0.64F);

/// What a property's numbers name, where they are labels.
struct Naming {
  bool names = false;              // else they are measured
  std::vector<Label> labels = {};  // the table that they are keys of; it may be empty
};

Naming naming_of_whole_numbers(const MeshFile& file, const Property& property) {
  Naming naming;
  if (is_floating(property.type)) return naming;
  naming.names = true;
  for (const std::string& comment : file.comments)
    if (std::optional<Label> label = label_in(comment)) naming.labels.push_back(*std::move(label));
  return naming;
}

Naming naming_at_vertices(const MeshFile& file, const Property& property) {
  for (const VertexData& data : attached_data(file))
    for (const std::string& name : data.properties)
      if (name == property.name)
        return data.kind == DataKind::Labels ? Naming{true, data.labels} : Naming{};
  return naming_of_whole_numbers(file, property);
}

std::map<double, Rgb> colours_of_table(const std::vector<Label>& labels) {
  std::map<double, Rgb> colours;
  for (const Label& label : labels)
    if (label.colour && (*label.colour)[3] > 0)
      colours[label.key] = Rgb((*label.colour)[0], (*label.colour)[1], (*label.colour)[2])
                               .cwiseMax(0.0F)
                               .cwiseMin(1.0F);
  return colours;
}

double percentile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Of labels all have a colour; of what is measured a few that stand out need none of their own.
HeatScale scale_of(const Property& property, bool names) {
  const double tail = names ? 0 : 0.02;
  std::vector<double> finite;
  for (const double value : property.values)
    if (std::isfinite(value)) finite.push_back(value);
  if (finite.empty()) return {property.name, 0, 1};
  const double low = percentile(finite, tail), high = percentile(finite, 1 - tail);
  if (names || !(low < 0 && 0 < high)) return {property.name, low, high};
  const double reach = std::max(-low, high);
  return {property.name, -reach, reach};
}

void note_values_beyond(const Property& property, HeatScale& scale) {
  for (const double value : property.values) {
    scale.below |= value < scale.low;
    scale.above |= value > scale.high;
  }
}

ValueColours colours_of(const Property& shown, const Naming& naming,
                        const std::optional<std::pair<double, double>>& range) {
  if (!naming.labels.empty()) return {naming.names, colours_of_table(naming.labels)};
  HeatScale scale =
      range ? HeatScale{shown.name, range->first, range->second} : scale_of(shown, naming.names);
  scale.given = range.has_value();
  note_values_beyond(shown, scale);
  return {naming.names, {}, std::move(scale)};
}

std::vector<Rgb> all_of(const ValueColours& colours, const Property& shown) {
  std::vector<Rgb> all;
  for (const double value : shown.values) all.push_back(colours.of(value));
  return all;
}

}  // namespace

Rgb ValueColours::of(double value) const {
  if (scale) return std::isfinite(value) ? heat_colour(*scale, value) : unknown;
  const auto found = table.find(value);
  return found == table.end() ? unknown : found->second;
}

ValueColours vertex_value_colours(const MeshFile& file, const std::string& property,
                                  const std::optional<std::pair<double, double>>& range) {
  const Property& shown = *file.find_vertex_property(property);
  return colours_of(shown, naming_at_vertices(file, shown), range);
}

ValueColours face_value_colours(const MeshFile& file, const std::string& property,
                                const std::optional<std::pair<double, double>>& range) {
  const Property& shown = *file.find_face_property(property);
  return colours_of(shown, naming_of_whole_numbers(file, shown), range);
}

ValuePaint value_paint(const MeshFile& file, const std::string& property,
                       const std::optional<std::pair<double, double>>& range) {
  ValueColours colours = vertex_value_colours(file, property, range);
  const Property& shown = *file.find_vertex_property(property);
  return {{.colours = all_of(colours, shown), .blends = !colours.names}, std::move(colours.scale)};
}

FaceValuePaint face_value_paint(const MeshFile& file, const std::string& property,
                                const std::optional<std::pair<double, double>>& range) {
  ValueColours colours = face_value_colours(file, property, range);
  return {{all_of(colours, *file.find_face_property(property))}, std::move(colours.scale)};
}

}  // namespace sphparam
