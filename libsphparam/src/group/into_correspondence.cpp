#include "group/into_correspondence.h"

#include <optional>
#include <utility>

#include "embedding/frame/nearest_rotation.h"
#include "sphparam/sphere/first_order_alignment.h"
#include "sphparam/sphere/spherical_harmonics.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

constexpr int degree = 12;  // of the harmonics that tell how a shape lies

Functions harmonics_of(const MappedMesh& mapped, int threads) {
  return fit_harmonics(mapped.topology(), mapped.map(), mapped.mesh().positions,
                       {.degree = degree, .threads = threads})
      .coefficients;
}

bool uses_ellipsoids(GroupStart start) { return start != GroupStart::Maps; }

MappedMesh turned_map(const MappedMesh& shape, const Eigen::Matrix3d& rotation) {
  return shape.with_map(
      turned(shape.map(), rotation),
      {{"version", version}, {"method", "group"}, {"stage", "turned"}, {"verdict", "one-to-one"}});
}

/// The shape's sphere lies as the target's does, by their first-order ellipsoids.
Brought by_ellipsoid(const GroupTarget& target, const MappedMesh& shape, int threads) {
  const FirstOrderAlignment alignment =
      first_order_alignment(harmonics_of(shape, threads), &target.aligned, threads);
  return {.mapped = turned_map(shape, target.sphere.transpose() * alignment.sphere),
          .start = "ellipsoid",
          .doubts = doubts_about(alignment)};
}

Brought from_match(Match match, std::string start) {
  return {.mapped = match.map.from(),
          .start = std::move(start),
          .energy = match.energy,
          .confidence = match.confidence,
          .warnings = std::move(match.warnings)};
}

std::optional<Brought> by_ends(const GroupTarget& target, const MappedMesh& shape,
                               MatchOptions options) try {
  options.search = true;
  Brought found = from_match(match_surfaces(shape, target.mapped, options), "ends");
  std::swap(found.doubts, found.warnings);
  return found;
} catch (const UnreachableLandmarks&) {  // it has none
  return std::nullopt;
}

}  // namespace

GroupTarget group_target(const MappedMesh& mapped, GroupStart start, int threads) {
  GroupTarget target{.mapped = mapped};
  if (!uses_ellipsoids(start)) return target;
  const Functions harmonics = harmonics_of(mapped, threads);
  const FirstOrderAlignment alignment = first_order_alignment(harmonics, nullptr, threads);
  target.aligned = aligned(harmonics, alignment, true, threads);
  target.sphere = alignment.sphere;
  return target;
}

Brought bring_to(const GroupTarget& target, const MappedMesh& shape, GroupStart start, bool hold,
                 const MatchOptions& options) {
  if (start == GroupStart::Ends)
    if (std::optional<Brought> found = by_ends(target, shape, options)) return *std::move(found);
  Brought begun = start == GroupStart::Maps ? Brought{.mapped = shape, .start = "its map"}
                                            : by_ellipsoid(target, shape, options.threads);
  if (hold) return begun;
  Brought result =
      from_match(match_surfaces(begun.mapped, target.mapped, options), std::move(begun.start));
  result.doubts = std::move(begun.doubts);
  return result;
}

}  // namespace sphparam
