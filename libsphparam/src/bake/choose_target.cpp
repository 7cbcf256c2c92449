#include "bake/choose_target.h"

#include <stdexcept>

#include "bake/make_scene.h"
#include "bake/shared_sphere.h"
#include "number_text.h"
#include "sphparam/chart/chart_failure.h"
#include "sphparam/io/planetocentric.h"

namespace sphparam {
namespace {

/// A map of its own would give every texel of the low mesh another place of the high one.
void require_one_sphere(const MappedMesh& source, const BakeSettings& settings,
                        ChosenTarget& chosen) {
  const MappedMesh& target = *settings.target;
  const double apart = disagreement(source, target, settings.threads);
  chosen.distance = apart;
  if (apart <= doubtful_disagreement) return;
  const std::string far = "in the same directions, half of its surface is more than " +
                          percent(apart) + " of the diagonal away from that of " +
                          source_name(source, settings);
  if (apart > other_sphere_disagreement) {
    throw OtherSphereError(target.name() + ": is not on the same sphere: " + far);
  }
  chosen.warnings.push_back(target.name() + ": " + far);
}

/// A direction is a ray from the centre, which about another one meets another place.
void compare_centres(const MappedMesh& source, const BakeSettings& settings, ChosenTarget& chosen) {
  const MappedMesh& target = *settings.target;
  const auto high = planetocentric(source.provenance()), low = planetocentric(target.provenance());
  if (!high || !low || high->centre == low->centre) return;
  const double apart = (high->centre - low->centre).stableNorm();
  chosen.warnings.push_back(target.name() + ": is mapped about another centre than " +
                            source_name(source, settings) + ", " + short_number(apart) +
                            " units of the mesh away, so that a direction is another place on it");
}

BakeTarget target_on(const MappedMesh& mapped, bool is_source, const BakeSettings& settings) {
  try {
    return make_target(mapped, is_source, settings.threads, settings.refine_poles,
                       settings.progress);
  } catch (const std::invalid_argument& error) {
    if (settings.refine_poles <= 1) throw;
    throw BakeSettingError("refine_poles", error.what());
  }
}

}  // namespace

const std::string& source_name(const MappedMesh& source, const BakeSettings& settings) {
  return settings.source_name.empty() ? source.name() : settings.source_name;
}

ChosenTarget choose_target(const MappedMesh& source, const BakeSettings& settings) {
  ChosenTarget chosen;
  if (settings.target) {
    require_one_sphere(source, settings, chosen);
    compare_centres(source, settings, chosen);
  }
  const MappedMesh& mesh = settings.target ? *settings.target : source;
  chosen.target = target_on(mesh, !settings.target && !settings.from, settings);
  const std::string& name = settings.target ? mesh.name() : source_name(source, settings);
  require_one_to_one(chosen.target.chart, name);
  const std::string moved = moved_vertices(chosen.target.chart);
  if (!moved.empty()) chosen.warnings.push_back(name + ": " + moved);
  return chosen;
}

}  // namespace sphparam
