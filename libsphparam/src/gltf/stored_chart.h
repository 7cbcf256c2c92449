#pragma once

#include "sphparam/chart/spherical_chart.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

/// How texture coordinates come to stand in a file.
struct UvStorage {
  bool mirrored = false;      // 1 − u: for conventions seen from inside
  bool sixteen_bits = false;  // as multiples of 1/65,535; else float32
  bool upwards = false;       // as 1 − v, which is rounded once more
};

/// The (u, v) of a chart's wedges as a file has them. Rounding keeps their order, and 0 and 1.
FloatRows stored_uv(const SphericalChart& chart, const UvStorage& storage);

/// As who reads the file takes them for a chart's.
TextureCoordinates read_uv(const FloatRows& uv, const UvStorage& storage);

/// What is proved of the chart with its (u, v) as stored. Triangles smaller than the spacing of
/// these numbers fold; they cover less than a texel of any image.
ChartCertificate certify_stored(const SphericalChart& chart, const FloatRows& uv,
                                const UvStorage& storage, int threads = 0);

/// How many triangles of all levels fold or flatten in (u, v) as 16-bit numbers, but not as the
/// floats that the asset has. Levels whose (u, v) leave [0, 1] stay floats and have none.
long folds_by_quantising(const Asset& asset);

/// How many triangles of the first level fold or flatten in (u, 1 − v) as floats, but not as the
/// floats that the asset has.
long folds_by_flipping(const Asset& asset);

}  // namespace sphparam
