#pragma once

#include <map>
#include <optional>
#include <vector>

#include "correspondence/composed_energy.h"
#include "correspondence/feature_scales.h"
#include "correspondence/moving_surface.h"
#include "correspondence/target_surface.h"
#include "embedding/frame/landmarks.h"
#include "mesh/mesh_hierarchy.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

/// The names that a level's vertices have on the finest.
std::vector<Vertex> names_on_finest(const MeshHierarchy& levels, size_t level);

struct ComposedOptions {
  ComposedEnergy energy = {};
  std::vector<Pin> landmarks = {};  // vertices of the source and the directions that they get
  bool release = false;             // landmarks and features count on the coarse level alone
  const FeatureScales* features = nullptr;  // that are to agree; null: none
  int threads = 0;
  Progress progress = {};
};

/// A map of a source onto the sphere of a target, of least distortion of source → sphere → target:
/// a coarse level first, then level by level up, landmarks held at their directions.
///
/// Every determinant is certain to be positive at every moment; same bits for any number of
/// threads.
class CoarseToFine {
 public:
  /// Borrows all that it is given. Requires: genus 0. Cost: that of the hierarchy.
  CoarseToFine(const TriangleMesh& source, const Topology& topology, const TargetSurface& target,
               const ComposedOptions& options);

  /// Makes the map of a coarse level, the best that so many starts lead to, and returns its energy,
  /// of a unit of area; nothing where there is none. Cost: 0.2 s a start.
  std::optional<double> start(int most_starts);
  /// The same from where this one-to-one map of the source has the vertices, as near as a map of
  /// the coarse level comes. Requires: no landmarks.
  double start_at(const SphereMap& map);
  /// Of the vertices of the level at hand, which is the same after every `start_at`.
  const std::vector<Place>& places() const { return places_; }
  /// Of the landmarks, after `start`: radians from their directions where it had to give up.
  const std::vector<double>& residuals() const { return residuals_; }
  /// The map of the source. Requires: `start` found a level. Cost: linear but for factorisations.
  SphereMap finish();

 private:
  struct State {
    size_t level = 0;
    int newton_level = 0;
    std::vector<Place> places = {};
  };

  size_t level_of(int vertices) const;
  std::optional<double> try_from(size_t level, size_t last);
  bool start_on(size_t level);
  bool reaches_landmarks(size_t level);
  std::optional<SphereMap> embedded(size_t level, const std::vector<Pin>& pins) const;
  bool climb_to(size_t level);
  bool insert(size_t level, std::vector<Place>& places) const;
  void settle(size_t level, int most_steps);
  std::vector<char> held_on(size_t level) const;
  const FeatureScales* features() const { return released_ ? nullptr : options_.features; }

  const TargetSurface& target_;
  const ComposedOptions& options_;
  MeshHierarchy hierarchy_;
  std::vector<std::vector<Vertex>> names_;  // of the landmarks, on each level; -1: removed
  std::vector<Place> places_;               // of the vertices of the level at hand
  std::vector<double> residuals_;
  std::map<size_t, std::vector<double>> failed_;  // residuals of levels that cannot be begun on
  size_t level_ = 0;                              // at hand
  int newton_level_ = 0;                          // vertices of the level of the last Newton steps
  double energy_ = 0;                             // after these
  bool released_ = false;  // landmarks and features no longer count; a map of its own still has
                           // these landmarks
};

/// The same from a map that is one-to-one and has the landmarks: Newton steps and sweeps as long as
/// they pay. A map that the energy has no finite value at comes back as it was.
SphereMap improve_composition(const TriangleMesh& source, const Topology& topology,
                              const TargetSurface& target, const SphereMap& map,
                              const ComposedOptions& options, int most_steps = 30);

/// Of source → sphere → target, of a unit of area.
double energy_of_composition(const TriangleMesh& source, const Topology& topology,
                             const TargetSurface& target, const SphereMap& map,
                             const ComposedEnergy& energy, int threads = 0);

}  // namespace sphparam
