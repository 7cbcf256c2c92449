// `sphparam map`: file → mesh → map → proof → file.

#include <new>
#include <utility>

#include "arguments/limits.h"
#include "arguments/map_arguments.h"
#include "commands/command.h"
#include "commands/data_files.h"
#include "commands/map_outputs.h"
#include "commands/map_parts.h"
#include "commands/sources.h"
#include "io/inspected_source.h"
#include "middle_poles.h"
#include "reports/map_wording.h"
#include "reports/told_losses.h"
#include "sphere/body_centre.h"
#include "sphere/distinct_directions.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/pin_file.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/io/written_map.h"
#include "sphparam/sphere/radial_directions.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Map a closed genus-0 mesh one-to-one onto the unit sphere, prove it, write it.\n"
    "\n"
    "Examples:\n"
    "  sphparam map statue.obj -o statue.sph.ply\n"
    "  sphparam map lh.white --write-sphere lh.sphere\n"
    "  sphparam map statue.ply -o statue.sph.ply --json map.json --plots plots/\n"
    "  sphparam map statue.off -o statue.sph.ply --write-sphere sphere.obj --poles 17,4203\n"
    "  sphparam map statue.obj -o placed.sph.ply --pin eyes.txt\n"
    "  sphparam map statue.obj -o even.sph.ply --balance equal-area --quality best\n"
    "  cat statue.obj | sphparam map - -o - > statue.sph.ply\n"
    "  sphparam map scan.ply -o scan.sph.ply --repair\n"
    "  sphparam map eros.obj -o eros.sph.ply --method radial\n"
    "  sphparam map face.ply -o face.sph.ply --repair --keep-holes\n"
    "  sphparam map low.obj -o low.sph.ply --like sculpture.sph.ply\n"
    "  sphparam map hemispheres.ply -o hemispheres.sph.ply --all-components\n"
    "  sphparam map statue.obj -o folded.sph.ply --method paper --keep-folded\n"
    "  sphparam map statue.obj -o mended.sph.ply --method tangential --repair-map\n";

/// Poles, meridian and pins as vertices of the mesh.
void settle_vertices(const std::string& pins, const MeshSource& source,
                     ParameterizeOptions& options, Console& console) try {
  if (!options.poles && !options.meridian && pins.empty()) return;
  tell_other_numbers(source, console);
  const FileNumbers numbers(source.file);
  options = with_vertices_of_mesh(std::move(options), numbers);
  if (!pins.empty()) options.pins = read_pins(pins, numbers);
  if (!options.poles) return;
  DistinctDirections poles;
  poles.add(Vector3::UnitZ());
  poles.add(-Vector3::UnitZ());
  for (const Landmark& pin : options.pins) {
    const std::string vertex = "--pin: vertex " + std::to_string(numbers.number(pin.vertex));
    if (pin.vertex == options.poles->north || pin.vertex == options.poles->south)
      throw UsageMistake(vertex + " is one of the --poles");
    if (poles.add(to_cartesian(pin.coordinates)))
      throw UsageMistake(vertex + " is pinned where one of the --poles is");
  }
} catch (const NoSuchVertex& error) {
  throw UsageMistake("--" + error.whose() + ": " + error.what());
}

/// The directions that the map takes or is turned to.
void settle_directions(const MapArguments& arguments, const MeshSource& source,
                       ParameterizeOptions& options, Session& session) try {
  const bool to_body = arguments.align == "body";
  if (to_body || options.method == Method::Radial) {
    if (const auto centre = arguments.centre.of(source.file.mesh)) options.centre = *centre;
    if (std::string line = line_of_outside(source.file.mesh, options.centre); !line.empty())
      session.warn({display_name(source.path) + ": " + line});
    SphereMap directions = body_directions(source.file, options.centre);
    if (to_body) options.align_to = std::move(directions);
  } else if (!arguments.align.empty()) {
    SphereMap map = read_map_of(source, arguments.align, input_limits(), "map to align to").map;
    if (const std::string warning = roundness_warning(map); !warning.empty())
      session.warn({display_name(arguments.align) + ": " + warning});
    options.align_to = unit_rays(std::move(map));
  }
} catch (const VertexAtCentre& error) {
  const long number = FileNumbers(source.file).number(error.vertex());
  throw UsageMistake("--centre: vertex " + std::to_string(number) +
                     " lies at the centre: it has no direction from there");
}

/// Is anything said of how the mesh stands?
bool is_to_stand(const MapArguments& arguments) {
  return arguments.upright_poles || arguments.given("--up") || arguments.given("--front");
}

/// Poles and meridian as the mesh stands, which its file says then.
void settle_upright(const MapArguments& arguments, MapOutcome& outcome, Session& session) {
  if (!is_to_stand(arguments)) return;
  MeshFile& file = outcome.source.file;
  const UprightAxes axes = upright_axes(file, arguments.up);
  note_up(file, {axes.up, axes.front});
  const ParameterizeOptions upright =
      with_upright_frame(outcome.options, file.mesh, outcome.topology(), axes);
  if (arguments.upright_poles) outcome.options.poles = upright.poles;
  if (arguments.upright_poles &&
      poles_share_filler(outcome.topology(), upright.fillers, *upright.poles))
    session.warn(
        {"top and bottom both lie on the rim of one hole that is kept: the surface is "
         "drawn out between them; --poles V1,V2 names others, --poles auto takes those "
         "that images suffer least from"});
  if (arguments.front_meridian) outcome.options.meridian = upright.meridian;
}

MethodRun run(const MapArguments& arguments, const MapOutcome& outcome) {
  const MeshFile& file = outcome.source.file;
  const ParameterizeOptions& options = outcome.options;
  if (options.method == Method::Radial)
    return {parameterize_standing(file, outcome.topology(), options)};
  return run_method(arguments.method, file.mesh, outcome.topology(), options);
}

