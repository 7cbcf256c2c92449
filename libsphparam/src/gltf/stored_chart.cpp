#include "gltf/stored_chart.h"

#include "gltf/format/packing.h"
#include "sphere/planar_orientation.h"

namespace sphparam {
namespace {

constexpr double steps = 65535;

ChartPoint quantised(const ChartPoint& point) {
  return {static_cast<double>(to_unsigned16(point.u)), static_cast<double>(to_unsigned16(point.v))};
}

/// An asset has no chart any more, but what quantising turns over has another exact sign than
/// before; in mirrored conventions all have the other one.
long folds_by_quantising(const Surface& surface) {
  if (surface.texcoords.empty() || surface.texcoords.front().rows() == 0) return 0;
  const FloatRows& uv = surface.texcoords.front();
  if (!fits_integers(uv)) return 0;
  long folds = 0;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const auto point = [&](std::size_t k) {
      const auto row = static_cast<Eigen::Index>(surface.indices[i + k]);
      return ChartPoint{static_cast<double>(uv(row, 0)), static_cast<double>(uv(row, 1))};
    };
    const ChartPoint a = point(0), b = point(1), c = point(2);
    const int sign = planar_orientation(a, b, c);
    folds += sign != 0 && planar_orientation(quantised(a), quantised(b), quantised(c)) != sign;
  }
  return folds;
}

}  // namespace

FloatRows stored_uv(const SphericalChart& chart, const UvStorage& storage) {
  FloatRows uv = chart.uv.cast<float>();
  if (storage.mirrored) uv.col(0) = (1 - chart.uv.col(0).array()).cast<float>();
  return uv;
}

TextureCoordinates read_uv(const FloatRows& uv, const UvStorage& storage) {
  TextureCoordinates read = uv.cast<double>();
  if (storage.sixteen_bits) {
    read = read.unaryExpr([](double x) { return to_unsigned16(x) / steps; });
  }
  if (storage.mirrored) read.col(0) = 1 - read.col(0).array();
  return read;
}

ChartCertificate certify_stored(const SphericalChart& chart, const FloatRows& uv,
                                const UvStorage& storage, int threads) {
  SphericalChart stored = chart;
  stored.uv = read_uv(uv, storage);
  ChartCertificate certificate = certify_chart(stored, threads);
  certificate.around_pole = chart.certificate.around_pole;  // what only the rays can tell
  return certificate;
}

long folds_by_quantising(const Asset& asset) {
  long folds = 0;
  for (const Surface& level : asset.levels) folds += folds_by_quantising(level);
  return folds;
}

}  // namespace sphparam
