#include "io/attributes/hard_edges.h"

#include <bit>
#include <cmath>

#include "io/attributes/shading_normals.h"
#include "io/polygons/distinct_rows.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/chart/tangent_frame.h"

// A wedge is a distinct (wedge, normal). The first normal of a wedge keeps its number, so that
// wedge i still belongs to refined vertex i.

namespace sphparam {
namespace {

/// Divided by its length, or zero.
Vector3 unit_or_zero(const Vector3& v) {
  const double length = v.stableNorm();
  return length > 0 && std::isfinite(length) ? Vector3(v / length) : Vector3(Vector3::Zero());
}

class HardEdges {
 public:
  HardEdges(SphericalChart& chart, const Points& vertex_normals)
      : chart_(chart),
        distinct_(static_cast<size_t>(chart.wedge_count())),
        is_used_(static_cast<size_t>(chart.wedge_count()), false) {
    normals_.reserve(is_used_.size());
    for (const Vertex v : chart.wedge_vertices) normals_.push_back(vertex_normals.row(v));
  }

  void add(Eigen::Index corner, const Vector3& normal) {
    int& wedge = chart_.wedges.data()[corner];
    const auto numbers = normal.cast<float>();
    // The bits of the wedge's number, as a key.
    const auto id = static_cast<size_t>(
        distinct_.insert({std::bit_cast<float>(wedge), numbers[0], numbers[1], numbers[2]}));
    if (id == wedges_.size()) wedges_.push_back(wedge_for(wedge, normal));
    wedge = wedges_[id];
  }

  Points finish() {
    const auto added = static_cast<Eigen::Index>(copied_.size()), before = chart_.uv.rows();
    chart_.uv.conservativeResize(before + added, 2);
    for (const int wedge : copied_) {
      const auto from = static_cast<size_t>(wedge);
      chart_.uv.row(static_cast<Eigen::Index>(chart_.wedge_kinds.size())) = chart_.uv.row(wedge);
      chart_.wedge_kinds.push_back(chart_.wedge_kinds[from]);
      chart_.wedge_vertices.push_back(chart_.wedge_vertices[from]);
    }
    Points normals(static_cast<Eigen::Index>(normals_.size()), 3);
    for (size_t w = 0; w < normals_.size(); ++w)
      normals.row(static_cast<Eigen::Index>(w)) = normals_[w];
    return normals;
  }

 private:
  int wedge_for(int wedge, const Vector3& normal) {
    const auto at = static_cast<size_t>(wedge);
    if (!is_used_[at]) {
      is_used_[at] = true;
      normals_[at] = normal;
      return wedge;
    }
    copied_.push_back(wedge);
    normals_.push_back(normal);
    return static_cast<int>(normals_.size()) - 1;
  }

  SphericalChart& chart_;
  DistinctRows<float, 4> distinct_;
  std::vector<int> wedges_;    // of each distinct row
  std::vector<bool> is_used_;  // of each wedge of the chart as it came
  std::vector<int> copied_;    // of each new wedge, the one it is a copy of
  std::vector<Eigen::RowVector3d> normals_;
};

}  // namespace

std::optional<Points> split_at_hard_edges(SphericalChart& chart, const MeshFile& file,
                                          int threads) {
  if (!file.corner_normals) return std::nullopt;
  const Triangles& source = file.mesh.triangles;
  const Points of_vertices = shading_normals(file);
  const Points refined = carry_normals(chart, source, of_vertices, threads);
  const Attributes corners =
      carry_corner_attribute(chart, source, *corner_shading_normals(file, of_vertices), threads);
  HardEdges edges(chart, refined);
  for (Eigen::Index corner = 0; corner < corners.rows(); ++corner) {
    const Vector3 unit = unit_or_zero(corners.row(corner));
    const Vertex v = chart.triangles.data()[corner];
    edges.add(corner, unit.isZero(0) ? Vector3(refined.row(v)) : unit);
  }
  return edges.finish();
}

}  // namespace sphparam
