#include "noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sphparam::samples {

std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

double random_unit(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(hash(hash(seed) ^ index) >> 11) * 0x1p-53;
}

Vector3 random_direction(std::uint64_t seed, std::uint64_t index) {
  const double z = 2 * random_unit(seed, 2 * index) - 1;
  const double angle = 2 * std::numbers::pi * random_unit(seed, 2 * index + 1);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

double noise(const Vector3& p, std::uint64_t seed) {
  const Vector3 cell = p.array().floor();
  const Vector3 t = p - cell;
  // One of the twelve edge directions of a cube at each lattice point.
  const auto corner = [&](int i, int j, int k) {
    const auto lattice = [](double base, int offset) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(base) + offset);
    };
    const std::uint64_t h =
        hash(lattice(cell.x(), i) * 0x8da6b343 ^ lattice(cell.y(), j) * 0xd8163841 ^
             lattice(cell.z(), k) * 0xcb1ab31f ^ hash(seed));
    const double x = t.x() - i, y = t.y() - j, z = t.z() - k;
    const double first = h & 4 ? x : h & 8 ? y : x, second = h & 4 ? y : z;
    return (h & 1 ? first : -first) + (h & 2 ? second : -second);
  };
  const auto fade = [](double s) { return s * s * s * (s * (6 * s - 15) + 10); };
  const double u = fade(t.x()), v = fade(t.y()), w = fade(t.z());
  const auto along_x = [&](int j, int k) { return std::lerp(corner(0, j, k), corner(1, j, k), u); };
  const auto along_y = [&](int k) { return std::lerp(along_x(0, k), along_x(1, k), v); };
  return std::lerp(along_y(0), along_y(1), w);
}

double fractal_noise(const Vector3& p, int octaves, std::uint64_t seed) {
  double sum = 0, amplitude = 1, frequency = 1;
  for (int k = 0; k < octaves; ++k) {
    sum += amplitude * noise(frequency * p, seed + static_cast<std::uint64_t>(k));
    amplitude /= 2;
    frequency *= 2;
  }
  return sum;
}

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace sphparam::samples
