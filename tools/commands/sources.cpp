#include "commands/sources.h"

#include <numbers>
#include <utility>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "embedding/frame/nearest_rotation.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/sphere/radial_directions.h"

namespace sphparam::cli {

MeshSource read_source(const std::string& path) {
  return sphparam::read_source(path, input_limits());
}

MappedMesh read_mapped(const std::string& path, const std::string& sphere, Session& session,
                       double lambda, const Words& data, MissingValues missing) {
  session.hold_signals();
  LoadOptions options{.sphere = sphere, .read = input_limits()};
  options.map.energy.lambda = lambda;
  options.map.threads = session.threads();
  options.map.progress = session.progress();
  MeshSource source = read_source(path);
  tell_losses(source, session.console);
  attach_data_files(source.file, source.path, data, missing, session);
  const MappedMesh mapped = mapped_mesh(std::move(source), options);
  if (mapped.mapped_here())
    session.console.say(mapped.name() + ": carries no map; mapped now (progressive)");
  return mapped;
}

void tell_longitudes(const MappedMesh& mapped, Convention convention, Session& session) try {
  if (convention != Convention::Gis) return;
  constexpr double degrees = 180 / std::numbers::pi, nothing = 1e-4;
  const std::optional<Planetocentric> radial = planetocentric(mapped.provenance());
  const SphereMap directions =
      radial_directions(mapped.mesh(), radial ? radial->centre : Vector3(0, 0, 0));
  const VectorX even = VectorX::Ones(mapped.mesh().vertex_count());
  const double angle = degrees * rms_angle(mapped.map(), directions, even);
  if (angle < nothing) return;
  session.console.say("  the map's longitudes and latitudes are " + short_number(angle) +
                      "° from those of the body (RMS); " +
                      (radial ? "it moved what folds"
                              : "`sphparam map` --method radial has the body's, --align body comes "
                                "near"));
} catch (const VertexAtCentre&) {  // no body about the origin
}

std::shared_ptr<const MeshTextures> read_shown_textures(const MeshFile& file,
                                                        const std::string& path,
                                                        const std::string& image,
                                                        Session& session) try {
  const std::string name = display_name(path);
  const ShownTextures shown = shown_textures(file, name, image, session.threads());
  const std::string advice =
      ": --texture IMAGE names it, or the glTF file with --sphere " + name + " has it";
  if (!shown.warning.empty())
    session.console.warning(shown.warning + (shown.left_behind ? advice : ""));
  return shown.textures;
} catch (const NoTexcoords& error) {
  throw UsageMistake(std::string("--texture: ") + error.what());
}

}  // namespace sphparam::cli
