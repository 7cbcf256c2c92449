// The options of `sphparam export`.

#include "arguments/export_arguments.h"

#include <CLI/CLI.hpp>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/up_option.h"
#include "console/paths.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Write a mesh with spherical texture coordinates, for viewers and other programs.\n"
    "\n"
    "Examples:\n"
    "  sphparam export statue.sph.ply --texture earth.png -o statue.glb\n"
    "  sphparam export statue.sph.ply --textures bake/ --variants checker,graticule -o statue.glb\n"
    "  sphparam export statue.sph.ply --texture earth.png --morph sphere -o statue.gltf\n"
    "  sphparam export statue.sph.ply --texture earth.png --shape sphere -o ball.glb\n"
    "  sphparam export statue.sph.ply --texture earth.png -o statue.obj\n"
    "\n"
    "Any equirectangular image sits right: the mesh is split along the date line and at the "
    "poles,\n"
    "every pole triangle has a vertex of its own there, u runs from 0 to 1 and never folds.\n"
    "Where the mesh has normals at corners, hard edges stay hard.\n"
    "Without an image the mesh shows its own texture, baked; else the colours of its vertices; "
    "else\n"
    "a checker, or white where a normal or occlusion map is given.\n"
    "Texture coordinates are certified as they are stored, rounding included; what folds there is "
    "told.\n"
    "A .glb, .obj or .ply is read back from the disk and compared, but for --compress. A normal "
    "map\n"
    "is of one mesh: coarser --lods are without.\n";

void add_images(CLI::App& command, LookOptions& look) {
  command.add_option("--texture", look.texture, "The equirectangular image, row 0 north")
      ->type_name("IMAGE");
  command.add_option("--normal", look.normal, "A tangent-space normal map as `bake` makes it")
      ->type_name("IMAGE");
  command.add_option("--occlusion", look.occlusion, "Ambient occlusion")->type_name("IMAGE");
  command
      .add_option("--textures", look.folder,
                  "A folder of `bake`: its basecolor, normal-tangent and ao")
      ->type_name("FOLDER");
  command
      .add_option(
          "--variants", look.variants,
          "More materials to switch to, with commas between: axes, checker, graticule, area, angle")
      ->type_name("NAMES")
      ->delimiter(',');
  command.add_option("--image-size", look.image_width, "Width of images that are made here")
      ->check(between(16, 16384, "16 to 16384"))
      ->check(CLI::Validator(
          [](const std::string& text) {
            return std::stoi(text) % 4 == 0 ? std::string()
                                            : std::string("expected a multiple of 4");
          },
          ""))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--unlit", look.unlit, "Show the colours as they are, without light");
}

void add_chart(CLI::App& command, ExportOptions& options) {
  std::vector<std::pair<std::string, Convention>> conventions;
  for (const ConventionInfo& info : all_conventions()) {
    conventions.emplace_back(info.name, info.convention);
  }
  add_choice<Convention>(command, "--convention", options.convention, conventions,
                         "Where longitude goes in the images (default: sphparam)");
  command.add_flag("--keep-topology", options.keep_topology,
                   "Add no vertices on the surface: triangles fold at the poles, they are listed");
  command
      .add_option("--refine-poles", options.refine_poles,
                  "Cut each triangle at a pole into so many; images of `bake` must be baked for it")
      ->check(between(1, 1024, "1 to 1024"))
      ->type_name("N")
      ->capture_default_str();
  add_choice<ShapeKind>(
      command, "--shape", options.shape,
      {{"mesh", ShapeKind::Mesh}, {"sphere", ShapeKind::Sphere}, {"flat", ShapeKind::Flat}},
      "The mesh, its image on the sphere, or the (u, v) rectangle (default: mesh)");
  add_choice<Morph>(command, "--morph", options.morph,
                    {{"none", Morph::None}, {"sphere", Morph::Sphere}, {"flat", Morph::Flat}},
                    "An animation that turns the mesh into its sphere, then unrolls it (default: "
                    "none)");
  add_up(command, options.up);
}

