// What makes no sense is refused before work.

#include <algorithm>
#include <stdexcept>

#include "arguments/limits.h"
#include "arguments/mesh_names.h"
#include "arguments/remesh_arguments.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/remesh/geometry_image.h"
#include "sphparam/remesh/levels_of_detail.h"

namespace sphparam::cli {

namespace {

constexpr std::string_view like_prefix = "like:";
constexpr double least_bytes_a_vertex = 400;  // of a remesh, measured: 450

/// --within finds the level, and what depends on it is not known before.
void check_sought_grid(const RemeshArguments& arguments) {
  if (!arguments.within) return;
  if (arguments.grid != "ico")
    throw UsageMistake("--within finds the level of --grid ico, and is not for --grid " +
                       arguments.grid);
  for (const auto& [is_given, option] : {std::pair(arguments.lods > 0, "--lods"),
                                         {arguments.subdivision.has_value(), "--subdiv-fit"},
                                         {arguments.adaptive, "--adaptive"},
                                         {!arguments.areas.empty(), "--areas"},
                                         {arguments.naming.pattern.has_value(), "--names"},
                                         {arguments.uv == TextureOf::Grid, "--uv grid"}})
    if (is_given)
      throw UsageMistake(std::string("--within is not for ") + option +
                         ": find the level first, and name it");
}

std::optional<GridSpec> grid_asked_for(const RemeshArguments& arguments) {
  if (arguments.within) return GridSpec{.kind = GridKind::Icosahedron, .size = finest_sought};
  if (arguments.grid == like_prefix)
    throw UsageMistake("--grid like: names no mesh, as in like:MESH");
  if (arguments.grid.starts_with(like_prefix)) return std::nullopt;
  try {
    const GridSpec grid = parse_grid(arguments.grid);
    require_memory(
        "--grid " + arguments.grid + ": its " + std::to_string(vertex_count(grid)) + " vertices",
        least_bytes_a_vertex * static_cast<double>(vertex_count(grid)));
    return grid;
  } catch (const std::invalid_argument& error) {
    throw UsageMistake("--grid " + arguments.grid + ": " + error.what());
  }
}

std::vector<ImageRequest> images_asked_for(const RemeshArguments& arguments) {
  std::vector<ImageRequest> requests;
  if (!arguments.geometry_image.empty()) requests.push_back({"position", arguments.geometry_image});
  if (!arguments.normal_image.empty()) requests.push_back({"normal", arguments.normal_image});
  for (const std::string& text : arguments.attribute_images) {
    const auto image = name_and_file(text);
    if (!image) throw UsageMistake("--attribute-image: expected NAME=FILE, not " + text);
    requests.push_back({image->first, image->second});
  }
  return requests;
}

/// Refuses a name with another ending; standard output takes a PLY. `listed`: for people.
void require_kind(const std::string& option, const std::string& path, const std::string& what,
                  const Words& kinds, const std::string& listed) {
  const std::string kind = is_stream(path) ? ".ply" : extension_of(path);
  if (path.empty() || std::ranges::find(kinds, kind) != kinds.end()) return;
  throw UsageMistake(option + ": " + what + " is written as " + listed + ", not as " +
                     output_name(path));
}

/// The name of the new mesh, where a pattern makes it.
void settle_output(RemeshArguments& arguments) {
  if (!arguments.naming.pattern) {
    if (!arguments.naming.subject.empty()) throw UsageMistake("--subject is for --names only");
    return;
  }
  if (arguments.output.empty()) throw UsageMistake("--names is of the new mesh: give -o a folder");
  arguments.output = named_surface(arguments.naming, arguments.output, "-o", arguments.input,
                                   arguments.sphere, "", arguments.grid);
}

/// Whether values may be missing: not where a mesh file or a table has them.
bool takes_missing(const RemeshArguments& arguments) {
  const auto is_beside = [](const std::string& path) {
    return path.empty() || has_data_beside(path);
  };
  return is_beside(arguments.output) && is_beside(arguments.limit_output) &&
         arguments.csv.empty() && images_asked_for(arguments).empty();
}

Words areas_asked_for(const RemeshArguments& arguments) {
  if (arguments.areas.empty()) return {};
  if (arguments.sample != SampleMode::AdapBaryArea)
    throw UsageMistake("--areas is for --sample adap-bary-area only");
  Words files = split(arguments.areas);
  if (files.size() != 2 || files[0].empty() || files[1].empty())
    throw UsageMistake(
        "--areas: expected two files, of the mesh's vertices and of the grid's, not " +
        arguments.areas);
  return files;
}

Words data_outputs_of(const RemeshArguments& arguments) {
  Words outputs = split_all(arguments.data_outputs);
  if (outputs.empty()) return outputs;
  const std::size_t inputs = split_all(arguments.data).size();
  if (outputs.size() != inputs)
    throw UsageMistake("--write-data: " + std::to_string(outputs.size()) + " files, for " +
                       std::to_string(inputs) + " of --data");
  for (const std::string& path : outputs)
    if (!is_written_data(path))
      throw UsageMistake("--write-data: values are written as " + written_data_names() +
                         ", not as " + output_name(path));
  return outputs;
}

void check_outputs(const RemeshArguments& arguments) {
  require_mesh_name("-o", "the new mesh", arguments.output, {".glb", ".usda", ".usdz"});
  if (arguments.output.empty() && arguments.limit_output.empty() && arguments.csv.empty() &&
      arguments.displacement.empty() && arguments.data_outputs.empty() &&
      images_asked_for(arguments).empty()) {
    throw UsageMistake("nothing to write: give -o, --write-data, --geometry-image or --csv");
  }
  table_separator("--csv", arguments.csv);
  if (arguments.degrees && arguments.csv.empty()) {
    throw UsageMistake("--degrees is for --csv only");
  }
}

/// Whatever depth is asked for, the format must hold it.
void require_depth(const RemeshArguments& arguments, const std::string& what,
                   const std::string& path) {
  const bool png = extension_of(path) == ".png";
  if (!arguments.depth || (*arguments.depth == ImageDepth::Uint16) == png) return;
  throw UsageMistake(what + ": half and float go into .exr, u16 into .png");
}

void check_images(const RemeshArguments& arguments, const std::optional<GridSpec>& spec) {
  for (const ImageRequest& request : images_asked_for(arguments)) {
    if (!spec || !has_image_layout(*spec)) {
      throw UsageMistake("images are of octa and cube grids, not of " + arguments.grid);
    }
    const std::string extension = extension_of(request.path);
    if (extension != ".png" && extension != ".exr")
      throw UsageMistake(request.path + ": images are written as .png or .exr");
    require_depth(arguments, request.path, request.path);
  }
}

void check_subdivision(const RemeshArguments& arguments, const std::optional<GridSpec>& grid) {
  const std::string& limit = arguments.limit_output;
  if (!arguments.subdivision) {
    if (!limit.empty()) throw UsageMistake("--limit-mesh is of --subdiv-fit, which is missing");
    return;
  }
  const bool triangles = !grid || !has_quads(*grid);
  if (*arguments.subdivision == Scheme::Loop && !triangles) {
    throw UsageMistake("--subdiv-fit loop is for grids of triangles, and " + arguments.grid +
                       " has quads: use catmark");
  }
  if (*arguments.subdivision == Scheme::CatmullClark && triangles) {
    throw UsageMistake("--subdiv-fit catmark is for grids of quads, and " + arguments.grid +
                       " has triangles only: use loop");
  }
  if (grid && grid->kind == GridKind::Geographic &&
      grid->size > LimitTopology::most_faces_about_a_vertex) {
    throw UsageMistake("--subdiv-fit: at the poles of " + arguments.grid + " " +
                       std::to_string(grid->size) + " faces meet, and at most " +
                       std::to_string(LimitTopology::most_faces_about_a_vertex) +
                       " can about a vertex of a limit surface");
  }
  require_mesh_name("--limit-mesh", "the mesh", limit);
}

void check_displacement(const RemeshArguments& arguments) {
  const std::string &image = arguments.displacement, &mesh = arguments.rebuilt;
  if (!mesh.empty() && image.empty()) {
    throw UsageMistake("--rebuild is made of the image of --displace, which is missing");
  }
  if (image.empty()) return;
  if (!arguments.subdivision) {
    throw UsageMistake(
        "--displace is along the normals of a limit surface: give --subdiv-fit; heights over a "
        "mesh of flat faces are `bake --for MESH --map height`");
  }
  require_kind("--displace", image, "the image", {".exr", ".png"}, ".exr or .png");
  require_depth(arguments, "--displace", image);
  require_kind("--rebuild", mesh, "the mesh", {".ply", ".obj"}, ".ply or .obj");
}

/// The layout of a grid goes by it too. After `check_texture`.
void check_displacement_size(const RemeshArguments& arguments) {
  if (arguments.displacement_size && arguments.displacement.empty() &&
      arguments.uv != TextureOf::Grid)
    throw UsageMistake("--displace-size is of the image of --displace, which is missing");
}

std::vector<GridSpec> check_levels(const RemeshArguments& arguments,
                                   const std::optional<GridSpec>& grid) {
  if (arguments.lods == 0) return {};
  if (arguments.output.empty()) throw UsageMistake("--lods are meshes: give -o");
  if (is_stream(arguments.output)) throw UsageMistake("--lods are files: give -o a name");
  std::vector<GridSpec> coarser =
      grid ? coarser_grids(*grid, arguments.lods) : std::vector<GridSpec>{};
  if (std::ssize(coarser) < arguments.lods) {
    throw UsageMistake("--lods: " + arguments.grid +
                       (coarser.empty()
                            ? " has no coarser grids: ico:L has, and octa:N with N - 1 and cube:N "
                              "with N a power of two"
                            : " has only " + std::to_string(coarser.size()) + " coarser"));
  }
  return coarser;
}

/// A control mesh, which keeps its quads.
bool is_cage_of_usd(const RemeshArguments& arguments) {
  const std::string kind = extension_of(arguments.output);
  return arguments.subdivision && (kind == ".usda" || kind == ".usdz");
}

bool takes_texture_of_grid(const RemeshArguments& arguments) {
  const std::string kind =
      is_stream(arguments.output) ? ".ply" : inner_extension_of(arguments.output);
  return kind == ".obj" || kind == ".ply" || is_cage_of_usd(arguments);
}

/// Whether texture coordinates are the grid's, where that was not said.
bool has_texture_of_grid_unasked(const RemeshArguments& arguments,
                                 const std::optional<GridSpec>& grid) {
  const Words carried = split(arguments.transfer);
  return arguments.subdivision && takes_texture_of_grid(arguments) && grid &&
         has_texture_layout(*grid) && std::ranges::find(carried, "uv") == carried.end();
}

/// Settles `uv`.
void check_texture(RemeshArguments& arguments, const std::optional<GridSpec>& grid) {
  if (!arguments.uv)
    arguments.uv = has_texture_of_grid_unasked(arguments, grid) ? TextureOf::Grid : TextureOf::Mesh;
  if (arguments.uv == TextureOf::Mesh) return;
  if (!grid || !has_texture_layout(*grid))
    throw UsageMistake("--uv grid: " + arguments.grid +
                       " has no layout of its own: cube:N, octa:N, ico:L, ico:f=N and uv:WxH have");
  const Words carried = split(arguments.transfer);
  if (std::ranges::find(carried, "uv") != carried.end())
    throw UsageMistake(
        "--transfer uv carries the mesh's texture coordinates, and --uv grid makes others");
  if (!takes_texture_of_grid(arguments))
    throw UsageMistake(
        "--uv grid is of -o in .obj or .ply, which keep quads; a .glb or USD has the chart of its "
        "directions");
}

TextureLayout layout_for(const RemeshArguments& arguments, const GridSpec& grid) {
  const DisplacementSize size = arguments.displacement_size.value_or(DisplacementSize{});
  return texture_layout(grid, std::int64_t{size.width} * size.height);
}

std::vector<std::string> outputs_of(const RemeshArguments& arguments, bool one_file) {
  if (arguments.lods == 0 || one_file) return {arguments.output};
  std::vector<std::string> paths;
  for (int level = 0; level <= arguments.lods; ++level)
    paths.push_back(level_path(arguments.output, level));
  return paths;
}

void check_all_places(const RemeshArguments& arguments, const RemeshRequests& requests) {
  Outputs outputs = {{"-o", requests.outputs.front()},
                     {"--limit-mesh", arguments.limit_output},
                     {"--displace", arguments.displacement},
                     {"--rebuild", arguments.rebuilt},
                     {"--csv", arguments.csv},
                     {"--json", arguments.json}};
  for (const ImageRequest& request : requests.images)
    outputs.emplace_back("the image of " + request.what, request.path);
  for (size_t level = 1; level < requests.outputs.size(); ++level)
    outputs.emplace_back("--lods", requests.outputs[level]);
  for (const std::string& path : requests.data_outputs) outputs.emplace_back("--write-data", path);
  check_places(outputs);
}

}  // namespace

RemeshRequests check_remesh_arguments(RemeshArguments& arguments) {
  check_sought_grid(arguments);
  settle_output(arguments);
  check_outputs(arguments);
  RemeshRequests requests;
  requests.areas = areas_asked_for(arguments);
  requests.data_outputs = data_outputs_of(arguments);
  requests.missing_values = takes_missing(arguments);
  requests.grid = grid_asked_for(arguments);
  if (!requests.grid) requests.like = arguments.grid.substr(like_prefix.size());
  requests.images = images_asked_for(arguments);
  check_images(arguments, requests.grid);
  check_subdivision(arguments, requests.grid);
  check_displacement(arguments);
  requests.coarser = check_levels(arguments, requests.grid);
  check_texture(arguments, requests.grid);
  check_displacement_size(arguments);
  if (arguments.uv == TextureOf::Grid) {
    requests.layout = layout_for(arguments, *requests.grid);
    for (const GridSpec& grid : requests.coarser)
      requests.coarser_layouts.push_back(layout_for(arguments, grid));
  }
  const std::string kind = extension_of(arguments.output);
  requests.one_file = kind == ".glb";
  requests.is_usd = kind == ".usda" || kind == ".usdz";
  requests.outputs = outputs_of(arguments, requests.one_file);
  check_all_places(arguments, requests);
  return requests;
}

}  // namespace sphparam::cli
