// `sphparam spharm`: the surface, and what it carries, as a sum of spherical harmonics: the shape
// description that a map to the sphere was first made for (Brechbühler, Gerig, Kübler 1995).

#include <algorithm>
#include <iterator>
#include <utility>

#include "arguments/limits.h"
#include "arguments/mesh_names.h"
#include "arguments/spharm_arguments.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "number_text.h"
#include "reports/told_fillers.h"
#include "reports/told_losses.h"
#include "sphere/body_centre.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/coef_file.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/records/harmonics_record.h"
#include "sphparam/remesh/harmonic_surface.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Describe a surface by spherical harmonics.\n"
    "\n"
    "Examples:\n"
    "  sphparam spharm brain.sph.ply --degree 20 --json brain.json\n"
    "  sphparam spharm brain.ply --sphere brain.sphere.gii --degree 60 --reconstruct smooth.ply\n"
    "  sphparam spharm moon.sph.ply --degree 90 --scalar gravity --csv moon.csv\n"
    "  sphparam spharm eros.sph.ply --degree 24 --shadr eros.sha\n"
    "  sphparam spharm hippocampus.sph.ply --degree 15 --align --coef h_SPHARM_ellalign.coef\n"
    "  sphparam spharm brain.json --degree 8 --grid ico:5 --reconstruct smooth.sph.ply\n"
    "\n"
    "The coefficients are of x, y and z, of the scalars named, and of the radius where it is\n"
    "wanted, in a real orthonormal basis or in that of geodesy.\n"
    "Least squares weigh each vertex by its solid angle on the sphere, that is, the part of the\n"
    "sphere that it stands for; residuals are told so weighted, and plain.\n"
    "Of coefficients in a file a surface is made on any grid, as of `remesh`.\n";

/// "nope; they have I, flow_0, flow_1", or what a vector's columns are called.
std::string what_there_is(const MeshFile& file, const std::string& name) {
  const Words names = names_of(file.vertex_properties, &Property::name);
  const auto is_column = [&](const std::string& known) {
    return known.starts_with(name + "_") &&
           known.find_first_not_of("0123456789", name.size() + 1) == std::string::npos;
  };
  Words columns;
  std::ranges::copy_if(names, std::back_inserter(columns), is_column);
  if (!columns.empty()) return name + ", but its columns, each a scalar: " + joined(columns);
  return name + "; they have " + (names.empty() ? "none" : joined(names)) +
         did_you_mean(name, names);
}

void require_scalars(const MeshFile& file, const SpharmArguments& arguments) {
  for (const std::string& name : arguments.scalars) {
    if (std::ranges::count(arguments.scalars, name) > 1)
      throw UsageMistake("--scalar: " + name + " is named twice");
    if (arguments.has_radius() && name == "radius")
      throw UsageMistake("--scalar: radius is what --radius and --shadr expand under that name");
    if (file.find_vertex_property(name)) continue;
    if (file.find_face_property(name))
      throw UsageMistake("--scalar: " + name +
                         " is a property of faces; harmonics are of what vertices have: ParaView's "
                         "Cell Data to Point Data averages it onto them");
    throw UsageMistake("--scalar: the vertices have no property " + what_there_is(file, name) +
                       (name.find(',') == std::string::npos
                            ? ""
                            : "; the option is given once for each: --scalar A --scalar B"));
  }
}

/// What the radius is measured from; nothing where none is wanted.
std::optional<Vector3> centre_of_radius(const SpharmArguments& arguments, const MappedMesh& mapped,
                                        Session& session) {
  if (!arguments.has_radius()) return std::nullopt;
  const Vector3 centre =
      body_centre(planetocentric(mapped.provenance()), arguments.centre.of(mapped.mesh()));
  if (!(mapped.mesh().positions.rowwise() - centre.transpose()).rowwise().norm().allFinite())
    throw UsageMistake("--centre: it is so far from the mesh that the radius is no number");
  if (const std::string line = line_of_outside(mapped.mesh(), centre); !line.empty())
    session.console.warning(line);
  const std::string off = longitudes_off(mapped, centre, false, session.threads());
  if (!off.empty())
    session.console.warning("the longitudes of these harmonics are the map's, not the body's: " +
                            off);
  return centre;
}

