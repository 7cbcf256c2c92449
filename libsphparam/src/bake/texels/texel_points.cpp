#include "bake/texels/texel_points.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bake/projected_surface.h"
#include "elementary.h"
#include "sphere/move_to_surface.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/sphere/spherical_coordinates.h"

// A refined face lies in one source face, and its map to it is affine in (u, v): a run of the chart
// is a run of the source. (Not so on the sphere, where the rays of new vertices have unit length.)
// Through another mesh, λ of the source is projective in the direction q: λ ∝ M⁻¹q, M = (x₀ x₁ x₂);
// its derivative, λ̇ = (M⁻¹q̇ − λ Σ M⁻¹q̇) / Σ M⁻¹q, is what a texel covers. Of a radial map M has the
// vertices as seen from its centre instead of their rays: λ is then of the point where q, as a ray
// from there, meets the triangle, on neighbouring triangles at the same points of their edge.

namespace sphparam {
namespace {

Vector3 three(const std::array<double, 2>& weights) {
  return {weights[0], weights[1], 1 - weights[0] - weights[1]};
}
Vector3 change(const std::array<double, 2>& weights) {
  return {weights[0], weights[1], -weights[0] - weights[1]};
}

Eigen::Matrix3d rays(const Triangles& triangles, const Points& points, Face f) {
  Eigen::Matrix3d columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = points.row(triangles(f, k));
  return columns;
}

TexelRun single(const SurfacePoint& point, int row, int column) {
  return {point.face, row, column, 1, {point.barycentric[0], point.barycentric[1]}, {0, 0}, {0, 0}};
}

}  // namespace

TexelFinder::TexelFinder(const BakeScene& scene, const TexelOwners& owners,
                         Interpolation interpolation, int threads)
    : scene_(&scene), owners_(&owners), interpolation_(interpolation) {
  const bool sphere = interpolation == Interpolation::Sphere;
  if (scene.target.is_source) find_refined();
  if (scene.source.mapped && (sphere || !scene.target.is_source)) look_in(*scene.source.mapped);
  if (sphere) look_on_chart(threads);
}

void TexelFinder::find_refined() {
  const SphericalChart& chart = scene_->target.chart;
  const Triangles& source = scene_->source.mesh().triangles;
  refined_.assign(static_cast<size_t>(chart.triangles.rows()), -1);
  for (Face f = 0; f < chart.triangles.rows(); ++f) {
    const Face parent = chart.source_faces[static_cast<size_t>(f)];
    if (f == parent && chart.triangles.row(f) == source.row(f)) continue;
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<size_t>(chart.triangles(f, k));
      corners.col(k) = barycentric_in(parent, chart.surface_points[v], source);
    }
    refined_[static_cast<size_t>(f)] = static_cast<int>(corners_.size());
    corners_.push_back(corners);
  }
}

void TexelFinder::look_in(const MappedMesh& mapped) {
  source_ = &mapped.locator();
  const auto radial = planetocentric(mapped.provenance());
  if (!radial || !is_as_said(*radial, mapped.file(), mapped.map())) return;
  const StandingBody body = standing_body(mapped.file(), radial->centre);
  seen_from_centre_ = body.mesh.positions.rowwise() - body.centre.transpose();
}

void TexelFinder::look_on_chart(int threads) {
  const SphericalChart& chart = scene_->target.chart;
  if (!chart.certificate.inverted.empty())
    throw std::invalid_argument("the chart's points are no sphere map");
  chart_topology_.emplace(chart.triangles, static_cast<int>(chart.points.rows()), threads);
  chart_map_ = SphereMap{chart.points};
  chart_.emplace(*chart_topology_, *chart_map_, threads);
}

