#include "pipeline/map_in_progress.h"

#include <utility>

#include "sphere/face_rays.h"
#include "sphparam/parallel.h"

// The gate: stages hand their maps in here, and each gets its certificate. What a stage has made is
// taken as it is, folds and all; a change of frame is not worth a fold.

namespace sphparam {
MapInProgress::MapInProgress(const TriangleMesh& given_mesh, const Topology& given_topology,
                             const ParameterizeOptions& given_options)
    : rescaled_(at_unit_size(given_mesh)),
      topology(given_topology),
      given(given_mesh),
      mesh(rescaled_ ? rescaled_->mesh : given_mesh),
      options(given_options),
      energy(given_options.energy) {}

const RestTriangles& MapInProgress::source() {
  if (source_.empty()) source_ = measure_source(mesh, options.threads);
  return source_;
}

double MapInProgress::surface_energy(const SphereMap& map, const DistortionEnergy& measure) {
  if (options.fillers.empty())
    return distortion_energy(topology, source(), map, measure, options.threads);
  const RestTriangles& triangles = source();
  return parallel_sum(mesh.face_count(), options.threads, [&](std::int64_t f0, std::int64_t f1) {
    double sum = 0;
    for (Face f = static_cast<Face>(f0); f < static_cast<Face>(f1); ++f) {
      const auto i = static_cast<size_t>(f);
      if (options.fillers[i]) continue;
      const auto [d, s] = distortion(triangles[i], face_rays(topology, map, f));
      sum += triangles[i].area * energy_density(measure, d, s);
    }
    return sum;
  });
}

void MapInProgress::restore(BalanceState state) {
  energy = state.energy;
  aim_ = std::move(state.aim);
  result.balance = state.record;
}

void MapInProgress::forget_poles() {
  result.poles.reset();
  result.date_line.reset();
}

void MapInProgress::accept(std::string made_by, SphereMap map) {
  report(options.progress, "certificate", 0);
  result.certificate = certify(topology, map, options.threads);
  result.map = std::move(map);
  if (made_by != balanced_map) {  // it was that of the map before
    result.balance.reset();
    aim_.clear();
  }
  result.energy_gap.reset();
  result.made_by = std::move(made_by);
  result.stages.push_back({"certificate", stopwatch_.lap(), -1, result.certificate.fold_count()});
}

bool MapInProgress::accept_if_certified(SphereMap map) {
  Certificate certificate = certify(topology, map, options.threads);
  if (!certificate.bijective()) return false;
  result.certificate = std::move(certificate);
  result.map = std::move(map);
  return true;
}

void MapInProgress::record(std::string name, const SphereMap& map, long planar_folds) {
  const double seconds = stopwatch_.lap();
  result.stages.push_back(
      {std::move(name), seconds, planar_folds, count_folds(map), measured(map)});
  stopwatch_.lap();
}

long MapInProgress::count_folds(const SphereMap& map) const {
  if (!options.measure_stages) return -1;
  return certify(topology, map, options.threads).fold_count();
}

std::optional<DistortionSummary> MapInProgress::measured(const SphereMap& map) const {
  if (!options.measure_stages) return std::nullopt;
  if (options.fillers.empty()) return summarise_distortion(mesh, map, options.threads);
  return summarise_distortion(surface_of(mesh, options.fillers), map, options.threads);
}

}  // namespace sphparam
