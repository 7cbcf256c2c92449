// `sphparam remesh`: a mapped mesh → a grid of the sphere → the mesh on that grid, whose map the
// grid's directions are.

#include <algorithm>
#include <utility>

#include "arguments/limits.h"
#include "arguments/remesh_arguments.h"
#include "commands/command.h"
#include "commands/remesh_outputs.h"
#include "commands/sources.h"
#include "console/places.h"
#include "number_text.h"
#include "remesh/wanted_values.h"
#include "reports/remesh_wording.h"
#include "reports/told_fillers.h"
#include "reports/told_losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/remesh/resample.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Resample a mesh on a grid of the sphere.\n"
    "\n"
    "Examples:\n"
    "  sphparam remesh statue.sph.ply --grid ico:7 -o statue_ico7.sph.ply\n"
    "  sphparam remesh statue.sph.ply --grid ico:5 --sample cell --transfer color,uv -o low.obj\n"
    "  sphparam remesh lh.white.gii --sphere lh.sphere.gii --grid like:ref.sphere.gii -o lh.ply\n"
    "  sphparam remesh lh.midthickness --sphere lh.sphere.reg --grid like:fs_LR.L.sphere.surf.gii "
    "\\\n"
    "    --data lh.thickness,lh.aparc.annot --sample adap-bary-area -o L.midthickness.surf.gii\n"
    "  sphparam remesh bennu.sph.ply --grid healpix:128 --csv bennu.csv\n"
    "  sphparam remesh statue.sph.ply --grid cube:32 --subdiv-fit catmark -o base.obj --displace "
    "lack.exr\n"
    "  sphparam remesh statue.sph.ply --grid ico:5 --subdiv-fit loop --displace disp.exr -o "
    "base.glb\n"
    "  sphparam remesh statue.sph.ply --grid ico:7 --lods 4 -o statue.glb\n"
    "  sphparam remesh statue.sph.ply --grid octa:257 --geometry-image gi.exr\n"
    "  sphparam remesh statue.sph.ply --grid ico --within 0.5% -o near.sph.ply\n"
    "\n"
    "Grids: ico:L (icosahedron, L times halved), ico:f=N (its edges cut into N), octa:N (flat\n"
    "octahedron, N×N samples), cube:N (quads, N an edge), uv:WxH (meridians and rows),\n"
    "healpix:NSIDE (pixel centres in RING order), like:MESH (another sphere's vertices).\n"
    "The directions of the grid are the map of the result: a .ply is certified as `map` writes\n"
    "it. Each vertex is located exactly; a mesh that carries no map is mapped first\n"
    "(as `map --lambda 5` does, which spreads a grid's vertices better than the default).\n";

/// The grid that --within finds, which is the one that was asked for then.
std::optional<GridWithin> seek_grid(RemeshArguments& arguments, RemeshRequests& requests,
                                    const MappedMesh& mapped, Session& session) {
  if (!arguments.within) return std::nullopt;
  const double most = arguments.within->of(diagonal_of(mapped.mesh().positions));
  const GridWithin found = coarsest_grid_within(
      mapped, most,
      {.sample = arguments.sample, .threads = session.threads(), .progress = session.progress()});
  requests.grid = found.grid;
  arguments.grid = name_of(found.grid);
  return found;
}

struct TimedGrid {
  SphereGrid grid;
  double seconds;
};

TimedGrid grid_for(const RemeshArguments& arguments, const RemeshRequests& requests,
                   Session& session) {
  session.console.progress("grid", 0);
  const Stopwatch stopwatch;
  SphereGrid grid = requests.grid ? make_grid(*requests.grid, {.threads = arguments.threads})
                                  : load_grid(requests.like, input_limits(), arguments.threads);
  grid.name = arguments.grid;
  const double seconds = stopwatch.seconds();
  if (!grid.warning.empty()) session.warn({grid.warning});
  return {std::move(grid), seconds};
}

