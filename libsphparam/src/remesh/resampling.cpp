// A mean is Σ weight·value, then brought between the least and the greatest of its values, out of
// which rounding may have carried it: what is constant stays so.

#include "remesh/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "io/attributes/mixed_colour.h"
#include "io/attributes/weightiest_label.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

/// What one sample is a mean of.
struct Sources {
  std::span<const Vertex> vertices;
  std::span<const double> weights;
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
        visit(i, Sources{{&cells.vertices[start], size}, {&cells.weights[start], size}});
        continue;
      }
      const SurfacePoint& point = resampling.points[at];
      const Vertex* const corners = resampling.triangles.data() + 3 * std::int64_t{point.face};
      visit(i, Sources{{corners, 3}, {point.barycentric.data(), 3}});
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

/// Values and their weights; good until the next call of this thread.
std::span<std::pair<double, double>> weighed(const Property& property, const Sources& sources) {
  thread_local std::vector<std::pair<double, double>> values;
  values.clear();
  for (size_t e = 0; e < sources.vertices.size(); ++e)
    values.emplace_back(property.values[static_cast<size_t>(sources.vertices[e])],
                        sources.weights[e]);
  return values;
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
  std::vector<double> result(resampling.points.size());
  for_each_sample(resampling, [&](std::int64_t i, const Sources& sources) {
    result[static_cast<size_t>(i)] =
        mixed_colour(channel.name, channel.type, weighed(channel, sources));
  });
  return result;
}

std::vector<double> resample_labels(const Resampling& resampling, const Property& property) {
  std::vector<double> result(resampling.points.size());
  for_each_sample(resampling, [&](std::int64_t i, const Sources& sources) {
    result[static_cast<size_t>(i)] = weightiest_label(weighed(property, sources));
  });
  return result;
}

}  // namespace sphparam
