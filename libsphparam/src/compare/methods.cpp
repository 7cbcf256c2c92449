// One table of methods, and one switch; everything else asks these.

#include "compare/methods.h"

#include <algorithm>
#include <utility>

#include "sphparam/baselines/brechbuehler.h"
#include "sphparam/baselines/conformal.h"
#include "sphparam/baselines/curvature_flow.h"
#include "sphparam/baselines/hemispheres.h"
#include "sphparam/baselines/stereographic.h"
#include "sphparam/baselines/tangential.h"
#include "sphparam/mesh/mesh_defects.h"

namespace sphparam {

namespace {

BaselineResult run_as_published(Baseline rival, const TriangleMesh& mesh, const Topology& topology,
                                const ParameterizeOptions& options) {
  const int threads = options.threads;
  const Progress& progress = options.progress;
  switch (rival) {
    case Baseline::Tangential:
      return map_tangential(mesh, topology, {.threads = threads}, progress);
    case Baseline::Hemispheres:
      return map_hemispheres(mesh, topology, {.threads = threads}, progress);
    case Baseline::Brechbuehler:
      return map_brechbuehler(mesh, topology, {.threads = threads}, progress);
    case Baseline::Stereographic:
      return map_stereographic(mesh, topology, {.threads = threads}, progress);
    case Baseline::Conformal:
      return map_conformal(mesh, topology, {.threads = threads}, progress);
    case Baseline::Flow:
      return map_flow(mesh, topology, {.threads = threads}, progress);
  }
  return {};
}

std::vector<StageRecord> records(const std::vector<BaselineStage>& stages) {
  std::vector<StageRecord> result;
  for (const BaselineStage& stage : stages) result.push_back({stage.name, stage.seconds});
  return result;
}

Parameterization certified(const Topology& topology, SphereMap map, int threads) {
  Parameterization result;
  result.certificate = certify(topology, map, threads);
  result.map = std::move(map);
  return result;
}

/// As made, or mended where that is wanted.
Parameterization conclude(const TriangleMesh& mesh, const Topology& topology, const char* name,
                          BaselineResult&& rival, const ParameterizeOptions& options) {
  Parameterization result;
  if (rival.map && options.repair_paper) {
    result = repair_map(mesh, *rival.map, options);
  } else if (rival.map) {
    result = certified(topology, std::move(*rival.map), options.threads);
  }
  if (!options.repair_paper || result.made_by == "given map") result.made_by = name;
  const std::vector<StageRecord> made = records(rival.stages);
  result.stages.insert(result.stages.begin(), made.begin(), made.end());
  return result;
}

MethodRun run_rival(Baseline rival, const TriangleMesh& mesh, const Topology& topology,
                    ParameterizeOptions options) {
  require_sphere(mesh, topology);
  options.automatic_poles = false;  // the frame is the authors'
  BaselineResult made = run_as_published(rival, mesh, topology, options);
  const MethodInfo& info = info_of(rival);
  BaselineAccount account = {made.end, made.iterations, made.statement, info.citation};
  return {conclude(mesh, topology, info.name, std::move(made), options), std::move(account)};
}

}  // namespace

const std::vector<MethodInfo>& all_methods() {
  static const std::vector<MethodInfo> methods = {
      {Method::Progressive, "progressive", "ours: coarse to fine, never folded"},
      {Method::Curvilinear, "curvilinear", "ours: the paper made sound"},
      {Method::Paper, "paper", "the paper as printed"},
      {Baseline::Tangential, "tangential", "Alexa 2000; Kobbelt et al. 1999"},
      {Baseline::Hemispheres, "hemispheres", "Saba, Yavneh, Gotsman, Sheffer 2005"},
      {Baseline::Brechbuehler, "brechbuehler", "Brechbühler, Gerig, Kübler 1995"},
      {Baseline::Stereographic, "stereographic", "Haker et al. 2000"},
      {Baseline::Conformal, "conformal", "Gu, Yau 2002, 2003"},
      {Baseline::Flow, "flow", "Kazhdan, Solomon, Ben-Chen 2012"}};
  return methods;
}

const std::vector<MethodInfo>& mapping_methods() {
  static const std::vector<MethodInfo> methods = [] {
    std::vector<MethodInfo> all = all_methods();
    all.push_back({Method::Radial, "radial", "ours: directions from a centre"});
    return all;
  }();
  return methods;
}

const MethodInfo& info_of(AnyMethod method) {
  return *std::find_if(mapping_methods().begin(), mapping_methods().end(),
                       [&](const MethodInfo& info) { return info.method == method; });
}

std::optional<AnyMethod> method_named(std::string_view name) {
  for (const MethodInfo& info : all_methods()) {
    if (info.name == name) return info.method;
  }
  return std::nullopt;
}

MethodRun run_method(AnyMethod method, const TriangleMesh& mesh, const Topology& topology,
                     ParameterizeOptions options) {
  if (const Baseline* rival = std::get_if<Baseline>(&method)) {
    return run_rival(*rival, mesh, topology, options);
  }
  options.method = std::get<Method>(method);
  return {parameterize(mesh, topology, options)};
}

}  // namespace sphparam
