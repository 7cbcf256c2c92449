#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

/// Where a face of a grid lies on the source, and on which side of its seams.
struct Middle {
  Vector3 direction;
  SurfacePoint point;
};

/// Values at the corners of a mesh's faces (texture coordinates, normals), which may differ across
/// edges: those edges are seams, and they divide the mesh into charts.
///
/// A face of a grid takes all its corners from the chart that its middle lies in. A corner beyond
/// the chart's end gets the values of that end, where the great circle from the middle leaves it,
/// so that nothing is ever interpolated across a seam.
class Seams {
 public:
  /// `values`: 3·#F rows of `width` numbers; all arguments outlive this.
  Seams(const Topology& topology, const SphereLocator& locator, const double* values, int width);

  /// The values at a corner of a face with that middle; `at` is where the corner lies.
  /// Ensures: at a vertex of the chart, its values there, bit for bit.
  void evaluate(const Middle& middle, const Vector3& direction, const SurfacePoint& at,
                double* result) const;

  int chart_count() const { return chart_count_; }

 private:
  bool agree_across(Halfedge h) const;
  bool agree(Halfedge a, Halfedge b) const;
  bool find_in_chart(int chart, const SurfacePoint& at, SurfacePoint& found) const;
  void put(const SurfacePoint& point, double* result) const;

  const Topology& topology_;
  const SphereLocator& locator_;
  const double* values_;
  int width_;
  int chart_count_ = 0;
  std::vector<int> chart_of_;  // #F
};

}  // namespace sphparam
