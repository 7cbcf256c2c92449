// The command line of `sphparam bake`, and what of it can be judged before any file is read.

#include "arguments/bake_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "console/paths.h"
#include "sphparam/image/image_format.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {
namespace {

std::string summary() {
  std::string text =
      "Bake maps of a mesh into equirectangular images.\n"
      "\n"
      "Examples:\n"
      "  sphparam bake statue.glb -o statue.png\n"
      "  sphparam bake statue.sph.ply --texture skin.png --size 4096 -o statue_{map}.png \\\n"
      "    --map basecolor,normal-object,ao\n"
      "  sphparam bake statue.sph.ply --for low.sph.ply --map basecolor,normal-tangent -o low/\n"
      "  sphparam bake statue.sph.ply --map position --depth float --mip -o statue.exr\n"
      "\n"
      "Longitude runs along the rows, the north pole is the first one; every texel has the value\n"
      "of the one point of the surface that maps there. A mesh without a map is mapped first.\n"
      "\n"
      "Maps:\n";
  for (const FieldInfo& field : all_fields()) {
    text += "  " + field.name + std::string(16 - field.name.size(), ' ') + field.about + "\n";
  }
  return text +
         "  axes, checker, graticule\n                  test images, to see how the sphere lies\n";
}

/// What can be told of an image before its mesh is read, in the words of the options.
void require_possible(const BakeRequest& image, const BakeSettings& settings) {
  try {
    require_bakeable({image}, settings);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    if (error.unknown().empty()) throw UsageMistake(std::string("--map: ") + error.what());
    const std::string meant = nearest_word(error.unknown(), error.known());
    std::string all;
    for (const std::string& name : error.known()) all += (all.empty() ? "" : ", ") + name;
    throw UsageMistake("--map: there is no map " + error.unknown() +
                       (meant.empty() ? "; there are " + all : "; did you mean " + meant + "?"));
  }
}

/// A name of a map as it stands in a name of a file.
std::string in_file_name(std::string map) {
  for (char& c : map) {
    if (c == ':' || c == '/' || c == '\\') c = '-';
  }
  return map;
}

std::string path_of(const BakeArguments& arguments, const std::string& map) {
  const std::filesystem::path output(arguments.output);
  std::error_code error;
  std::string path = arguments.output;
  if (path.ends_with('/') || std::filesystem::is_directory(output, error)) {
    const std::string stem = is_stream(arguments.input)
                                 ? "mesh"
                                 : std::filesystem::path(arguments.input).stem().stem().string();
    path = (output / (stem + "_{map}.png")).string();
  }
  const std::string pattern = "{map}";
  for (size_t at = path.find(pattern); at != std::string::npos; at = path.find(pattern, at)) {
    path.replace(at, pattern.size(), in_file_name(map));
    at += in_file_name(map).size();
  }
  return path;
}

/// With --heat every image counts as one with a scale: which ones have it is known only once they
/// are made.
void check_all_places(const BakeArguments& arguments, const std::vector<BakeRequest>& images) {
  Outputs written;
  for (const BakeRequest& image : images) {
    written.emplace_back("-o", image.path);
    if (arguments.settings.fields.heat && !is_stream(image.path)) {
      written.emplace_back("--heat", scale_path(image.path));
    }
  }
  written.emplace_back("--json", arguments.json);
  check_places({arguments.input, arguments.sphere, arguments.target, arguments.settings.texture},
               written);
}

void add_inputs(CLI::App& command, BakeArguments& arguments) {
  command.add_option("FILE", arguments.input, "A map or a mesh; - for standard input")
      ->type_name(" ")
      ->required();
  command
      .add_option("-o,--output", arguments.output,
                  "The image: .png .jpg .tif .exr; {map} stands for the map; or a folder")
      ->type_name("IMAGE")
      ->required();
  command
      .add_option("--map", arguments.maps,
                  "What is baked, with commas between (default: basecolor)")
      ->type_name("MAPS")
      ->delimiter(',');
  command
      .add_option("--texture", arguments.settings.texture, "The texture of the mesh, for basecolor")
      ->type_name("IMAGE");
  add_choice<TextureWrap>(command, "--wrap", arguments.settings.wrap,
                          {{"repeat", TextureWrap::Repeat},
                           {"mirror", TextureWrap::Mirror},
                           {"clamp", TextureWrap::Clamp}},
                          "What --texture says beyond its borders (default: repeat)");
  command
      .add_option("--sphere", arguments.sphere,
                  "The map in a file of its own: the same mesh on the sphere")
      ->type_name("FILE");
  command
      .add_option(
          "--for", arguments.target,
          "Another mesh on the same sphere that the images are for: its chart, its frame of "
          "normals, its surface as base of heights; one with a map of its own is refused")
      ->type_name("FILE");
}

void add_image_options(CLI::App& command, BakeArguments& arguments) {
  command.add_option("--size", arguments.settings.width, "Texels a row; half as many rows")
      ->check(between(2, 65536, "2 to 65536"))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--samples", arguments.settings.samples, "N × N samples a texel")
      ->check(between(1, 32, "1 to 32"))
      ->type_name("N")
      ->capture_default_str();
  add_choice<Interpolation>(
      command, "--interp", arguments.settings.interpolation,
      {{"uv", Interpolation::Uv}, {"sphere", Interpolation::Sphere}},
      "Between vertices: linear in (u, v), as GPUs draw; or on the sphere, for "
      "other meshes (default: uv)");
  command
      .add_option("--refine-poles", arguments.settings.refine_poles,
                  "For `export --refine-poles N`: the image belongs to that chart")
      ->check(between(1, 1024, "1 to 1024"))
      ->type_name("N")
      ->capture_default_str();
  add_choice<TextureFilter>(command, "--filter", arguments.settings.fields.filter,
                            {{"nearest", TextureFilter::Nearest},
                             {"bilinear", TextureFilter::Bilinear},
                             {"bicubic", TextureFilter::Bicubic}},
                            "How the texture is magnified (default: bilinear)");
  add_choice<std::optional<SampleType>>(
      command, "--depth", arguments.settings.depth,
      {{"u8", SampleType::Uint8},
       {"u16", SampleType::Uint16},
       {"half", SampleType::Half},
       {"float", SampleType::Float}},
      "Of a channel (default: u8; data in .png, .tif: u16; .exr: half, "
      "data float)");
  add_choice<bool>(command, "--normal-y", arguments.settings.fields.normal_y_down,
                   {{"gl", false}, {"dx", true}},
                   "Where green points in normal-tangent: up or down the image (default: gl)");
  std::vector<std::pair<std::string, Convention>> conventions;
  for (const ConventionInfo& info : all_conventions()) {
    conventions.emplace_back(info.name, info.convention);
  }
  add_choice<Convention>(command, "--convention", arguments.settings.convention, conventions,
                         "Where longitude goes in the image (default: sphparam)");
  command.add_flag("--mip", arguments.settings.mip,
                   "Tiles, and all levels down to one texel (.exr only)");
  command.add_flag("--heat", arguments.settings.fields.heat,
                   "Colours for distortion and curvature, and their scale in a file beside");
  command
      .add_option("--rays", arguments.settings.fields.rays,
                  "Rays a sample, for ao, bent and thickness")
      ->check(between(1, 65536, "1 to 65536"))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--max-dist", arguments.settings.fields.max_ray_distance,
                  "How far rays of ao and bent reach, of the bounding box's diagonal")
      ->check(between(1e-9, 1e9, "1e-9 to 1e9"))
      ->type_name("X")
      ->capture_default_str();
}

}  // namespace