/// The map of the mesh that is to be followed; nothing: none is.
std::optional<MappedMesh> read_other(const MapArguments& arguments, Session& session) {
  if (arguments.like.empty()) return std::nullopt;
  return read_mapped(arguments.like, "", session);
}

/// Instead of the map that the mesh has by itself, one that means what the other's does.
void follow(const MappedMesh& other, MapOutcome& outcome, Session& session) try {
  const Stopwatch stopwatch;
  const MappedMesh own({.file = outcome.source.file,
                        .map = outcome.result.map,
                        .topology = outcome.topology(),
                        .name = display_name(outcome.source.path)},
                       session.threads());
  outcome.likeness =
      map_like(own, other, {.threads = session.threads(), .progress = session.progress()});
  outcome.other = other.name();
  Parameterization& result = outcome.result;
  result.map = outcome.likeness->mapped.map();
  result.certificate = outcome.likeness->mapped.certificate();
  result.made_by = "like";
  result.energy_gap.reset();
  result.stages.push_back({.name = "like", .seconds = stopwatch.seconds()});
  take_up(outcome.source.file, other.file());
} catch (const UnlikeSurfaces& error) {
  throw UsageMistake(std::string("--like: ") + error.what());
}

/// Of each triangle only where that is to be drawn.
void measure(const TriangleMesh& surface, const MapArguments& arguments, MapOutcome& outcome) {
  const int threads = outcome.options.threads;
  if (arguments.plots.empty()) {
    outcome.figures = summarise_distortion(surface, outcome.result.map, threads);
  } else {
    outcome.distortion = measure_distortion(surface, outcome.result.map, threads);
    outcome.figures = summarise(*outcome.distortion, threads);
  }
}

/// A map that the file has is not what is written.
void tell_map_left(const MeshSource& source, Session& session) {
  const auto has = [&](const char* ray) {
    return source.file.find_vertex_property(ray) != nullptr;
  };
  if (has("sx") && has("sy") && has("sz"))
    session.console.say(display_name(source.path) +
                        ": carries a map, which is left: it gets another one; all subcommands but "
                        "this take the one that it carries");
}

MapOutcome compute(MeshSource source, const MapArguments& arguments, Session& session) {
  require_mappable(source);
  tell_map_left(source, session);
  require_area(source);
  const std::optional<MappedMesh> other = read_other(arguments, session);
  InputNames input = input_names(source.file);
  MapOutcome outcome = {.source = std::move(source),
                        .input = std::move(input),
                        .method = arguments.method,
                        .options = arguments.options};
  const TriangleMesh& mesh = outcome.source.file.mesh;
  ParameterizeOptions& options = outcome.options;
  options.progress = session.progress();
  options.fillers = fillers_of(outcome.source.file);
  settle_vertices(arguments.pins, outcome.source, options, session.console);
  settle_upright(arguments, outcome, session);
  settle_directions(arguments, outcome.source, options, session);
  MethodRun made = run(arguments, outcome);
  outcome.result = std::move(made.result);
  outcome.account = std::move(made.account);
  if (other) follow(*other, outcome, session);
  outcome.frame = check_frame(outcome.result, options);
  if (outcome.has_map() && is_to_stand(arguments))
    outcome.upright = upright_words(outcome.result.map, mesh, outcome.topology(),
                                    upright_axes(outcome.source.file), options.fillers);
  if (outcome.has_map()) {
    if (options.fillers.empty())
      measure(mesh, arguments, outcome);
    else
      measure(surface_of(mesh, options.fillers), arguments, outcome);
  }
  return outcome;
}

/// The mesh, after the repairs that are wanted.
MeshSource mended(MeshPart part, const MapArguments& arguments) try {
  const std::optional<RepairOptions> repairs = wanted_repairs(arguments.repair);
  if (repairs) return repaired_part(std::move(part), *repairs);
  return std::move(part.source);
} catch (const NoSuchComponent& error) {
  throw UsageMistake(std::string("--component: ") + error.what());
}

MeshSource read_mended(const MapArguments& arguments, Session& session) {
  MeshSource source = sphparam::read_source(arguments.input, limits_for(arguments.repair));
  attach_data_files(source.file, source.path, arguments.data, MissingValues::LeftOut, session);
  return mended({std::move(source)}, arguments);
}

int run_map(MapArguments& arguments) {
  settle(arguments);
  Session session(arguments);
  if (arguments.all_components) {
    session.hold_signals();
    return run_map_of_parts(arguments, session, [&](MeshPart part) {
      return compute(mended(std::move(part), arguments), arguments, session);
    });
  }
  MeshSource source = read_mended(arguments, session);
  session.hold_signals();
  MapOutcome outcome = compute(std::move(source), arguments, session);
  tell_stages(outcome, session.console);
  tell_frame(outcome, session.console);
  tell_directions(outcome, session.console);
  const bool writes =
      outcome.has_map() && outcome.frame.holds() && (outcome.bijective() || arguments.keep_folded);
  write_outputs(arguments, outcome, writes, session);
  try {
    const std::string& file = arguments.output.empty() ? arguments.sphere : arguments.output;
    const std::string written = writes ? file : "";
    tell_result(outcome, written, session.stopwatch.seconds(), session.console);
  } catch (const std::bad_alloc&) {  // what is on disk is there all the same
  }
  return outcome.succeeded() ? Ok : NotCertified;
}

}  // namespace

Command declare_map(CLI::App& program) {
  return make_command(program, "map", summary, declare_map_options, run_map);
}

}  // namespace sphparam::cli
