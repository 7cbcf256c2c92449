#include "bake/texels/calm_walls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/projected_surface.h"
#include "mesh/triangle_geometry.h"
#include "rays/flat_normal.h"
#include "rays/interpolation.h"
#include "sphparam/parallel.h"

// Triangles of a target are probed at some points each, by their area; points beside walls are
// those on triangles that share a vertex with one that has a point on a wall.

namespace sphparam {
namespace {

constexpr int most_probes = 64;  // a triangle
constexpr size_t most_beside = 512, most_on_walls = 512;

/// The i-th of n points spread over a triangle: a row of the two-dimensional sequence of the
/// plastic number, folded into it.
Vector3 spread(int i, int n) {
  if (n == 1) return Vector3::Constant(1.0 / 3);
  double a = std::fmod(0.5 + i * 0.7548776662466927, 1),
         b = std::fmod(0.5 + i * 0.5698402909980532, 1);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return {1 - a - b, a, b};
}

std::vector<double> areas_of(const BakeTarget& target) {
  std::vector<double> areas;
  for (const auto& f : target.chart.triangles.rowwise()) {
    const Vector3 a = target.positions.row(f[0]), b = target.positions.row(f[1]),
                  c = target.positions.row(f[2]);
    areas.push_back(triangle_area(a, b, c));
  }
  return areas;
}

bool stays(const TexelRun& place) { return place.step == std::array<double, 2>{0, 0}; }

bool is_appearance(const SurfaceField& field) {
  return field.kind == FieldKind::Colour || field.eight_bits;
}

}  // namespace

/// A point of the target, and what of the surface it shows.
struct CalmWalls::Probe {
  SurfacePoint at;
  double area;
  Vector3 step, below;
  SurfaceRun run = {};
};

std::vector<CalmWalls::Probe> CalmWalls::probes_of(const BakeTarget& target) {
  const std::vector<double> areas = areas_of(target);
  double all = 0;
  for (const double area : areas) all += area;
  const double mean = all / static_cast<double>(std::max<size_t>(areas.size(), 1));
  std::vector<Probe> probes;
  for (size_t f = 0; f < areas.size(); ++f) {
    const double wanted = mean > 0 ? std::ceil(areas[f] / mean) : 1;
    const int n = static_cast<int>(std::clamp<double>(wanted, 1, most_probes));
    const double side = 1 / std::sqrt(n);
    for (int i = 0; i < n; ++i)
      probes.push_back(
          {{static_cast<Face>(f), spread(i, n)}, areas[f] / n, {-side, side, 0}, {-side, 0, side}});
  }
  return probes;
}

Vector3 CalmWalls::on_target(const SurfacePoint& at) const {
  return interpolate(scene_->target.positions, scene_->target.chart.triangles, at);
}

bool CalmWalls::hides(const SurfacePoint& at, const SurfaceRun& shown) const {
  return share(on_target(at), shown, 0) == 1;
}

/// How much of a texel is wall: nothing up to `beyond`, all of it from twice as far.
double CalmWalls::share(const Vector3& place, const SurfaceRun& run, int i) const {
  const TriangleMesh& mesh = scene_->source.mesh();
  const Vector3 shown =
      interpolate(mesh.positions, mesh.triangles, {run.face, run.first + i * run.step});
  double away = (shown - place).norm();
  // What a line met may be far and something else near. Only distances between matter.
  if (away > beyond_ && !is_nearest(run.found)) {
    const RayScene& rays = scene_->source.surface->rays();
    if (!rays.is_within(2 * beyond_, place, run.face)) return 1;
    away = std::sqrt(rays.nearest(place, run.face, beyond_ * beyond_).squared_distance);
  }
  const double t = std::clamp(away / beyond_ - 1, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::vector<float> CalmWalls::shares(std::span<const SurfaceRun> runs,
                                     std::span<const TexelRun> places) const {
  std::vector<float> shares;
  shares.reserve(runs.size());  // mostly each is one
  size_t run = 0;
  int in_run = 0;
  for (const TexelRun& place : places) {
    for (int i = 0; i < place.count; ++i) {
      shares.push_back(static_cast<float>(share(on_target(place.at(i)), runs[run], in_run)));
      if (++in_run == runs[run].count) ++run, in_run = 0;
    }
  }
  return shares;
}

void CalmWalls::keep_normals(const std::vector<Probe>& probes, const std::vector<char>& is_wall) {
  const auto count = static_cast<size_t>(std::ranges::count(is_wall, 1));
  const size_t stride = (count + most_on_walls - 1) / std::max<size_t>(most_on_walls, 1);
  size_t seen = 0;
  for (size_t i = 0; i < probes.size(); ++i) {
    if (!is_wall[i] || seen++ % stride != 0) continue;
    const Probe& probe = probes[i];
    const auto corner = [&](int k) -> Vector3 {
      return scene_->target.positions.row(scene_->target.chart.triangles(probe.at.face, k));
    };
    wall_points_.push_back(on_target(probe.at));
    wall_normals_.push_back(probe.area * flat_normal(corner(0), corner(1), corner(2)));
  }
}

Vector3 CalmWalls::normal(const SurfaceSample& sample, const Vector3& own) const {
  if (sample.wall == 0) return own;
  const SurfacePoint& place = sample.place;
  const Vector3 at = on_target(place);
  const Vector3 faces = interpolate(scene_->target.outward, scene_->target.chart.triangles, place);
  Vector3 mean = Vector3::Zero();
  for (size_t i = 0; i < wall_points_.size(); ++i) {
    const double alike = wall_normals_[i].dot(faces);  // not of the wall's other side
    if (alike <= 0) continue;
    const double away = (wall_points_[i] - at).squaredNorm() + 4 * beyond_ * beyond_;
    mean += wall_normals_[i] / (away * away);
  }
  mean = mean.stableNormalized();
  const Vector3 mixed = (1 - sample.wall) * own + sample.wall * mean;
  return mean.isZero(0) || mixed.isZero(0) ? own : Vector3(mixed.stableNormalized());
}

/// Finds what each probe shows of the source. Returns whether it is on a wall.
std::vector<char> CalmWalls::project(std::vector<Probe>& probes) const {
  std::vector<char> is_wall(probes.size());
  parallel_for(std::ssize(probes), 256, scene_->threads, [&](std::int64_t from, std::int64_t to) {
    for (auto i = static_cast<size_t>(from); i < static_cast<size_t>(to); ++i) {
      Probe& probe = probes[i];
      probe.run = scene_->source.surface->project(
          scene_->target, {probe.at.face, probe.at.barycentric, probe.step, probe.below});
      is_wall[i] = share(on_target(probe.at), probe.run, 0) > 0;
    }
  });
  return is_wall;
}

double CalmWalls::share_of_area(const std::vector<Probe>& probes,
                                const std::vector<char>& is_wall) {
  double all = 0, walls = 0;
  for (size_t i = 0; i < probes.size(); ++i) {
    all += probes[i].area;
    if (is_wall[i]) walls += probes[i].area;
  }
  return all > 0 ? walls / all : 0;
}

/// Probes that are on no wall, in triangles that share a vertex with one that is.
std::vector<size_t> CalmWalls::beside_walls(const std::vector<Probe>& probes,
                                            const std::vector<char>& is_wall) const {
  const BakeTarget& target = scene_->target;
  std::vector<char> touched(static_cast<size_t>(target.positions.rows()));
  for (size_t i = 0; i < probes.size(); ++i)
    if (is_wall[i])
      for (const Vertex v : target.chart.triangles.row(probes[i].at.face))
        touched[static_cast<size_t>(v)] = 1;
  std::vector<size_t> beside;
  for (size_t i = 0; i < probes.size(); ++i)
    if (!is_wall[i] &&
        std::ranges::any_of(target.chart.triangles.row(probes[i].at.face),
                            [&](Vertex v) { return touched[static_cast<size_t>(v)] != 0; }))
      beside.push_back(i);
  return beside;
}

void CalmWalls::keep_rim(const std::vector<Probe>& probes, const std::vector<size_t>& beside) {
  const size_t stride = (beside.size() + most_beside - 1) / most_beside;
  for (size_t i = 0; i < beside.size(); i += stride) {
    const Probe& probe = probes[beside[i]];
    rim_.push_back(probe.run);
    rim_points_.push_back(on_target(probe.at));
    rim_areas_.push_back(probe.area);
  }
}

std::shared_ptr<const CalmWalls> CalmWalls::find(const BakeScene& scene, double beyond) {
  auto walls = std::shared_ptr<CalmWalls>(new CalmWalls(scene, beyond));
  std::vector<Probe> probes = probes_of(scene.target);
  const std::vector<char> is_wall = walls->project(probes);
  const std::vector<size_t> beside = walls->beside_walls(probes, is_wall);
  if (beside.empty()) return nullptr;
  walls->area_share_ = share_of_area(probes, is_wall);
  walls->keep_normals(probes, is_wall);
  walls->keep_rim(probes, beside);
  return walls;
}

std::vector<float> CalmWalls::rim_values(const SurfaceField& field) const {
  std::vector<float> values(rim_.size() * static_cast<size_t>(field.channels));
  field.evaluate_runs(rim_, values.data());
  return values;
}

void CalmWalls::mean(const Vector3& place, const std::vector<float>& values,
                     std::span<float> mean) const {
  std::array<double, 4> sums{};
  double all = 0;
  for (size_t i = 0; i < rim_points_.size(); ++i) {
    const double away = (rim_points_[i] - place).squaredNorm() + beyond_ * beyond_;
    const double weight = rim_areas_[i] / (away * away);
    all += weight;
    for (size_t c = 0; c < mean.size(); ++c) sums[c] += weight * values[i * mean.size() + c];
  }
  for (size_t c = 0; c < mean.size(); ++c) mean[c] = static_cast<float>(sums[c] / all);
}

void CalmWalls::calm(const std::shared_ptr<const CalmWalls>& walls, SurfaceField& field) {
  if (!walls || !field.evaluate_runs || !is_appearance(field)) return;
  const auto channels = static_cast<size_t>(field.channels);
  std::vector<float> about = walls->rim_values(field);
  field.calm = true;
  const bool clear = field.clear_walls;
  field.amend = [walls, about = std::move(about), channels, clear](std::span<const float> hidden,
                                                                   std::span<const TexelRun> places,
                                                                   float* values) {
    size_t sample = 0;
    std::array<float, 4> calm{};
    for (const TexelRun& place : places) {
      bool known = false;  // the mean: of a place that does not move it is one
      for (int i = 0; i < place.count; ++i, ++sample, values += channels) {
        const float share = hidden[sample];
        if (share == 0) continue;
        if (!known)
          walls->mean(walls->on_target(place.at(i)), about, std::span(calm).first(channels));
        known = stays(place);
        for (size_t c = 0; c < channels; ++c) values[c] += share * (calm[c] - values[c]);
        if (clear) values[channels - 1] = 0;
      }
    }
  };
}

}  // namespace sphparam