CLI::App* declare_bake_arguments(CLI::App& program, BakeArguments& arguments) {
  CLI::App* command = program.add_subcommand("bake", summary());
  add_inputs(*command, arguments);
  add_image_options(*command, arguments);
  add_json(*command, arguments.json);
  add_threads(*command, arguments.settings.threads);
  add_progress(*command, arguments.progress);
  add_loudness(*command, arguments.loudness);
  return command;
}

std::vector<BakeRequest> bake_requests(const BakeArguments& arguments) {
  std::vector<BakeRequest> images;
  std::set<std::string> paths;
  for (const std::string& map :
       arguments.maps.empty() ? std::vector<std::string>{"basecolor"} : arguments.maps) {
    images.push_back({map, path_of(arguments, map)});
    require_possible(images.back(), arguments.settings);
    if (paths.insert(images.back().path).second) continue;
    throw UsageMistake("-o: several maps would go to " + images.back().path +
                       "; {map} in the name stands for each, as in statue_{map}.png");
  }
  check_all_places(arguments, images);
  return images;
}

UsageMistake as_mistake(const BakeSettingError& error) {
  static const std::map<std::string, std::string> options = {
      {"path", "-o"},
      {"width", "--size"},
      {"samples", "--samples"},
      {"convention", "--size: --convention "},  // the message goes on with its name
      {"depth", "--depth"},
      {"mip", "--mip"},
      {"refine_poles", "--refine-poles"},
      {"rays", "--rays"},
      {"max_ray_distance", "--max-dist"}};
  const std::string& option = options.at(error.setting());
  return UsageMistake(option + (option.ends_with(' ') ? "" : ": ") + error.what());
}

}  // namespace sphparam::cli
