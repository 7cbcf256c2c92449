#include "sphparam/embedding/distortion_energy.h"

#include <algorithm>
#include <numbers>

#include "sphere/face_rays.h"
#include "sphparam/parallel.h"

// Let a = x1 − x0, b = x2 − x0 be the image edges, l, h and t the source's base, height and foot.
// In the source's orthonormal axes the Jacobian has the columns j1 = a/l, j2 = (b − t a)/h, so
//   d = ½(|j1|² + |j2|²) = ½ Σ_ij L_ij x_i·x_j,   s = det(x0, x1, x2) / 2A.
// L = ggᵀ + kkᵀ with g = (−1, 1, 0)/l, k = (t − 1, −t, 1)/h is the cotangent matrix over A.
// Moving x_k by a tangent vector τ and normalising gives x_k + τ − ½|τ|² x_k + O(τ³): the second
// derivatives on the sphere are those of space less (∂E/∂x_k · x_k) on the diagonal.

namespace sphparam {
namespace {

constexpr double least_area_of_mean = 1e-9;
constexpr std::int64_t grain = 4096;

RestTriangle equilateral(double area) {
  const double base = std::sqrt(4 * area / std::numbers::sqrt3);
  return {area, 1 / base, base / (2 * area), 0.5};
}

}  // namespace

RestTriangles measure_source(const TriangleMesh& mesh, int threads) {
  const Eigen::Index faces = mesh.face_count();
  RestTriangles source(static_cast<size_t>(faces));
  // Coordinates of 1e±300 must neither overflow nor vanish when subtracted and squared.
  const Vector3 lower = mesh.positions.colwise().minCoeff() / 2;
  const Vector3 upper = mesh.positions.colwise().maxCoeff() / 2;
  const double half_extent = (upper - lower).maxCoeff();
  const double unit = half_extent > 0 ? half_extent : 1;
  const double total = parallel_sum(faces, threads, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Eigen::Index f = first; f < last; ++f) {
      const auto corner = [&](int k) -> Vector3 {
        return (mesh.position(mesh.triangles(f, k)) / 2 - lower) / unit;
      };
      const Vector3 a = corner(1) - corner(0), b = corner(2) - corner(0);
      const double area = a.cross(b).norm() / 2, base = a.norm();
      source[static_cast<size_t>(f)] = {area, 1 / base, base / (2 * area),
                                        a.dot(b) / a.squaredNorm()};
      sum += area;
    }
    return sum;
  });
  const double mean = 4 * std::numbers::pi / static_cast<double>(std::max<Eigen::Index>(faces, 1));
  const double factor = 4 * std::numbers::pi / total;
  const auto settled = [&](const RestTriangle& triangle) {
    if (!(total > 0)) return equilateral(mean);
    if (!(triangle.area * factor > least_area_of_mean * mean)) {
      return equilateral(least_area_of_mean * mean);
    }
    return scaled(triangle, factor);
  };
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<size_t>(first); f < static_cast<size_t>(last); ++f) {
      source[f] = settled(source[f]);
    }
  });
  return source;
}

RestTriangle rotated(const RestTriangle& triangle, int corner) {
  if (corner == 0) return triangle;
  // v0 = (0, 0), v1 = (l, 0), v2 = (t l, h)
  const double l = 1 / triangle.inverse_base, h = 1 / triangle.inverse_height, t = triangle.foot;
  const double x = corner == 1 ? (1 - t) * l : t * l;
  const double base2 = x * x + h * h, base = std::sqrt(base2);
  const double dot = corner == 1 ? (1 - t) * l * l : h * h - t * (1 - t) * l * l;
  return {triangle.area, 1 / base, base / (l * h), dot / base2};
}

RestTriangle scaled(const RestTriangle& triangle, double factor) {
  const double length = std::sqrt(factor);
  return {triangle.area * factor, triangle.inverse_base / length, triangle.inverse_height / length,
          triangle.foot};
}

