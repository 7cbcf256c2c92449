#pragma once

#include <limits>
#include <optional>

#include "embedding/constructions/kneading.h"
#include "embedding/constructions/level_embedding.h"
#include "embedding/constructions/rising_progress.h"
#include "embedding/newton/newton_refinement.h"
#include "embedding/newton/optimise.h"

namespace sphparam {

/// Embeds one mesh in several ways, and keeps the lowest map. What `embed_progressively` says of
/// starts, steps and slivers is done here. All arguments outlive it.
class Starts {
 public:
  Starts(const TriangleMesh& mesh, const Topology& topology, const ProgressiveOptions& options,
         const KeptVertices& keep);
  Starts(const Starts&) = delete;
  Starts& operator=(const Starts&) = delete;

  /// One map by the energy asked for, and nothing more. No map: nothing found room.
  ProgressiveEmbedding first();

  /// The lowest of all. No map: nothing found room. A map with pressed fillers is the first, for
  /// the caller to settle.
  ProgressiveEmbedding lowest();

  RefinementOptions steps(const DistortionEnergy& energy, Quality quality) const;
  /// Steps towards the energy of a map that was found by another one; notes what they leave.
  void refine(ProgressiveEmbedding& embedding, const RefinementOptions& how) const;

 private:
  /// How a start's energy compares with that of the lowest map before it.
  enum class Found { Lower, Same, Higher };

  /// How a map is led from the λ it was made by to the one asked for: λ is multiplied by `factor`
  /// as often as needed, with at most `steps` steps each time, while they gain `least_gain`.
  struct Way {
    double factor, least_gain;
    int steps;
  };
  static const Way up, down;  // from a smaller λ, from a greater one

  static constexpr double any_energy = std::numeric_limits<double>::infinity();

  // --- One embedding ---

  /// Of starts: the steps of the best are for the lowest of them, at last.
  Quality start_quality() const;
  /// `demanding`, `most_blocked`: as in StartOptions.
  ProgressiveEmbedding embed(const DistortionEnergy& energy, Quality quality,
                             double demanding = any_energy, int most_blocked = 0) const;
  /// By this energy, or where that finds no room by greater λ first: weighing areas more keeps
  /// protrusions from shrinking to where doubles have no room left.
  ProgressiveEmbedding embed_with_room(const DistortionEnergy& energy,
                                       double demanding = any_energy, int most_blocked = 0) const;
  /// With the slivers fat at first (slivers.h); all starts are tried so, the lowest is slimmed.
  ProgressiveEmbedding embed_fattened(double demanding);
  /// From the λ by which a map was made to the energy asked for. No map afterwards: it was clear on
  /// the way that it would not become the lowest.
  void lead(ProgressiveEmbedding& start, double lambda, const Way& way) const;

  // --- Which starts are tried ---

  /// The pins, led from where the map without pins has them; the rest stays folded as it is there.
  /// Returns whether that map is as low as the lowest, or is now the lowest.
  bool try_free_map();
  /// Other starts, where sweeps did not suffice.
  void try_more(double demanding);
  void try_others();
  Found try_nearly_conformal(double lambda);
  /// A second nearly conformal start, where minima may be many: how far two of them are apart says
  /// how much energy may be left.
  void compare_minima();
  /// Whether slivers stopped the steps of the lowest map. A map that has had no steps gets a few
  /// for this; where there is no map slivers may be what left no room.
  bool finds_slivers_in_the_way();
  /// The first map waits for its steps until it is clear that it needs them: it does where the best
  /// is wanted, or where this start is not clearly better.
  void give_steps_unless(const ProgressiveEmbedding& start);

  // --- What the lowest map gets at last ---

  /// Kneads by angles as long as that pays, then by areas, in turn until neither does. As much as
  /// the last round gained may be left.
  void knead_lowest();
  /// What a round of kneading gained, as a share of the energy.
  double gain_by(Kneading kneading);
  /// Steps as the best gets them, within a budget, where steps ended early or minima are far apart.
  void go_on();

  // --- How maps compare ---

  /// The start becomes the lowest map if it misses the pins less, or as much with less energy.
  Found keep_lower(ProgressiveEmbedding start);
  bool is_clearly_better(const SphereMap& map) const;
  /// How much less it misses the pins than the lowest map, in radians of all pins together. Maps
  /// that both miss them by next to nothing are alike, unless one of them is exact.
  double nearer_pins(const SphereMap& map) const;
  double missed_by(const SphereMap& map) const;
  double energy_of(const SphereMap& map) const;
  OptimiseOptions step_of(const DistortionEnergy& energy, double least_gain, int steps) const;
  /// Measured whenever it is needed: cheaper than its room while levels are embedded.
  RestTriangles source() const;

  // --- What is known of the lowest map ---

  bool is_best() const { return options_.quality == Quality::Best; }
  bool is_draft() const { return options_.quality == Quality::Draft; }
  /// Whether the energy is more than so many times an isometry's.
  bool exceeds(double isometries) const;
  bool best_of_many() const;
  /// Whether steps to come would take much of the energy; what is not a number nobody knows, and it
  /// is taken for much.
  bool is_far() const;
  bool ended_early() const;
  /// Of a round that moves the pins of the map without pins: rounds are bounded by it.
  double work_of_pins() const;

  const TriangleMesh& mesh_;
  const Topology& topology_;
  const ProgressiveOptions& options_;
  const KeptVertices& keep_;
  const DistortionEnergy wanted_;
  RisingProgress rising_;
  const Progress progress_;

  ProgressiveEmbedding lowest_;
  double energy_ = 0, first_energy_ = 0;  // as wanted: of the lowest map, and of the first
  std::optional<double> latest_;          // of the start that came last, if it had a map to compare
  double apart_ = 0;                      // how far two minima are, as a share of the energy
  double fatness_ = 0;                    // of all that is measured, while slivers are fat
  bool slimmed_ = false;                  // whether the lowest map comes from fattened slivers
};

}  // namespace sphparam
