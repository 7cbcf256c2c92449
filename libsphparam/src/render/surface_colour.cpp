#include "render/surface_colour.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elementary.h"
#include "mesh/vertex_normals.h"
#include "render/sky_visibility.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "texture/texture_pyramid.h"

// Colour of a point = paint, lines over it, then light: a warm key light from the upper left, a
// weak cool fill from the right, and the sky, which the visible share of it scales. Everything in
// linear light. θ and ϕ come from the interpolated ray of the point itself, so that checker and
// lines are exact in every pixel, whatever the triangles.

namespace sphparam {
namespace {

using std::numbers::pi;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Vector3 interpolate(const Points& values, const Triangles& triangles, Face face,
                    const Eigen::Vector3d& weights) {
  return weights[0] * values.row(triangles(face, 0)) + weights[1] * values.row(triangles(face, 1)) +
         weights[2] * values.row(triangles(face, 2));
}

/// A grid coordinate here and how fast it changes, per pixel.
struct GridCoordinate {
  double value;
  double rate;

  double distance_to(double line) const { return std::abs(value - line) / rate; }
};

struct GridPoint {
  GridCoordinate theta, phi;  // degrees
};

GridPoint grid_point(const Points& rays, const Triangles& triangles, const ShadedSample& sample) {
  const auto at = [&](const Eigen::Vector3d& weights) {
    return to_spherical(interpolate(rays, triangles, sample.face, weights));
  };
  const SphericalCoordinates here = at(sample.weights), right = at(sample.weights_right),
                             below = at(sample.weights_below);
  const auto turn = [](double d) { return std::remainder(d, 2 * pi); };
  constexpr double degrees = 180 / pi, least = 1e-12;
  return {{here.theta * degrees, degrees * elementary::hypot(turn(right.theta - here.theta),
                                                             turn(below.theta - here.theta)) +
                                     least},
          {here.phi * degrees,
           degrees * elementary::hypot(right.phi - here.phi, below.phi - here.phi) + least}};
}

const SourceTexture& texture_of(const TexturePaint& paint, Face face) {
  static const SourceTexture white;
  if (paint.texture_of.empty()) return paint.textures.front();
  const int texture = paint.texture_of[static_cast<size_t>(face)];
  return texture < 0 ? white : paint.textures[static_cast<size_t>(texture)];
}

/// The steps to the next pixels say how much of the image this one covers; a triangle seen edge-on
/// has none. Black where coordinates are no numbers.
Rgb texture_colour(const TexturePaint& paint, const ShadedSample& sample) {
  Eigen::Vector2d here(0, 1), right(0, 0), below(0, 0);
  TextureLine::Face face;
  if (paint.texcoords.corners.rows() > 0) {
    const Eigen::Matrix<double, 2, 3> corners =
        paint.texcoords.corners.middleRows<3>(3 * sample.face).transpose();
    face.seams = paint.texcoords.seams_of(sample.face);
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 2; ++c) face.corners[k][c] = corners(c, k);
      face.first[k] = sample.weights[k];
    }
    here = corners * sample.weights;
    right = corners * (sample.weights_right - sample.weights);
    below = corners * (sample.weights_below - sample.weights);
  }
  if (!here.allFinite()) return Rgb::Zero();
  if (!right.allFinite() || !below.allFinite()) right = below = Eigen::Vector2d::Zero();
  const TextureLine line{
      {here.x(), 1 - here.y()}, {right.x(), -right.y()}, {below.x(), -below.y()}, 1, face};
  Rgb colour;
  sample_texture(texture_of(paint, sample.face), TextureFilter::Bilinear, line, colour.data(), 3);
  return colour;
}

Rgb checker_colour(const CheckerPaint& paint, const Triangles& triangles,
                   const ShadedSample& sample) {
  const GridPoint p = grid_point(paint.rays, triangles, sample);
  const auto column = std::lround(std::floor(p.theta.value / paint.step));
  const auto row = std::lround(std::floor(p.phi.value / paint.step));
  const Rgb light = to_linear(paint.light), dark = to_linear(paint.dark);
  // Fields smaller than two pixels are grey, not noise.
  const double rate = std::max(p.theta.rate, p.phi.rate) / paint.step;
  const auto grey = static_cast<float>(std::clamp(4 * rate - 1, 0.0, 1.0));
  const Rgb field = (column + row) % 2 == 0 ? light : dark;
  return field + grey * (0.5F * (light + dark) - field);
}

/// How much a line of `width` pixels covers at the nearest multiple of `step`; lines closer than
/// about four widths fade away.
float line_cover(const GridCoordinate& coordinate, double step, double width) {
  const double line = std::round(coordinate.value / step) * step;
  if (coordinate.distance_to(line) > width / 2) return 0;
  return static_cast<float>(std::clamp(1.5 - 4 * width * coordinate.rate / step, 0.0, 1.0));
}

}  // namespace

SurfaceColour::SurfaceColour(const RenderObject& object, const Eigen::Matrix3d& view, int pixels,
                             int threads)
    : object_(&object), view_(view) {
  normals_ = object.normals ? *object.normals : vertex_normals(object.mesh);
  if (object.occlusion)
    light_ = sky_visibility(object.mesh, normals_, 128, sky_cells_for(pixels), threads);
  normals_ = (normals_ * view.transpose()).eval();
}

