#pragma once

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// How much fatter than they are rest triangles count. Each squared edge is longer by
/// μ² (⅔ Σ + L²), Σ the sum of the triangle's three and L the edge of an equilateral triangle of
/// the mean area: as if a part μ² of the metrics of two equilateral triangles were added, of one
/// that is as long and of one as large as any. A triangle keeps at least about μ of its length as
/// width, and of L as length; fat ones hardly change, and with μ all come back to what they are.
///
/// What for: the image of a sliver is a sliver, and one that is next to folded blocks all around
/// it. While they are fat, the map finds its place; led from μ to μ it then slims them all at once,
/// as a path-following method follows its barrier to a corner. Their areas add up to more than 4π:
/// of plain meshes by 3 μ², of slivers alone to several times as much. Our own.
struct Fatness {
  double mu = 0;
  double relative = 0, absolute = 0;  // μ² 4/3, μ² L²

  Fatness() = default;
  /// Of `faces` triangles with 4π of area in all.
  Fatness(double part, double faces);

  bool is_none() const { return mu == 0; }
  /// What is added to each squared edge, of edges a and b from a corner. `half_sum` = |a|² + |b|² −
  /// a·b, which is half of Σ.
  template <class Number>
  Number added(Number half_sum) const {
    return relative * half_sum + Number(absolute);
  }
};

RestTriangle fattened(const RestTriangle& triangle, const Fatness& fatness);
/// Those of `measure_source`. 0: as they are.
RestTriangles fattened(RestTriangles source, double mu, int threads);

/// μ by which meshes of slivers are embedded at first.
constexpr double fattening = 0.2;

/// Whether more than 3 in 100 triangles get more than twice their area by it: about those whose
/// width is less than a ninth of their length, or whose area is less than 1/25 of the mean.
bool has_slivers(const RestTriangles& source);

/// What rest triangles count as that are too small or too thin to be mapped as they are.
struct RestFloors {
  double area;  // smaller ones count as equilateral ones of that area, before they are fattened
  Fatness fatness = {};

  RestFloors(double least_area, const Fatness& added = {})  // NOLINT: implicit
      : area(least_area), fatness(added) {}
};

/// With edges a and b from corner 0.
RestTriangle rest_triangle(const Vector3& a, const Vector3& b, const RestFloors& floors);

}  // namespace sphparam
