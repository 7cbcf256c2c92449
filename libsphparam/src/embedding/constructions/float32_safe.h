#pragma once

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/float_rounding.h"

namespace sphparam {

struct Float32SafeOptions {
  DistortionEnergy energy = {};
  double radius = 1;  // of the sphere whose coordinates are to be floats
  int threads = 0;
  Progress progress = {};
};

struct Float32SafeRounding {
  FloatRounding rounding;
  /// 0: the given map was rounded. Else it was embedded anew, and triangles with less than this
  /// share of the mean area counted as equilateral ones of that size.
  double least_area = 0;
};

/// A map rounded to float32 where `round_to_float` alone may fail, because the map has made what is
/// small on the mesh smaller than the spacing of floats: coincident vertices, needles, triangles
/// stacked in one another.
///
/// Such a mesh is embedded anew with small triangles taken for larger ones, as little larger as
/// will do, and turned as the given map is as nearly as a rotation can. It has no vertices at ±z
/// then. Requires: unit rays up to rounding, a radius as `round_to_float` takes it. Ensures:
/// `rounding.map` equals its own float32 image; the same bytes for any number of threads; what
/// `round_to_float` can hold is left to it, and so is a map that is folded. Cost: as
/// `round_to_float`; an embedding more for each share that is tried. Our own: distortion where
/// there was little to see is the price of a certificate in float32.
Float32SafeRounding round_float32_safe(const TriangleMesh& mesh, const Topology& topology,
                                    const SphereMap& map, const Float32SafeOptions& options = {});

}  // namespace sphparam
