#include "curvilinear/quasi_harmonic.h"

#include <algorithm>
#include <cmath>

#include "elementary.h"
#include "mesh/triangle_geometry.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double least_source = 1e-9;  // of the mean source area
constexpr double least_image = 1e-18;  // of the mean area on the sphere

/// Fills values[f] = of_face(f) and returns their sum.
template <class OfFace>
double fill_and_sum(std::vector<double>& values, int threads, OfFace&& of_face) {
  return parallel_sum(static_cast<std::int64_t>(values.size()), threads,
                      [&](std::int64_t first, std::int64_t last) {
                        double sum = 0;
                        for (Face f = static_cast<Face>(first); f < last; ++f) {
                          sum += values[static_cast<size_t>(f)] = of_face(f);
                        }
                        return sum;
                      });
}

}  // namespace

std::vector<double> area_distortion(const TriangleMesh& mesh, const SphereMap& map, int threads) {
  const double faces = static_cast<double>(mesh.face_count());
  std::vector<double> source(static_cast<size_t>(mesh.face_count())), kappa(source.size());
  const double source_sum =
      fill_and_sum(source, threads, [&](Face f) { return face_area(mesh, f); });
  const double sphere_sum = fill_and_sum(kappa, threads, [&](Face f) {
    const auto t = mesh.triangles.row(f);
    return std::abs(solid_angle(map.point(t[0]), map.point(t[1]), map.point(t[2])));
  });
  // κ_T = (Σ A / Σ A') A'_T / A_T
  const double source_floor = least_source * source_sum / faces;
  const double sphere_floor = least_image * sphere_sum / faces;
  const double scale = source_sum / sphere_sum;
  fill_and_sum(kappa, threads, [&](Face f) {
    const size_t i = static_cast<size_t>(f);
    return scale * std::max(kappa[i], sphere_floor) / std::max(source[i], source_floor);
  });
  return kappa;
}

void accumulate_kappa(std::vector<double>& accumulated, const std::vector<double>& kappa,
                      double power, int threads) {
  if (accumulated.empty()) accumulated.assign(kappa.size(), 1);
  const std::int64_t faces = static_cast<std::int64_t>(kappa.size());
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (size_t f = static_cast<size_t>(first); f < static_cast<size_t>(last); ++f) {
      accumulated[f] *= elementary::pow(kappa[f], power);
    }
  });
}

double mean_abs_ln(const std::vector<double>& kappa, int threads) {
  const double sum = parallel_sum(
      static_cast<std::int64_t>(kappa.size()), threads, [&](std::int64_t first, std::int64_t last) {
        double part = 0;
        for (std::int64_t f = first; f < last; ++f) {
          part += std::abs(elementary::log(kappa[static_cast<size_t>(f)]));
        }
        return part;
      });
  return sum / static_cast<double>(kappa.size());
}

}  // namespace sphparam
