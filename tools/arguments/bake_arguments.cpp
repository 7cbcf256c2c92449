// The command line of `sphparam bake`, and what of it can be judged before any file is read.

#include "arguments/bake_arguments.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "arguments/ends.h"
#include "console/places.h"
#include "io/shell_word.h"
#include "sphparam/image/image_format.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {
namespace {

/// With --heat every image counts as one with a scale: which ones have it is known only once they
/// are made.
void check_all_places(const BakeArguments& arguments, const std::vector<BakeRequest>& images) {
  Outputs written;
  for (const BakeRequest& image : images) {
    written.emplace_back("-o", image.path);
    if (arguments.settings.fields.heat && !is_stream(image.path)) {
      written.emplace_back("--heat", scale_path(image.path));
    }
    if (arguments.settings.fields.body && has_sidecar(image.path)) {
      written.emplace_back("--body", sidecar_path(image.path));
    }
  }
  written.emplace_back("--json", arguments.json);
  check_places(written);
}

/// What other programs call a map; else what is nearest to the word.
std::string hint_of_map(const FieldError& error) {
  static const std::map<std::string, std::string> synonyms = {
      {"colour", "basecolor"},      {"color", "basecolor"},        {"diffuse", "basecolor"},
      {"albedo", "basecolor"},      {"base_color", "basecolor"},   {"texture", "basecolor"},
      {"normal", "normal-tangent"}, {"normals", "normal-tangent"}, {"emission", "emissive"},
      {"metalness", "metallic"},    {"displacement", "height"},    {"xyz", "position"}};
  const auto known = synonyms.find(error.unknown());
  return known == synonyms.end() ? did_you_mean(error.unknown(), error.known())
                                 : "; did you mean " + known->second + "?";
}

/// What can be told of an image before its mesh is read.
void require_possible(const BakeRequest& image, const BakeSettings& settings) {
  try {
    require_bakeable({image}, settings);
  } catch (const BakeSettingError& error) {
    throw as_mistake(error);
  } catch (const FieldError& error) {
    if (error.unknown().empty()) throw UsageMistake(std::string("--map: ") + error.what());
    const std::string meant = hint_of_map(error);
    throw UsageMistake("--map: there is no map " + error.unknown() +
                       (meant.empty() ? "; there are " + joined(error.known()) : meant));
  }
}

void declare_inputs(Declaration& command, BakeArguments& arguments) {
  BakeSettings& settings = arguments.settings;
  command.input("FILE", arguments.input, "A map or a mesh; - for standard input")
      .output(arguments.output, "IMAGE",
              "The image: .png .jpg .tif .exr; {map} stands for the map; or a folder")
      .list("--map", arguments.maps, "MAPS",
            "What is baked, with commas between (default: basecolor)")
      .text("--texture", settings.texture, "IMAGE", "The texture of the mesh, for basecolor")
      .choice("--wrap", settings.wrap,
              {{"repeat", TextureWrap::Repeat},
               {"mirror", TextureWrap::Mirror},
               {"clamp", TextureWrap::Clamp}},
              "What --texture says beyond its borders (default: repeat)")
      .sphere(arguments.sphere)
      .flag("--all-components", arguments.all_components,
            "Of FILE_0001 and so on, as `map --all-components` writes them; images are so numbered")
      .data(arguments.data)
      .text("--for", arguments.target, "FILE",
            "Another mesh on the same sphere that the images are for: its chart, its frame of "
            "normals, its surface as base of heights; one with a map of its own is refused")
      .text("--from", arguments.from, "FILE",
            "Another surface about where the mesh is, any triangles: it is baked on the mesh")
      .crease(arguments.crease)
      .source_normals(arguments.source_normals_down);
}

void declare_body(Declaration& command, BakeArguments& arguments) {
  FieldOptions& fields = arguments.settings.fields;
  command.group("Maps of a body")
      .text("--body", arguments.body, "NAME|RADIUS|A,B,C|WKT",
            "Whose surface it is: one of the IAU's names, radii in the mesh's unit, or a "
            "coordinate system; files beside .tif and .png tell GDAL and QGIS where they lie")
      .choice("--unit", arguments.unit, {{"m", 1.0}, {"km", 1000.0}},
              "Of the mesh's coordinates (default: m)")
      .flag("--west", fields.positive_west, "Longitudes grow to the west")
      .parsed(
          "--centre", centre_pattern,
          [&arguments](const std::string& text) { return read_centre(text, arguments.centre); },
          wanted_centre,
          "The body's centre, in the mesh's coordinates, or that of what it encloses")
      .preset("that of a radial map, else 0,0,0");
}

void declare_images(Declaration& command, BakeSettings& settings) {
  command.number("--size", settings.width, "N", {2, 65536}, "Texels a row; half as many rows")
      .number("--samples", settings.samples, "N", {1, 32}, "N × N samples a texel")
      .choice(
          "--interp", settings.interpolation,
          {{"uv", Interpolation::Uv}, {"sphere", Interpolation::Sphere}},
          "Between vertices: linear in (u, v), as GPUs draw; or on the sphere, for other meshes "
          "(default: uv)")
      .refine_poles(settings.refine_poles,
                    "For `export --refine-poles N`: the image belongs to that chart")
      .choice("--filter", settings.fields.filter,
              {{"nearest", TextureFilter::Nearest},
               {"bilinear", TextureFilter::Bilinear},
               {"bicubic", TextureFilter::Bicubic}},
              "How the texture is magnified (default: bilinear)")
      .choice("--depth", settings.depth,
              {{"u8", SampleType::Uint8},
               {"u16", SampleType::Uint16},
               {"half", SampleType::Half},
               {"float", SampleType::Float}},
              "Of a channel (default: u8; data in .png, .tif: u16; .exr: half, data float)")
      .parsed(
          "--range", "MIN,MAX",
          [&settings](const std::string& text) {
            settings.fields.scalar_range = two_ends(text);
            return settings.fields.scalar_range.has_value();
          },
          wanted_ends,
          "Of scalar:NAME: what the least and the greatest integer (--heat: colour) stand for")
      .preset("as the numbers are")
      .choice("--normal-y", settings.fields.normal_y_down, {{"gl", false}, {"dx", true}},
              "Where green points in normal-tangent: up or down the image (default: gl)")
      .convention(settings.convention)
      .flag("--mip", settings.mip, "Tiles, and all levels down to one texel (.exr only)")
      .flag("--heat", settings.fields.heat,
            "Colours for distortion, curvature and scalar:NAME, and their scale in a file beside")
      .number("--rays", settings.fields.rays, "N", {1, 65536},
              "Rays a sample, for ao, bent and thickness")
      .number("--max-dist", settings.fields.max_ray_distance, "X", {1e-9, 1e9, "1e-9 to 1e9"},
              "How far rays of ao and bent reach, of the bounding box's diagonal");
}

}  // namespace

