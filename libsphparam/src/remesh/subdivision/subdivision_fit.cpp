// Places → directions → points of the source; least squares; then the same again with the nearest
// points of the source, and sliding. The area a sample stands for: the source's triangle (p₀, p₁,
// p₂) has the rays x₀, x₁, x₂, and its point Σ λᵢ pᵢ the direction of x = Σ λᵢ xᵢ, so that
//
//   d(area) / d(solid angle) = |(p₁ − p₀) × (p₂ − p₀)| |x|³ / det(x₀, x₁, x₂),
//   d(solid angle) / d(s, t) = det(d, dₛ, dₜ) / |d|³

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "elementary.h"
#include "option_domain.h"
#include "rays/interpolation.h"
#include "rays/ray_scene.h"
#include "remesh/subdivision/limit_stencils.h"
#include "remesh/subdivision/stencil_least_squares.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/parallel.h"
#include "sphparam/remesh/subdivision.h"
#include "sphparam/stopwatch.h"

namespace sphparam {

namespace {

constexpr std::int64_t patch_grain = 64;
constexpr int fewest_along_edge = 4, most_along_edge = 16;
constexpr double sliding_price = 0.03;    // of a distance along the surface
constexpr double early_reduction = 3e-2;  // of residuals, where another round follows

Vector3 area_normal(const TriangleMesh& mesh, Face face) {
  const Vector3 a = mesh.position(mesh.triangles(face, 0));
  return (mesh.position(mesh.triangles(face, 1)) - a)
      .cross(mesh.position(mesh.triangles(face, 2)) - a);
}

double area_of_solid_angle(const TriangleMesh& mesh, const SphereMap& map,
                           const SurfacePoint& point) {
  Eigen::Matrix3d rays;
  for (int k = 0; k < 3; ++k) rays.col(k) = map.point(mesh.triangles(point.face, k));
  return area_normal(mesh, point.face).norm() *
         elementary::pow((rays * point.barycentric).norm(), 3) / rays.determinant();
}

/// A row for each vertex in the direction of a row.
Points points_of(const TriangleMesh& mesh, const std::vector<SurfacePoint>& places) {
  Points points(std::ssize(places), 3);
  for (size_t i = 0; i < places.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) =
        interpolate(mesh.positions, mesh.triangles, places[i]);
  }
  return points;
}

int samples_along_edge(const SubdivisionFitOptions& options, std::int64_t triangles, int patches) {
  if (options.samples_along_edge > 0) return options.samples_along_edge;
  const double wanted = std::sqrt(static_cast<double>(triangles) / patches);
  return static_cast<int>(
      std::ceil(std::clamp<double>(wanted, fewest_along_edge, most_along_edge)));
}

/// The samples of one fit; rows are those of StencilLeastSquares.
class Samples {
 public:
  Samples(const TriangleMesh& source, const SphereMap& map, const LimitSurface& sphere,
          const LimitStencils& stencils, const SphereLocator& locator, int threads)
      : source_(source), stencils_(stencils), threads_(threads) {
    const std::int64_t count = stencils.patch_count() * std::ssize(stencils.places());
    Points directions(count, 3);
    weights.resize(count);
    const double piece = (sphere.topology().scheme() == Scheme::Loop ? 0.5 : 1.0) /
                         static_cast<double>(stencils.places().size());
    for_each(sphere, [&](std::int64_t i, const LimitPoint& point) {
      const double length = point.position.norm();
      directions.row(i) = point.position / length;
      weights[i] = piece * std::abs(point.position.dot(point.by_s.cross(point.by_t))) /
                   (length * length * length);
    });
    const std::vector<SurfacePoint> places = locator.locate_all(directions, threads);
    in_place = points_of(source, places);
    nearest_.resize(places.size());
    for (size_t i = 0; i < places.size(); ++i) {
      nearest_[i] = places[i].face;
      weights[static_cast<Eigen::Index>(i)] *= area_of_solid_angle(source, map, places[i]);
    }
    weights /= weights.mean();
  }

  /// Targets and normals for the next round, and how far the limit is from the source now.
  void project(const RayScene& scene, const LimitSurface& limit) {
    targets = in_place;
    normals.resize(in_place.rows(), 3);
    squared_distances.resize(in_place.rows());
    for_each(limit, [&](std::int64_t i, const LimitPoint& point) {
      const NearestPoint found = scene.nearest(point.position, nearest_[static_cast<size_t>(i)]);
      squared_distances[i] = found.squared_distance;
      normals.row(i) = point.normal();
      if (area_normal(source_, found.on.face).dot(point.normal()) <= 0) return;
      nearest_[static_cast<size_t>(i)] = found.on.face;
      targets.row(i) = interpolate(source_.positions, source_.triangles, found.on);
    });
  }

