// The options of `sphparam export`.

#include "arguments/export_arguments.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "arguments/ends.h"
#include "arguments/numbers.h"
#include "arguments/texture_arguments.h"
#include "arguments/words.h"
#include "console/exit_codes.h"
#include "console/places.h"

namespace sphparam::cli {

namespace {

void declare_scalar(Declaration& command, ExportArguments& arguments) {
  command
      .text("--scalar", arguments.scalar, "NAME",
            "A number of the vertices, seen as colours: those of `render --scalar`")
      .parsed(
          "--range", "MIN,MAX",
          [&arguments](const std::string& text) {
            arguments.range = two_ends(text);
            return arguments.range.has_value();
          },
          wanted_ends, "The scale of that number")
      .preset("its 2nd to its 98th percentile; all of whole numbers");
}

void declare_look(Declaration& command, LookOptions& look) {
  command.text("--image", look.texture, "IMAGE", "The equirectangular image, row 0 north")
      .text("--normal-map", look.normal, "IMAGE", "A tangent-space normal map as `bake` makes it")
      .text("--occlusion-map", look.occlusion, "IMAGE", "Ambient occlusion")
      .text("--orm-map", look.orm, "IMAGE",
            "Occlusion, roughness and metallic in red, green and blue")
      .text("--emissive-map", look.emissive, "IMAGE", "The light that the surface gives")
      .text("--images", look.folder, "FOLDER",
            "A folder of `bake`: its basecolor, normal-tangent, ao, orm and emissive")
      .list("--variants", look.variants, "NAMES",
            "More materials to switch to, with commas between: " + joined(variant_names()))
      .number("--image-size", look.image_width, "N", {16, 16384},
              "Width of images that are made here")
      .multiple_of(4)
      .flag("--unlit", look.unlit, "Show the colours as they are, without light");
  declare_textures(command, look.textures, look.webp_quality);
}

void declare_chart(Declaration& command, ExportOptions& options) {
  command.convention(options.convention)
      .flag("--keep-topology", options.keep_topology,
            "Add no vertices on the surface: triangles fold at the poles, or edges are torn; they "
            "are listed")
      .refine_poles(
          options.refine_poles,
          "Cut each triangle at a pole into so many; images of `bake` must be baked for it")
      .choice("--shape", options.shape,
              {{"mesh", ShapeKind::Mesh}, {"sphere", ShapeKind::Sphere}, {"flat", ShapeKind::Flat}},
              "The mesh, its image on the sphere, or the (u, v) rectangle (default: mesh)")
      .choice("--morph", options.morph,
              {{"none", Morph::None}, {"sphere", Morph::Sphere}, {"flat", Morph::Flat}},
              "An animation that turns the mesh into its sphere, then unrolls it (default: none)")
      .up(options.up);
}

/// 20000 and 5000 of "20000,5000"; empty where it is none such.
std::vector<long> falling_numbers(const std::string& text) {
  constexpr std::size_t most = 8;
  std::vector<long> numbers;
  for (const std::string& word : split(text)) {
    const long end = numbers.empty() ? 2'000'000'000 : numbers.back() - 1;
    if (!complaint_of_number(word, Range<long>{4, end}).empty()) return {};
    numbers.push_back(std::stol(word));
  }
  return numbers.size() > most ? std::vector<long>{} : numbers;
}

void declare_buffers(Declaration& command, ExportArguments& arguments) {
  ExportOptions& options = arguments.exported;
  command
      .flag("--tangents", options.look.tangents,
            "Tangents also without a normal map: a flat one is bound")
      .flag("--theta-phi", options.theta_phi, "θ and ϕ as the attribute _THETA_PHI")
      .flag("--source-uv", options.source_uv, "The mesh's own texture coordinates as TEXCOORD_1")
      .flag("--embedded", arguments.embedded, ".gltf only: everything in the one file")
      .flag("--quantize", options.quantise, "16-bit numbers (KHR_mesh_quantization)")
      .flag("--compress", arguments.compress,
            "EXT_meshopt_compression of 16-bit numbers, in another order")
      .number("--lods", arguments.lods, "N", {0, 8},
              "So many coarser meshes, 8 at most, each a quarter of the one before, down to 20 "
              "triangles")
      .parsed(
          "--lod-faces", "N,N,…",
          [&arguments](const std::string& text) {
            arguments.lod_faces = falling_numbers(text);
            return !arguments.lod_faces.empty();
          },
          "expected up to 8 numbers of triangles that fall, from 4 on, as in 20000,5000",
          "Coarser meshes of at most so many triangles, before the chart cuts some")
      .choice("--lod", arguments.lod_style, {{"files", LodStyle::Files}, {"msft", LodStyle::Msft}},
              "Files of their own, NAME_lod1 …, or one file (default: files)");
}

void refuse(bool wrong, const std::string& message) {
  if (wrong) throw UsageMistake(message);
}

/// Refuses what does not go together.
void refuse_combinations(const ExportArguments& a, const std::string& extension) {
  const ExportOptions& e = a.exported;
  const LookOptions& look = e.look;
  refuse(a.all_components && (is_stream(a.output) || !a.sphere.empty()),
         "--all-components writes several files: give -o a name, and leave out --sphere: the maps "
         "that "
         "`map --all-components` writes have it in them");
  refuse(e.keep_topology && e.refine_poles > 1,
         "--refine-poles adds vertices, --keep-topology forbids them");
  refuse(e.morph != Morph::None && e.shape != ShapeKind::Mesh,
         "--morph starts from the mesh: leave out --shape");
  refuse(a.lods > 0 && !a.lod_faces.empty(), "--lods and --lod-faces: one of them says how many");
  const std::string levels = a.lod_faces.empty() ? "--lods" : "--lod-faces";
  refuse(e.morph != Morph::None && a.levels() > 0,
         levels + " are of meshes that do not change: leave out --morph");
  refuse(e.keep_topology && a.levels() > 0, levels + " are new meshes: leave out --keep-topology");
  refuse(e.shape != ShapeKind::Mesh && a.levels() > 0,
         levels + " are of the mesh: leave out --shape");
  refuse(e.source_uv && a.levels() > 0,
         levels + " have no texture coordinates of the mesh: leave out --source-uv");
  refuse(a.embedded && extension != ".gltf",
         "--embedded is for .gltf; a .glb and a .usdz are one file anyway");
  refuse(a.levels() > 0 && is_stream(a.output) && a.lod_style == LodStyle::Files,
         levels + " are files: give -o a name");
  refuse(!a.scalar.empty() && (!look.texture.empty() || !look.folder.empty()),
         "--scalar is colours of its own: leave out --image and --images");
  refuse(a.range && a.scalar.empty(), "--range is the scale of --scalar: name a number a vertex");
  refuse(look.unlit && (look.tangents || !look.normal.empty() || !look.occlusion.empty() ||
                        !look.orm.empty() || !look.emissive.empty()),
         "--unlit shows no light: leave out --normal-map, --occlusion-map, --orm-map, "
         "--emissive-map and --tangents");
}

/// Refuses what USD has no place for.
void refuse_beyond_usd(const ExportArguments& a, const std::string& extension) {
  const ExportOptions& e = a.exported;
  const std::string only = " is for .glb and .gltf, not for " + extension;
  for (const auto& [given, option] : {std::pair{e.morph != Morph::None, "--morph"},
                                      {e.look.tangents, "--tangents"},
                                      {e.quantise, "--quantize"},
                                      {a.compress, "--compress"},
                                      {a.lod_style == LodStyle::Msft, "--lod msft"}})
    refuse(given, option + only);
  refuse(e.look.textures == TextureFormat::Webp || e.look.textures == TextureFormat::WebpLossless,
         "--textures: images of USD are PNG or JPEG");
}

/// Refuses what OBJ and PLY have no place for.
void refuse_beyond_geometry(const ExportArguments& a, const std::string& extension) {
  const ExportOptions& e = a.exported;
  const LookOptions& look = e.look;
  // Its .mtl has them too.
  constexpr std::array<std::string_view, 3> of_library = {"--normal-map", "--orm-map",
                                                          "--emissive-map"};
  const std::string only = " is for .glb and .gltf, not for " + extension;
  for (const auto& [given, option] : {std::pair{e.morph != Morph::None, "--morph"},
                                      {e.shape == ShapeKind::Flat, "--shape flat"},
                                      {!look.variants.empty(), "--variants"},
                                      {!look.normal.empty(), "--normal-map"},
                                      {!look.occlusion.empty(), "--occlusion-map"},
                                      {!look.orm.empty(), "--orm-map"},
                                      {!look.emissive.empty(), "--emissive-map"},
                                      {look.unlit, "--unlit"},
                                      {look.tangents, "--tangents"},
                                      {e.theta_phi, "--theta-phi"},
                                      {e.source_uv, "--source-uv"},
                                      {e.quantise, "--quantize"},
                                      {a.compress, "--compress"},
                                      {a.lods > 0, "--lods"},
                                      {!a.lod_faces.empty(), "--lod-faces"},
                                      {a.lod_style == LodStyle::Msft, "--lod msft"}}) {
    const bool in_library = extension == ".obj" && std::ranges::count(of_library, option) > 0;
    if (given && !in_library) throw UsageMistake(std::string(option) + only);
  }
}

}  // namespace

void declare_export_options(Declaration& command, ExportArguments& arguments) {
  command.input("MESH", arguments.input, "A mesh, with its map or without; - for standard input")
      .sphere(arguments.sphere)
      .output(arguments.output, "FILE",
              ".glb, .gltf, .usda, .usdz, .obj or .ply; - for a .glb on standard output")
      .flag("--all-components", arguments.all_components,
            "Of MESH_0001 and so on, as `map --all-components` writes them; files are so numbered")
      .crease(arguments.crease)
      .number("--scale", arguments.scale, "FACTOR", {1e-12, 1e12},
              "Lengths become so many times as long: 0.001 where the file is in millimetres, as "
              "glTF is in metres")
      .json(arguments);
  declare_scalar(command, arguments);
  declare_look(command, arguments.exported.look);
  declare_chart(command, arguments.exported);
  declare_buffers(command, arguments);
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

void check_export_arguments(const ExportArguments& a) {
  const std::string extension = is_stream(a.output) ? ".glb" : extension_of(a.output);
  const bool is_gltf = extension == ".glb" || extension == ".gltf";
  const bool is_usd = extension == ".usda" || extension == ".usdz";
  if (!is_gltf && !is_usd && extension != ".obj" && extension != ".ply") {
    throw UsageMistake("-o: expected .glb, .gltf, .usda, .usdz, .obj or .ply, not " +
                       (extension.empty() ? output_name(a.output) : extension));
  }
  for (const std::string& name : a.exported.look.variants)
    place_among(variant_names(), name, "--variants");
  refuse_combinations(a, extension);
  if (is_usd) {
    refuse_beyond_usd(a, extension);
  } else if (!is_gltf) {
    refuse_beyond_geometry(a, extension);
  }
}

}  // namespace sphparam::cli