/// Of scalars alone: their directions are the map's. Spheres that `--align` turns have their own.
void tell_directions(const SpharmArguments& arguments, const MappedMesh& mapped, Session& session) {
  if (arguments.has_radius() || arguments.scalars.empty() || !arguments.align.empty()) return;
  const std::string off =
      directions_turned(mapped, arguments.centre.of(mapped.mesh()), session.threads());
  if (!off.empty())
    session.console.warning("the directions of these harmonics are the map's, not the body's: " +
                            off);
}

HarmonicExpansion expand(const SpharmArguments& arguments, const MappedMesh& mapped,
                         Session& session) {
  require_measurable(mapped.mesh());
  tell_counted_fillers(mapped, "these harmonics", session.console);
  tell_directions(arguments, mapped, session);
  HarmonicExpansion expansion = expand_in_harmonics(mapped, arguments.scalars,
                                                    {.degree = arguments.wanted_degree(),
                                                     .least_squares = arguments.least_squares,
                                                     .threads = session.threads(),
                                                     .progress = session.progress()},
                                                    centre_of_radius(arguments, mapped, session));
  expansion.normalisation = arguments.normalisation;
  return expansion;
}

/// Throws: ReadError where the template's own sphere is not aligned.
void align_as_asked(const SpharmArguments& arguments, const MappedMesh& mapped,
                    HarmonicExpansion& expansion, Session& session) {
  std::optional<Functions> flips;
  if (!arguments.flips.empty()) flips = read_coef(arguments.flips);
  try {
    align(expansion, mapped, alignment_of(arguments), flips ? &*flips : nullptr, session.threads());
  } catch (const std::invalid_argument& error) {
    throw ReadError(display_name(arguments.flips), error.what());
  }
  if (expansion.alignment) session.warn(doubts_about(*expansion.alignment));
}

/// Least squares alone weigh vertices.
void warn_of_heavy_vertices(const SpharmArguments& arguments, const MappedMesh& mapped,
                            Console& console) {
  if (!arguments.least_squares) return;
  if (const std::string line = heavy_vertices_line(mapped); !line.empty()) console.warning(line);
}

/// The residual at the vertices says nothing of what they leave open.
void warn_of_open_degrees(const HarmonicExpansion& expansion, Console& console) {
  const std::string open = undecided_line(expansion);
  if (open.empty()) return;
  console.warning(open + "; --degree " + std::to_string(*expansion.fit.decided_degree) +
                  " leaves it out, --fit quadrature is the integral");
  if (const std::string line = decided_change_line(expansion); !line.empty()) console.warning(line);
}

/// The mesh with its map; what it lacks is told before it is mapped.
MappedMesh read_expanded(const SpharmArguments& arguments, Session& session) {
  session.hold_signals();
  MeshSource source = read_mended(arguments.input, arguments.repair, session);
  require_scalars(source.file, arguments);
  return map_source(std::move(source), arguments.sphere, session, arguments.repair);
}

/// The surface on the grid that was asked for.
MappedMesh on_grid(const SpharmArguments& arguments, const HarmonicExpansion& expansion,
                   Session& session) {
  const std::string like = file_of_grid(arguments);
  SphereGrid grid = like.empty()
                        ? make_grid(parse_grid(arguments.grid), {.threads = session.threads()})
                        : load_grid(like, input_limits(), session.threads());
  if (!grid.warning.empty()) session.warn({grid.warning});
  return harmonic_surface(expansion, std::move(grid), session.threads());
}

void add_on_grid(const SpharmArguments& arguments, const HarmonicExpansion& expansion,
                 Session& session) {
  const MappedMesh surface = on_grid(arguments, expansion, session);
  tell_losses(arguments.reconstruction,
              add_mapped(session.files, arguments.reconstruction, surface, session.threads()),
              session.console);
}

