#include "sphparam/remesh/resample.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

#include "io/attributes/weightiest_label.h"
#include "remesh/flat_places.h"
#include "remesh/float32_places.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

/// The corners of a place that have weight, in the order of their numbers.
class Corners {
 public:
  Corners(const Topology& topology, const SurfacePoint& place) {
    for (int k = 0; k < 3; ++k)
      if (place.barycentric[k] != 0)
        all_[size_++] = {topology.vertex(place.face, k), place.barycentric[k]};
    std::sort(begin(), end());
  }
  std::pair<Vertex, double>* begin() { return all_.data(); }
  std::pair<Vertex, double>* end() { return all_.data() + size_; }
  std::size_t size() const { return size_; }
  bool has(Vertex v) const {
    return std::any_of(all_.data(), all_.data() + size_,
                       [v](const std::pair<Vertex, double>& corner) { return corner.first == v; });
  }

 private:
  std::array<std::pair<Vertex, double>, 3> all_{};
  std::size_t size_ = 0;
};

void append(Gather& gather, Vertex vertex, double weight) {
  gather.vertices.push_back(vertex);
  gather.weights.push_back(weight);
}

/// What each new vertex is given by the current ones that lie in triangles about it, in their
/// order.
Gather scattered(const std::vector<SurfacePoint>& places, const Topology& topology) {
  Gather result;
  const auto count = static_cast<std::size_t>(topology.vertex_count());
  result.starts.assign(count + 1, 0);
  const auto for_each = [&](const auto& give) {
    for (std::size_t v = 0; v < places.size(); ++v)
      for (const auto& [to, weight] : Corners(topology, places[v]))
        give(static_cast<std::size_t>(to), static_cast<Vertex>(v), weight);
  };
  for_each([&](std::size_t to, Vertex, double) { ++result.starts[to + 1]; });
  for (std::size_t i = 0; i < count; ++i) result.starts[i + 1] += result.starts[i];
  result.vertices.resize(static_cast<std::size_t>(result.starts.back()));
  result.weights.resize(result.vertices.size());
  std::vector<std::int64_t> next(result.starts.begin(), result.starts.end() - 1);
  for_each([&](std::size_t to, Vertex from, double weight) {
    const auto at = static_cast<std::size_t>(next[to]++);
    result.vertices[at] = from;
    result.weights[at] = weight;
  });
  return result;
}

/// Of both, what each new vertex takes: what it is given, where that names a vertex that is no
/// corner of the triangle it lies in.
Gather adapted(const std::vector<SurfacePoint>& places, const Topology& current,
               const Gather& given) {
  Gather result;
  result.starts = {0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Corners corners(current, places[i]);
    const auto first = static_cast<std::size_t>(given.starts[i]);
    const auto last = static_cast<std::size_t>(given.starts[i + 1]);
    bool has_others = false;
    for (std::size_t e = first; e < last; ++e) has_others |= !corners.has(given.vertices[e]);
    if (has_others) {
      for (std::size_t e = first; e < last; ++e)
        append(result, given.vertices[e], given.weights[e]);
    } else {
      for (const auto& [vertex, weight] : corners) append(result, vertex, weight);
    }
    result.starts.push_back(std::ssize(result.vertices));
  }
  return result;
}

void normalise(Gather& gather) {
  for (std::int64_t i = 0; i < gather.count(); ++i) {
    const auto first = gather.weights.begin() + gather.starts[static_cast<std::size_t>(i)];
    const auto last = gather.weights.begin() + gather.starts[static_cast<std::size_t>(i) + 1];
    double sum = 0;
    for (auto weight = first; weight != last; ++weight) sum += *weight;
    if (sum > 0) {
      for (auto weight = first; weight != last; ++weight) *weight /= sum;
    } else {  // no area: all count alike
      std::fill(first, last, 1 / static_cast<double>(last - first));
    }
  }
}

void correct_areas(Gather& gather, const VectorX& current_areas, const VectorX& new_areas) {
  std::vector<double> sums(static_cast<std::size_t>(current_areas.size()), 0.0);
  for (std::int64_t i = 0; i < gather.count(); ++i) {
    for (auto e = gather.starts[static_cast<std::size_t>(i)];
         e < gather.starts[static_cast<std::size_t>(i) + 1]; ++e) {
      const auto at = static_cast<std::size_t>(e);
      gather.weights[at] *= new_areas[i];
      sums[static_cast<std::size_t>(gather.vertices[at])] += gather.weights[at];
    }
  }
  for (std::size_t e = 0; e < gather.weights.size(); ++e) {
    const double sum = sums[static_cast<std::size_t>(gather.vertices[e])];
    gather.weights[e] *= sum > 0 ? current_areas[gather.vertices[e]] / sum : 0;
  }
}

