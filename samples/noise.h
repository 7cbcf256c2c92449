#pragma once

#include <cstdint>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::samples {

/// A well-mixed 64-bit hash (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t hash(std::uint64_t x);

/// A number in [0, 1) for each (seed, index).
double random_unit(std::uint64_t seed, std::uint64_t index);

/// A direction, uniform on the sphere.
Vector3 random_direction(std::uint64_t seed, std::uint64_t index);

/// Gradient noise (Perlin 2002), about [−1, 1], features of size 1.
double noise(const Vector3& p, std::uint64_t seed);

/// Σ noise(2^k p)/2^k over `octaves`.
double fractal_noise(const Vector3& p, int octaves, std::uint64_t seed);

/// 0 below `low`, 1 above `high`, smooth between.
double smooth_step(double low, double high, double x);

}  // namespace sphparam::samples
