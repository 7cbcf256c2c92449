#include "embedding/energy/solid_angle_aim.h"

#include <algorithm>
#include <cmath>

#include "elementary.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
// Of a determinant to twice the solid angle, near half a sphere.
constexpr double least_ratio = 0.01;

struct ImageArea {
  double solid_angle;
  double ratio;  // of the determinant to twice the solid angle
};

ImageArea area_of(const Topology& topology, const std::vector<ImagePoint>& image, Face f) {
  const auto corner = [&](int k) {
    return image[static_cast<size_t>(topology.vertex(f, k))].vector();
  };
  const HalfSolidAngle half = half_solid_angle_of(corner(0), corner(1), corner(2));
  const double solid_angle = 2 * elementary::atan2(half.sine, half.cosine);
  const double ratio = half.sine / 2 / solid_angle;
  return {solid_angle, ratio > 0 ? std::clamp(ratio, least_ratio, 1.0) : 1};  // 0/0: tiny
}

/// The mean of an error of faces, weighted by source area.
template <class Error>
double mean(const RestTriangles& source, int threads, const Error& error_of) {
  double area = 0;
  for (const RestTriangle& triangle : source) area += triangle.area;
  const auto chunk = [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      sum += source[static_cast<size_t>(f)].area * error_of(f);
    }
    return sum;
  };
  return parallel_sum(std::ssize(source), threads, chunk) / area;
}

}  // namespace

double area_error(const Topology& topology, const RestTriangles& source,
                  const std::vector<ImagePoint>& image, int threads) {
  return mean(source, threads, [&](Face f) {
    const double source_area = source[static_cast<size_t>(f)].area;
    return std::abs(elementary::log2(area_of(topology, image, f).solid_angle / source_area));
  });
}

double determinant_error(const Topology& topology, const RestTriangles& source,
                         const std::vector<ImagePoint>& image, int threads) {
  return mean(source, threads,
              [&](Face f) { return -elementary::log2(area_of(topology, image, f).ratio); });
}

RestTriangles aimed_at_solid_angles(const Topology& topology, RestTriangles source,
                                    const std::vector<ImagePoint>& image, int threads) {
  parallel_for(topology.face_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      RestTriangle& triangle = source[static_cast<size_t>(f)];
      triangle = scaled(triangle, area_of(topology, image, f).ratio);
    }
  });
  return source;
}

}  // namespace sphparam
