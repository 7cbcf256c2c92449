#pragma once

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

struct AxisOptions {
  int candidates = 96;  // directions spread evenly over half the sphere; at least 1
  int threads = 0;      // 0: all cores
};

/// An axis through a finished map, and what the (θ, ϕ) chart around it is like beside the others.
struct AxisChoice {
  Vector3 axis;               // unit; the half sphere around it shows more of the source
  double folds = 0;           // triangles that fold when linear in (θ, ϕ); the same, mean of all
  double mean_folds = 0;      // candidates
  double density_spread = 0;  // standard deviation of log2(texels per source area), area-weighted
  double mean_density_spread = 0;
};

/// Chooses the poles' axis: among evenly spread ones, that for which the equirectangular chart of
/// the map folds least and spends its texels most evenly. Either figure is counted in its standard
/// deviations among the candidates; the least sum wins.
///
/// The chart has 1/sin ϕ times as many texels per solid angle as at the equator. Poles where the
/// map shows the source small (the tips of protrusions) even that out; poles beside long stretched
/// triangles make them fold. The paper leaves the choice to the user.
/// Evidence (17 real meshes, 622 to 199,034 triangles; chosen against the mean of 384 axes, all
/// triangles counted): see tests/embedding/test_axis_choice.cpp for the law.
/// Folds are counted among triangles longer than four of their heights, the others fold only where
/// a pole touches them; densities on 216 cells of the sphere.
/// Requires: a bijective map. Ensures: same bits for any number of threads. Our own.
/// Cost: one pass, about 0.03 µs a triangle.
AxisChoice choose_axis(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                       const AxisOptions& options = {});

/// The longitude, of 256, whose half-circle fewest triangles cross: what it crosses has to be split
/// for the chart. In radians, [0, 2π). Our own. Cost: one pass.
double choose_meridian(const Topology& topology, const SphereMap& map, int threads = 0);

/// Whether a triangle whose corners are joined by straight lines in (θ, ϕ), the short way round,
/// runs against the sphere. Never where it contains ±z or touches it: the chart splits it there.
/// Requires: counter-clockwise on the sphere. Double arithmetic: a figure, not a certificate.
bool folds_in_chart(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace sphparam
