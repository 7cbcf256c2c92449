// `sphparam remesh`: a mapped mesh → a grid of the sphere → the mesh on that grid, whose map the
// grid's directions are. What was written is read back and certified before it gets its name.

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

#include "arguments/limits.h"
#include "arguments/remesh_arguments.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/attributes/appearance.h"
#include "io/match_targets.h"
#include "number_text.h"
#include "remesh/wanted_values.h"
#include "reports/remesh_wording.h"
#include "reports/told_fillers.h"
#include "reports/told_losses.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/remesh/geometry_image.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/remesh/texture_layout.h"

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
    "\n"
    "Grids: ico:L (icosahedron, L times halved), ico:f=N (its edges cut into N), octa:N (flat\n"
    "octahedron, N×N samples), cube:N (quads, N an edge), uv:WxH (meridians and rows),\n"
    "healpix:NSIDE (pixel centres in RING order), like:MESH (another sphere's vertices).\n"
    "The directions of the grid are the map of the result: a .ply is certified as `map` writes\n"
    "it. Each vertex is located exactly; a mesh that carries no map is mapped first\n"
    "(as `map --lambda 5` does, which spreads a grid's vertices better than the default).\n";

SphereGrid grid_for(const RemeshArguments& arguments, const RemeshRequests& requests) {
  SphereGrid grid = requests.grid ? make_grid(*requests.grid, {.threads = arguments.threads})
                                  : load_grid(requests.like, input_limits(), arguments.threads);
  grid.name = arguments.grid;
  return grid;
}