SurfaceRun TexelFinder::run_in_source(const TexelRun& place) const {
  SurfaceRun run{place.face, place.count, three(place.weights), change(place.step),
                 change(place.below)};
  const int refined = refined_[static_cast<size_t>(place.face)];
  if (refined >= 0) {
    const Eigen::Matrix3d& corners = corners_[static_cast<size_t>(refined)];
    run.face = scene_->target.chart.source_faces[static_cast<size_t>(place.face)];
    run.first = corners * run.first;
    run.step = corners * run.step;
    run.below = corners * run.below;
  }
  return run;
}

namespace {

/// What the weights of q's point change by as q moves to the east and to the south.
std::array<Vector3, 2> derivatives(const Eigen::Matrix3d& corners, const SurfacePoint& point,
                                   const Vector3& q, const Vector3& east, const Vector3& south) {
  const Eigen::Matrix3d inverse = corners.inverse();
  const double size = (inverse * q).sum();
  const auto derivative = [&](const Vector3& dq) -> Vector3 {
    const Vector3 raw = inverse * dq;
    const Vector3 result = (raw - point.barycentric * raw.sum()) / size;
    return result.allFinite() ? result : Vector3::Zero();
  };
  return {derivative(east), derivative(south)};
}

/// Where part s of a texel's grid is on the plane of its face.
PlaceOnTarget part_of_face(const TexelRun& texel, GridSize parts, int s) {
  const Vector3 step = change(texel.step) / parts.east, below = change(texel.below) / parts.south;
  const double right = s % parts.east + 0.5 - 0.5 * parts.east,
               down = s / parts.east + 0.5 - 0.5 * parts.south;
  return {texel.face, three(texel.weights) + right * step + down * below, step, below};
}

/// Where its centroid is on the sphere, and what spans its solid angle there: about its middle
/// parallel, ϕ, the mean of ϕ is ϕ + h² cot ϕ/12 to the third order of its height h.
TexelFinder::Look part_of_sphere(const TexelOwners& image, const TexelRun& texel, GridSize parts,
                                 int s) {
  const double width = 2 * std::numbers::pi / image.width() / parts.east,
               height = std::numbers::pi / image.height() / parts.south;
  const double theta = width * (texel.first * parts.east + s % parts.east + 0.5),
               phi = height * (texel.row * parts.south + s / parts.east + 0.5);
  const double sine = elementary::sin(phi);  // not 0: no middle is a pole
  const Vector3 q = to_cartesian({theta, phi + height * height / 12 * elementary::cos(phi) / sine});
  const double radius = std::sqrt(q[0] * q[0] + q[1] * q[1]);
  return {q, width * sine / radius * Vector3(-q[1], q[0], 0),
          height * Vector3(q[2] * q[0] / radius, q[2] * q[1] / radius, -radius)};
}

}  // namespace

SurfaceRun TexelFinder::located(const Look& look) const {
  const auto& [q, east, south] = look;
  SurfacePoint point = source_->locate(q);
  const BakeSource& source = scene_->source;
  const Eigen::Matrix3d corners =
      rays(source.mesh().triangles,
           seen_from_centre_ ? *seen_from_centre_ : source.mapped->map().points, point.face);
  if (seen_from_centre_) move_to_surface(corners.colwise().norm(), point.barycentric);
  const auto [step, below] = derivatives(corners, point, q, east, south);
  return {point.face, 1, point.barycentric, step, below};
}

SurfaceRun TexelFinder::projected(const TexelRun& place, const Vector3& at) const {
  return scene_->source.surface->project(scene_->target,
                                         {place.face, at, change(place.step), change(place.below)});
}

/// The points of the other surface about where those of a run of the target are.
void TexelFinder::project(const TexelRun& place, std::vector<SurfaceRun>& runs) const {
  std::vector<PlaceOnTarget> places;
  for (int i = 0; i < place.count; ++i)
    places.push_back({place.face, three(place.weights) + i * change(place.step), change(place.step),
                      change(place.below)});
  scene_->source.surface->project(scene_->target, places, runs.empty() ? -1 : runs.back().face,
                                  runs);
}

