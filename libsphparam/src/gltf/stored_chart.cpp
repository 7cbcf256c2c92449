#include "gltf/stored_chart.h"

#include "gltf/format/packing.h"
#include "sphere/planar_orientation.h"

namespace sphparam {
namespace {

constexpr double steps = 65535;

ChartPoint quantised(const ChartPoint& point) {
  return {static_cast<double>(to_unsigned16(point.u)), static_cast<double>(to_unsigned16(point.v))};
}

/// As USD has it, and back: what floats lose by it is lost.
ChartPoint flipped_twice(const ChartPoint& point) {
  return {point.u, 1 - static_cast<double>(1 - static_cast<float>(point.v))};
}

/// An asset has no chart any more, but what rounding turns over has another exact sign than
/// before; in mirrored conventions all have the other one.
long folds_by(ChartPoint (*rounded)(const ChartPoint&), const Surface& surface) {
  if (surface.texcoords.empty()) return 0;
  const FloatRows& uv = surface.texcoords.front();
  long folds = 0;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const auto point = [&](std::size_t k) {
      const auto row = static_cast<Eigen::Index>(surface.indices[i + k]);
      return ChartPoint{static_cast<double>(uv(row, 0)), static_cast<double>(uv(row, 1))};
    };
    const ChartPoint a = point(0), b = point(1), c = point(2);
    const int sign = planar_orientation(a, b, c);
    folds += sign != 0 && planar_orientation(rounded(a), rounded(b), rounded(c)) != sign;
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
  if (storage.upwards) read.col(1) = 1 - (1 - uv.col(1).array()).cast<double>();
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
  for (const Surface& level : asset.levels)
    if (!level.texcoords.empty() && fits_integers(level.texcoords.front()))
      folds += folds_by(quantised, level);
  return folds;
}

long folds_by_flipping(const Asset& asset) { return folds_by(flipped_twice, asset.levels.front()); }

}  // namespace sphparam