Adaptation adapt(const MappedMesh& mapped, std::int64_t samples, const std::string& input,
                 Session& session) {
  Adaptation adapted =
      adapt_map(mapped, samples, {.threads = session.threads(), .progress = session.progress()});
  if (adapted.steps == 0) {
    session.console.warning(
        display_name(input) +
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
  return levels;
} catch (const UnfittableGrid& error) {
  throw UsageMistake("--subdiv-fit: " + std::string(error.what()));
}

void add_errors(Asset& asset, std::span<const LevelOfDetail> levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string name = "level_" + std::to_string(i);
    asset.extras.emplace_back(name + "_grid", levels[i].mesh.name());
    asset.extras.emplace_back(name + "_rms", short_number(levels[i].distance.value().rms, 6));
    asset.extras.emplace_back(name + "_max", short_number(levels[i].distance.value().max, 6));
  }
}

Asset asset_of(const RemeshArguments& arguments, const MappedMesh& mapped,
               std::span<const LevelOfDetail> levels, Session& session) try {
  const MappedMesh& made = levels.front().mesh;
  ExportOptions options{.name = stem_or(arguments.input, "mesh"),
                        .source = display_name(arguments.input),
                        .threads = session.threads(),
                        .progress = session.progress()};
  const Look look = make_look(made, mapped, options);
  for (const LevelOfDetail& level : levels.subspan(1)) options.coarser.push_back(level.mesh);
  Asset asset = make_asset(made, look, options);
  if (levels.size() > 1) add_errors(asset, levels);
  return asset;
} catch (const LookError& error) {
  throw UsageMistake(error.what());
}

/// The new mesh as a .glb with the chart of its directions, as `export` writes it: with the
/// texture of the source where its coordinates are carried, else with the colours carried, else
/// with a checker. Quads are cut in two. Coarser levels hang on the finest by MSFT_lod, which is
/// what viewers without it show; the extras tell the error of each.
///
/// Requires: a level, the finest first. Throws: NotCertifiedError where (u, v) is not one-to-one;
/// ReadError for positions beyond float32; WriteError for more than a .glb holds, and as
/// PendingFiles does; Cancelled.
void add_glb(const RemeshArguments& arguments, const MappedMesh& mapped,
             std::span<const LevelOfDetail> levels, Session& session) {
  with_file_errors(arguments.input, arguments.output, [&] {
    const Asset asset = asset_of(arguments, mapped, levels, session);
    session.warn(asset.warnings);
    add_asset(session.files, arguments.output, asset);
  });
}

/// The data that has files of its own. `last`: the `last_attached` of what was read.
void add_data(const RemeshRequests& requests, int last, const Remeshed& made, Session& session) {
  std::vector<VertexData> data = attached_data(made.file());
  const int first = last + 1 - static_cast<int>(requests.data_outputs.size());
  for (std::size_t i = 0; i < requests.data_outputs.size(); ++i) {
    const std::string& path = requests.data_outputs[i];
    const auto found =
        std::ranges::find(data, first + static_cast<int>(i), &VertexData::attached_as);
    if (found == data.end())
      throw UsageMistake("--write-data: " + output_name(path) +
                         ": nothing of its --data is on the new mesh: --transfer leaves it out; "
                         "--transfer all carries it");
    VertexData& one = *found;
    one.triangles = made.mesh().face_count();
    tell_losses(path, add_vertex_data(session.files, path, one, &made.mesh().positions),
                session.console);
  }
}

void add_meshes(const RemeshArguments& arguments, const RemeshRequests& requests,
                const MappedMesh& mapped, const std::vector<LevelOfDetail>& levels,
                Session& session) {
  const WriteOptions new_mesh{.origin = arguments.input};
  if (requests.one_file) {
    add_glb(arguments, mapped, levels, session);
  } else if (!arguments.output.empty()) {
    std::vector<std::string> left_behind;
    add_sampling_losses(left_behind, mapped.file());
    add_match_loss(left_behind, mapped.file());
    tell_losses(arguments.output, left_behind, session.console);
    for (size_t level = 0; level < levels.size(); ++level)
      tell_losses(requests.outputs[level],
                  add_mapped(session.files, requests.outputs[level], levels[level].mesh,
                             session.threads(), new_mesh, arguments.holes),
                  session.console);
  }
  if (arguments.limit_output.empty()) return;
  const LevelOfDetail& finest = levels.front();
  const auto limit = limit_mesh(finest.mesh, finest.fit.value(), session.threads());
  tell_losses(arguments.limit_output,
              add_mapped(session.files, arguments.limit_output, limit, session.threads(), new_mesh,
                         arguments.holes),
              session.console);
}

std::optional<WrittenDisplacement> displace(const RemeshArguments& arguments,
                                            const RemeshRequests& requests,
                                            const MappedMesh& mapped, const LevelOfDetail& level,
                                            Session& session) try {
  if (arguments.displacement.empty()) return std::nullopt;
  WrittenDisplacement written = add_displacement(
      session.files, {arguments.displacement, arguments.depth, arguments.rebuilt}, mapped,
      level.mesh, level.fit.value(),
      {.width = arguments.displacement_size.width,
       .height = arguments.displacement_size.height,
       .layout = requests.layout ? DisplacementLayout::Grid : DisplacementLayout::Equirectangular,
       .threads = session.threads(),
       .progress = session.progress()});
  if (written.proof && written.proof->farther_than_base()) session.console.warning(farther_warning);
  return written;
} catch (const std::range_error& error) {
  throw UsageMistake("--depth: displacement: " + std::string(error.what()));
}

/// What a program that displaces must be told, as a comment.
std::string recipe_of(const std::string& image, Scheme scheme, const WrittenDisplacement& written) {
  const std::string name = scheme == Scheme::Loop ? "Loop" : "Catmull-Clark";
  return "displacement: " + output_name(image) + ": subdivide by " + name + ", " +
         std::to_string(written.layout.value().levels) +
         " levels, to the limit surface; along normals by (value - " + shortest(written.midlevel) +
         ") * " + shortest(written.scale) + ", in units of the mesh";
}

/// Gives the levels the texture coordinates of their grids.
void lay_textures(std::vector<LevelOfDetail>& levels, const RemeshArguments& arguments,
                  const RemeshRequests& requests, const MappedMesh& mapped,
                  const std::optional<WrittenDisplacement>& displacement, Session& session) {
  if (!requests.layout) return;
  if (has_texcoords(mapped.file()))
    session.console.warning("texture coordinates of the mesh are left out; --uv mesh carries them");
  std::vector<std::string> recipe;
  if (displacement)
    recipe.push_back(
        recipe_of(arguments.displacement, arguments.subdivision.value(), *displacement));
  for (size_t i = 0; i < levels.size(); ++i) {
    const TextureLayout& layout = i == 0 ? *requests.layout : requests.coarser_layouts[i - 1];
    levels[i].mesh = with_grid_texture(levels[i].mesh, layout, session.threads(),
                                       i == 0 ? recipe : std::vector<std::string>{});
  }
}

void add_images(PendingFiles& files, const RemeshArguments& arguments,
                const RemeshRequests& requests, const Remeshed& mesh) {
  for (const auto& [what, path] : requests.images) {
    try {
      add_geometry_image(files, path, mesh, what, arguments.depth);
    } catch (const NoSuchProperty& error) {
      throw UsageMistake("--attribute-image: " + std::string(error.what()));
    } catch (const std::range_error& error) {
      throw UsageMistake("--depth: " + what + ": " + error.what());
    }
  }
}

/// Tells what faces have, which rows of vertices have no place for.
void tell_left_out_of_table(const std::string& table, const MeshFile& made, Console& console) {
  std::vector<std::string> names;
  for (const Property& property : made.face_properties)
    if (property.name != filler_property && property.name != "source_face")  // of the grid's quads
      names.push_back(property.name);
  Words losses;
  if (!names.empty()) add_loss(losses, enumerated(names) + " of faces: rows are of vertices");
  tell_losses(table, losses, console);
}

/// Warns of what the directions of a table are not, and of rows that lie in holes.
std::string table_of(const RemeshArguments& arguments, const MappedMesh& mapped,
                     const Remeshed& made, Session& session) {
  if (arguments.degrees) tell_longitudes(mapped, Convention::Gis, false, std::nullopt, session);
  tell_left_out_of_table(arguments.csv, made.file(), session.console);
  const TableHoles holes{in_holes(mapped, made.map().points, session.threads()),
                         arguments.holes == FillersInFile::Left};
  if (const auto count = std::count(holes.in_hole.begin(), holes.in_hole.end(), 1); count > 0) {
    session.console.say("  " + output_name(arguments.csv) + ": " +
                        counted(count, "row lies in a hole", "rows lie in holes") +
                        (holes.left_out ? ": left out"
                                        : ": 1 in the column filler; --holes drop leaves them "
                                          "out"));
  }
  return sample_table(made, arguments.degrees ? TableAngles::Degrees : TableAngles::Radians, holes);
}

/// Files of --data, beside meshes or as they were named.
Words data_files(const RemeshArguments& arguments, const RemeshRequests& requests,
                 std::span<const LevelOfDetail> levels) {
  Words files = requests.data_outputs;
  const auto add_beside = [&](const std::string& path, const LevelOfDetail& level) {
    if (!path.empty())
      std::ranges::copy(paths_beside(path, level.mesh.file()), std::back_inserter(files));
  };
  for (size_t i = 0; i < requests.outputs.size() && i < levels.size(); ++i)
    add_beside(requests.outputs[i], levels[i]);
  add_beside(arguments.limit_output, levels.front());
  return files;
}

RemeshOutputs outputs_of(const RemeshArguments& arguments, const RemeshRequests& requests,
                         std::span<const LevelOfDetail> levels) {
  return {.mesh = arguments.output,
          .limit_mesh = arguments.limit_output,
          .displacement = arguments.displacement,
          .rebuilt = arguments.rebuilt,
          .geometry_image = arguments.geometry_image,
          .normals = arguments.normal_image,
          .csv = arguments.csv,
          .attribute_images = arguments.attribute_images,
          .data = data_files(arguments, requests, levels),
          .levels = requests.outputs};
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

/// The mesh with its map; what it lacks is told before it is mapped, which may take minutes.
MappedMesh read_remeshed(const RemeshArguments& arguments, const RemeshRequests& requests,
                         Session& session) {
  session.hold_signals();
  MeshSource source = read_mended(arguments.input, arguments.repair, session, arguments.data,
                                  missing_values(requests));
  require_values(source.file, arguments, requests);
  return map_source(std::move(source), arguments.sphere, session, arguments.repair,
                    remeshing_lambda);
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
  const RemeshRequests requests = check_remesh_arguments(arguments);
  require_there({arguments.input, arguments.sphere, requests.like});
  require_there(requests.areas);
  MappedMesh mapped = read_remeshed(arguments, requests, session);
  const int last_data = last_attached(mapped.file());
  if (arguments.subdivision || arguments.lods > 0) require_measurable(mapped.mesh());
  if (arguments.subdivision) tell_counted_fillers(mapped, "what is fitted", session.console);
  if (arguments.adaptive) tell_counted_fillers(mapped, "where vertices go", session.console);
  session.console.progress("grid", 0);
  const Stopwatch grid_stopwatch;
  SphereGrid grid = grid_for(arguments, requests);
  const double grid_seconds = grid_stopwatch.seconds();
  if (!grid.warning.empty()) session.warn({grid.warning});
  tell_areas_of_sphere(arguments, mapped.mesh(), session);
  std::optional<Adaptation> adaptation;
  if (arguments.adaptive) {
    adaptation = adapt(mapped, grid.directions.rows(), arguments.input, session);
    mapped = adaptation->mapped;
  }
  std::vector<LevelOfDetail> levels =
      make_levels(mapped, std::move(grid), arguments, requests, session);
  for (const LevelOfDetail& level : levels) tell_changed_holes(mapped, level.mesh, session.console);
  session.console.progress("write", 0);
  const std::optional<WrittenDisplacement> displacement =
      displace(arguments, requests, mapped, levels.front(), session);
  lay_textures(levels, arguments, requests, mapped, displacement, session);
  RemeshRecord record{.input = arguments.input,
                      .grid = arguments.grid,
                      .source = mapped,
                      .levels = levels,
                      .sample = arguments.sample,
                      .adaptation = adaptation,
                      .layout = requests.layout,
                      .displacement = displacement,
                      .outputs = outputs_of(arguments, requests, levels),
                      .grid_seconds = grid_seconds};
  const LevelOfDetail& finest = levels.front();
  add_meshes(arguments, requests, mapped, levels, session);
  add_data(requests, last_data, finest.mesh, session);
  add_images(session.files, arguments, requests, finest.mesh);
  if (!arguments.csv.empty())
    session.files.add(arguments.csv, table_of(arguments, mapped, finest.mesh, session));
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  session.publish();
  record.seconds = session.stopwatch.seconds();
  tell(record, session.console);
  return Ok;
}

}  // namespace

Command declare_remesh(CLI::App& program) {
  return make_command(program, "remesh", summary, declare_remesh_options, run_remesh);
}

}  // namespace sphparam::cli
