#include "render/value_paint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/formats/gifti/gifti_labels.h"
#include "lower_case.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {
namespace {

const Rgb unknown(0.62F, 0.62F, 0.64F);

/// The table that the property's numbers are keys of; none where they are measured.
std::vector<Label> labels_of(const MeshFile& file, const Property& property) {
  for (const VertexData& data : attached_data(file))
    for (const std::string& name : data.properties)
      if (name == property.name)
        return data.kind == DataKind::Labels ? data.labels : std::vector<Label>{};
  std::vector<Label> labels;
  if (is_floating(property.type)) return labels;
  for (const std::string& comment : file.comments)
    if (std::optional<Label> label = label_in(comment)) labels.push_back(*std::move(label));
  return labels;
}

VertexPaint label_paint(const Property& property, const std::vector<Label>& labels) {
  std::map<double, Rgb> colours;
  for (const Label& label : labels)
    if (label.colour && (*label.colour)[3] > 0)
      colours[label.key] = Rgb((*label.colour)[0], (*label.colour)[1], (*label.colour)[2])
                               .cwiseMax(0.0F)
                               .cwiseMin(1.0F);
  VertexPaint paint{.colours = {}, .blends = false};
  for (const double value : property.values) {
    const auto found = colours.find(value);
    paint.colours.push_back(found == colours.end() ? unknown : found->second);
  }
  return paint;
}

double percentile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

HeatScale scale_of(const Property& property) {
  constexpr double tail = 0.02;
  std::vector<double> finite;
  for (const double value : property.values)
    if (std::isfinite(value)) finite.push_back(value);
  if (finite.empty()) return {property.name, 0, 1};
  const double low = percentile(finite, tail), high = percentile(finite, 1 - tail);
  if (!(low < 0 && 0 < high)) return {property.name, low, high};
  const double reach = std::max(-low, high);
  return {property.name, -reach, reach};
}

void note_values_beyond(const Property& property, HeatScale& scale) {
  for (const double value : property.values) {
    scale.below |= value < scale.low;
    scale.above |= value > scale.high;
  }
}

}  // namespace

ValuePaint value_paint(const MeshFile& file, const std::string& property,
                       const std::optional<std::pair<double, double>>& range) {
  const Property& shown = *file.find_vertex_property(property);
  if (const std::vector<Label> labels = labels_of(file, shown); !labels.empty())
    return {label_paint(shown, labels), std::nullopt};
  HeatScale scale = range ? HeatScale{shown.name, range->first, range->second} : scale_of(shown);
  scale.given = range.has_value();
  note_values_beyond(shown, scale);
  VertexPaint paint;
  for (const double value : shown.values)
    paint.colours.push_back(std::isfinite(value) ? heat_colour(scale, value) : unknown);
  scale.title = in_lower_case(scale.title);
  return {std::move(paint), std::move(scale)};
}

}  // namespace sphparam
