#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "bake/texels/texel_owners.h"

namespace sphparam {

/// Walls of a target: what is far from the surface that is baked on it, as where a wrap closes a
/// way through. The nearest points make streaks there, and so do those that lines along its normals
/// meet somewhere; what stands about the wall, carried across as smoothly as can be, does not.
///
/// Ensures: the same for any number of threads. Source: our own; the means are those of D. Shepard,
/// A two-dimensional interpolation function for irregularly-spaced data, 1968, of fourth power.
class CalmWalls {
 public:
  /// None: no walls, or nothing beside them. Requires: a source with a `surface`, which with the
  /// scene outlives it; beyond > 0. Cost: some projections a triangle of the target.
  static std::shared_ptr<const CalmWalls> find(const BakeScene& scene, double beyond);

  /// The normal to be seen at a sample that has this one: on walls a mean of the target's own about
  /// it, for walls have the steps of a lattice. Unit. Cost: as `calm`.
  Vector3 normal(const SurfaceSample& sample, const Vector3& own) const;

  /// Of the target's area, as far as points tell that are spread over it.
  double area_share() const { return area_share_; }

  /// Whether nothing is seen of what a point of the target shows of the source, for it lies far
  /// within a wall. Requires: `shown` is of one sample.
  bool hides(const SurfacePoint& at, const SurfaceRun& shown) const;

  /// How much of what each sample of the runs shows is hidden, in [0, 1]. Requires: `places` are of
  /// as many samples. Cost: at most a nearest point a sample.
  std::vector<float> shares(std::span<const SurfaceRun> runs,
                            std::span<const TexelRun> places) const;

  /// Lets a field be calm on walls: colours and what materials say. Labels, places and measures
  /// stay as they are found. Cost: some hundred products a texel on walls.
  static void calm(const std::shared_ptr<const CalmWalls>& walls, SurfaceField& field);

 private:
  explicit CalmWalls(const BakeScene& scene, double beyond) : scene_(&scene), beyond_(beyond) {}
  struct Probe;
  static std::vector<Probe> probes_of(const BakeTarget& target);
  std::vector<char> project(std::vector<Probe>& probes) const;
  static double share_of_area(const std::vector<Probe>& probes, const std::vector<char>& is_wall);
  std::vector<size_t> beside_walls(const std::vector<Probe>& probes,
                                   const std::vector<char>& is_wall) const;
  void keep_normals(const std::vector<Probe>& probes, const std::vector<char>& is_wall);
  void keep_rim(const std::vector<Probe>& probes, const std::vector<size_t>& beside);
  Vector3 on_target(const SurfacePoint& at) const;
  double share(const Vector3& place, const SurfaceRun& run, int i) const;
  std::vector<float> rim_values(const SurfaceField& field) const;
  void mean(const Vector3& place, const std::vector<float>& values, std::span<float> mean) const;

  const BakeScene* scene_;
  double beyond_;
  double area_share_ = 0;
  // Of points beside walls.
  std::vector<SurfaceRun> rim_;
  std::vector<Vector3> rim_points_;
  std::vector<double> rim_areas_;
  // Of points on walls.
  std::vector<Vector3> wall_points_, wall_normals_;  // times area
};

}  // namespace sphparam
