#pragma once

#include <functional>
#include <span>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "bake/texels/texel_points.h"
#include "sphparam/progress.h"

namespace sphparam {

struct BakeOptions {
  int width = 2048, height = 1024;
  int samples = 1;  // N: N×N a texel, their mean
  Interpolation interpolation = Interpolation::Uv;
  int threads = 0;
  // Asked at least between some dozen samples; false ends the bake.
  Progress progress = {};
};

/// Takes finished rows of a field, from the top, one call after the other for a field; for several
/// fields at the same time. Colours are linear light.
using RowSink = std::function<void(size_t field, int first_row, int rows, const float* values)>;

/// Evaluates fields at the texels of an equirectangular image, in u = θ/2π, v = ϕ/π.
///
/// Every texel has one owner, so every texel of every field has a value. Where triangles of the
/// source are smaller than texels (`CrowdedTexels`), a texel is the mean over all that lies in it,
/// weighted by area on the surface: what is small on the sphere does not vanish from the image.
/// Labels are those of the texel's centre.
/// Ensures: same values for any number of threads. Memory: some bands of rows, whatever the size.
/// Throws: Cancelled; what the sink throws; std::invalid_argument for sizes below 1.
/// Our own. Cost: linear in texels and triangles.
void bake(const BakeScene& scene, std::span<const SurfaceField> fields, const BakeOptions& options,
          const RowSink& sink);

}  // namespace sphparam
