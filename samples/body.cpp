#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geodesic_sphere.h"
#include "noise.h"
#include "sample_meshes.h"
#include "sphparam/parallel.h"
#include "vertex_colours.h"

// A small body like an asteroid: the geodesic sphere, each vertex moved along its ray to
// r(d) = lumps + craters. Craters are a bowl with a raised rim and an apron, large ones first, so
// that small ones lie on them. Mesh colours and texture come from the same function of direction.

namespace sphparam::samples {
namespace {

constexpr double margin = 0.03;  // of an atlas square, against bleeding
constexpr std::uint64_t seed = 2006;

struct Crater {
  Vector3 centre;
  double radius;  // as an angle
  double fresh;   // 1: bright rays, 0: none
};

/// Radii follow a power law: few large, many small.
std::vector<Crater> make_craters() {
  std::vector<Crater> craters;
  constexpr int count = 110;
  for (int i = 0; i < count; ++i) {
    const auto id = static_cast<std::uint64_t>(i);
    const double radius = 0.5 * std::pow(1 + 0.35 * i, -0.62);
    const double fresh = i > 12 && random_unit(seed + 7, id) < 0.09 ? 1 : 0;
    craters.push_back({random_direction(seed, id), radius, fresh});
  }
  return craters;
}

const std::vector<Crater>& craters() {
  static const std::vector<Crater> instance = make_craters();
  return instance;
}

/// Distance from a crater's centre in radii, ragged.
double distance_in_radii(const Crater& crater, const Vector3& d, double ragged) {
  const double chord = (d - crater.centre).norm();
  return 2 * std::asin(std::min(1.0, chord / 2)) / crater.radius * (1 + 0.10 * ragged);
}

/// Height of a crater of radius 1 at distance t: bowl, rim at 1, apron that ends at 2.
double crater_profile(double t) {
  constexpr double depth = 0.40, rim = 0.11;
  if (t >= 2) return 0;
  if (t >= 1) return rim * (2 - t) * (2 - t) * (2 - t);
  const double bowl = t * t * (2 - t * t);
  return -depth + (depth + rim) * bowl;
}

double radius_at(const Vector3& d) {
  // Two unequal lobes with a waist, then lumps.
  const double ellipsoid =
      1 / std::sqrt(d.x() * d.x() / 1.96 + d.y() * d.y() / 1.0 + d.z() * d.z() / 0.72);
  const double waist = 0.10 * std::exp(-std::pow((d.x() - 0.12) / 0.22, 2));
  double r = ellipsoid * (1 - waist) + 0.16 * noise(1.3 * d, seed + 1) * (1 + 0.3 * d.x()) +
             0.045 * fractal_noise(3.1 * d, 4, seed + 2);
  const double ragged = noise(6 * d, seed + 3);
  for (const Crater& crater : craters()) {
    const double t = distance_in_radii(crater, d, ragged);
    if (t < 2) r += r * crater.radius * crater_profile(t);
  }
  return r;
}

/// Rust-brown dust on grey rock; floors of craters darker, fresh ones bright with rays.
Colour colour_at(const Vector3& d) {
  const double broad = fractal_noise(1.7 * d, 3, seed + 4);
  const double fine = fractal_noise(14 * d, 3, seed + 5);
  Colour colour = mix({0.66, 0.58, 0.50}, {0.50, 0.51, 0.54}, smooth_step(-0.25, 0.3, broad));
  colour = mix(colour, {0.72, 0.53, 0.38}, 0.7 * smooth_step(0.15, 0.6, -broad));
  double light = 1 + 0.16 * fine, bright = 0;
  const double ragged = noise(6 * d, seed + 3);
  for (const Crater& crater : craters()) {
    const double t = distance_in_radii(crater, d, ragged);
    if (t > 5) continue;
    light *= 1 - 0.20 * (1 - smooth_step(0.55, 0.95, t));
    light *= 1 + 0.14 * std::exp(-std::pow((t - 1) / 0.13, 2));
    if (crater.fresh == 0) continue;
    const Vector3 outward = (d - crater.centre).normalized();
    const double streak = smooth_step(-0.1, 0.45, noise(5.5 * outward, seed + 6));
    const double apron = 1 - smooth_step(0.9, 1.6, t), rays = 1 - smooth_step(1.0, 5.0, t);
    bright = std::max(bright, std::max(0.9 * apron, 0.75 * streak * rays));
  }
  return mix(colour * light, {0.93, 0.91, 0.86}, 0.75 * bright);
}

}  // namespace

sphparam::MeshFile make_body(int frequency) {
  GeodesicSphere sphere = geodesic_sphere(frequency, margin);
  sphparam::MeshFile file;
  file.mesh = std::move(sphere.mesh);
  file.corner_texcoords = std::move(sphere.texcoords);
  std::vector<Colour> colours(static_cast<size_t>(file.mesh.vertex_count()));
  parallel_for(file.mesh.vertex_count(), 512, 0, [&](std::int64_t first, std::int64_t last) {
    for (Eigen::Index v = first; v < last; ++v) {
      const Vector3 d = file.mesh.positions.row(v);
      colours[static_cast<size_t>(v)] = colour_at(d);
      file.mesh.positions.row(v) = radius_at(d) * d;
    }
  });
  add_vertex_colours(colours, file);
  file.format = "sample";
  return file;
}

sphparam::Image make_body_texture(int square) {
  sphparam::Image image(5 * square, 2 * square, 3);
  parallel_for(image.height, 4, 0, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < last; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double u = (x + 0.5) / image.width, v = 1 - (y + 0.5) / image.height;
        const Colour colour = colour_at(atlas_direction(u, v, margin));
        for (int c = 0; c < 3; ++c) {
          image.pixel(x, y)[c] = static_cast<float>(std::clamp(colour[c], 0.0, 1.0));
        }
      }
    }
  });
  return image;
}

}  // namespace sphparam::samples
