// The new mesh and what lies beside it. What was written is read back and certified before it gets
// its name.

#include "commands/remesh_outputs.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

#include "arguments/mesh_names.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/attributes/appearance.h"
#include "io/match_targets.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/gltf/export.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/remesh/geometry_image.h"
#include "sphparam/remesh/remesh.h"

namespace sphparam::cli {

namespace {

void add_errors(Asset& asset, std::span<const LevelOfDetail> levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string name = "level_" + std::to_string(i);
    asset.extras.emplace_back(name + "_grid", levels[i].mesh.name());
    asset.extras.emplace_back(name + "_rms", short_number(levels[i].distance.value().rms, 6));
    asset.extras.emplace_back(name + "_max", short_number(levels[i].distance.value().max, 6));
  }
}

Asset asset_of(const RemeshArguments& arguments, const MappedMesh& mapped,
               std::span<const LevelOfDetail> levels, bool is_usd, Session& session) try {
  const MappedMesh& made = levels.front().mesh;
  ExportOptions options{.name = stem_or(arguments.input, "mesh"),
                        .source = display_name(arguments.input),
                        .upward_v = is_usd,
                        .threads = session.threads(),
                        .progress = session.progress()};
  // Telephones show no colours of vertices.
  options.look.bake_colours = extension_of(arguments.output) == ".usdz";
  const Look look = make_look(made, mapped, options);
  for (const LevelOfDetail& level : levels.subspan(1)) options.coarser.push_back(level.mesh);
  Asset asset = make_asset(made, look, options);
  if (levels.size() > 1) add_errors(asset, levels);
  return asset;
} catch (const LookError& error) {
  throw UsageMistake(error.what());
}

/// The new mesh as a .glb or USD with the chart of its directions, as `export` writes it: with the
/// texture of the source where its coordinates are carried, else with the colours carried, else
/// with a checker. Quads are cut in two. Coarser levels hang on the finest by MSFT_lod, which is
/// what viewers without it show; the extras tell the error of each. As USD each level has files of
/// its own.
///
/// Requires: a level, the finest first. Throws: NotCertifiedError where (u, v) is not one-to-one;
/// ReadError for positions beyond float32; WriteError for more than a .glb holds, and as
/// PendingFiles does; Cancelled.
void add_charted(const RemeshArguments& arguments, const RemeshRequests& requests,
                 const MappedMesh& mapped, std::span<const LevelOfDetail> levels,
                 Session& session) {
  with_file_errors(arguments.input, arguments.output, [&] {
    const std::size_t in_each = requests.one_file ? levels.size() : 1;
    for (std::size_t i = 0; i < requests.outputs.size(); ++i) {
      const Asset asset =
          asset_of(arguments, mapped, levels.subspan(i, in_each), !requests.one_file, session);
      session.warn(asset.warnings);
      if (!requests.one_file) session.warn(beyond_usd(asset));
      add_asset(session.files, requests.outputs[i], asset);
    }
  });
}

/// Control meshes, whose quads stay.
void add_cages(const RemeshArguments& arguments, const RemeshRequests& requests,
               const std::vector<LevelOfDetail>& levels, Session& session) {
  const bool is_loop = arguments.subdivision == Scheme::Loop;
  for (std::size_t i = 0; i < levels.size(); ++i)
    tell_losses(requests.outputs[i],
                add_usd_cage(session.files, requests.outputs[i], levels[i].mesh, is_loop),
                session.console);
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
  if (requests.is_usd && arguments.subdivision) {
    add_cages(arguments, requests, levels, session);
  } else if (requests.one_file || requests.is_usd) {
    add_charted(arguments, requests, mapped, levels, session);
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
  const DisplacementSize size = arguments.displacement_size.value_or(DisplacementSize{});
  WrittenDisplacement written = add_displacement(
      session.files, {arguments.displacement, arguments.depth, arguments.rebuilt}, mapped,
      level.mesh, level.fit.value(),
      {.width = size.width,
       .height = size.height,
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
  return sample_table(made, arguments.degrees ? TableAngles::Degrees : TableAngles::Radians, holes,
                      table_separator("--csv", arguments.csv));
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

}  // namespace

RemeshFiles add_files(const RemeshArguments& arguments, const RemeshRequests& requests,
                      const MappedMesh& mapped, int last_data, std::vector<LevelOfDetail>& levels,
                      Session& session) {
  session.console.progress("write", 0);
  const LevelOfDetail& finest = levels.front();
  std::optional<WrittenDisplacement> displacement =
      displace(arguments, requests, mapped, finest, session);
  lay_textures(levels, arguments, requests, mapped, displacement, session);
  add_meshes(arguments, requests, mapped, levels, session);
  add_data(requests, last_data, finest.mesh, session);
  add_images(session.files, arguments, requests, finest.mesh);
  if (!arguments.csv.empty())
    session.files.add(arguments.csv, table_of(arguments, mapped, finest.mesh, session));
  return {std::move(displacement), outputs_of(arguments, requests, levels)};
}

}  // namespace sphparam::cli
