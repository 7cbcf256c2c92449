#pragma once

#include <array>
#include <cstdint>
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
  /// Requires: a map that `certify` calls bijective; both outlive the locator.
  /// Throws: std::invalid_argument if their sizes differ.
  /// Cost: linear but for one sort; 0.3 µs and 100 bytes a triangle.
  SphereLocator(const Topology& topology, const SphereMap& map, int threads = 0);

  /// The point of the surface that the map takes to the direction q: q ∥ Σ λᵢ xᵢ, λ barycentric.
  /// Ensures: the face contains q by exact signs. On an edge or at a vertex, where several do, it
  ///          is the one of lowest index, and the weights of the other corners are exactly 0.
  /// Requires: q finite and not zero, of any length.
  /// Throws: std::invalid_argument if not; std::logic_error if no face contains q: the map was
  ///         none that `certify` calls bijective.
  /// Cost: about 0.1 µs.
  SurfacePoint locate(const Vector3& direction) const;

  /// The same for each row. Fastest where neighbouring rows are near one another, as the vertices
  /// of a grid are: then a walk starts where the last one ended. Same result for any order and any
  /// number of threads.
  std::vector<SurfacePoint> locate_all(const Points& directions, int threads = 0) const;

 private:
  /// What a walk reads of one face, in one place. Cells are in the order of a space-filling curve.
  struct Cell {
    std::array<Vector3, 3> normals;  // k: xᵢ × xⱼ of the edge (i, j) opposite to corner k
    std::array<std::int32_t, 3>
        across;  // k: 3·cell + edge there, of the neighbour beyond that edge
    Face face;
  };
  struct Found {
    int cell;
    std::array<int, 3> signs;  // of the three edges: 0 or 1
  };

  int sign(const Cell& cell, int edge, const Vector3& q, double bound) const;
  Found walk(const Vector3& q, int start) const;
  Found search(const Vector3& q) const;
  SurfacePoint point(const Vector3& q, const Found& found) const;
  SurfacePoint on_lowest_face(const SurfacePoint& point, const Found& found) const;
  SurfacePoint finish(const Vector3& q, const Found& found) const;
  int start(const Vector3& q) const;

  struct Keyed;
  void make_cells(const std::vector<Keyed>& order, int threads);
  void make_table(const std::vector<Keyed>& order);
  std::int32_t make_entry(const std::vector<Keyed>& order, std::uint64_t key, int bits,
                          size_t first, size_t last, int& near);

  const Topology* topology_;
  const SphereMap* map_;
  double rounding_ = 0;  // of a dot product of a stored normal with a q of |q|₁ = 1
  double reach2_ = 0;    // squared distance of two directions, up to which a walk is quicker
  std::vector<Cell> cells_;
  int level_ = 0;                    // the table has 6·4^level entries, then blocks of 16
  std::vector<std::int32_t> table_;  // a cell; or, negative, ~index of a block of finer entries
};

}  // namespace sphparam