/// What the mesh has besides what was expanded.
Words left_out_on_grid(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  Words names, losses;
  Words kept = expansion.functions;
  kept.insert(kept.end(), {"source_vertex", "source_face", filler_property});  // of this file alone
  const auto add = [&](const std::vector<Property>& properties) {
    for (const Property& property : properties)
      if (std::ranges::find(kept, property.name) == kept.end()) names.push_back(property.name);
  };
  const MeshFile file = without_map(mapped.file());
  add(file.vertex_properties);
  add(file.face_properties);
  if (file.corner_texcoords) names.emplace_back("texture coordinates");
  if (!names.empty()) add_loss(losses, enumerated(names) + ": on a grid is what was expanded");
  add_sampling_losses(losses, file);
  return losses;
}

void add_surface(const SpharmArguments& arguments, const MappedMesh& mapped,
                 const HarmonicExpansion& expansion, Session& session) {
  const bool is_on_grid = !arguments.grid.empty();
  tell_losses(
      arguments.reconstruction,
      is_on_grid ? left_out_on_grid(mapped, expansion) : reconstruction_losses(mapped, expansion),
      session.console);
  if (is_on_grid) return add_on_grid(arguments, expansion, session);
  add_reconstruction(session.files, arguments.reconstruction, mapped, expansion, session.threads());
}

/// Coefficients → a surface on a grid.
int run_coefficients(const SpharmArguments& arguments) {
  require_coefficients_alone(arguments);
  Session session(arguments);
  session.hold_signals();
  HarmonicExpansion expansion = read_harmonics(arguments.input);
  if (arguments.degree.value_or(0) > expansion.degree())
    throw UsageMistake("--degree: " + display_name(arguments.input) +
                       " has coefficients up to degree " + std::to_string(expansion.degree()));
  if (arguments.degree) expansion = low_pass(std::move(expansion), *arguments.degree);
  add_on_grid(arguments, expansion, session);
  session.publish();
  session.console.say(display_name(arguments.input) + ": degree " +
                      std::to_string(expansion.degree()) + " on " + arguments.grid +
                      ", certified one-to-one → " + output_name(arguments.reconstruction));
  return Ok;
}

int run_spharm(SpharmArguments& arguments) {
  require_sensible(arguments);
  require_there({arguments.input, arguments.sphere, arguments.flips, file_of_grid(arguments)});
  if (has_coefficients(arguments.input)) return run_coefficients(arguments);
  Session session(arguments);
  const MappedMesh mapped = read_expanded(arguments, session);
  HarmonicExpansion expansion = expand(arguments, mapped, session);
  warn_of_heavy_vertices(arguments, mapped, session.console);
  warn_of_open_degrees(expansion, session.console);
  align_as_asked(arguments, mapped, expansion, session);
  session.add_report([&] { return to_json(expansion, arguments.input, mapped.provenance()); });
  if (expansion.fit.quadrature_change.value_or(0) > settled_quadrature)
    session.console.warning("the integral has not settled with the most nodes that there are");
  if (!arguments.csv.empty())
    session.files.add(arguments.csv, to_csv(expansion, table_separator("--csv", arguments.csv)));
  if (!arguments.shadr.empty()) session.files.add(arguments.shadr, to_shadr(expansion));
  if (!arguments.coef.empty())
    session.files.add(arguments.coef, to_coef(expansion.fit.coefficients));
  if (!arguments.reconstruction.empty()) add_surface(arguments, mapped, expansion, session);
  session.publish();
  session.console.say(display_name(arguments.input) + ": " + residual_line(expansion) + ", " +
                      short_number(session.stopwatch.seconds()) + " s");
  for (const std::string& line : further_lines(expansion)) session.console.say("  " + line);
  session.console.detail("  " + std::to_string(expansion.fit.iterations) + " iterations" +
                         (expansion.fit.converged ? "" : ", not converged"));
  return Ok;
}

}  // namespace

Command declare_spharm(CLI::App& program) {
  return make_command(program, "spharm", summary, declare_options, run_spharm);
}

}  // namespace sphparam::cli
