#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "geodesic_sphere.h"
#include "noise.h"
#include "relaxation_on_surface.h"
#include "sample_meshes.h"
#include "vertex_colours.h"

// A sphere with worm-like ridges: its radius is a steep step of a sum of plane waves of one length,
// whose zero lines wind like sulci. Then space is bent by one-to-one maps, which leave the surface
// a sphere that does not meet itself: every concentric shell is turned rigidly, by an angle that
// grows with its radius, so that the ridges lean over; then it is stretched to the shape of a
// brain.

namespace sphparam::samples {
namespace {

constexpr std::uint64_t seed = 1909;
constexpr int frequency = 45;
constexpr double depth = 0.19;      // of the sulci, the radius being 1
constexpr double wave_number = 27;  // radians a unit length
constexpr int wave_count = 28;

struct Wave {
  Vector3 direction;
  double phase;
};

std::vector<Wave> make_waves() {
  std::vector<Wave> waves;
  for (std::uint64_t i = 0; i < wave_count; ++i) {
    waves.push_back(
        {wave_number * random_direction(seed, i), 2 * std::numbers::pi * random_unit(seed + 1, i)});
  }
  return waves;
}

/// Of mean 0 and variance 1, its zero lines half a wave apart.
double wave_sum(const Vector3& d) {
  static const std::vector<Wave> waves = make_waves();
  double sum = 0;
  for (const Wave& wave : waves) sum += std::cos(wave.direction.dot(d) + wave.phase);
  return sum / std::sqrt(0.5 * wave_count);
}

/// 0 in the depth of a sulcus or of the fissure between the halves, 1 on a gyrus: steep walls,
/// round crowns.
double ridge(const Vector3& d) {
  const double above = (wave_sum(d) + 0.75) / 2.1;
  const double wall = std::min(1.0, 0.5 * (above + std::hypot(above, 0.1)));
  const double fold = 1 - std::pow(1 - wall, 3);
  const double fissure =
      1 - std::exp(-std::pow(d.y() / 0.055, 2)) * smooth_step(-0.75, -0.2, d.z());
  return fold * fissure;
}

double radius_at(const Vector3& d) {
  return 1 - depth * (1 - ridge(d)) + 0.035 * noise(1.6 * d, seed + 2);
}

/// Turns every shell about two axes, each by an angle that grows with the radius.
Vector3 leaned(const Vector3& p, double sign) {
  const double angle = 0.55 * (p.norm() - 0.9);
  static const Vector3 upward = Vector3(0.3, 0.2, 1).normalized();
  static const Vector3 forward = Vector3(1, -0.4, 0.1).normalized();
  const Eigen::AngleAxisd first(sign * angle, upward), second(sign * 0.8 * angle, forward);
  return sign > 0 ? Vector3(second * (first * p)) : Vector3(first * (second * p));
}

const Vector3 stretch(1.25, 0.98, 0.92);

Vector3 bent(const Vector3& p) { return stretch.cwiseProduct(leaned(p, 1)); }
Vector3 unbent(const Vector3& p) { return leaned(p.cwiseQuotient(stretch), -1); }

/// Grey-pink gyri, dark red sulci.
Colour colour_at(const Vector3& d) {
  const double height = ridge(d), fine = fractal_noise(7 * d, 3, seed + 3);
  const Colour colour = mix({0.45, 0.16, 0.16}, {0.90, 0.72, 0.67}, smooth_step(0.0, 0.9, height));
  return colour * (1 + 0.07 * fine);
}

struct Lobe {
  const char* name;
  Colour colour;
};

// Left and right halves of four lobes, numbered from 1: the left ones are odd.
const std::array<Lobe, 4> lobes{{{"frontal", {0.86, 0.37, 0.30}},
                                 {"parietal", {0.95, 0.77, 0.30}},
                                 {"temporal", {0.33, 0.62, 0.42}},
                                 {"occipital", {0.30, 0.45, 0.76}}}};

/// The lobe of a direction from the centre; the face looks along +x.
int lobe_at(const Vector3& d) {
  if (d.x() > 0.30) return 0;
  if (d.x() < -0.62) return 3;
  return d.z() < -0.10 ? 2 : 1;
}

/// A line of a label table, as a comment: what `lobe` stands for (GIFTI files keep it as theirs).
std::string label_comment(int key, const char* side, const Lobe& lobe) {
  std::ostringstream text;
  text << "gifti label " << key << ' ' << lobe.colour.x() << ' ' << lobe.colour.y() << ' '
       << lobe.colour.z() << " 1 " << side << ' ' << lobe.name;
  return text.str();
}

}  // namespace

void add_lobes(sphparam::MeshFile& cortex) {
  sphparam::Property property{"lobe", sphparam::ScalarType::Int32, {}};
  for (Eigen::Index v = 0; v < cortex.mesh.vertex_count(); ++v) {
    const Vector3 d = unbent(cortex.mesh.positions.row(v)).normalized();
    property.values.push_back(2 * lobe_at(d) + (d.y() < 0 ? 2 : 1));
  }
  cortex.set_vertex_property(std::move(property));
  for (int i = 0; i < static_cast<int>(lobes.size()); ++i) {
    const Lobe& lobe = lobes[static_cast<size_t>(i)];
    cortex.comments.push_back(label_comment(2 * i + 1, "left", lobe));
    cortex.comments.push_back(label_comment(2 * i + 2, "right", lobe));
  }
}

sphparam::MeshFile make_cortex() {
  const Field field = [](const Vector3& p) {
    const Vector3 q = unbent(p);
    const double r = q.norm();
    return r - radius_at(q / r);
  };
  TriangleMesh start = geodesic_sphere(frequency, 0).mesh;
  for (Eigen::Index v = 0; v < start.vertex_count(); ++v) {
    const Vector3 d = start.positions.row(v);
    start.positions.row(v) = bent(radius_at(d) * d);
  }
  sphparam::MeshFile file;
  file.mesh = relaxed_on_surface(start, field, {.rounds = 25});
  std::vector<Colour> colours;
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    colours.push_back(colour_at(unbent(file.mesh.positions.row(v)).normalized()));
  }
  add_vertex_colours(colours, file);
  file.format = "sample";
  return file;
}

}  // namespace sphparam::samples