void add_buffers(CLI::App& command, ExportArguments& arguments) {
  command.add_flag("--tangents", arguments.exported.look.tangents,
                   "Tangents also without a normal map: a flat one is bound");
  command.add_flag("--theta-phi", arguments.exported.theta_phi,
                   "θ and ϕ as the attribute _THETA_PHI");
  command.add_flag("--source-uv", arguments.exported.source_uv,
                   "The mesh's own texture coordinates as TEXCOORD_1");
  command.add_flag("--embedded", arguments.embedded, ".gltf only: everything in the one file");
  command.add_flag("--quantize", arguments.exported.quantise,
                   "16-bit numbers (KHR_mesh_quantization)");
  command.add_flag("--compress", arguments.compress, "EXT_meshopt_compression");
  command
      .add_option("--lods", arguments.lods,
                  "So many coarser meshes, each a quarter of the one before")
      ->check(between(0, 8, "0 to 8"))
      ->type_name("N")
      ->capture_default_str();
  add_choice<LodStyle>(command, "--lod", arguments.lod_style,
                       {{"files", LodStyle::Files}, {"msft", LodStyle::Msft}},
                       "Files of their own, NAME_lod1 …, or one file (default: files)");
}

}  // namespace

CLI::App* declare_export_arguments(CLI::App& program, ExportArguments& arguments) {
  CLI::App* command = program.add_subcommand("export", summary);
  command
      ->add_option("MESH", arguments.input, "A mesh, with its map or without; - for standard input")
      ->type_name(" ")
      ->required();
  command->add_option("--sphere", arguments.sphere, "The map of the mesh, in a file of its own")
      ->type_name("FILE");
  command
      ->add_option("-o,--output", arguments.output,
                   ".glb, .gltf, .obj or .ply; - for a .glb on standard output")
      ->type_name("FILE")
      ->required();
  add_json(*command, arguments.json);
  add_images(*command, arguments.exported.look);
  add_chart(*command, arguments.exported);
  add_buffers(*command, arguments);
  add_threads(*command, arguments.exported.threads);
  add_progress(*command, arguments.progress);
  add_loudness(*command, arguments.loudness);
  return command;
}

namespace {

void refuse(bool wrong, const char* message) {
  if (wrong) throw UsageMistake(message);
}

}  // namespace

void check_export_arguments(const ExportArguments& a) {
  const ExportOptions& e = a.exported;
  const LookOptions& look = e.look;
  const std::string extension = is_stream(a.output) ? ".glb" : extension_of(a.output);
  const bool is_gltf = extension == ".glb" || extension == ".gltf";
  if (!is_gltf && extension != ".obj" && extension != ".ply") {
    throw UsageMistake("-o: expected .glb, .gltf, .obj or .ply, not " +
                       (extension.empty() ? output_name(a.output) : extension));
  }
  refuse(e.keep_topology && e.refine_poles > 1,
         "--refine-poles adds vertices, --keep-topology forbids them");
  refuse(e.morph != Morph::None && e.shape != ShapeKind::Mesh,
         "--morph starts from the mesh: leave out --shape");
  refuse(e.morph != Morph::None && a.lods > 0,
         "--lods are of meshes that do not change: leave out --morph");
  refuse(e.keep_topology && a.lods > 0, "--lods are new meshes: leave out --keep-topology");
  refuse(e.shape != ShapeKind::Mesh && a.lods > 0, "--lods are of the mesh: leave out --shape");
  refuse(e.source_uv && a.lods > 0,
         "--lods have no texture coordinates of the mesh: leave out --source-uv");
  refuse(a.embedded && extension != ".gltf", "--embedded is for .gltf; a .glb is one file anyway");
  refuse(a.lods > 0 && is_stream(a.output) && a.lod_style == LodStyle::Files,
         "--lods are files: give -o a name");
  refuse(look.unlit && (look.tangents || !look.normal.empty() || !look.occlusion.empty()),
         "--unlit shows no light: leave out --normal, --occlusion and --tangents");
  if (is_gltf) return;
  const std::string only = " is for .glb and .gltf, not for " + extension;
  for (const auto& [given, option] : {std::pair{e.morph != Morph::None, "--morph"},
                                      {e.shape == ShapeKind::Flat, "--shape flat"},
                                      {!look.variants.empty(), "--variants"},
                                      {!look.normal.empty(), "--normal"},
                                      {!look.occlusion.empty(), "--occlusion"},
                                      {look.unlit, "--unlit"},
                                      {look.tangents, "--tangents"},
                                      {e.theta_phi, "--theta-phi"},
                                      {e.source_uv, "--source-uv"},
                                      {e.quantise, "--quantize"},
                                      {a.compress, "--compress"},
                                      {a.lods > 0, "--lods"},
                                      {a.lod_style == LodStyle::Msft, "--lod msft"}}) {
    if (given) throw UsageMistake(option + only);
  }
}

}  // namespace sphparam::cli
