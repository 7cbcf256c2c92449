// A mean is Σ weight·value, then brought between the least and the greatest of its values, out of
// which rounding may have carried it: what is constant stays so.

#include "remesh/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "io/attributes/appearance.h"
#include "io/attributes/weightiest_label.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

/// What one sample is a mean of.
struct Sources {
  std::span<const Vertex> vertices;
  std::span<const double> weights;
  bool of_cell;
};

/// Calls visit(sample, sources) for every sample, in parallel.
template <class Visit>
void for_each_sample(const Resampling& resampling, const Visit& visit) {
  const auto count = static_cast<std::int64_t>(resampling.points.size());
  const Gather& cells = resampling.cells;
  parallel_for(count, grain, resampling.threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto at = static_cast<size_t>(i);
      const auto start = cells.starts.empty() ? 0 : static_cast<size_t>(cells.starts[at]);
      const auto size =
          cells.starts.empty() ? 0 : static_cast<size_t>(cells.starts[at + 1]) - start;
      if (size > 0) {
        visit(i, Sources{{&cells.vertices[start], size}, {&cells.weights[start], size}, true});
        continue;
      }
      const SurfacePoint& point = resampling.points[at];
      const Vertex* const corners = resampling.triangles.data() + 3 * std::int64_t{point.face};
      visit(i, Sources{{corners, 3}, {point.barycentric.data(), 3}, false});
    }
  });
}

/// The mean of value(vertex). What has no weight is not looked at: it may be NaN.
template <class Value>
double mean(const Sources& sources, const Value& value) {
  double sum = 0, least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (size_t e = 0; e < sources.vertices.size(); ++e) {
    if (sources.weights[e] == 0) continue;
    const double x = value(sources.vertices[e]);
    sum += sources.weights[e] * x;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  return sum < least ? least : greatest < sum ? greatest : sum;
}

double in_type(ScalarType type, double value) {
  if (type == ScalarType::Float64) return value;
  if (type == ScalarType::Float32) return static_cast<double>(static_cast<float>(value));
  return std::round(value);
}

}  // namespace

std::vector<double> resample(const Resampling& resampling, const double* values, int width) {
  std::vector<double> result(resampling.points.size() * static_cast<size_t>(width));
  for_each_sample(resampling, [&](std::int64_t i, const Sources& sources) {
    for (int k = 0; k < width; ++k) {
      result[static_cast<size_t>(i * width + k)] =
          mean(sources, [&](Vertex v) { return values[std::int64_t{v} * width + k]; });
    }
  });
  return result;
}

std::vector<double> resample_property(const Resampling& resampling, const Property& property) {
  std::vector<double> result = resample(resampling, property.values.data(), 1);
  for (double& value : result) value = in_type(property.type, value);
  return result;
}

std::vector<double> resample_colour(const Resampling& resampling, const Property& channel) {
  const SrgbCurves& curves = SrgbCurves::get();
  const double unit = brightest(channel.type);
  const auto stored = [&](Vertex v) { return channel.values[static_cast<size_t>(v)]; };
  const auto light = [&](Vertex v) {
    return static_cast<double>(curves.to_linear(static_cast<float>(stored(v) / unit)));
  };
  const bool is_light = channel.name != "alpha";
  std::vector<double> result(resampling.points.size());
  for_each_sample(resampling, [&](std::int64_t i, const Sources& sources) {
    double value = mean(sources, stored);
    if (sources.of_cell && is_light) {
      const auto [least, greatest] =
          std::minmax_element(sources.vertices.begin(), sources.vertices.end(),
                              [&](Vertex a, Vertex b) { return stored(a) < stored(b); });
      const bool has_curve = stored(*least) >= 0 && stored(*greatest) <= unit;
      const double shown = curves.to_srgb(static_cast<float>(mean(sources, light))) * unit;
      if (has_curve) value = std::clamp(shown, stored(*least), stored(*greatest));
    }
    result[static_cast<size_t>(i)] = in_type(channel.type, value);
  });
  return result;
}

std::vector<double> resample_labels(const Resampling& resampling, const Property& property) {
  std::vector<double> result(resampling.points.size());
  for_each_sample(resampling, [&](std::int64_t i, const Sources& sources) {
    thread_local std::vector<std::pair<double, double>> labelled;
    labelled.clear();
    for (size_t e = 0; e < sources.vertices.size(); ++e) {
      labelled.emplace_back(property.values[static_cast<size_t>(sources.vertices[e])],
                            sources.weights[e]);
    }
    result[static_cast<size_t>(i)] = weightiest_label(labelled);
  });
  return result;
}

}  // namespace sphparam
