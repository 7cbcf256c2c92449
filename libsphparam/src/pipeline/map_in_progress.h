#pragma once

#include <optional>
#include <string>
#include <utility>

#include "mesh/unit_size.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/stopwatch.h"

namespace sphparam {

/// `made_by` of a map that a balance of angles against areas came last to.
inline constexpr char balanced_map[] = "balance";

/// What the stages of the pipeline work on: the mesh, the wishes, and the map so far, with its
/// certificate and the record of what was done.
class MapInProgress {
  const std::optional<Rescaled> rescaled_;

 public:
  /// Borrows all three. Requires: `require_sphere` accepts them.
  MapInProgress(const TriangleMesh& mesh, const Topology& topology,
                const ParameterizeOptions& options);
  MapInProgress(const MapInProgress&) = delete;  // it may borrow from itself
  MapInProgress& operator=(const MapInProgress&) = delete;

  const Topology& topology;
  const TriangleMesh& given;
  const TriangleMesh& mesh;  // the same at about unit size, if its squares could overflow or vanish
  const ParameterizeOptions& options;
  DistortionEnergy energy;  // minimised at last: with the λ that a balance has found
  bool tried_to_embed = false;
  /// Directions that a map which is made anew is turned to; empty: it may lie as it comes.
  SphereMap orientation = {};
  Parameterization result;

  /// Of the mesh; measured when first needed.
  const RestTriangles& source();
  /// `distortion_energy` of the surface: fillers may be as much distorted as they like.
  double surface_energy(const SphereMap& map, const DistortionEnergy& measure);
  /// What the map is optimal for: the source, or what a balance has made of it.
  const RestTriangles& aim() { return aim_.empty() ? source() : aim_; }
  void aim_at(RestTriangles aim) { aim_ = std::move(aim); }

  /// What a balance has changed, to go back to where its map is not taken.
  struct BalanceState {
    DistortionEnergy energy;
    RestTriangles aim;
    std::optional<BalanceRecord> record;
  };
  BalanceState balance_state() const { return {energy, aim_, result.balance}; }
  void restore(BalanceState state);

  bool certified() const { return result.certificate.bijective(); }

  /// `map` is the map so far, with its certificate.
  void accept(std::string made_by, SphereMap map);
  /// Takes a map that differs from the last one by its frame; false: it is not certified, and the
  /// last one stays.
  bool accept_if_certified(SphereMap map);
  void forget_poles();

  /// Puts what a stage has made among the stages.
  void record(std::string name, const SphereMap& map, long planar_folds = -1);
  void warn(std::string text) { result.warnings.push_back(std::move(text)); }
  /// Seconds since the last one.
  double lap() { return stopwatch_.lap(); }

  /// With `measure_stages`.
  long count_folds(const SphereMap& map) const;
  std::optional<DistortionSummary> measured(const SphereMap& map) const;

 private:
  RestTriangles source_, aim_;
  Stopwatch stopwatch_;
};

}  // namespace sphparam
