#include "group/into_correspondence.h"

#include <algorithm>
#include <utility>

#include "correspondence/matchable.h"
#include "correspondence/stance.h"
#include "number_text.h"
#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/correspondence/map_alignment.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/sphere/first_order_alignment.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {
namespace {

constexpr int degree = 12;  // of the harmonics that tell how a shape lies
constexpr int tried_turns = 4;
constexpr double clear_correlation = 0.3, clear_difference = 0.05;
constexpr double clearly_better = 0.9;  // times as far from fitting, or less
constexpr char what_to_do[] =
    "look at its correspondence; where it is wrong, --start ends or ellipsoid, or landmarks by "
    "match, bring it right";

Functions harmonics_of(const MappedMesh& mapped, int threads) {
  return fit_harmonics(mapped.topology(), mapped.map(), mapped.mesh().positions,
                       {.degree = degree, .threads = threads})
      .coefficients;
}

/// The shape's sphere lies as the target's does, by their first-order ellipsoids.
Brought by_ellipsoid(const GroupTarget& target, const MappedMesh& shape, int threads) {
  const FirstOrderAlignment alignment =
      first_order_alignment(harmonics_of(shape, threads), &target.aligned, threads);
  return {.mapped = turned_map(shape, target.sphere.transpose() * alignment.sphere),
          .start = "ellipsoid",
          .confidence = alignment.confidence,
          .doubts = doubts_about(alignment)};
}

/// What tells how a map lies: what it looks like, or, of shapes that lie alike in space, places.
Functions turning_signals(const MappedMesh& mapped, bool alike, int threads) {
  const MapSignalOptions options{.threads = threads};
  return alike ? map_signals(mapped, stance_of(mapped.mesh()), options)
               : map_signals(mapped, options);
}

/// Whether functions on the sphere are as good as themselves, turned.
bool is_symmetric(const Functions& signals, int threads) {
  const auto turns = turns_by_correlation(signals, signals, tried_turns, threads);
  return turns.size() > 1 && turns[1].correlation > 1 - clear_difference;
}

/// How much more alike the best position is than the next; 1 where a symmetry of the target makes
/// others as right.
double confidence_in(const std::vector<TurnOfFunctions>& turns, bool symmetric) {
  if (turns.size() < 2 || symmetric) return 1;
  const double unlike = 1 - turns[0].correlation, next = 1 - turns[1].correlation;
  return next > 0 ? std::clamp(1 - unlike / next, 0.0, 1.0) : 0;
}

/// The shape's sphere lies as the target's does, by what the maps look like.
Brought by_rotation(const GroupTarget& target, const MappedMesh& shape, bool alike, int threads) {
  const Functions signals = turning_signals(shape, alike, threads);
  const std::vector<TurnOfFunctions> turns =
      turns_by_correlation(signals, target.signals, tried_turns, threads);
  Brought result{.mapped = turned_map(shape, turns.front().rotation),
                 .start = "rotation",
                 .confidence = confidence_in(turns, target.symmetric)};
  if (turns.front().correlation < clear_correlation)
    result.doubts.push_back(
        "its map looks little like that of the template, however it is turned "
        "(correlation " +
        short_number(turns.front().correlation) + "): " + what_to_do);
  else if (turns.size() > 1 && !target.symmetric &&
           turns.front().correlation - turns[1].correlation < clear_difference)
    result.doubts.push_back(
        "its map looks like that of the template in two positions "
        "(correlations " +
        short_number(turns[0].correlation) + " and " + short_number(turns[1].correlation) +
        "): " + what_to_do);
  return result;
}

Brought from_match(Match match, std::string start) {
  if (const auto facing = opposite_facing(match.map.from(), match.map.to()))
    std::erase(match.warnings, *facing);  // a group tells it once, however often it is matched
  return {.mapped = match.map.from(),
          .start = std::move(start),
          .energy = match.energy,
          .confidence = match.confidence,
          .warnings = std::move(match.warnings)};
}

/// As `GroupMember::start` has it.
std::string start_of(const Match& match) {
  if (match.made_by == "own map") return "its map";
  return match.made_by == "turn" || match.made_by == "places" ? match.made_by : "ends";
}

Brought by_ends(const GroupTarget& target, const MappedMesh& shape, MatchOptions options) {
  options.search = true;
  Match match = match_surfaces(shape, target.mapped, options);
  std::string start = start_of(match);
  for (std::string& warning : match.warnings)
    if (warning.starts_with("nothing but a turn")) warning += "; --start rotation may find more";
  Brought found = from_match(std::move(match), std::move(start));
  std::swap(found.doubts, found.warnings);
  return found;
}

/// Σ area · distance² of a shape's vertices from their points on the target, moved and scaled.
double squares_apart(const Brought& brought, const GroupTarget& target, int threads) {
  const SurfaceMap map(brought.mapped, target.mapped);
  const Points there =
      moved(map.from_on_to(threads).positions, placement_on(map, Placement::Scaled, threads));
  const VectorX areas = vertex_areas(brought.mapped.surface());
  return areas.dot((there - brought.mapped.mesh().positions).rowwise().squaredNorm());
}

/// Whether the one fits clearly better than the other.
bool fits_better(const Brought& one, const Brought& other, const GroupTarget& target,
                 const MatchOptions& options) {
  if (one.energy > 0 && other.energy > 0) {
    const double isometric = differentiate(options.energy, 1, 1).f;
    return one.energy - isometric < clearly_better * (other.energy - isometric);
  }
  return squares_apart(one, target, options.threads) <
         clearly_better * clearly_better * squares_apart(other, target, options.threads);
}

}  // namespace

GroupTarget group_target(const MappedMesh& mapped, GroupStart start, bool alike, int threads) {
  GroupTarget target{.mapped = mapped};
  if (start == GroupStart::Rotation || start == GroupStart::Ends) {
    target.signals = turning_signals(mapped, alike, threads);
    target.symmetric = is_symmetric(target.signals, threads);
  }
  if (start != GroupStart::Ellipsoid) return target;
  const Functions harmonics = harmonics_of(mapped, threads);
  const FirstOrderAlignment alignment = first_order_alignment(harmonics, nullptr, threads);
  target.aligned = aligned(harmonics, alignment, true, threads);
  target.sphere = alignment.sphere;
  return target;
}

Brought bring_to(const GroupTarget& target, const MappedMesh& shape, GroupStart start, bool hold,
                 const MatchOptions& options) {
  if (start == GroupStart::Ends && !hold) return by_ends(target, shape, options);
  Brought begun = start == GroupStart::Maps ? Brought{.mapped = shape, .start = "its map"}
                  : start == GroupStart::Ellipsoid
                      ? by_ellipsoid(target, shape, options.threads)
                      : by_rotation(target, shape, options.alike, options.threads);
  if (hold) return begun;
  Brought result =
      from_match(match_surfaces(begun.mapped, target.mapped, options), std::move(begun.start));
  result.doubts = std::move(begun.doubts);
  result.confidence = std::min(result.confidence, begun.confidence);
  return result;
}

Brought bring_either_to(const GroupTarget& target, const MappedMesh& shape, GroupStart start,
                        bool hold, const MatchOptions& options) {
  Brought own = bring_to(target, shape, start, hold, options);
  Brought image = bring_to(target, mirror_image(shape, options.threads), start, hold, options);
  if (!fits_better(image, own, target, options)) return own;
  image.mirrored = true;
  return image;
}

}  // namespace sphparam
