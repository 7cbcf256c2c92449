#pragma once

#include <string>
#include <vector>

#include "sphparam/io/sphere_file.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam::cli {

/// What `sphparam spharm` found.
struct HarmonicsReport {
  std::string mesh;                    // path
  Provenance map;                      // of the map that was used
  std::vector<std::string> functions;  // "x", "y", "z", then scalars by name: one a column
  bool least_squares = true;
  HarmonicFit fit;      // its residuals are weighted by solid angle
  VectorX plain_rms;    // of what is left at the vertices, each counted once
  double diagonal = 0;  // of the bounding box: the scale of the residuals of x, y, z

  int degree() const;
  /// Of the distances, not of one coordinate: weighted by solid angle, and plain.
  double position_rms() const { return fit.rms.head<3>().norm(); }
  double plain_position_rms() const { return plain_rms.head<3>().norm(); }
};

/// The report with all coefficients, as the manual describes it.
std::string to_json(const HarmonicsReport& report);

/// One line a coefficient: l, m, then one number a function; a header line first. Numbers come back
/// exactly.
std::string to_csv(const HarmonicsReport& report);

}  // namespace sphparam::cli