  Points in_place;  // the source in the samples' directions
  VectorX weights;  // areas; 1 in the mean
  Points targets, normals;
  VectorX squared_distances;

 private:
  template <class Visit>
  void for_each(const LimitSurface& surface, const Visit& visit) const {
    const auto& places = stencils_.places();
    parallel_for(stencils_.patch_count(), patch_grain, threads_,
                 [&](std::int64_t first, std::int64_t last) {
                   for (std::int64_t p = first; p < last; ++p) {
                     const LimitPatch patch = surface.patch(static_cast<int>(p));
                     std::int64_t i = p * std::ssize(places);
                     for (const auto& place : places) {
                       visit(i++, patch.evaluate(place.x(), place.y()));
                     }
                   }
                 });
  }

  const TriangleMesh& source_;
  const LimitStencils& stencils_;
  int threads_;
  std::vector<Face> nearest_;
};

std::shared_ptr<const LimitTopology> topology_of(const SphereGrid& grid, Scheme scheme) try {
  return std::make_shared<LimitTopology>(grid.faces, static_cast<int>(grid.directions.rows()),
                                         scheme);
} catch (const std::invalid_argument& error) {
  throw UnfittableGrid(grid.name + ": " + error.what());
}

void require_domain(const SubdivisionFitOptions& options) {
  require_one_of("scheme", options.scheme, Scheme::CatmullClark);
  require_between("samples_along_edge", options.samples_along_edge, 0, most_samples_along_edge);
  require_at_least("rounds", options.rounds, 0);
  require_more_than("reduction", options.reduction, 0);
  if (!(options.reduction < 1)) refuse_option("reduction", options.reduction, "below 1");
}

/// A fit and what it is made with.
class Fitting {
 public:
  /// Puts the control points and the samples where the map has them.
  Fitting(const MappedMesh& mapped, const SphereGrid& grid, const SubdivisionFitOptions& options)
      : options_(options),
        source_(mapped.mesh()),
        topology_(topology_of(grid, options.scheme)),
        stencils_(*topology_, places_of_samples(), options.threads),
        samples_(source_, mapped.map(), LimitSurface(topology_, grid.directions), stencils_,
                 mapped.locator(), options.threads),
        squares_(stencils_, grid.faces, samples_.weights, options.threads) {
    fit_.topology = topology_;
    fit_.control =
        points_of(source_, mapped.locator().locate_all(grid.directions, options.threads));
    fit_.samples = samples_.weights.size();
    fit_.thin_vertices = squares_.thin_count();
    fit_.sampling_seconds = stopwatch_.lap();
  }

  SubdivisionFit run() {
    minimise(samples_.in_place, options_.rounds == 0);
    fit_.rms_in_place =
        rms((squares_.evaluate(fit_.control) - samples_.in_place).rowwise().squaredNorm().matrix());
    const RayScene scene(source_);
    project(scene, 0);
    for (int round = 1; round <= options_.rounds; ++round) {
      squares_.set_metric(samples_.normals, sliding_price);
      minimise(samples_.targets, round == options_.rounds);
      project(scene, round);
    }
    fit_.rms = rms(samples_.squared_distances);
    fit_.max = std::sqrt(samples_.squared_distances.maxCoeff());
    return std::move(fit_);
  }

 private:
  std::vector<Eigen::Vector2d> places_of_samples() const {
    const int along = samples_along_edge(options_, source_.face_count(), topology_->patch_count());
    return middles_of_pieces(options_.scheme, along);
  }

  void minimise(const Points& targets, bool last) {
    const double reduction =
        last ? options_.reduction : std::max(options_.reduction, early_reduction);
    fit_.steps.push_back(
        squares_.minimise(targets, fit_.control, reduction, options_.progress).steps);
    fit_.solving_seconds += stopwatch_.lap();
  }

  void project(const RayScene& scene, int round) {
    report(options_.progress, "project", static_cast<double>(round) / (options_.rounds + 1));
    samples_.project(scene, LimitSurface(topology_, fit_.control));
    fit_.projecting_seconds += stopwatch_.lap();
  }

  template <class Squared>
  double rms(const Squared& squared) const {
    return std::sqrt(samples_.weights.dot(squared) / samples_.weights.sum());
  }

  const SubdivisionFitOptions& options_;
  const TriangleMesh& source_;
  Stopwatch stopwatch_;
  std::shared_ptr<const LimitTopology> topology_;
  LimitStencils stencils_;
  Samples samples_;
  StencilLeastSquares squares_;
  SubdivisionFit fit_;
};

}  // namespace

SubdivisionFit fit_subdivision(const MappedMesh& mapped, const SphereGrid& grid,
                               const SubdivisionFitOptions& options) {
  require_domain(options);
  require_measurable(mapped.mesh());
  report(options.progress, "samples", 0);
  return Fitting(mapped, grid, options).run();
}

}  // namespace sphparam
