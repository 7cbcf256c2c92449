#include "gltf/shape.h"

#include "sphparam/chart/carry_attributes.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 16384;

/// How far along a direction; a coordinate of its own as it is, to the sign of a zero.
double along(const Vector3& direction, const Vector3& p) {
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 1) return p[k];
    if (direction[k] == -1) return -p[k];
  }
  return direction.dot(p);
}

/// With z up (x, y, z) → (x, z, −y); a fourth column stays.
template <class Rows>
void turn_up(Rows& rows, const Eigen::Matrix3d& rotation, int threads) {
  parallel_for(rows.rows(), chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const Vector3 p = rows.row(i).template head<3>();
      for (int k = 0; k < 3; ++k) rows(i, k) = along(rotation.row(k), p);
    }
  });
}

/// Rows of refined vertices for the wedges.
Points spread(const SphericalChart& chart, const Points& of_vertices, int threads) {
  Points rows(chart.wedge_count(), 3);
  parallel_for(rows.rows(), chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t w = first; w < last; ++w)
      rows.row(w) = of_vertices.row(chart.wedge_vertices[static_cast<size_t>(w)]);
  });
  return rows;
}

Shape shape_of(const SphericalChart& chart, const Points& positions, const Points& normals,
               const UprightAxes& up, int threads) {
  Shape shape{spread(chart, positions, threads), tangent_frame(chart, positions, normals, threads)};
  const Eigen::Matrix3d rotation = upright_rotation(up);
  if (rotation.isIdentity(0)) return shape;
  turn_up(shape.positions, rotation, threads);
  turn_up(shape.frame.normals, rotation, threads);
  turn_up(shape.frame.tangents, rotation, threads);
  return shape;
}

}  // namespace

Shape mesh_shape(const SphericalChart& chart, const TriangleMesh& mesh, const Points& mesh_normals,
                 const UprightAxes& up, int threads) {
  return lit_shape(chart, mesh, carry_normals(chart, mesh.triangles, mesh_normals, threads), up,
                   threads);
}

Shape lit_shape(const SphericalChart& chart, const TriangleMesh& mesh, const Points& normals,
                const UprightAxes& up, int threads) {
  return shape_of(chart, carry_vertex_attribute(chart, mesh.triangles, mesh.positions, threads),
                  normals, up, threads);
}

Shape sphere_shape(const SphericalChart& chart, const Vector3& front, int threads) {
  return shape_of(chart, chart.points, chart.points, {Vector3::UnitZ(), front}, threads);
}

Shape flat_shape(const SphericalChart& chart) {
  const Eigen::Index wedges = chart.wedge_count();
  Shape shape{Points::Zero(wedges, 3), {Points::Zero(wedges, 3), Tangents::Zero(wedges, 4)}};
  shape.positions.col(0) = 2 * chart.uv.col(0).array() - 1;
  shape.positions.col(1) = 0.5 - chart.uv.col(1).array();
  shape.frame.normals.col(2).setOnes();
  shape.frame.tangents.col(0).setOnes();
  shape.frame.tangents.col(3).setOnes();
  return shape;
}

Shape placed(Shape shape, double scale, const Vector3& middle) {
  shape.positions *= scale;
  shape.positions.rowwise() += middle.transpose();
  return shape;
}

Vector3 middle_of(const Shape& shape) {
  // Halved first: the sum of two large numbers may be none.
  return 0.5 * shape.positions.colwise().minCoeff().transpose() +
         0.5 * shape.positions.colwise().maxCoeff().transpose();
}

double area_of(const Shape& shape, const SphericalChart& chart, int threads) {
  return parallel_sum(chart.wedges.rows(), threads, [&](std::int64_t first, std::int64_t last) {
    double area = 0;
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const Vector3 a = shape.positions.row(chart.wedges(f, 0));
      const Vector3 b = shape.positions.row(chart.wedges(f, 1)) - a.transpose(),
                    c = shape.positions.row(chart.wedges(f, 2)) - a.transpose();
      area += 0.5 * b.cross(c).norm();
    }
    return area;
  });
}

}  // namespace sphparam