/// Calls visit(sample, vertices, weights) for each sample, in parallel.
template <class Visit>
void for_each_sample(const Gather& gather, int threads, const Visit& visit) {
  parallel_for(gather.count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto start = static_cast<std::size_t>(gather.starts[static_cast<std::size_t>(i)]);
      const auto size =
          static_cast<std::size_t>(gather.starts[static_cast<std::size_t>(i) + 1]) - start;
      visit(static_cast<std::size_t>(i), std::span(gather.vertices).subspan(start, size),
            std::span(gather.weights).subspan(start, size));
    }
  });
}

}  // namespace

Gather barycentric_weights(const MappedMesh& current, const Points& directions, int threads) {
  const std::vector<SurfacePoint> places =
      nearest_on_facets(current.topology(), current.map(), directions,
                        current.locator().locate_all(directions, threads), threads);
  Gather result;
  result.starts = {0};
  for (const SurfacePoint& place : places) {
    for (const auto& [vertex, weight] : Corners(current.topology(), place))
      append(result, vertex, weight);
    result.starts.push_back(std::ssize(result.vertices));
  }
  return result;
}

Gather adap_bary_area_weights(const MappedMesh& current, const Topology& topology,
                              const SphereMap& sphere, const VectorX& current_areas,
                              const VectorX& new_areas, int threads) {
  if (current_areas.size() != current.mesh().vertex_count() ||
      new_areas.size() != topology.vertex_count())
    throw std::invalid_argument("adap_bary_area_weights: areas are one a vertex of each sphere");
  const SphereMap units = unit_rays(sphere);
  const Float32Points on_current = at_radius_100(current.map().points);
  const Float32Points on_new = at_radius_100(sphere.points);
  const std::vector<SurfacePoint> in_current =
      nearest_in_float32(current.topology(), on_current, on_new,
                         current.locator().locate_all(units.points, threads), threads);
  const std::vector<SurfacePoint> in_new = nearest_in_float32(
      topology, on_new, on_current,
      SphereLocator(topology, units, threads).locate_all(current.map().points, threads), threads);
  Gather gather = adapted(in_current, current.topology(), scattered(in_new, topology));
  correct_areas(gather, current_areas, new_areas);
  normalise(gather);
  return gather;
}

std::vector<double> weighted_means(const Gather& gather, const std::vector<double>& values,
                                   int threads) {
  std::vector<double> result(static_cast<std::size_t>(gather.count()));
  for_each_sample(gather, threads, [&](std::size_t i, auto vertices, auto weights) {
    double sum = 0, least = values[static_cast<std::size_t>(vertices[0])], greatest = least;
    for (std::size_t e = 0; e < vertices.size(); ++e) {
      const double value = values[static_cast<std::size_t>(vertices[e])];
      sum += weights[e] * value;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    result[i] = sum < least ? least : greatest < sum ? greatest : sum;
  });
  return result;
}

std::vector<double> weightiest_labels(const Gather& gather, const std::vector<double>& labels,
                                      int threads) {
  std::vector<double> result(static_cast<std::size_t>(gather.count()));
  for_each_sample(gather, threads, [&](std::size_t i, auto vertices, auto weights) {
    thread_local std::vector<std::pair<double, double>> labelled;
    labelled.clear();
    for (std::size_t e = 0; e < vertices.size(); ++e)
      labelled.emplace_back(labels[static_cast<std::size_t>(vertices[e])], weights[e]);
    result[i] = weightiest_label(labelled);
  });
  return result;
}

VertexData resample_data(VertexData data, const Gather& gather, int threads) {
  const Vertex last = gather.vertices.empty()
                          ? -1
                          : *std::max_element(gather.vertices.begin(), gather.vertices.end());
  if (last >= data.vertex_count())
    throw std::invalid_argument("resample_data: " + data.name + " has values of " +
                                std::to_string(data.vertex_count()) +
                                " vertices, and the sphere has more");
  for (DataColumn& column : data.columns)
    column.values = data.kind == DataKind::Labels
                        ? weightiest_labels(gather, column.values, threads)
                        : weighted_means(gather, column.values, threads);
  data.triangles = 0;
  return data;
}

}  // namespace sphparam
