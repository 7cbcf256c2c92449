// The options of `sphparam remesh`.

#include "arguments/remesh_arguments.h"

#include <cmath>

#include "arguments/energy_words.h"

namespace sphparam::cli {

namespace {

bool read_size(const std::string& text, std::optional<DisplacementSize>& size) {
  const auto numbers = two_numbers(text, 'x');
  if (!numbers) return false;
  const auto [width, height] = *numbers;
  size = DisplacementSize{width, height};
  return width >= 2 && width % 2 == 0 && height >= 1 && std::int64_t{width} * height <= most_texels;
}

bool read_length(const std::string& text, std::optional<Amount>& length) {
  length = amount_of(text);
  return length && std::isfinite(length->value) && length->value >= 0;
}

void declare_subdivision(Declaration& command, RemeshArguments& arguments) {
  command
      .choice("--subdiv-fit", arguments.subdivision,
              {{"loop", Scheme::Loop}, {"catmark", Scheme::CatmullClark}},
              "The new mesh is the control mesh of a subdivision surface that is fitted to the "
              "mesh: loop on grids of triangles, catmark on grids of quads")
      .text("--limit-mesh", arguments.limit_output, "FILE",
            "With --subdiv-fit, also the mesh whose vertices lie on that surface, in the format of "
            "its "
            "name")
      .written()
      .text("--displace", arguments.displacement, "FILE",
            "With --subdiv-fit: an image of how far the mesh is from the fitted surface along its "
            "normal: .exr, or .png in 16 bits; in the layout of the new mesh's texture coordinates "
            "where these are the grid's, else equirectangular")
      .written()
      .parsed(
          "--displace-size", "WxH",
          [&](const std::string& text) { return read_size(text, arguments.displacement_size); },
          "expected columns and rows, as in 4096x2048, columns even, at most " +
              std::to_string(most_texels) + " texels, not ",
          "Columns and rows of that image; in the layout of a grid it has no more texels in all, "
          "and "
          "a power of two of them along a face")
      .preset("4096x2048")
      .text("--rebuild", arguments.rebuilt, "FILE",
            "With --displace: the mesh that surface and image give, as fine as the image, and how "
            "far it is from the mesh: .ply, .obj")
      .written();
}

void declare_outputs(Declaration& command, RemeshArguments& arguments) {
  command
      .text(
          "-o,--output", arguments.output, "FILE",
          "The new mesh in the format of its name (.ply, .vtk and .vtp with its map), or .glb, "
          ".usda or .usdz with its chart; beside .gii and FreeSurfer's, data has files of its own")
      .written()
      .texts("--write-data", arguments.data_outputs, "FILE,…",
             "A file for each of --data, in the format of its name; may be given again")
      .written()
      .text("--geometry-image", arguments.geometry_image, "FILE",
            "Positions as an image, of octa and cube grids: .exr in float, .png in 16 bits")
      .written()
      .text("--normal-image", arguments.normal_image, "FILE", "The image of the new mesh's normals")
      .written()
      .texts("--attribute-image", arguments.attribute_images, "NAME=FILE",
             "The image of what is carried, as in color=FILE or thickness=FILE; may be given again")
      .written()
      .choice(
          "--depth", arguments.depth,
          {{"half", ImageDepth::Half}, {"float", ImageDepth::Float}, {"u16", ImageDepth::Uint16}},
          "Of images: half or float in .exr, u16 in .png (default: float, u16)")
      .text("--csv", arguments.csv, "FILE",
            "A row for each vertex: direction, position, properties")
      .written()
      .flag("--degrees", arguments.degrees,
            "Directions in --csv as longitude and latitude in degrees")
      .json(arguments);
  declare_naming(command, arguments.naming, "-o");
}

}  // namespace

void declare_remesh_options(Declaration& command, RemeshArguments& arguments) {
  command.input("MESH", arguments.input, "A mesh, with its map or without; - for standard input")
      .text("--grid", arguments.grid, "GRID", grid_patterns() + " or like:MESH; ico with --within")
      .required()
      .parsed(
          "--within", "X|X%",
          [&](const std::string& text) { return read_length(text, arguments.within); },
          "expected a length, as 0.01 or 0.5%, not ",
          "With --grid ico: the coarsest level whose faces are nowhere farther than this from the "
          "mesh, nor it from them; % is of its diagonal")
      .sphere(arguments.sphere)
      .choice("--holes", arguments.holes,
              {{"keep", FillersInFile::Kept}, {"drop", FillersInFile::Left}},
              "What closes holes of the mesh: keep it or leave it out (default: kept and marked in "
              "a map and in --csv, else left out)")
      .text("--transfer", arguments.transfer, "NAMES",
            "What to carry, with commas between: all, none, color, normal, uv, material, or names "
            "of properties")
      .choice("--uv", arguments.uv, {{"grid", TextureOf::Grid}, {"mesh", TextureOf::Mesh}},
              "Texture coordinates of the new mesh: in the grid's own layout (cube:N six squares, "
              "octa:N one, ico ten diamonds, uv:WxH the equirectangular chart), or those of the "
              "mesh, carried (default: grid for control meshes in .obj, .ply and USD, else "
              "mesh)")
      .choice("--sample", arguments.sample,
              {{"point", SampleMode::Point},
               {"cell", SampleMode::Cell},
               {"barycentric", SampleMode::Barycentric},
               {"adap-bary-area", SampleMode::AdapBaryArea}},
              "point: the surface at a direction; cell: its mean over the grid's triangles about "
              "the vertex, weighted by area and by nearness (1 at the vertex, 0 at their far "
              "sides), where the grid is coarser than the mesh; barycentric, adap-bary-area: "
              "positions as point, what vertices have by wb_command's methods of these names "
              "(default: point)")
      .data(arguments.data)
      .text("--areas", arguments.areas, "SOURCE,GRID",
            "With --sample adap-bary-area: surfaces, or files of areas a vertex, of the mesh's and "
            "of the grid's vertices (default: the mesh, and what becomes of it)")
      .number("--lambda", arguments.lambda, "NUMBER", lambdas,
              "Weight of area against angle in a map that is made or adapted here, " +
                  lambdas.text() +
                  ": less has fewer faces that cross, and is farther from the mesh")
      .flag("--adaptive", arguments.adaptive,
            "Relax the map first, so that where the surface bends it gets more vertices");
  declare_subdivision(command, arguments);
  command.number("--lods", arguments.lods, "N", {0, 12},
                 "So many coarser meshes, each on the coarser half of its grid (ico:L; octa:N with "
                 "N - 1 and cube:N with N a power of two), with the error of each: files of their "
                 "own, NAME_lod1 …, or levels (MSFT_lod) of one .glb");
  declare_outputs(command, arguments);
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
  arguments.given = command.given();
}

}  // namespace sphparam::cli