namespace {

constexpr char channels_word[] = "channels";

bool contains(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

bool shows_longitude(const BakeArguments& arguments) {
  return contains(arguments.maps, "lon") || contains(arguments.maps, "lonlat");
}

/// Whether a range of numbers is of use: floats hold them all as they are.
bool has_integers(const BakeRequest& image, const BakeSettings& settings) {
  const bool is_exr = image_format_of(image.path) == ImageFormat::Exr;
  return settings.depth ? is_integer(*settings.depth) : !is_exr;
}

/// Throws: UsageMistake where nothing heeds the range.
void require_ranged(const std::vector<BakeRequest>& images, const BakeSettings& settings) {
  if (!settings.fields.scalar_range) return;
  const bool is_heeded = std::ranges::any_of(images, [&](const BakeRequest& image) {
    return image.field.starts_with("scalar:") &&
           (settings.fields.heat || has_integers(image, settings));
  });
  if (!is_heeded)
    throw UsageMistake(
        "--range is for --map scalar:NAME in integers: floats hold all numbers as they are");
}

/// What is to be baked, with all channels where that word stands; nothing twice for it.
Words fields_of(const BakeArguments& arguments) {
  if (arguments.maps.empty()) return {"basecolor"};
  Words fields;
  for (const std::string& map : arguments.maps) {
    if (map != channels_word) {
      fields.push_back(map);
      continue;
    }
    for (const std::string& channel : all_channels())
      if (!contains(arguments.maps, channel)) fields.push_back(channel);
  }
  return fields;
}

}  // namespace

std::string bake_summary() {
  std::string text =
      "Bake maps of a mesh into equirectangular images.\n"
      "\n"
      "Examples:\n"
      "  sphparam bake statue.glb -o statue.png\n"
      "  sphparam bake helmet.glb --map channels -o helmet_{map}.png\n"
      "  sphparam bake statue.sph.ply --texture skin.png --size 4096 -o statue_{map}.png \\\n"
      "    --map basecolor,normal-object,ao\n"
      "  sphparam bake statue.sph.ply --for low.sph.ply --map basecolor,normal-tangent -o low/\n"
      "  sphparam bake wrapped.sph.ply --from asset.glb --map channels -o asset_{map}.png\n"
      "  sphparam bake statue.sph.ply --map position --depth float --mip -o statue.exr\n"
      "  sphparam bake eros.sph.ply --body eros --unit km --map radius,slope -o eros_{map}.tif\n"
      "\n"
      "Longitude runs along the rows, the north pole is the first one; every texel has the value\n"
      "of the one point of the surface that maps there. A mesh without a map is mapped first.\n"
      "\n"
      "Maps:\n";
  for (const FieldInfo& field : all_fields()) {
    text += "  " + field.name + std::string(16 - std::min<size_t>(15, field.name.size()), ' ') +
            field.about + "\n";
  }
  return text +
         "  axes, checker, graticule\n                  test images, to see how the sphere lies\n"
         "  channels        all that its materials say: basecolor, normal-tangent, orm, emissive\n";
}

void declare_bake_options(Declaration& command, BakeArguments& arguments) {
  declare_inputs(command, arguments);
  arguments.given = command.given();
  declare_images(command, arguments.settings);
  declare_body(command, arguments);
  declare_repair_options(command, arguments.repair);
  command.group("Options").json(arguments).threads(arguments).console(arguments);
}

UsageMistake as_mistake(const BakeSettingError& error) {
  static const std::map<std::string, std::string> options = {
      {"path", "-o"},
      {"from", "--from"},
      {"width", "--size"},
      {"samples", "--samples"},
      {"convention", "--size: --convention "},  // the message goes on with its name
      {"depth", "--depth"},
      {"mip", "--mip"},
      {"refine_poles", "--refine-poles"},
      {"scalar_range", "--range"},
      {"rays", "--rays"},
      {"max_ray_distance", "--max-dist"},
      {"body", "--body"},
      {"centre", "--centre"}};
  const auto known = options.find(error.setting());
  const std::string option = known == options.end() ? error.setting() : known->second;
  return UsageMistake(option + (option.ends_with(' ') ? "" : ": ") + error.reason());
}

UsageMistake as_mistake(const FieldError& error, const BakeSettings& settings) {
  const bool bare = dynamic_cast<const NoColoursError*>(&error) != nullptr;
  return UsageMistake(settings.source_name + ": " + error.what() +
                      (bare ? "; --texture IMAGE names its texture" : "") +
                      did_you_mean(error.unknown(), error.known()));
}

UsageMistake as_mistake(const OtherSphereError& error, const MappedMesh& source,
                        const BakeArguments& arguments) {
  return UsageMistake(std::string("--for: ") + error.what() + "; " +
                      advice_for_target(source, arguments));
}

std::string advice_for_target(const MappedMesh& source, const BakeArguments& arguments) {
  const auto command = [](const std::string& words) { return "`sphparam " + words + "`"; };
  const auto stem = [](const std::string& path) {
    return is_stream(path) ? "mesh" : stem_of(path);
  };
  const std::string name = stem(arguments.input);
  const std::string made_here = shell_file(name + "_map.sph.ply"),
                    fine = is_stream(arguments.input) ? "MESH" : shell_file(arguments.input),
                    low = shell_file(name + "_ico6.sph.ply"),
                    target = is_stream(arguments.target) ? "LOW" : shell_file(arguments.target),
                    followed = shell_file(stem(arguments.target) + "_like.sph.ply");
  std::string mapped = fine, options = typed_again(arguments.repair), advice;
  if (source.mapped_here()) {
    // `remesh` would map it with another λ.
    advice = command("map " + fine + options + " -o " + made_here) + ", then ";
    mapped = made_here;
    options.clear();
  } else if (!arguments.sphere.empty()) {
    options += " --sphere " + shell_file(arguments.sphere);
  }
  advice += command("remesh " + mapped + options + " --grid ico:6 -o " + low) +
            " makes a mesh on its sphere: --for " + low;
  if (!options.empty()) return advice;  // the mesh to follow is read as it is
  return advice + "; where both are of one thing, " +
         command("map " + target + " -o " + followed + " --like " + mapped) +
         " maps this one there: --for " + followed;
}

void settle_body(BakeArguments& arguments) {
  BakeSettings& settings = arguments.settings;
  if (arguments.body.empty()) {
    if (arguments.given("--unit")) throw UsageMistake("--unit is for --body only");
    if (settings.fields.positive_west && !shows_longitude(arguments))
      throw UsageMistake("--west is for --body, and for the maps lon and lonlat");
    return;
  }
  try {
    settings.fields.body = body_of(arguments.body, arguments.unit);
  } catch (const BodyError& error) {
    throw UsageMistake(std::string("--body: ") + error.what() +
                       did_you_mean(error.unknown(), error.known()));
  }
  Body& body = *settings.fields.body;
  if (settings.fields.positive_west && !body.wkt.empty() && !body.positive_west) {
    throw UsageMistake("--west contradicts --body: the WKT has longitudes that grow to the east");
  }
  body.positive_west |= settings.fields.positive_west;
  if (!arguments.given("--convention")) settings.convention = Convention::Gis;
  if (settings.convention != Convention::Gis)
    throw UsageMistake(
        "--convention: images of a --body go from -180 to 180 degrees, as gis has it: leave it "
        "out; `gdalwarp -te 0 -90 360 90 IMAGE.tif OUT.tif` makes 0 to 360 of that");
  if (!arguments.given("--interp")) settings.interpolation = Interpolation::Sphere;
}

std::vector<BakeRequest> requests_of_mesh(std::vector<BakeRequest> images,
                                          const BakeArguments& arguments, const MeshFile& file,
                                          bool is_map) {
  if (!contains(arguments.maps, channels_word)) return images;
  Words there = channels_of(file, !arguments.from.empty());
  if (!arguments.settings.texture.empty()) there.emplace_back("basecolor");
  std::erase_if(images, [&](const BakeRequest& image) {
    return contains(all_channels(), image.field) && !contains(arguments.maps, image.field) &&
           !contains(there, image.field);
  });
  if (!images.empty()) return images;
  const std::string& name = arguments.from.empty() ? arguments.input : arguments.from;
  if (!is_map || !arguments.from.empty()) {
    throw UsageMistake(name +
                       (file.materials.empty()
                            ? ": has neither materials nor colours"
                            : ": nothing that could be read says what its materials look like"));
  }
  throw UsageMistake(name +
                     ": has neither materials nor colours. A map carries no materials: bake the "
                     "asset that it is of, `sphparam bake ASSET --sphere " +
                     shell_file(name) + " --map channels`");
}

std::vector<BakeRequest> bake_requests(const BakeArguments& arguments) {
  const std::filesystem::path input(arguments.input);
  std::vector<BakeRequest> images =
      requests_for(fields_of(arguments), arguments.output,
                   is_stream(arguments.input) ? "mesh" : input.stem().stem().string());
  std::set<std::string> paths;
  for (const BakeRequest& image : images) {
    require_possible(image, arguments.settings);
    if (paths.insert(image.path).second) continue;
    throw UsageMistake("-o: several maps would go to " + image.path +
                       "; {map} in the name stands for each, as in statue_{map}.png");
  }
  require_ranged(images, arguments.settings);
  check_all_places(arguments, images);
  return images;
}

}  // namespace sphparam::cli
