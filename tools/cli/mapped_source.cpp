// Whoever uses a map first proves it: the certificate costs little, and nothing that follows holds
// without it.

#include "cli/mapped_source.h"

#include <optional>
#include <utility>

#include "cli/certified.h"
#include "cli/exit_codes.h"
#include "cli/paths.h"
#include "cli/repairing.h"
#include "cli/told_losses.h"
#include "cli/wording.h"
#include "mesh_io/connectivity.h"
#include "mesh_io/read_options.h"
#include "mesh_io/safe_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/version.h"

namespace sphparam::tools {

namespace {

struct WrittenMap {
  SphereMap map;
  Provenance provenance;
};

WrittenMap map_of_sphere(const Source& shape, const std::string& shape_path,
                         const std::string& path) {
  const MeshFile sphere = read_source(path).file;
  const std::string difference = connectivity_difference(shape.file, sphere);
  if (!difference.empty()) {
    throw ReadError(display_name(path),
                    "not a sphere of " + display_name(shape_path) + ": " + difference);
  }
  std::optional<SphereMap> map = read_sphere(sphere);
  return {map ? std::move(*map) : SphereMap{sphere.mesh.positions}, read_provenance(sphere)};
}

std::optional<WrittenMap> written_map(const Source& source, const std::string& path,
                                      const std::string& sphere) {
  if (!sphere.empty()) return map_of_sphere(source, path, sphere);
  std::optional<SphereMap> map = read_sphere(source.file);
  if (!map) return std::nullopt;
  return WrittenMap{std::move(*map), read_provenance(source.file)};
}

SphereMap make_map(const MappedSource& mapped, const std::string& name, Provenance& provenance,
                   int threads, Console& console, double lambda) {
  ParameterizeOptions options;
  options.energy.lambda = lambda;
  options.threads = threads;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  Parameterization result =
      parameterize(mapped.source.file.mesh, mapped.source.topology.value(), options);
  if (!result.certificate.bijective()) {
    throw NotCertifiedError(name + ": no one-to-one map was found: " + verdict(result.certificate));
  }
  console.clear_progress();
  console.say(name + ": carries no map; mapped now (progressive)");
  provenance = {{"version", version},
                {"method", name_of(options.method)},
                {"stage", result.made_by},
                {"options", options_line(options)},
                {"verdict", verdict(result.certificate)}};
  return std::move(result.map);
}

}  // namespace

SphereMap unit_rays(SphereMap map) {
  constexpr double roundings = 8 * 2.22e-16;
  const Eigen::ArrayXd deviation = map.points.rowwise().norm().array() - 1;
  return (deviation.abs() <= roundings).all() ? map : normalised(std::move(map.points));
}

MappedSource read_mapped_source(const std::string& path, const std::string& sphere, int threads,
                                Console& console, double lambda) {
  MappedSource mapped;
  mapped.source = read_source(path);
  tell_losses(mapped.source, path, console);
  require_mappable(mapped.source);
  std::optional<WrittenMap> written = written_map(mapped.source, path, sphere);
  mapped.mapped_here = !written;
  const std::string name = display_name(written && !sphere.empty() ? sphere : path);
  if (written) {
    const Topology& topology = mapped.source.topology.value();
    require_certified(certify(topology, written->map, threads), name);
    mapped.map = unit_rays(std::move(written->map));
    require_certified(certify(topology, mapped.map, threads), name + ", with rays of unit length");
    mapped.provenance = std::move(written->provenance);
  } else {
    mapped.map = make_map(mapped, name, mapped.provenance, threads, console, lambda);
  }
  return mapped;
}

}  // namespace sphparam::tools
