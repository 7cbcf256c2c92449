#include "commands/sources.h"

#include <numbers>
#include <utility>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "embedding/frame/nearest_rotation.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "reports/told_repairs.h"
#include "sphparam/io/creases.h"
#include "sphparam/io/normal_maps.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/radial_directions.h"

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

namespace {

/// Nearly all of a body looks away from its centre, which of a statue a tenth and more does not.
bool is_like_body(const MappedMesh& mapped, const SphereMap& directions, int threads) {
  constexpr double most_folded = 0.05;  // of the triangles
  const Certificate found = certify(mapped.topology(), directions, threads);
  return static_cast<double>(found.fold_count()) <=
         most_folded * static_cast<double>(mapped.mesh().face_count());
}

/// What a map is that says that it is radial and has not the longitudes of a body.
std::string what_it_is(const MappedMesh& mapped, const std::optional<Planetocentric>& radial,
                       const Vector3& centre) {
  if (!radial) return "";
  if (!is_about(*radial, centre, mapped.mesh())) return "it is radial about another centre; ";
  if (radial->made_anew) return "it was made anew, for too much folds; ";
  if (is_as_said(*radial, mapped.file(), mapped.map())) return "it moved what folds";
  return "mesh or map were moved since it was made; ";
}

/// Why a map's longitudes are not those of a body about this centre, and what would have them.
std::string why_off(const MappedMesh& mapped, const std::optional<Planetocentric>& radial,
                    const Vector3& centre) {
  const std::string why = what_it_is(mapped, radial, centre);
  if (!why.empty() && !why.ends_with("; ")) return why;  // no other has them
  const std::string typed =
      shortest(centre.x()) + "," + shortest(centre.y()) + "," + shortest(centre.z());
  const std::string what = radial && radial->made_anew
                               ? "`sphparam map` --align body comes near"
                               : "`sphparam map` --method radial has the body's, --align body "
                                 "comes near";
  return why + what + (centre.isZero(0) ? "" : ", with --centre " + typed);
}

}  // namespace

std::string longitudes_off(const MappedMesh& mapped, const Vector3& centre, bool of_bodies_only,
                           int threads) try {
  constexpr double degrees = 180 / std::numbers::pi, nothing = 1e-4;
  const std::optional<Planetocentric> radial = planetocentric(mapped.provenance());
  const SphereMap directions = body_directions(mapped.file(), centre);
  if (of_bodies_only && !radial && !is_like_body(mapped, directions, threads)) return "";
  const double angle =
      degrees * rms_angle(mapped.map(), directions,
                          vertex_areas(surface_of(mapped.mesh(), mapped.fillers())));
  if (!(angle >= nothing)) return "";
  return "the map's longitudes and latitudes are " + short_number(angle) +
         "° from those of the body (RMS over the surface); " + why_off(mapped, radial, centre);
} catch (const VertexAtCentre&) {  // no body about it
  return "";
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
