#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Finds the triangle of a sphere map that a direction lies in, exactly.
///
/// A table over the six sides of a cube, finer where triangles are small, names a face near every
/// direction; from there a walk crosses edges until all three signs say "inside". Signs are exact:
/// a floating-point filter on stored edge normals decides almost all, `orientation` the rest.
/// Source: our own; walks by random choice of the edge: Devillers, Pion, Teillaud, "Walking in a
/// triangulation" (2002), which end in every triangulation.
class SphereLocator {
 public:
  using PointsView = const Eigen::Ref<const Points>&;

  /// Requires: a map that `certify` calls bijective; both outlive the locator.
  /// Throws: std::invalid_argument if their sizes differ.
  /// Cost: linear but for one sort; 0.3 µs and 100 bytes a triangle.
  SphereLocator(const Topology& topology, const SphereMap& map, int threads = 0);
  SphereLocator(const Topology&&, const SphereMap&, int = 0) = delete;
  SphereLocator(const Topology&, const SphereMap&&, int = 0) = delete;
  SphereLocator(const Topology&&, const SphereMap&&, int = 0) = delete;

  /// The point of the surface that the map takes to the direction q: q ∥ Σ λᵢ xᵢ, λ barycentric.
  /// Ensures: the face contains q by exact signs. On an edge or at a vertex, where several do, it
  ///          is the one of lowest index, and the weights of the other corners are exactly 0.
  /// Requires: q finite and not zero, of any length.
  /// Throws: std::invalid_argument if not; std::logic_error if no face contains q: the map was
  ///         none that `certify` calls bijective.
  /// Cost: about 0.2 µs alone; 0.025 to 0.1 µs among many (see `locate_all`).
  SurfacePoint locate(const Vector3& direction) const;

  /// The same for each row. Rows that are near the ones before them, as the vertices of a grid
  /// are, are walked to from there; others are sorted along a curve first, block by block. Same
  /// result for any order and any number of threads.
  std::vector<SurfacePoint> locate_all(const Points& directions, int threads = 0) const;
  /// The same into memory that is there, one point a row.
  /// Throws: std::invalid_argument if their numbers differ.
  void locate_all(PointsView directions, std::span<SurfacePoint> points, int threads = 0) const;

 private:
  friend class RowLocator;  // along rows of images

  /// What a walk reads of one face, in one place. Cells are in the order of a space-filling curve.
  struct Cell {
    std::array<double, 3> x, y, z;       // k: xᵢ × xⱼ of the edge (i, j) opposite to corner k
    std::array<std::int32_t, 3> across;  // k: the cell beyond that edge
    Face face;
  };
  /// Where a walk ended: weights ∝ dets; all signs are positive unless `touches` says otherwise.
  struct Found {
    std::int32_t cell;
    bool touches;  // an edge, perhaps: exact signs tell
    std::array<double, 3> dets;
  };

  static std::array<double, 3> dets(const Cell& cell, const Vector3& q);
  Found met(std::int32_t cell, const std::array<double, 3>& dets) const;
  int sign(const Cell& cell, int edge, double det, const Vector3& q) const;
  int edge_to_cross(const Cell& cell, const Found& found, const Vector3& q, int offset) const;
  Found walk(const Vector3& q, std::int32_t start) const;
  Found wander(const Vector3& q, std::int32_t start) const;
  std::int32_t step(const Vector3& q, std::int32_t at) const;
  SurfacePoint finish(const Vector3& q, const Found& found) const;
  bool settle(const Vector3& q, std::int32_t at, SurfacePoint& point) const;
  SurfacePoint finish_at_edge(const Vector3& q, const Found& found) const;
  Vector3 small_weights(const Vector3& q, Face face) const;
  std::int32_t start(const Vector3& q) const;
  template <class RowAt>
  void locate_in_order(PointsView directions, std::int64_t first, std::int64_t last,
                       const RowAt& row_at, SurfacePoint* points) const;
  bool is_coherent(PointsView directions) const;

  struct Keyed;
  void make_cells(const std::vector<Keyed>& order, int threads);
  void make_table(const std::vector<Keyed>& order);
  std::int32_t make_entry(const std::vector<Keyed>& order, std::uint64_t key, int bits,
                          size_t first, size_t last, std::int32_t& near);

  const Topology* topology_;
  const SphereMap* map_;
  double bound_ = 0;  // of the rounding in a dot product of a stored normal with a usable q
  std::vector<Cell> cells_;
  int level_ = 0;                    // the table has 6·4^level entries, then blocks of 16
  std::vector<std::int32_t> table_;  // a cell; or, negative, ~index of a block of finer entries
};

}  // namespace sphparam
