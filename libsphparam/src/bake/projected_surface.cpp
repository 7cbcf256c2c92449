// With p and the unit direction n of a line, and corners a, b, c as seen from p, the triple
// products n·(b×c), n·(c×a), n·(a×b) are as the weights of the point where the line meets the
// triangle's plane. They are linear in p, and their sum is n · (the normal, twice as long as the
// area): it tells which way the triangle faces.

#include "bake/projected_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/triangle_geometry.h"
#include "rays/flat_normal.h"
#include "rays/interpolation.h"
#include "sphparam/io/fillers.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr double passing_by = 4;  // times the nearest distance: 1/cos of 75.5°

struct Line {
  Vector3 point, direction;
};

struct Triangle {
  Vector3 a, b, c;
  Triangle(const TriangleMesh& mesh, Face f)
      : a(mesh.position(mesh.triangles(f, 0))),
        b(mesh.position(mesh.triangles(f, 1))),
        c(mesh.position(mesh.triangles(f, 2))) {}
  Vector3 normal() const { return flat_normal(a, b, c); }
  Vector3 at(const Vector3& w) const { return w[0] * a + w[1] * b + w[2] * c; }
};

/// As the weights of the point where a line along n through p meets the plane.
Vector3 volumes(const Triangle& t, const Vector3& p, const Vector3& n) {
  const Vector3 a = t.a - p, b = t.b - p, c = t.c - p;
  return {n.dot(b.cross(c)), n.dot(c.cross(a)), n.dot(a.cross(b))};
}

/// What the weights change by as p moves by `step`; nothing where the line runs along the plane.
Vector3 change_of_weights(const Triangle& t, const Vector3& n, const Vector3& step) {
  const Vector3 change(n.dot((t.c - t.b).cross(step)), n.dot((t.a - t.c).cross(step)),
                       n.dot((t.b - t.a).cross(step)));
  const Vector3 weights = change / n.dot((t.b - t.a).cross(t.c - t.a));
  return weights.allFinite() ? weights : Vector3::Zero();
}

/// A point of the surface, and how it was found.
struct Met {
  SurfacePoint on;
  double distance;  // along the line
  bool faces_away;
};

constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Places whose rays are cast together, at most.
constexpr size_t bundle = 64;

template <class Item>
using Bundle = std::array<Item, bundle>;

/// Of some lines, which a bundle holds.
struct Lines {
  Bundle<Line> each;
  size_t count = 0;
};

/// Where a line meets a face that a ray along it found; the weights are of doubles.
std::optional<Met> met_on(const ProjectedSurface& surface, const Line& line, Face face) {
  if (face < 0) return std::nullopt;
  const Triangle triangle(surface.file().mesh, face);
  const Vector3 raw = volumes(triangle, line.point, line.direction);
  const double sum = raw.sum();
  const Vector3 inside = (raw / sum).cwiseMax(0);
  if (!(std::isfinite(inside.sum()) && inside.sum() > 0)) return std::nullopt;
  const Vector3 weights = inside / inside.sum();
  return Met{{face, weights}, (triangle.at(weights) - line.point).norm(), sum < 0};
}

/// What the lines first meet on one side, each up to its own distance. A line without a direction
/// meets nothing.
Bundle<std::optional<Met>> first_on(const ProjectedSurface& surface, const Lines& lines,
                                    double side, const Bundle<double>& reaches) {
  Bundle<Ray> rays;
  Bundle<RayHit> hits;
  for (size_t i = 0; i < lines.count; ++i) {
    const Line& line = lines.each[i];
    const Vector3 way = side * line.direction;
    rays[i] = {line.point - surface.rays().clearance() * way, way, reaches[i]};
    if (line.direction.isZero(0)) rays[i] = {line.point, Vector3::UnitZ(), -1};
  }
  surface.rays().first_hits(std::span(rays).first(lines.count), std::span(hits).first(lines.count));
  Bundle<std::optional<Met>> met;
  for (size_t i = 0; i < lines.count; ++i) met[i] = met_on(surface, lines.each[i], hits[i].face);
  return met;
}

bool is_better(const Met& a, const Met& b) {
  if (a.faces_away != b.faces_away) return b.faces_away;
  return a.distance < b.distance;
}

/// Whether nothing is so much nearer that the line passes the surface by.
bool is_here(const ProjectedSurface& surface, const Line& line, const Met& met, Face guess) {
  const double beyond = met.distance - 2 * surface.rays().clearance();
  return beyond <= 0 || !surface.rays().is_within(beyond / passing_by, line.point, guess);
}

/// How far what is met outwards may be from the point to be better than this inwards. A ray from a
/// clearance behind the point; both distances are rounded.
double worth_looking(const ProjectedSurface& surface, const std::optional<Met>& inwards) {
  if (!inwards || inwards->faces_away) return everywhere;
  return inwards->distance + 4 * surface.rays().clearance();
}

/// What a line meets of both sides, the better first.
using BothSides = std::array<std::optional<Met>, 2>;

/// Inwards first: a target mostly lies about what is projected on it, and what is met there bounds
/// the way outwards.
Bundle<BothSides> met_along(const ProjectedSurface& surface, const Lines& lines) {
  Bundle<double> reaches;
  reaches.fill(everywhere);
  const auto inwards = first_on(surface, lines, -1, reaches);
  for (size_t i = 0; i < lines.count; ++i) reaches[i] = worth_looking(surface, inwards[i]);
  const auto outwards = first_on(surface, lines, 1, reaches);
  Bundle<BothSides> met;
  for (size_t i = 0; i < lines.count; ++i) {
    met[i] = {outwards[i], inwards[i]};
    if (!outwards[i] || (inwards[i] && is_better(*inwards[i], *outwards[i])))
      std::swap(met[i][0], met[i][1]);
  }
  return met;
}

