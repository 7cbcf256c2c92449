#include "bake/calm_walls.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <vector>

#include "bake/bake_rows.h"
#include "bake/projected_surface.h"
#include "sphparam/parallel.h"

// Of a wall's vertices those that triangles beside it have too are its rim: their values are means
// of what these triangles show. The others have the mean of their neighbours, L x = b.

namespace sphparam {
namespace {

using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool is_appearance(const SurfaceField& field) {
  static const std::vector<std::string> numbers = {"orm", "roughness", "metallic", "occlusion"};
  return field.kind == FieldKind::Colour || std::ranges::count(numbers, field.name) > 0;
}

bool is_wall(const FillerMarks& walls, Face f) { return walls[static_cast<size_t>(f)] != 0; }

std::vector<char> vertices_of(const BakeTarget& target, bool of_walls) {
  std::vector<char> found(static_cast<size_t>(target.positions.rows()), 0);
  for (Face f = 0; f < target.chart.triangles.rows(); ++f) {
    if (is_wall(target.walls, f) != of_walls) continue;
    for (int k = 0; k < 3; ++k) found[static_cast<size_t>(target.chart.triangles(f, k))] = 1;
  }
  return found;
}

/// The middle of a face, each texel as large as a third of it.
TexelRun middle_of(Face f) {
  return {f, 0, 0, 1, {1.0 / 3, 1.0 / 3}, {1.0 / 3, 0}, {0, 1.0 / 3}};
}

SurfaceRun seen_at(const BakeScene& scene, const TexelRun& place) {
  const auto change = [](const std::array<double, 2>& w) { return Vector3(w[0], w[1], -w[0] - w[1]); };
  return scene.source.surface->project(
      scene.target,
      {place.face, Vector3::Constant(1.0 / 3), change(place.step), change(place.below)});
}

/// Values at the rims of walls, means of those of the faces beside them; zero elsewhere.
Values values_at_rims(const SurfaceField& field, const BakeScene& scene,
                      const std::vector<char>& on_wall) {
  const Triangles& triangles = scene.target.chart.triangles;
  std::vector<TexelRun> places;
  std::vector<SurfaceRun> runs;
  for (Face f = 0; f < triangles.rows(); ++f) {
    const bool touches = std::ranges::any_of(
        triangles.row(f), [&](Vertex v) { return on_wall[static_cast<size_t>(v)] != 0; });
    if (is_wall(scene.target.walls, f) || !touches) continue;
    places.push_back(middle_of(f));
    runs.push_back(seen_at(scene, places.back()));
  }
  const std::vector<float> seen = values_at(field, runs, places);
  Values sums = Values::Zero(scene.target.positions.rows(), field.channels);
  VectorX counts = VectorX::Zero(sums.rows());
  for (size_t i = 0; i < places.size(); ++i) {
    const auto value = Eigen::Map<const Eigen::RowVectorXf>(
        seen.data() + i * static_cast<size_t>(field.channels), field.channels);
    for (const Vertex v : triangles.row(places[i].face)) {
      sums.row(v) += value.cast<double>();
      counts[v] += 1;
    }
  }
  return sums.array().colwise() / counts.array().max(1);
}

/// Makes the vertices within walls the means of their neighbours.
void carry_across(const BakeTarget& target, const std::vector<char>& on_wall,
                  const std::vector<char>& on_rim, Values& values) {
  std::vector<int> number(on_wall.size(), -1);
  int count = 0;
  for (size_t v = 0; v < on_wall.size(); ++v)
    if (on_wall[v] && !on_rim[v]) number[v] = count++;
  if (count == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  Values right = Values::Zero(count, values.cols());
  for (Face f = 0; f < target.chart.triangles.rows(); ++f) {
    if (!is_wall(target.walls, f)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vertex a = target.chart.triangles(f, k), b = target.chart.triangles(f, (k + 1) % 3);
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        const int row = number[static_cast<size_t>(from)], column = number[static_cast<size_t>(to)];
        if (row < 0) continue;
        entries.emplace_back(row, row, 1);
        if (column >= 0) entries.emplace_back(row, column, -1);
        if (column < 0) right.row(row) += values.row(to);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Values within = factor.solve(right);
  for (size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) values.row(static_cast<Eigen::Index>(v)) = within.row(number[v]);
}

Values smooth_values(const SurfaceField& field, const BakeScene& scene) {
  const std::vector<char> on_wall = vertices_of(scene.target, true),
                          on_rim = vertices_of(scene.target, false);
  Values values = values_at_rims(field, scene, on_wall);
  carry_across(scene.target, on_wall, on_rim, values);
  return values;
}

Values flat_normals(const BakeTarget& target) {
  Values values = Values::Zero(target.positions.rows(), 3);
  values.col(2).setOnes();
  return values;
}

}  // namespace

std::shared_ptr<const CalmWalls> CalmWalls::make(const SurfaceField& field,
                                                 const BakeScene& scene) {
  if (scene.target.walls.empty()) return nullptr;
  Values values;
  if (field.name == "normal-tangent") {
    values = flat_normals(scene.target);
  } else if (field.name == "normal-object") {
    values = scene.target.normals;
  } else if (is_appearance(field)) {
    values = smooth_values(field, scene);
  } else {
    return nullptr;
  }
  auto walls = std::make_shared<CalmWalls>();
  walls->triangles_ = scene.target.chart.triangles;
  walls->walls_ = scene.target.walls;
  walls->values_ = values.cast<float>();
  return walls;
}

void CalmWalls::fill(std::span<const TexelRun> places, int channels, float* values) const {
  for (const TexelRun& run : places) {
    for (int i = 0; i < run.count; ++i, values += channels) {
      if (!is_wall(walls_, run.face)) continue;
      const auto a = static_cast<float>(run.weights[0] + i * run.step[0]),
                 b = static_cast<float>(run.weights[1] + i * run.step[1]);
      const auto corner = [&](int k) { return values_.row(triangles_(run.face, k)); };
      Eigen::Map<Eigen::RowVectorXf>(values, channels) =
          a * corner(0) + b * corner(1) + (1 - a - b) * corner(2);
    }
  }
}

FillerMarks walls_of(const BakeTarget& target, const ProjectedSurface& surface, double beyond,
                     int threads) {
  std::vector<char> is_far(static_cast<size_t>(target.positions.rows()));
  parallel_for(std::ssize(is_far), 256, threads, [&](std::int64_t from, std::int64_t to) {
    for (auto v = from; v < to; ++v)
      is_far[static_cast<size_t>(v)] = !surface.rays().is_within(beyond, target.positions.row(v));
  });
  if (std::ranges::count(is_far, 0) == 0) return {};  // all of it is elsewhere
  FillerMarks walls;
  for (const auto& f : target.chart.triangles.rowwise())
    walls.push_back(std::ranges::all_of(f, [&](Vertex v) { return is_far[static_cast<size_t>(v)]; }));
  if (std::ranges::count(walls, 1) == 0) walls.clear();
  return walls;
}

}  // namespace sphparam
