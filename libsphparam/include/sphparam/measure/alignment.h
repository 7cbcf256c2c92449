#pragma once

#include <cstdint>

#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/similarity.h"
#include "sphparam/progress.h"

namespace sphparam {

struct AlignmentOptions {
  bool scale = false;             // also to the first's size
  std::int64_t samples = 20'000;  // of each surface, ≥ 1
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// From where the second surface came to where it is.
enum class AlignmentStart {
  AsTheyAre,      // its own place
  Centroids,      // moved until the centroids are one, not turned
  PrincipalAxes,  // also turned until the axes of least and greatest extent are
};

/// "as they are", "centroids", "principal axes".
const char* name_of(AlignmentStart start);

/// How the second surface is put onto the first.
struct Alignment {
  Similarity motion;    // of the second's coordinates; no mirror image
  bool scaled = false;  // whether a scale was sought
  AlignmentStart start = AlignmentStart::AsTheyAre;
  double reach = 0;  // samples that are farther from the other surface count as what it lacks …
  double kept = 1;   // … and this share of both surfaces' is not; it is what is brought together
  double rms = 0;    // of the distances of these, after it
  int iterations = 0;
};

/// Moves and turns the second surface, and with `scale` scales it, onto the first: until samples of
/// each are as near to the other as they come, in least squares. What one surface has and the other
/// lacks, as a scan lacks what nobody saw, is left out: samples that are farther than 3 standard
/// deviations, as the median of the distances tells it (half of the samples and more must have
/// their like; at first, where all are far, all count).
///
/// It starts from where the surfaces are. Where that does not bring them together to 0.2 % of the
/// diagonal, it starts also from one centroid, and from the 24 ways to lay principal axes on
/// principal axes; one of these is taken where it ends at most half as far. So what lies within a
/// tenth of its size and some 30° of where it belongs stays with it; two surfaces of one whole body
/// come together from anywhere; a part of a body far from its place does not.
///
/// Source: Besl and McKay, "A method for registration of 3-D shapes" (1992), with the distance to
/// planes of Chen and Medioni (1992) where that is nearer, and trimmed as is common since Zhang
/// (1994); both ways, so that a scale is determined. Requires: samples ≥ 1. Throws:
/// std::invalid_argument if not; UnmeasurableSurface as `measure_distance`, and where the second is
/// more than 10¹⁰⁰ times as large or as far away as the first is large; Cancelled. Ensures: the
/// same bits for any number of threads; what is undetermined, as turns of a ball are, is left as it
/// was. Cost: some 20 nearest points a sample, 200 at most where one slides on
/// the other, and some 500,000 where it starts anew.
Alignment align_surfaces(const TriangleMesh& first, const TriangleMesh& second,
                         const AlignmentOptions& options = {});

}  // namespace sphparam
