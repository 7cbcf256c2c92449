#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Elements drawn in proportion to their weights: the total is cut into `count` equal shares, and
/// draw i is the element at a random place of share i. Each draw of its own number, so that they
/// may be asked for in any order; elements ascend with i.
class WeightedDraw {
 public:
  /// Requires: weights ≥ 0 and finite, not all 0; count ≥ 1. Throws: std::invalid_argument.
  WeightedDraw(const std::vector<double>& weights, std::int64_t count, std::uint64_t seed);

  std::int64_t count() const { return count_; }
  /// Ensures: its weight is not 0. Cost: O(log #weights).
  std::int64_t operator()(std::int64_t i) const;

 private:
  std::vector<double> sums_;  // of the weights up to and with this one
  std::int64_t count_;
  std::int64_t last_;  // with a weight
  std::uint64_t seed_;
};

/// Points uniformly distributed over the area of a mesh.
class FaceSamples {
 public:
  /// Requires: some triangle has an area; the mesh outlives the samples.
  FaceSamples(const TriangleMesh& mesh, std::int64_t count, std::uint64_t seed);
  std::int64_t count() const { return draw_.count(); }
  Vector3 operator()(std::int64_t i) const;

 private:
  const TriangleMesh& mesh_;
  WeightedDraw draw_;
  std::uint64_t seed_;
};

/// Points uniformly distributed over the edges of a mesh, each edge once however many triangles
/// have it.
class EdgeSamples {
 public:
  /// Requires: some edge has a length; the mesh outlives the samples. Cost: O(#F log #F).
  EdgeSamples(const TriangleMesh& mesh, std::int64_t count, std::uint64_t seed);
  std::int64_t count() const { return draw_.count(); }
  Vector3 operator()(std::int64_t i) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<std::pair<Vertex, Vertex>> edges_;
  WeightedDraw draw_;
  std::uint64_t seed_;
};

}  // namespace sphparam
