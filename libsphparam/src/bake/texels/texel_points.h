#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "bake/texels/texel_owners.h"
#include "sphparam/bake/interpolation.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

struct PlaceOnTarget;

/// The points of some texels, row by row from the west: runs[i] in the source mesh, and, for as
/// many texels, places[i] in the target's chart.
struct TexelPoints {
  std::vector<SurfaceRun> runs;
  std::vector<TexelRun> places;
};

/// How many points a texel is looked at, side by side to the east and to the south.
struct GridSize {
  int east = 1, south = 1;

  int count() const { return east * south; }
  void include(const GridSize& other) {
    east = std::max(east, other.east);
    south = std::max(south, other.south);
  }
};

/// Finds the points of the source mesh that the texels of an image show.
///
/// With `Uv`, the texel's owner in the target's chart gives a point of the target; where that is
/// another mesh than the source, the direction that its map takes the point to leads to the point
/// of the source. With `Sphere`, the direction of the texel's centre is located in the maps. Where
/// the source is a surface without a map, points of the target are projected on it.
/// Source: our own. Source and target share the sphere: no ray is cast, no cage needed.
class TexelFinder {
 public:
  /// A direction, and what it changes by to the east and to the south.
  struct Look {
    Vector3 q, east, south;
  };

  /// Both outlive it. Requires for `Sphere`: no inverted faces in the chart (else throws
  /// std::invalid_argument).
  TexelFinder(const BakeScene& scene, const TexelOwners& owners, Interpolation interpolation,
              int threads);

  /// The points of the texels of a band at (column + x, row + y), 0 < x, y < 1.
  /// Ensures: same result for any number of threads. Cost: some ns a texel where the source is the
  /// target and `Uv`; else some 0.1 µs.
  TexelPoints points(int band, double x, double y) const;

  /// The source run of a run of the chart. Requires: the source is the target.
  SurfaceRun run_in_source(const TexelRun& place) const;

  /// Appends a grid of points of the source in a texel, row by row: those of the middles of its
  /// parts, and what a part covers, whose solid angle is narrower nearer to a pole. Of `Uv`, parts
  /// within the texel's face are as it leads to them, others by their directions; on a surface
  /// without a map all are on the plane of the face. `place`: the run of one texel of the chart at
  /// its centre. `near`: a face of the source that may be near, which changes nothing.
  /// Requires: the source is not the target, or `Sphere`.
  void grid(const TexelRun& place, GridSize size, Face near, std::vector<SurfaceRun>& runs) const;

  /// Whether each texel is located by itself, by direction or by projection; else the chart's
  /// triangles lead to its point.
  bool by_location() const { return source_ != nullptr || !scene_->source.mapped; }
  const TexelOwners& owners() const { return *owners_; }

 private:
  void find_refined();
  void look_in(const MappedMesh& mapped);
  void look_on_chart(int threads);
  void locate(const TexelRun& place, std::vector<SurfaceRun>& runs) const;
  void project(const TexelRun& place, std::vector<SurfaceRun>& runs) const;
  SurfaceRun projected(const TexelRun& place, const Vector3& at) const;
  SurfaceRun located(const Look& look) const;
  PlaceOnTarget on_target(const Look& look) const;
  TexelPoints by_direction(int band, double x, double y) const;

  const BakeScene* scene_;
  const TexelOwners* owners_;
  Interpolation interpolation_;
  // Of faces that are not the source's own: columns are the weights of the corners in the source.
  std::vector<int> refined_;  // per chart face, into corners_; −1: the source's own
  std::vector<Eigen::Matrix3d> corners_;
  const SphereLocator* source_ = nullptr;  // of the source's map, where points are located
  // Of a radial map the vertices as seen from its centre; else nothing.
  std::optional<Points> seen_from_centre_;
  std::optional<Topology> chart_topology_;
  std::optional<SphereMap> chart_map_;
  std::optional<SphereLocator> chart_;  // of the chart's refined map
};

}  // namespace sphparam
