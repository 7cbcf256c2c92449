#include "commands/sources.h"

#include <utility>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "reports/told_repairs.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/normal_maps.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam::cli {

MeshSource read_source(const std::string& path) {
  return sphparam::read_source(path, input_limits());
}

namespace {

/// The repairs that are wanted, done by one of the library's two ways, and told.
template <class Mend>
MeshSource told_mended(MeshSource source, const RepairArguments& repair, Session& session,
                       Mend&& mend) {
  const std::optional<RepairOptions> wanted = wanted_repairs(repair);
  if (!wanted) return source;
  const std::string name = display_name(source.path);
  try {
    source = mend(std::move(source), *wanted);
  } catch (const NoSuchComponent& error) {
    throw UsageMistake("--component: " + name + ": " + error.what());
  }
  tell_repairs(source, session.console);
  if (source.repairs.empty() || !read_sphere(source.file)) return source;
  source.file = without_map(std::move(source.file));
  session.console.say("  " + name + ": its map is of the mesh before the repair, and left out");
  return source;
}

}  // namespace

ReadOptions limits_for(const RepairArguments& repair) {
  const std::optional<RepairOptions> wanted = wanted_repairs(repair);
  ReadOptions options = input_limits();
  options.repeated_corners = wanted && wanted->duplicates;
  options.non_finite = wanted && wanted->non_finite;
  return options;
}

MeshSource read_mended(const std::string& path, const RepairArguments& repair, Session& session,
                       const Words& data, MissingValues missing) {
  MeshSource source = sphparam::read_source(path, limits_for(repair));
  tell_notes(source, session.console);
  attach_data_files(source.file, source.path, data, missing, session);
  return told_mended(std::move(source), repair, session, repaired);
}

MeshSource read_mended_as_far(const std::string& path, const RepairArguments& repair,
                              Session& session) {
  return told_mended(sphparam::read_source(path, limits_for(repair)), repair, session, mended);
}

MappedMesh read_mapped(const std::string& path, const std::string& sphere, Session& session,
                       const RepairArguments& repair, double lambda, const Words& data,
                       MissingValues missing) {
  session.hold_signals();
  return map_source(read_mended(path, repair, session, data, missing), sphere, session, repair,
                    lambda);
}

MappedMesh map_source(MeshSource source, const std::string& sphere, Session& session,
                      const RepairArguments& repair, double lambda) {
  session.hold_signals();
  LoadOptions options{.sphere = sphere, .read = input_limits()};
  options.map.energy.lambda = lambda;
  options.map.filler_share = wanted_filler_share(repair);
  options.map.threads = session.threads();
  options.map.progress = session.progress();
  const auto known = std::ssize(source.notes);
  const MappedMesh mapped = mapped_mesh(std::move(source), options);
  session.warn({mapped.notes().begin() + known, mapped.notes().end()});  // of the sphere
  if (mapped.mapped_here())
    session.console.say(mapped.name() + ": carries no map; mapped now (progressive)");
  return mapped;
}

void tell_longitudes(const MappedMesh& mapped, Convention convention, bool named_as_body,
                     const std::optional<Vector3>& given_centre, Session& session) {
  if (convention != Convention::Gis) return;
  const Vector3 centre = body_centre(planetocentric(mapped.provenance()), given_centre);
  const std::string off = longitudes_off(mapped, centre, !named_as_body, session.threads());
  if (!off.empty()) session.console.say("  " + off);
}

void turn_normals(MeshFile& file, const std::string& path, bool down, Session& session) {
  if (down && turn_normal_maps_over(file) == 0)
    session.console.warning(display_name(path) +
                            ": has no normal map: --source-normal-y says nothing of it");
}

void crease(MeshFile& file, const std::string& path, double degrees, Session& session) {
  if (degrees < 0) return;
  const std::optional<long> hard = add_creases(file, degrees);
  const std::string name = "  " + display_name(path) + ": ";
  if (hard) return session.console.detail(name + counted(*hard, "edge is hard", "edges are hard"));
  session.console.say(name +
                      "has normals of its own, which say what is hard: --crease is for others");
}

std::shared_ptr<const MeshTextures> read_shown_textures(const MeshFile& file,
                                                        const std::string& path,
                                                        const std::string& image,
                                                        Session& session) try {
  const std::string name = display_name(path);
  const ShownTextures shown = shown_textures(file, name, image, session.threads());
  const std::string advice =
      ": --texture IMAGE names it, or the file that was mapped, with --sphere " + name + ", has it";
  if (!shown.warning.empty())
    session.console.warning(shown.warning + (shown.left_behind ? advice : ""));
  return shown.textures;
} catch (const NoTexcoords& error) {
  throw UsageMistake(std::string("--texture: ") + error.what());
}

}  // namespace sphparam::cli
