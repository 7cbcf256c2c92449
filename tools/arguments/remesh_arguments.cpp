// The options of `sphparam remesh`.

#include "arguments/remesh_arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "arguments/choice.h"
#include "arguments/common_options.h"

namespace sphparam::cli {

namespace {

constexpr int most_levels = 12;

constexpr char summary[] =
    "Resample a mesh on a grid of the sphere.\n"
    "\n"
    "Examples:\n"
    "  sphparam remesh statue.sph.ply --grid ico:7 -o statue_ico7.sph.ply\n"
    "  sphparam remesh statue.sph.ply --grid ico:5 --sample cell --transfer color,uv -o low.obj\n"
    "  sphparam remesh lh.white.gii --sphere lh.sphere.gii --grid like:ref.sphere.gii -o lh.ply\n"
    "  sphparam remesh bennu.sph.ply --grid healpix:128 --csv bennu.csv\n"
    "  sphparam remesh statue.sph.ply --grid cube:32 --subdiv-fit catmark -o base.obj\n"
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

void add_outputs(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option(
          "-o,--output", arguments.output,
          "The new mesh: .ply with its map, .obj (quads stay quads in both), or .glb with its "
          "chart")
      ->type_name("FILE");
  command
      .add_option("--geometry-image", arguments.geometry_image,
                  "Positions as an image, of octa and cube grids: .exr in float, .png in 16 bits")
      ->type_name("FILE");
  command.add_option("--normals", arguments.normal_image, "The image of the new mesh's normals")
      ->type_name("FILE");
  command
      .add_option("--attribute-image", arguments.attribute_images,
                  "The image of what is carried, as in color=FILE or thickness=FILE; may be given "
                  "again")
      ->type_name("NAME=FILE")
      ->expected(1)
      ->take_all();
  add_choice<std::optional<ImageDepth>>(
      command, "--depth", arguments.depth,
      {{"half", ImageDepth::Half}, {"float", ImageDepth::Float}, {"u16", ImageDepth::Uint16}},
      "Of images: half or float in .exr, u16 in .png (default: "
      "float, u16)");
  command
      .add_option("--csv", arguments.csv, "A row for each vertex: direction, position, properties")
      ->type_name("FILE");
  add_json(command, arguments.json);
}

void declare_subdivision_options(CLI::App& command, RemeshArguments& arguments) {
  add_choice<std::optional<Scheme>>(
      command, "--subdiv-fit", arguments.subdivision,
      {{"loop", Scheme::Loop}, {"catmark", Scheme::CatmullClark}},
      "The new mesh is the control mesh of a subdivision surface that is fitted to the mesh: loop "
      "on grids of triangles, catmark on grids of quads");
  command
      .add_option("--limit-mesh", arguments.limit_output,
                  "With --subdiv-fit, also the mesh whose vertices lie on that surface: .ply, .obj")
      ->type_name("FILE");
}

void declare_displacement_options(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option("--displace", arguments.displacement,
                  "With --subdiv-fit: an equirectangular image of how far the mesh is from the "
                  "fitted surface along its normal: .exr, or .png in 16 bits")
      ->type_name("FILE");
  command
      .add_option("--displace-size", arguments.displacement_size, "Columns and rows of that image")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return image_size_named(text)
                       ? std::string()
                       : "expected columns and rows, as in 4096x2048, columns even, "
                         "at most " +
                             std::to_string(most_texels) + " texels, not " + text;
          },
          ""))
      ->type_name("WxH")
      ->capture_default_str();
  command
      .add_option("--rebuild", arguments.rebuilt,
                  "With --displace: the mesh that surface and image give, as fine as the image, "
                  "and how far it is from the mesh: .ply, .obj")
      ->type_name("FILE");
}

void declare_lod_options(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option(
          "--lods", arguments.lods,
          "So many coarser meshes, each on the coarser half of its grid (ico:L; octa:N with N - 1 "
          "and cube:N with N a power of two), with the error of each: files of their own, "
          "NAME_lod1 …, or levels (MSFT_lod) of one .glb")
      ->check(between(0, most_levels, "0 to 12"))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

std::optional<DisplacementSize> image_size_named(const std::string& text) {
  DisplacementSize size{};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  const bool good = height.ec == std::errc{} && height.ptr == end && size.width >= 2 &&
                    size.width % 2 == 0 && size.height >= 1 &&
                    std::int64_t{size.width} * size.height <= most_texels;
  return good ? std::optional(size) : std::nullopt;
}

CLI::App* declare_remesh_arguments(CLI::App& program, RemeshArguments& arguments) {
  CLI::App* command = program.add_subcommand("remesh", summary);
  command
      ->add_option("MESH", arguments.input, "A mesh, with its map or without; - for standard input")
      ->type_name(" ")
      ->required();
  command
      ->add_option("--grid", arguments.grid,
                   "ico:L, ico:f=N, octa:N, cube:N, uv:WxH, healpix:NSIDE or like:MESH")
      ->type_name("GRID")
      ->required();
  command->add_option("--sphere", arguments.sphere, "The map of the mesh, in a file of its own")
      ->type_name("FILE");
  command
      ->add_option("--transfer", arguments.transfer,
                   "What to carry, with commas between: all, none, color, normal, uv, material, or "
                   "names of properties")
      ->type_name("NAMES")
      ->capture_default_str();
  add_choice<SampleMode>(*command, "--sample", arguments.sample,
                         {{"point", SampleMode::Point}, {"cell", SampleMode::Cell}},
                         "point: the surface at a direction; cell: its mean, weighted by area, "
                         "over the cell where the "
                         "grid is coarser than the mesh (default: point)");
  command->add_flag("--adaptive", arguments.adaptive,
                    "Relax the map first, so that where the surface bends it gets more vertices");
  declare_subdivision_options(*command, arguments);
  declare_displacement_options(*command, arguments);
  declare_lod_options(*command, arguments);
  add_outputs(*command, arguments);
  add_threads(*command, arguments.threads);
  add_progress(*command, arguments.progress);
  add_loudness(*command, arguments.loudness);
  return command;
}

}  // namespace sphparam::cli