/// Where it is wanted.
std::optional<Adaptation> adapt(const RemeshArguments& arguments, const MappedMesh& mapped,
                                std::int64_t samples, Session& session) {
  if (!arguments.adaptive) return std::nullopt;
  Adaptation adapted = adapt_map(
      mapped, samples,
      {.lambda = arguments.lambda, .threads = session.threads(), .progress = session.progress()});
  if (adapted.steps == 0) {
    session.console.warning(
        display_name(arguments.input) +
        ": triangles of the map are too thin to be moved: --adaptive does nothing");
  }
  return adapted;
}

struct Areas {
  VectorX source, grid;
};

VectorX areas_in_data(const std::string& path, Eigen::Index vertices) {
  const VertexData data = read_vertex_data(path, vertices, input_limits());
  const std::vector<double>& values = data.columns.front().values;
  const bool are_areas = std::ranges::all_of(values, [](double area) { return area >= 0; });
  if (data.columns.size() != 1 || !are_areas)
    throw ReadError(path, "areas are one column of numbers that are not negative");
  return Eigen::Map<const VectorX>(values.data(), vertices);
}

/// Areas of vertices: of a surface, or as a file has them.
VectorX read_areas(const std::string& path, Eigen::Index vertices) {
  std::optional<TriangleMesh> surface;
  try {
    surface = read_mesh(path, input_limits()).mesh;
  } catch (const ReadError&) {
    return areas_in_data(path, vertices);
  }
  if (surface->vertex_count() == vertices) return vertex_areas(*surface);
  throw ReadError(path, "has " + std::to_string(surface->vertex_count()) + " vertices, and " +
                            std::to_string(vertices) + " are wanted");
}

Areas read_areas(const RemeshRequests& requests, Eigen::Index vertices, Eigen::Index on_grid) {
  if (requests.areas.empty()) return {};
  return {read_areas(requests.areas[0], vertices), read_areas(requests.areas[1], on_grid)};
}

std::vector<LevelOfDetail> make_levels(const MappedMesh& mapped, SphereGrid grid,
                                       const RemeshArguments& arguments,
                                       const RemeshRequests& requests, Session& session) try {
  const Areas areas = read_areas(requests, mapped.mesh().vertex_count(), grid.directions.rows());
  std::vector<LevelOfDetail> levels = levels_of_detail(mapped, std::move(grid), requests.coarser,
                                                       {.sample = arguments.sample,
                                                        .source_areas = areas.source,
                                                        .grid_areas = areas.grid,
                                                        .transfer = split(arguments.transfer),
                                                        .subdivision = arguments.subdivision,
                                                        .measure = !requests.coarser.empty(),
                                                        .threads = session.threads(),
                                                        .progress = session.progress()});
  for (const LevelOfDetail& level : levels) {
    if (!level.fit || !level.fit->flat_is_nearer()) continue;
    session.console.warning(
        level.mesh.name() +
        " is too coarse for a smooth surface: flat faces on it are nearer to the mesh than what "
        "was fitted");
  }
  for (const LevelOfDetail& level : levels) tell_changed_holes(mapped, level.mesh, session.console);
  return levels;
} catch (const UnfittableGrid& error) {
  throw UsageMistake("--subdiv-fit: " + std::string(error.what()));
}

MissingValues missing_values(const RemeshRequests& requests) {
  if (requests.missing_values) return MissingValues::Kept;
  return requests.data_outputs.empty() ? MissingValues::LeftOut : MissingValues::Refused;
}

/// Throws: UsageMistake for what is to be carried, or shown by an image, and is not there.
void require_values(const MeshFile& source, const RemeshArguments& arguments,
                    const RemeshRequests& requests) try {
  const WantedValues wanted(split(arguments.transfer), source);
  try {
    for (const ImageRequest& image : requests.images) wanted.require_image(image.what, source);
  } catch (const NoSuchProperty& error) {
    throw UsageMistake("--attribute-image: " + std::string(error.what()));
  }
} catch (const NoSuchProperty& error) {
  throw UsageMistake("--transfer: " + std::string(error.what()));
}

