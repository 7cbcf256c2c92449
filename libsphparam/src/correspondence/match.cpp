#include "sphparam/correspondence/match.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "correspondence/coarse_to_fine.h"
#include "correspondence/landmark_search.h"
#include "embedding/frame/landmarks.h"
#include "embedding/frame/nearest_rotation.h"
#include "number_text.h"
#include "option_domain.h"
#include "sphparam/version.h"

// Two starts. The map that `from` has, turned so that the landmarks fit, where they fit all but
// exactly: two maps that mean the same. Else from coarse to fine, landmarks first.
// Mirrored landmarks are known by the energy on the coarse level: that of the mirror image with the
// same landmarks is far lower.

namespace sphparam {
namespace {

constexpr int all_starts = 3;           // of coarse levels, to take the best
constexpr double fitting = 1e-6;        // radians: landmarks of maps that mean the same
constexpr double mirrored_share = 0.5;  // of the energy beyond isometry: less is the mirror image's
constexpr double telling_energy = 0.25;      // what lies between the two must be more
constexpr double alike = 1.05;               // of that energy: the mirror image fits about as well
constexpr double collapsed = 0.01;           // of its share of the area: a triangle that is lost
constexpr double telling_area = 1e-3;        // share of the surface that is lost: worth a word
constexpr double telling_confidence = 0.15;  // less is worth a word
constexpr size_t telling_landmarks = 3;      // fewer have no sides

void require_landmarks(const MatchOptions& options, const MappedMesh& from, const MappedMesh& to) {
  if (options.search && !options.landmarks.empty())
    throw std::invalid_argument("landmarks: given, and to be searched for");
  std::set<Vertex> firsts, seconds;
  for (const LandmarkPair& pair : options.landmarks) {
    require_vertex("landmarks: from", pair.from, from.mesh().vertex_count());
    require_vertex("landmarks: to", pair.to, to.mesh().vertex_count());
    if (!firsts.insert(pair.from).second || !seconds.insert(pair.to).second)
      throw std::invalid_argument("landmarks: a vertex is in two pairs");
  }
}

std::vector<Pin> pins_of(const std::vector<LandmarkPair>& landmarks, const MappedMesh& to) {
  std::vector<Pin> pins;
  for (const LandmarkPair& pair : landmarks) pins.push_back({pair.from, to.map().point(pair.to)});
  return pins;
}

/// The map of `from`, turned, with its landmarks exactly there, where that is hardly a change.
std::optional<SphereMap> fitting_map(const MappedMesh& from, const std::vector<Pin>& pins) {
  SphereMap map = from.map();
  if (pins.empty() || all_exact(pin_residuals(map, pins))) return map;
  if (pins.size() < telling_landmarks) return std::nullopt;  // a rotation always nearly fits these
  map = turned(map, best_rotation(map, pins));
  for (const double residual : pin_residuals(map, pins))
    if (residual > fitting) return std::nullopt;
  for (const Pin& pin : pins) map.points.row(pin.vertex) = pin.point;
  if (!certify(from.topology(), map).bijective()) return std::nullopt;
  return map;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  mesh.positions.col(0) *= -1;
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/// Throws where the mirror image of `from` fits the landmarks far better; warns where it fits no
/// worse. `direct`: the energy of `from` on its coarse level, if it has one.
std::optional<std::string> suspicion_of_sides(const MappedMesh& from, const TargetSurface& target,
                                              const ComposedOptions& options,
                                              std::optional<double> direct) {
  if (options.release || options.landmarks.size() < telling_landmarks) return std::nullopt;
  const TriangleMesh other = mirrored(from.mesh());
  const Topology topology(other, options.threads);
  const std::optional<double> image = CoarseToFine(other, topology, target, options).start(1);
  const double least = differentiate(options.energy.energy, 1, 1).f;
  if (!image || (direct && *image - least > alike * (*direct - least))) return std::nullopt;
  const std::string energies =
      "energy " + short_number(*image) +
      (direct ? " against " + short_number(*direct) : ", and cannot be reached without it") + " (" +
      short_number(least) + " is isometry)";
  const bool far = !direct || (*image - least < mirrored_share * (*direct - least) &&
                               *direct - *image > telling_energy);
  if (far) {
    throw MirroredLandmarks("the landmarks look mirrored: they fit the mirror image of " +
                            from.name() + " far better, " + energies);
  }
  return "the landmarks fit the mirror image of " + from.name() +
         (*image < *direct ? " better, " : " about as well, ") + energies +
         ": are left and right as they should be?";
}

std::string words_of(const std::vector<double>& residuals) {
  const double worst = residuals.empty() ? 0 : *std::ranges::max_element(residuals);
  return residuals.empty() ? "they fold a triangle"
                           : "the worst stays " + short_number(worst * 180 / std::numbers::pi) +
                                 "° from its partner";
}

/// From coarse to fine.
SphereMap matched(const MappedMesh& from, const TargetSurface& target,
                  const ComposedOptions& options, std::vector<std::string>& warnings) {
  CoarseToFine way(from.mesh(), from.topology(), target, options);
  const std::optional<double> energy = way.start(all_starts);
  if (const auto warning = suspicion_of_sides(from, target, options, energy))
    warnings.push_back(*warning);
  SphereMap map = energy ? way.finish() : SphereMap{};
  if (map.points.rows() > 0) return map;
  throw UnreachableLandmarks("no map of " + from.name() +
                             " with these landmarks was found: " + words_of(way.residuals()));
}

/// Warns of parts of one surface that hardly have a place on the other.
void tell_collapse(const SurfaceMap& map, int threads, std::vector<std::string>& warnings) {
  const Distortion distortion = measure_distortion(map, threads);
  const double lost =
      (distortion.area_ratio.array() < collapsed).select(distortion.source_area.array(), 0.0).sum();
  if (lost < telling_area) return;
  warnings.push_back(short_number(100 * lost) + " % of the area of " + map.from().name() +
                     " shrinks to less than 1/100 on " + map.to().name() +
                     ": landmarks at the ends of what sticks out there may help");
}

ComposedOptions composed_options(const MatchOptions& options, const MappedMesh& to) {
  ComposedEnergy energy;
  energy.energy.kind = options.energy.kind;
  energy.energy.lambda = options.energy.lambda;
  return {.energy = energy,
          .landmarks = pins_of(options.landmarks, to),
          .threads = options.threads,
          .progress = options.progress};
}

/// What is known of the landmarks that are searched for.
struct Found {
  std::vector<SuggestedLandmarks> suggestions = {};
  double confidence = 1;
};

Found search_landmarks(const MappedMesh& from, const MappedMesh& to, const TargetSurface& target,
                       ComposedOptions& composed, std::vector<std::string>& warnings) {
  Found found{suggest_landmarks(from, to, target, composed)};
  if (found.suggestions.empty()) {
    throw UnreachableLandmarks("no three ends of " + from.name() + " and " + to.name() +
                               " that might correspond were found: landmarks are needed");
  }
  found.confidence = confidence_of(found.suggestions);
  composed.landmarks = pins_of(found.suggestions.front().landmarks, to);
  composed.release = true;
  if (found.confidence < telling_confidence) {
    warnings.push_back("another pairing of the surfaces' ends fits about as well (confidence " +
                       short_number(found.confidence) + "): look at the result, or give landmarks");
  }
  return found;
}

}  // namespace

Match match_surfaces(const MappedMesh& from, const MappedMesh& to, const MatchOptions& options) {
  require_landmarks(options, from, to);
  const TargetSurface target(to);
  ComposedOptions composed = composed_options(options, to);
  const auto energy_of = [&](const SphereMap& map, const DistortionEnergy& density) {
    return energy_of_composition(from.mesh(), from.topology(), target, map, {density, 0},
                                 options.threads);
  };
  std::vector<std::string> warnings;
  std::optional<SphereMap> fits = fitting_map(from, composed.landmarks), found_map;
  Found found;
  if (options.search) {
    found = search_landmarks(from, to, target, composed, warnings);
    found_map = matched(from, target, composed, warnings);
    const DistortionEnergy& density = composed.energy.energy;
    if (energy_of(*found_map, density) < energy_of(*fits, density)) fits.reset();
  }
  SphereMap map = fits ? improve_composition(from.mesh(), from.topology(), target, *fits, composed)
                  : found_map ? std::move(*found_map)
                              : matched(from, target, composed, warnings);
  // What is minimised differs from the plain energy by its ε and its barrier: an isometry is to
  // stay one.
  const DistortionEnergy plain{options.energy.kind, options.energy.lambda};
  if (fits && energy_of(*fits, plain) < energy_of(map, plain)) map = *fits;
  const double energy = energy_of(map, composed.energy.energy);
  const std::string made_by = fits ? "own map" : "coarse to fine";
  const Provenance lines = {
      {"version", version}, {"method", "match"}, {"stage", made_by}, {"verdict", "one-to-one"}};
  MappedMesh moved = from.with_map(std::move(map), lines);
  std::vector<double> residuals =
      options.search ? std::vector<double>{} : pin_residuals(moved.map(), composed.landmarks);
  SurfaceMap surface_map(std::move(moved), to);
  tell_collapse(surface_map, options.threads, warnings);
  tell_collapse(surface_map.inverse(), options.threads, warnings);
  return {std::move(surface_map),
          energy,
          made_by,
          std::move(residuals),
          std::move(found.suggestions),
          found.confidence,
          std::move(warnings)};
}

}  // namespace sphparam