/// The better one that the line does not pass by.
std::optional<Met> shown(const ProjectedSurface& surface, const Line& line, const BothSides& sides,
                         Face guess) {
  for (const auto& met : sides)
    if (met && is_here(surface, line, *met, guess)) return met;
  return std::nullopt;
}

Line line_of(const BakeTarget& target, const PlaceOnTarget& place) {
  const SurfacePoint point{place.face, place.at};
  const Triangles& triangles = target.chart.triangles;
  return {interpolate(target.positions, triangles, point),
          interpolate(target.outward, triangles, point).stableNormalized()};
}

/// What a place shows, from what its line met; else of the nearest point.
SurfaceRun run_at(const ProjectedSurface& surface, const BakeTarget& target,
                  const PlaceOnTarget& place, const Line& line, const std::optional<Met>& met,
                  Face guess) {
  const SurfacePoint on = met ? met->on : surface.rays().nearest(line.point, guess).on;
  const Triangle triangle(surface.file().mesh, on.face);
  const Vector3 normal = triangle.normal(), along = met ? line.direction : normal;
  const bool away = met ? met->faces_away : normal.dot(line.direction) < 0;
  const Triangles& triangles = target.chart.triangles;
  const auto covered = [&](const Vector3& weights) {
    return change_of_weights(triangle, along,
                             interpolate(target.positions, triangles, {place.face, weights}));
  };
  return {.face = on.face,
          .count = 1,
          .first = on.barycentric,
          .step = covered(place.step),
          .below = covered(place.below),
          .found = met ? (away ? Found::Back : Found::Here)
                       : (away ? Found::NearestBack : Found::Nearest)};
}

}  // namespace

ProjectedSurface::ProjectedSurface(MeshFile file) : file_(std::move(file)) {
  if (file_.mesh.face_count() == 0) throw FieldError("the surface to bake from has no triangles");
  const FillerMarks fillers = fillers_of(file_);
  surface_ = fillers.empty() ? file_.mesh : surface_in_place(file_.mesh, fillers);
  rays_ = std::make_unique<const RayScene>(surface_);
}

void ProjectedSurface::project(const BakeTarget& target, std::span<const PlaceOnTarget> places,
                               Face guess, std::vector<SurfaceRun>& runs) const {
  for (; !places.empty(); places = places.subspan(std::min(bundle, places.size()))) {
    project_some(target, places.first(std::min(bundle, places.size())), guess, runs);
    guess = runs.back().face;
  }
}

void ProjectedSurface::project_some(const BakeTarget& target, std::span<const PlaceOnTarget> places,
                                    Face guess, std::vector<SurfaceRun>& runs) const {
  Lines lines;
  for (const PlaceOnTarget& place : places) lines.each[lines.count++] = line_of(target, place);
  const Bundle<BothSides> met = met_along(*this, lines);
  for (size_t i = 0; i < places.size(); ++i) {
    runs.push_back(run_at(*this, target, places[i], lines.each[i],
                          shown(*this, lines.each[i], met[i], guess), guess));
    guess = runs.back().face;
  }
}

namespace {

/// What a triangle of the target says of its middle.
struct Probe {
  double area, distance;
  Found found;
};

Probe probe(const ProjectedSurface& surface, const BakeTarget& target, Face f,
            const SurfaceRun& run) {
  const auto corner = [&](int k) -> Vector3 {
    return target.positions.row(target.chart.triangles(f, k));
  };
  const Vector3 from = (corner(0) + corner(1) + corner(2)) / 3;
  return {triangle_area(corner(0), corner(1), corner(2)),
          (Triangle(surface.file().mesh, run.face).at(run.first) - from).norm(), run.found};
}

/// The distance that half of the area is within.
double median_distance(std::vector<Probe> probes, double area) {
  std::ranges::stable_sort(probes, {}, &Probe::distance);
  double within = 0;
  for (const Probe& one : probes)
    if ((within += one.area) >= area / 2) return one.distance;
  return 0;
}

/// Of every triangle of the target.
std::vector<Probe> probe_all(const ProjectedSurface& surface, const BakeTarget& target,
                             int threads) {
  std::vector<Probe> probes(static_cast<size_t>(target.chart.triangles.rows()));
  parallel_for(std::ssize(probes), 256, threads, [&](std::int64_t from, std::int64_t to) {
    const auto first = static_cast<Face>(from), last = static_cast<Face>(to);
    std::vector<PlaceOnTarget> middles;
    for (Face f = first; f < last; ++f)
      middles.push_back({f, Vector3::Constant(1.0 / 3), Vector3::Zero(), Vector3::Zero()});
    std::vector<SurfaceRun> runs;
    surface.project(target, middles, -1, runs);
    for (Face f = first; f < last; ++f)
      probes[static_cast<size_t>(f)] =
          probe(surface, target, f, runs[static_cast<size_t>(f - first)]);
  });
  return probes;
}

ProjectionShares shares_of(std::vector<Probe> probes, double diagonal) {
  ProjectionShares shares;
  double area = 0;
  for (const Probe& one : probes) {
    area += one.area;
    if (is_back(one.found)) shares.back += one.area;
    if (is_nearest(one.found)) shares.nearest += one.area;
    shares.farthest = std::max(shares.farthest, one.distance);
  }
  if (!(area > 0)) return shares;
  shares.back /= area;
  shares.nearest /= area;
  shares.median = median_distance(std::move(probes), area) / diagonal;
  shares.farthest /= diagonal;
  return shares;
}

}  // namespace

ProjectionShares measure_projection(const ProjectedSurface& surface, const BakeTarget& target,
                                    int threads) {
  return shares_of(probe_all(surface, target, threads), surface.rays().diagonal());
}

}  // namespace sphparam