/// Throws: UsageMistake for a --lambda that a map is not made with.
void require_use_of_lambda(const MeshFile& source, const RemeshArguments& arguments) {
  const bool has_map = !arguments.sphere.empty() || read_sphere(source).has_value();
  if (!arguments.given("--lambda") || arguments.adaptive || !has_map) return;
  throw UsageMistake("--lambda is for maps that are made here, and " +
                     display_name(arguments.input) +
                     " has one: map the mesh anew, as by `sphparam map --lambda " +
                     shortest(arguments.lambda) + "`, or leave --lambda out");
}

/// The mesh with its map; what it lacks is told before it is mapped, which may take minutes.
MappedMesh read_remeshed(const RemeshArguments& arguments, const RemeshRequests& requests,
                         Session& session) {
  session.hold_signals();
  MeshSource source = read_mended(arguments.input, arguments.repair, session, arguments.data,
                                  missing_values(requests));
  require_values(source.file, arguments, requests);
  require_use_of_lambda(source.file, arguments);
  tell_replaced(source, session.console);
  return map_source(std::move(source), arguments.sphere, session, arguments.repair,
                    arguments.lambda);
}

/// Refuses what cannot be fitted or measured; tells of fillers that count as surface.
void look_at_source(const RemeshArguments& arguments, const MappedMesh& mapped, Session& session) {
  if (arguments.subdivision || arguments.lods > 0 || arguments.within)
    require_measurable(mapped.mesh());
  if (arguments.subdivision) tell_counted_fillers(mapped, "what is fitted", session.console);
  if (arguments.adaptive) tell_counted_fillers(mapped, "where vertices go", session.console);
}

/// Of data on a sphere, whose areas are none of the surface that was measured.
void tell_areas_of_sphere(const RemeshArguments& arguments, const TriangleMesh& mesh,
                          Session& session) {
  const bool are_its_own = arguments.sample == SampleMode::AdapBaryArea &&
                           arguments.areas.empty() && !arguments.data.empty();
  if (are_its_own && roundness_warning(SphereMap{mesh.positions}).empty())
    session.warn({"the areas of --sample adap-bary-area are those of " +
                  display_name(arguments.input) +
                  ", which is a sphere: --areas OLD,NEW takes those of surfaces, as "
                  "`wb_command … -area-surfs` does"});
}

int run_remesh(RemeshArguments& arguments) {
  Session session(arguments);
  RemeshRequests requests = check_remesh_arguments(arguments);
  require_there({arguments.input, arguments.sphere, requests.like});
  require_there(requests.areas);
  MappedMesh mapped = read_remeshed(arguments, requests, session);
  const int last_data = last_attached(mapped.file());
  look_at_source(arguments, mapped, session);
  const std::optional<GridWithin> within = seek_grid(arguments, requests, mapped, session);
  TimedGrid made = grid_for(arguments, requests, session);
  tell_areas_of_sphere(arguments, mapped.mesh(), session);
  const std::optional<Adaptation> adaptation =
      adapt(arguments, mapped, made.grid.directions.rows(), session);
  if (adaptation) mapped = adaptation->mapped;
  std::vector<LevelOfDetail> levels =
      make_levels(mapped, std::move(made.grid), arguments, requests, session);
  const RemeshFiles files = add_files(arguments, requests, mapped, last_data, levels, session);
  RemeshRecord record{.input = arguments.input,
                      .grid = arguments.grid,
                      .source = mapped,
                      .levels = levels,
                      .sample = arguments.sample,
                      .within = within,
                      .adaptation = adaptation,
                      .layout = requests.layout,
                      .displacement = files.displacement,
                      .outputs = files.outputs,
                      .grid_seconds = made.seconds,
                      .seconds = session.stopwatch.seconds()};
  session.add_report([&] { return to_json(record); });
  session.publish();
  record.seconds = session.stopwatch.seconds();
  tell(record, session.console);
  return within && !within->holds() ? LimitExceeded : Ok;
}

}  // namespace

Command declare_remesh(CLI::App& program) {
  return make_command(program, "remesh", summary, declare_remesh_options, run_remesh);
}

}  // namespace sphparam::cli
