// Random numbers are functions of the seed and the sample's number: 0 of 4 places it in its share
// of the total, 1 and 2 in its element. A point of a triangle: (u, v) of the unit square, where
// u + v > 1 turned about the middle of the diagonal.

#include "measure/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/flat_face.h"
#include "rays/random_numbers.h"

namespace sphparam {

namespace {

double random_of(std::uint64_t seed, std::int64_t sample, int which) {
  return random_fraction(
      seed, 4 * static_cast<std::uint64_t>(sample) + static_cast<std::uint64_t>(which));
}

std::vector<double> face_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(static_cast<size_t>(mesh.face_count()));
  for (Face f = 0; f < mesh.face_count(); ++f) areas[static_cast<size_t>(f)] = face_area(mesh, f);
  return areas;
}

std::vector<std::pair<Vertex, Vertex>> edges_of(const TriangleMesh& mesh) {
  std::vector<std::pair<Vertex, Vertex>> edges;
  edges.reserve(3 * static_cast<size_t>(mesh.face_count()));
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      edges.push_back(
          std::minmax({mesh.triangles(f, corner), mesh.triangles(f, (corner + 1) % 3)}));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<double> lengths_of(const TriangleMesh& mesh,
                               const std::vector<std::pair<Vertex, Vertex>>& edges) {
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) lengths.push_back((mesh.position(b) - mesh.position(a)).norm());
  return lengths;
}

}  // namespace

WeightedDraw::WeightedDraw(const std::vector<double>& weights, std::int64_t count,
                           std::uint64_t seed)
    : sums_(weights), count_(count), last_(0), seed_(seed) {
  double sum = 0;
  for (size_t i = 0; i < sums_.size(); ++i) {
    if (sums_[i] > 0) last_ = static_cast<std::int64_t>(i);
    sum += sums_[i];
    sums_[i] = sum;
  }
  if (!(sum > 0) || !std::isfinite(sum)) {
    throw std::invalid_argument("WeightedDraw: the weights have no sum");
  }
}

std::int64_t WeightedDraw::operator()(std::int64_t i) const {
  const double share = static_cast<double>(i) + random_of(seed_, i, 0);
  const double place = share / static_cast<double>(count_) * sums_.back();
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), place) - sums_.begin();
  return std::min<std::int64_t>(found, last_);
}

FaceSamples::FaceSamples(const TriangleMesh& mesh, std::int64_t count, std::uint64_t seed)
    : mesh_(mesh), draw_(face_areas(mesh), count, seed), seed_(seed) {}

Vector3 FaceSamples::operator()(std::int64_t i) const {
  const auto corners = mesh_.triangles.row(static_cast<Eigen::Index>(draw_(i)));
  double u = random_of(seed_, i, 1), v = random_of(seed_, i, 2);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vector3 a = mesh_.position(corners[0]);
  return a + u * (mesh_.position(corners[1]) - a) + v * (mesh_.position(corners[2]) - a);
}

EdgeSamples::EdgeSamples(const TriangleMesh& mesh, std::int64_t count, std::uint64_t seed)
    : mesh_(mesh),
      edges_(edges_of(mesh)),
      draw_(lengths_of(mesh, edges_), count, seed),
      seed_(seed) {}

Vector3 EdgeSamples::operator()(std::int64_t i) const {
  const auto& [from, to] = edges_[static_cast<size_t>(draw_(i))];
  const Vector3 a = mesh_.position(from);
  return a + random_of(seed_, i, 1) * (mesh_.position(to) - a);
}

}  // namespace sphparam
