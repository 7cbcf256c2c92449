#include <algorithm>
#include <cmath>
#include <vector>

#include "level_set.h"
#include "noise.h"
#include "relaxation_on_surface.h"
#include "sample_meshes.h"
#include "vertex_colours.h"

// Two ellipsoids in touch, joined by a smooth minimum (a polynomial one, Quilez 2013: rubble fills
// the neck), rough all over. The smaller one leans over the larger: from the centre of the body the
// cliffs of the neck are behind it.

namespace sphparam::samples {
namespace {

constexpr std::uint64_t seed = 1969;  // when the comet it is like was found
constexpr double kilometres = 1.5;    // of a unit of the formulas
constexpr double rubble = 0.18;       // width of the joint
constexpr double cube = 0.062;        // of the lattice

struct Lobe {
  Vector3 centre, semi_axes;
};
const Lobe body{{-0.46, 0, -0.08}, {0.98, 0.84, 0.66}};
const Lobe head{{0.92, 0.10, 0.34}, {0.52, 0.66, 0.58}};

/// The distance to an ellipsoid up to a factor near 1 (Quilez 2008).
double distance(const Lobe& lobe, const Vector3& p) {
  const Vector3 q = (p - lobe.centre).cwiseQuotient(lobe.semi_axes);
  const double length = q.norm(), slope = q.cwiseQuotient(lobe.semi_axes).norm();
  return slope > 0 ? length * (length - 1) / slope : -lobe.semi_axes.minCoeff();
}

/// Less than 0 nearer to the head, 0 in the middle of the neck.
double side(const Vector3& p) { return distance(head, p) - distance(body, p); }

double skin(const Vector3& p) {
  const double a = distance(body, p), b = distance(head, p);
  const double h = std::max(rubble - std::abs(a - b), 0.0) / rubble;
  const double smooth = std::min(a, b) - h * h * rubble / 4;
  const double rough = smooth_step(0, 0.25, std::abs(a - b));  // the neck is smooth
  return smooth + (0.02 + 0.03 * rough) * fractal_noise(2.6 * p, 4, seed);
}

/// Dark dust, bright smooth ice in the neck, terraces in layers parallel to each lobe's skin.
Colour colour_at(const Vector3& p) {
  const double broad = fractal_noise(1.9 * p, 3, seed + 1),
               fine = fractal_noise(12 * p, 3, seed + 2);
  Colour colour = mix({0.34, 0.30, 0.27}, {0.46, 0.40, 0.33}, smooth_step(-0.3, 0.35, broad));
  const double layers = std::sin(34 * (p - body.centre).cwiseQuotient(body.semi_axes).norm());
  colour = mix(colour, {0.27, 0.24, 0.23}, 0.35 * smooth_step(0.2, 0.9, layers));
  if (side(p) < 0) colour = mix(colour, {0.52, 0.39, 0.30}, 0.55);
  const double neck = 1 - smooth_step(0.05, 0.22, std::abs(side(p)) + 0.05 * broad);
  colour = mix(colour, {0.74, 0.80, 0.86}, 0.9 * neck);
  return colour * (1 + 0.14 * fine);
}

}  // namespace

sphparam::MeshFile make_comet() {
  const TriangleMesh rough = level_set(skin, {-1.7, -1.2, -1.1}, {1.8, 1.2, 1.3}, cube);
  sphparam::MeshFile file;
  file.mesh = relaxed_on_surface(rough, skin, {.rounds = 30});
  std::vector<Colour> colours;
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    colours.push_back(colour_at(file.mesh.positions.row(v)));
  }
  add_vertex_colours(colours, file);
  file.mesh.positions *= kilometres;
  file.format = "sample";
  return file;
}

}  // namespace sphparam::samples
