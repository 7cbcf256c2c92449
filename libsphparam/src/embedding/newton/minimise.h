#pragma once

#include "embedding/newton/global_newton.h"
#include "embedding/newton/optimise.h"

namespace sphparam {

/// A f of an isometry, summed over the source: what no map of small triangles gets below, but where
/// pressure makes triangles smaller or larger than they are.
double isometric_energy(const RestTriangles& source, const DistortionEnergy& energy,
                        const FillerMarks& pressed);

/// Steps until they gain less than `least_gain` of what the energy has more than `isometric`, or
/// there were `max_steps`. Adds to the report's counts; its energies are those of this call.
void minimise(GlobalNewton& newton, double isometric, const OptimiseOptions& options,
              OptimiseReport& report);

/// Throws: std::invalid_argument naming an option outside of its domain.
void require_domain(const OptimiseOptions& options, int vertices);

}  // namespace sphparam
