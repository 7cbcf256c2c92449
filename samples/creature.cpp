#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "level_set.h"
#include "noise.h"
#include "relaxation_on_surface.h"
#include "sample_meshes.h"
#include "vertex_colours.h"

// Limbs are curves of varying thickness, made of many cones with round ends, and joined by a smooth
// minimum (a polynomial one, Quilez 2013: flesh fills the joints); the skin is where the distance
// is zero.

namespace sphparam::samples {
namespace {

constexpr std::uint64_t seed = 1974;
constexpr double flesh = 0.16;  // width of the smooth joints
constexpr double cube = 0.085;  // of the lattice

struct Bone {
  Vector3 from, to;
  double from_radius, to_radius;
};

/// Bones along a curve, with a ball around them all.
struct Limb {
  std::vector<Bone> bones;
  Vector3 centre;
  double radius;
};

/// A point and the thickness there.
using Joint = Eigen::Vector4d;

/// A limb along the Catmull–Rom curve through the joints.
Limb make_limb(const std::vector<Joint>& joints) {
  constexpr int pieces = 4;  // a section
  std::vector<Joint> curve;
  const auto count = static_cast<int>(joints.size());
  const auto joint = [&](int i) {
    return joints[static_cast<size_t>(std::clamp(i, 0, count - 1))];
  };
  for (int i = 0; i + 1 < count; ++i) {
    const Joint before = joint(i - 1), from = joint(i), to = joint(i + 1), after = joint(i + 2);
    for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      curve.push_back(0.5 * (2 * from + t * (to - before) +
                             t * t * (2 * before - 5 * from + 4 * to - after) +
                             t * t * t * (3 * from - before - 3 * to + after)));
    }
  }
  Limb limb;
  limb.centre.setZero();
  for (const Joint& j : curve) limb.centre += j.head<3>() / static_cast<double>(curve.size());
  limb.radius = 0;
  for (const Joint& j : curve) {
    limb.radius = std::max(limb.radius, (j.head<3>() - limb.centre).norm() + j[3]);
  }
  for (size_t i = 0; i + 1 < curve.size(); ++i) {
    limb.bones.push_back(
        {curve[i].head<3>(), curve[i + 1].head<3>(), curve[i][3], curve[i + 1][3]});
  }
  return limb;
}

/// Looks along +x, stands on z = 0. Trunk first.
std::vector<Limb> make_limbs() {
  std::vector<Limb> limbs;
  const auto add = [&](const std::vector<Joint>& joints) { limbs.push_back(make_limb(joints)); };
  add({{-0.88, 0, 1.12, 0.26},
       {-0.25, 0, 1.13, 0.30},
       {0.48, 0, 1.20, 0.34},
       {0.86, 0, 1.58, 0.19},
       {1.06, 0, 2.00, 0.15},
       {1.27, 0, 2.17, 0.205},
       {1.50, 0, 2.08, 0.15},
       {1.68, 0, 2.01, 0.115}});
  // The tail's curl stays clear of the trunk.
  add({{-0.95, 0, 1.17, 0.20},
       {-1.40, 0.04, 1.12, 0.125},
       {-1.85, 0.12, 1.28, 0.105},
       {-2.18, 0.22, 1.64, 0.09},
       {-2.22, 0.30, 2.05, 0.08},
       {-1.95, 0.34, 2.36, 0.072},
       {-1.62, 0.34, 2.30, 0.066},
       {-1.54, 0.33, 2.04, 0.062}});
  for (const double side : {-1.0, 1.0}) {
    const auto at = [side](double x, double y, double z, double thickness) {
      return Joint(x, side * y, z, thickness);
    };
    const double stride = 0.17 * side;  // one leg before the other
    add({at(0.50, 0.19, 1.12, 0.21), at(0.46 + 0.8 * stride, 0.37, 0.68, 0.125),
         at(0.58 + stride, 0.42, 0.28, 0.088), at(0.62 + stride, 0.44, 0.10, 0.085),
         at(0.82 + stride, 0.46, 0.075, 0.075)});
    add({at(-0.86, 0.18, 1.06, 0.24), at(-0.64 - 0.7 * stride, 0.36, 0.68, 0.15),
         at(-0.96 - stride, 0.39, 0.36, 0.088), at(-0.92 - stride, 0.41, 0.11, 0.085),
         at(-0.72 - stride, 0.42, 0.075, 0.075)});
    add({at(1.20, 0.10, 2.26, 0.085), at(1.08, 0.24, 2.54, 0.072), at(1.10, 0.36, 2.72, 0.064),
         at(1.24, 0.40, 2.92, 0.056)});                              // horn
    add({at(1.14, 0.12, 2.17, 0.09), at(1.00, 0.38, 2.14, 0.062)});  // ear
  }
  return limbs;
}

/// The distance to a cone with round ends, up to a factor near 1.
double distance(const Bone& bone, const Vector3& p) {
  const Vector3 axis = bone.to - bone.from;
  const double t = std::clamp((p - bone.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - bone.from - t * axis).norm() - std::lerp(bone.from_radius, bone.to_radius, t);
}

double smooth_minimum(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

double distance(const std::vector<Limb>& limbs, const Vector3& p) {
  double result = 1e9;
  for (const Limb& limb : limbs) {
    // What is farther than the flesh is thick changes nothing.
    if ((p - limb.centre).norm() - limb.radius > result + flesh) continue;
    double nearest = 1e9;
    for (const Bone& bone : limb.bones) nearest = std::min(nearest, distance(bone, p));
    result = smooth_minimum(result, nearest, flesh);
  }
  return result;
}

/// Sandy back with dark stripes, pale belly, dark feet, tail tip and horns.
Colour colour_at(const Vector3& p, const Vector3& normal) {
  const double wobble = noise(2.2 * p, seed), fine = fractal_noise(9 * p, 3, seed + 1);
  Colour colour = mix({0.80, 0.52, 0.24}, {0.70, 0.38, 0.18}, smooth_step(-0.4, 0.5, wobble));
  const double along = p.x() + 0.55 * p.z() + 0.10 * wobble;
  const double stripe = smooth_step(0.25, 0.6, std::sin(13 * along + 2 * wobble));
  const double back = smooth_step(-0.25, 0.45, normal.z() + 0.3 * wobble);
  colour = mix(colour, {0.26, 0.15, 0.10}, 0.85 * stripe * back);
  colour = mix(colour, {0.93, 0.85, 0.70}, smooth_step(0.1, 0.75, -normal.z() + 0.2 * wobble));
  colour = mix(colour, {0.22, 0.15, 0.12}, 1 - smooth_step(0.10, 0.34, p.z()));
  colour = mix(colour, {0.92, 0.88, 0.80}, smooth_step(2.42, 2.52, p.z()));
  colour = mix(colour, {0.20, 0.12, 0.09}, smooth_step(1.72, 1.76, p.x()));
  for (const double side : {-1.0, 1.0}) {
    const double eye = (p - Vector3(1.40, side * 0.17, 2.21)).norm();
    colour = mix(colour, {0.05, 0.04, 0.04}, 1 - smooth_step(0.050, 0.065, eye));
  }
  return colour * (1 + 0.07 * fine);
}

}  // namespace

sphparam::MeshFile make_creature() {
  const std::vector<Limb> limbs = make_limbs();
  const Field skin = [&](const Vector3& p) { return distance(limbs, p); };
  const TriangleMesh rough = level_set(skin, {-2.5, -0.8, -0.2}, {2.0, 0.8, 3.2}, cube);
  sphparam::MeshFile file;
  file.mesh = relaxed_on_surface(rough, skin, {.rounds = 40});
  std::vector<Colour> colours;
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    const Vector3 p = file.mesh.positions.row(v);
    colours.push_back(colour_at(p, gradient(skin, p, flesh / 2).normalized()));
  }
  add_vertex_colours(colours, file);
  file.format = "sample";
  return file;
}

}  // namespace sphparam::samples
