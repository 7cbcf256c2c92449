#include "sphparam/chart/carry_attributes.h"

#include <stdexcept>
#include <string>

#include "sphparam/parallel.h"

// Positions interpolate linearly on the source's triangles, and so does everything else; the chart
// knows where each refined vertex lies. Most vertices are the source's own: their weights are
// (1, 0, 0), and zero weights are left out, so that their values are copied, infinities and all.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;

void require_rows(const AttributesView& values, Eigen::Index rows, const char* what) {
  if (values.rows() == rows) return;
  throw std::invalid_argument("an attribute has " + std::to_string(values.rows()) + " rows for " +
                              std::to_string(rows) + " " + what + " of the source");
}

/// row(i) = Σ weightsᵢ · values(rows[i]).
template <class Row>
void combine(Row&& result, const Vector3& weights, const int (&rows)[3],
             const AttributesView& values) {
  for (int i = 0; i < 3; ++i) {
    if (weights[i] == 1) {
      result = values.row(rows[i]);
      return;
    }
  }
  result.setZero();
  for (int i = 0; i < 3; ++i) {
    if (weights[i] != 0) result += weights[i] * values.row(rows[i]);
  }
}

}  // namespace

Attributes carry_vertex_attribute(const SphericalChart& chart, const Triangles& source,
                                  AttributesView values, int threads) {
  require_rows(values, source.size() == 0 ? 0 : source.maxCoeff() + 1, "vertices");
  const auto count = static_cast<std::int64_t>(chart.surface_points.size());
  Attributes result(count, values.cols());
  parallel_for(count, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      const SurfacePoint& point = chart.surface_points[static_cast<size_t>(v)];
      const int corners[] = {source(point.face, 0), source(point.face, 1), source(point.face, 2)};
      combine(result.row(v), point.barycentric, corners, values);
    }
  });
  return result;
}

Attributes carry_corner_attribute(const SphericalChart& chart, const Triangles& source,
                                  AttributesView values, int threads) {
  require_rows(values, source.size(), "corners");
  Attributes result(chart.triangles.size(), values.cols());
  parallel_for(
      chart.triangles.rows(), chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
        for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
          const Face from = chart.source_faces[static_cast<size_t>(f)];
          const int corners[] = {3 * from, 3 * from + 1, 3 * from + 2};
          for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<size_t>(chart.triangles(f, k));
            combine(result.row(3 * f + k), barycentric_in(from, chart.surface_points[v], source),
                    corners, values);
          }
        }
      });
  return result;
}

Attributes carry_face_attribute(const SphericalChart& chart, const Triangles& source,
                                AttributesView values) {
  require_rows(values, source.rows(), "faces");
  Attributes result(chart.triangles.rows(), values.cols());
  for (Face f = 0; f < static_cast<Face>(result.rows()); ++f)
    result.row(f) = values.row(chart.source_faces[static_cast<size_t>(f)]);
  return result;
}

}  // namespace sphparam