/// The points of the source below those of a run of the target.
void TexelFinder::locate(const TexelRun& place, std::vector<SurfaceRun>& runs) const {
  const SphericalChart& chart = scene_->target.chart;
  const Eigen::Matrix3d corners = rays(chart.triangles, chart.points, place.face);
  const Vector3 first = corners * three(place.weights), east = corners * change(place.step),
                south = corners * change(place.below);
  for (int i = 0; i < place.count; ++i) runs.push_back(located({first + i * east, east, south}));
}

PlaceOnTarget TexelFinder::on_target(const Look& look) const {
  const SphericalChart& chart = scene_->target.chart;
  const SurfacePoint at = chart_->locate(look.q);
  const auto [step, below] =
      derivatives(rays(chart.triangles, chart.points, at.face), at, look.q, look.east, look.south);
  return {at.face, at.barycentric, step, below};
}

void TexelFinder::grid(const TexelRun& place, GridSize size, Face near,
                       std::vector<SurfaceRun>& runs) const {
  const SphericalChart& chart = scene_->target.chart;
  const Eigen::Matrix3d corners = rays(chart.triangles, chart.points, place.face);
  // Beside the triangle of a pole weights do not change to the east, and span no area.
  const bool by_chart = interpolation_ == Interpolation::Uv && !change(place.step).isZero(0);
  std::vector<PlaceOnTarget> places;
  for (int s = 0; s < size.count(); ++s) {
    const PlaceOnTarget flat = part_of_face(place, size, s);
    const bool in_face = by_chart && flat.at.minCoeff() >= 0;
    if (!source_)
      places.push_back(in_face || !chart_ ? flat
                                          : on_target(part_of_sphere(*owners_, place, size, s)));
    else if (in_face)
      runs.push_back(located({corners * flat.at, corners * flat.step, corners * flat.below}));
    else
      runs.push_back(located(part_of_sphere(*owners_, place, size, s)));
  }
  if (!source_) scene_->source.surface->project(scene_->target, places, near, runs);
}

TexelPoints TexelFinder::by_direction(int band, double x, double y) const {
  TexelPoints texels;
  const SphericalChart& chart = scene_->target.chart;
  const int width = owners_->width(), first = owners_->first_row(band);
  const auto direction = [&](double row, double column) {
    constexpr double pi = std::numbers::pi;
    return to_cartesian({2 * pi * (column + x) / width, pi * (row + y) / owners_->height()});
  };
  for (int row = first; row < first + owners_->rows(band); ++row) {
    Points directions(width, 3);
    for (int column = 0; column < width; ++column) directions.row(column) = direction(row, column);
    const std::vector<SurfacePoint> places = chart_->locate_all(directions, 1);
    for (int column = 0; column < width; ++column) {
      const SurfacePoint& place = places[static_cast<size_t>(column)];
      const Vector3 q = directions.row(column);
      const Vector3 east = direction(row, column + 1) - q, south = direction(row + 1, column) - q;
      const auto [step, below] =
          derivatives(rays(chart.triangles, chart.points, place.face), place, q, east, south);
      TexelRun run = single(place, row, column);
      run.step = {step[0], step[1]};
      run.below = {below[0], below[1]};
      texels.places.push_back(run);
      texels.runs.push_back(source_ ? located({q, east, south})
                                    : projected(run, place.barycentric));
    }
  }
  return texels;
}

TexelPoints TexelFinder::points(int band, double x, double y) const {
  if (interpolation_ == Interpolation::Sphere) return by_direction(band, x, y);
  TexelPoints texels;
  texels.places = owners_->runs(band, x, y);
  texels.runs.reserve(texels.places.size());
  for (const TexelRun& place : texels.places) {
    if (scene_->target.is_source) {
      texels.runs.push_back(run_in_source(place));
    } else if (!source_) {
      project(place, texels.runs);
    } else {
      locate(place, texels.runs);
    }
  }
  return texels;
}

}  // namespace sphparam
