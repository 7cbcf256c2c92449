#include "gltf/stored_chart.h"

#include "gltf/packing.h"

namespace sphparam {
namespace {

constexpr double steps = 65535;

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

}  // namespace sphparam