TriangleDistortion distortion(const RestTriangle& source, const ImageTriangle& image) {
  const Vector3 a = image[1] - image[0], b = image[2] - image[0];
  const Vector3 j1 = a * source.inverse_base;
  const Vector3 j2 = (b - source.foot * a) * source.inverse_height;
  return {(j1.squaredNorm() + j2.squaredNorm()) / 2, image[0].dot(a.cross(b)) / (2 * source.area)};
}

TriangleEnergy triangle_energy(const DistortionEnergy& energy, const RestTriangle& source,
                               const ImageTriangle& x, const std::array<TangentFrame, 3>& frames) {
  const auto [d, s] = distortion(source, x);
  const EnergyDerivatives f = differentiate(energy, d, s);

  const Vector3 g = Vector3(-1, 1, 0) * source.inverse_base;
  const Vector3 k = Vector3(source.foot - 1, -source.foot, 1) * source.inverse_height;
  const Eigen::Matrix3d laplacian = g * g.transpose() + k * k.transpose();
  const Vector3 a = x[1] - x[0], b = x[2] - x[0];
  const Vector3 j1 = g[1] * a, j2 = k[1] * a + k[2] * b;

  // Rows: ∂d/∂τ and ∂s/∂τ; on the sphere's normal: ∂f/∂x_i · x_i.
  Eigen::Matrix<double, 3, 6> tangents;
  Eigen::Matrix<double, 6, 1> d_tau, s_tau;
  Vector3 normal_slope;
  for (int i = 0; i < 3; ++i) {
    const size_t n = static_cast<size_t>(i), n1 = (n + 1) % 3, n2 = (n + 2) % 3;
    tangents.col(2 * i) = frames[n].u;
    tangents.col(2 * i + 1) = frames[n].v;
    const Vector3 d_x = g[i] * j1 + k[i] * j2;                           // Σ_j L_ij x_j
    const Vector3 s_x = x[n1].cross(x[n2] - x[n1]) / (2 * source.area);  // x_j × x_k / 2A
    d_tau.segment<2>(2 * i) = tangents.middleCols<2>(2 * i).transpose() * d_x;
    s_tau.segment<2>(2 * i) = tangents.middleCols<2>(2 * i).transpose() * s_x;
    normal_slope[i] = f.f_d * d_x.dot(x[n]) + f.f_s * s;
  }

  TriangleEnergy result;
  result.value = source.area * f.f;
  result.gradient = source.area * (f.f_d * d_tau + f.f_s * s_tau);
  // ∇²f = f_ds(∇d∇sᵀ + ∇s∇dᵀ) + f_ss ∇s∇sᵀ + f_d ∇²d + f_s ∇²s
  auto& h = result.hessian;
  h = f.f_ds * (d_tau * s_tau.transpose() + s_tau * d_tau.transpose()) +
      f.f_ss * (s_tau * s_tau.transpose());
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    h.block<2, 2>(2 * i, 2 * i).diagonal().array() += f.f_d * laplacian(i, i) - normal_slope[i];
    // ∂²s/∂x_i∂x_j of det(x_i, x_j, x_k)/2A, on tangents: (τ_i × τ_j) · x_k / 2A
    const Vector3& x_k = x[static_cast<size_t>((i + 2) % 3)];
    Eigen::Matrix2d block;
    for (int p = 0; p < 2; ++p) {
      for (int q = 0; q < 2; ++q) {
        const Vector3 ti = tangents.col(2 * i + p), tj = tangents.col(2 * j + q);
        block(p, q) = f.f_d * laplacian(i, j) * ti.dot(tj) +
                      f.f_s * ti.cross(tj).dot(x_k) / (2 * source.area);
      }
    }
    h.block<2, 2>(2 * i, 2 * j) += block;
    h.block<2, 2>(2 * j, 2 * i) += block.transpose();
  }
  h *= source.area;
  return result;
}

double distortion_energy(const Topology& topology, const RestTriangles& source,
                         const SphereMap& map, const DistortionEnergy& energy, int threads) {
  return parallel_sum(topology.face_count(), threads, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const RestTriangle& triangle = source[static_cast<size_t>(f)];
      const auto [d, s] = distortion(triangle, face_rays(topology, map, f));
      sum += triangle.area * energy_density(energy, d, s);
    }
    return sum;
  });
}

}  // namespace sphparam