Rgb SurfaceColour::painted(const ShadedSample& sample) const {
  const Triangles& triangles = object_->mesh.triangles;
  const auto mean = [&](const auto& value_of_corner) {
    auto sum = (static_cast<float>(sample.weights[0]) * value_of_corner(0)).eval();
    for (int k = 1; k < 3; ++k) sum += static_cast<float>(sample.weights[k]) * value_of_corner(k);
    return sum;
  };
  return std::visit(
      Overloaded{
          [](const UniformPaint& paint) { return to_linear(paint.colour); },
          [&](const VertexPaint& paint) -> Rgb {
            Eigen::Index nearest = 0;
            if (!paint.blends) {
              sample.weights.maxCoeff(&nearest);
              const Vertex corner = triangles(sample.face, nearest);
              return to_linear(paint.colours[static_cast<size_t>(corner)]);
            }
            return mean([&](int k) {
              return to_linear(paint.of_corners.empty()
                                   ? paint.colours[static_cast<size_t>(triangles(sample.face, k))]
                                   : paint.of_corners[static_cast<size_t>(3 * sample.face + k)]);
            });
          },
          [&](const FacePaint& paint) {
            return to_linear(paint.colours[static_cast<size_t>(sample.face)]);
          },
          [&](const CheckerPaint& paint) { return checker_colour(paint, triangles, sample); },
          [&](const TexturePaint& paint) -> Rgb {
            const Rgb colour = texture_colour(paint, sample);
            if (paint.tints.empty()) return colour;
            return colour.cwiseProduct(mean([&](int k) {
              return to_linear(paint.tints[static_cast<size_t>(3 * sample.face + k)]);
            }));
          }},
      object_->paint);
}

Rgb SurfaceColour::with_graticule(const ShadedSample& sample, const Rgb& below) const {
  const Graticule& graticule = *object_->graticule;
  const GridPoint p = grid_point(graticule.rays, object_->mesh.triangles, sample);
  const float line = std::max(line_cover(p.theta, graticule.step, graticule.width),
                              line_cover(p.phi, graticule.step, graticule.width));
  Rgb colour = below + graticule.opacity * line * (to_linear(graticule.colour) - below);
  const double to_date_line = std::min(p.theta.value, 360 - p.theta.value) / p.theta.rate;
  if (to_date_line < graticule.date_line / 2) colour = to_linear(graticule.date_line_colour);
  return colour;
}

Rgb SurfaceColour::with_wireframe(const ShadedSample& sample, const Rgb& below) const {
  const Wireframe& wireframe = *object_->wireframe;
  const unsigned hidden = wireframe.hidden_sides.empty()
                              ? 0U
                              : wireframe.hidden_sides[static_cast<size_t>(sample.face)];
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (!(hidden >> k & 1U)) distance = std::min(distance, sample.edge_distance[k]);
  }
  if (distance > wireframe.width / 2) return below;
  // Edges of triangles of a few pixels fade away, or the surface would be black.
  const double fade = wireframe.fades
                          ? std::clamp(sample.altitude.minCoeff() / (6 * wireframe.width), 0.0, 1.0)
                          : 1.0;
  return below +
         wireframe.opacity * static_cast<float>(fade) * (to_linear(wireframe.colour) - below);
}

/// In camera directions, of any length.
Vector3 SurfaceColour::normal_at(const ShadedSample& sample) const {
  const Triangles& triangles = object_->mesh.triangles;
  if (object_->shading == Shading::Flat) {
    const auto corner = [&](int k) { return object_->mesh.position(triangles(sample.face, k)); };
    return view_ * (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
  if (object_->corner_normals)
    return view_ *
           object_->corner_normals->middleRows<3>(3 * Eigen::Index{sample.face}).transpose() *
           sample.weights;
  return interpolate(normals_, triangles, sample.face, sample.weights);
}

Rgb SurfaceColour::lit(const ShadedSample& sample, const Rgb& colour) const {
  const Triangles& triangles = object_->mesh.triangles;
  Vector3 normal = normal_at(sample).normalized();
  if (!sample.front) normal = -normal;
  float sky = 1;
  if (light_.size() > 0) {
    sky = 0;
    for (int k = 0; k < 3; ++k) {
      sky += static_cast<float>(sample.weights[k]) * light_[triangles(sample.face, k)];
    }
  }
  // Camera directions: x right, y up, z towards the eye.
  static const Vector3 key = Vector3(-0.45, 0.65, 0.75).normalized();
  static const Vector3 fill = Vector3(0.85, 0.05, 0.45).normalized();
  static const Vector3 half = (key + Vector3::UnitZ()).normalized();
  const auto facing = [&](const Vector3& light) {
    return static_cast<float>(std::max(0.0, normal.dot(light)));
  };
  const Rgb key_light = Rgb(1.0F, 0.97F, 0.92F) * (0.80F * facing(key) * (0.4F + 0.6F * sky));
  const Rgb fill_light = Rgb(0.75F, 0.85F, 1.0F) * (0.17F * facing(fill));
  const auto upward = static_cast<float>(0.5 + 0.5 * normal.y());
  const Rgb sky_light = Rgb(0.95F, 0.98F, 1.0F) * ((0.26F + 0.17F * upward) * sky);
  const float gloss = 0.045F * static_cast<float>(elementary::pow(facing(half), 36)) * sky;
  return colour.cwiseProduct(key_light + fill_light + sky_light) + Rgb::Constant(gloss);
}

Rgb SurfaceColour::operator()(const ShadedSample& sample) const {
  Rgb colour = painted(sample);
  if (object_->graticule) colour = with_graticule(sample, colour);
  if (object_->wireframe) colour = with_wireframe(sample, colour);
  return lit(sample, colour);
}

}  // namespace sphparam
