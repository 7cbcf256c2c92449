// `sphparam asset FILE`, also `sphparam FILE`: an asset → one closed surface, its map, all its
// images, a .glb that has them, a page. All files appear together or none.

#include <algorithm>
#include <filesystem>
#include <optional>

#include "arguments/limits.h"
#include "arguments/texture_arguments.h"
#include "commands/command.h"
#include "commands/lengths.h"
#include "commands/sources.h"
#include "console/places.h"
#include "console/session.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/asset/remake_asset.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/records/bake_record.h"
#include "sphparam/version.h"
#include "sphparam/wrap/wrap.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

constexpr char summary[] =
    "Make of an asset one closed surface with one chart, with all that the asset shows.\n"
    "\n"
    "Examples:\n"
    "  sphparam helmet.glb                          into the folder helmet_sphere/\n"
    "  sphparam asset helmet.glb -o out/ --size 4096 --compress --textures webp\n"
    "  sphparam asset truck.obj -o out/ --faces 20000 --json out/truck.json\n"
    "\n"
    "What is a closed surface of genus 0 stays as it is; what repair mends, keeping 98 % of the\n"
    "area, is mended; all else is wrapped. Base colour, normals, occlusion, roughness, metallic "
    "and\n"
    "emission of all its materials are baked. Into the folder go NAME.glb with all of them,\n"
    "NAME.sph.ply with the map, the images, and NAME.html to look at it. What becomes of the "
    "asset\n"
    "is told; `sphparam FILE` is the same.\n";

struct AssetArguments : CommonArguments {
  std::string input, output;
  double crease = -1;                // degrees; below 0: none
  double scale = 1;                  // of lengths
  bool source_normals_down = false;  // green of its own normal maps
  RemakeOptions options;
};

/// The folder that files go to. One that was made here goes again unless it is used.
class Folder {
 public:
  explicit Folder(const AssetArguments& arguments)
      : path_(arguments.output.empty() ? stem_or(arguments.input, "mesh") + "_sphere"
                                       : arguments.output) {
    while (path_.size() > 1 && path_.ends_with('/')) path_.pop_back();
    std::error_code error;
    if (fs::exists(path_, error) && !fs::is_directory(path_, error))
      throw WriteError(path_, "is a file, and a folder is needed: -o names one");
    is_made_ = fs::create_directory(path_, error);
    const std::string parent = fs::path(path_).parent_path().string();
    if (error == std::errc::no_such_file_or_directory && parent.empty())
      throw WriteError(path_, "the folder that this was started in is gone; -o names another one");
    if (error == std::errc::no_such_file_or_directory)
      throw WriteError(path_, "the folder that it is to be made in is not there: mkdir -p " +
                                  shell_word(parent) + " makes it");
    if (error) throw WriteError(path_, error.message());
  }
  ~Folder() {
    std::error_code error;
    if (is_made_) fs::remove(path_, error);  // only an empty one
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool is_made_ = false;
};

MeshSource read_asset(const std::string& path) {
  ReadOptions options = input_limits();
  options.repeated_corners = options.non_finite = true;
  MeshSource asset = sphparam::read_source(path, options);
  keep_companions(asset.file);
  return asset;
}

RemadeAsset remade(const MeshSource& asset, const std::string& folder,
                   const AssetArguments& arguments, Session& session) try {
  RemakeOptions options = arguments.options;
  options.whole.threads = session.threads();
  options.whole.progress = session.progress();
  options.facts = {{"program", std::string("sphparam ") + version}};
  return remake_asset(asset, folder, options, session.files);
} catch (const BakeSettingError& error) {
  throw UsageMistake("--size: " + error.reason());
} catch (const VoxelError& error) {
  // How fine a lattice can be the mesh decides: no domain of the option says so before.
  throw UsageMistake(std::string("--") + error.what());
} catch (const MeshError& error) {
  throw ReadError(display_name(asset.path), error.defects().front().message);
}

constexpr double hardly_any = 0.001;  // of the area: what little there is of walls nobody sees

std::string share_of_walls(const RemadeAsset& made) {
  return "walls that close ways through it are " + short_number(100 * made.baked.wall_share, 2) +
         " % of its area";
}

bool has_alpha(const BakedImage& image) {
  return image.field == "basecolor" && image.channels == 4;
}

/// Though they were to be cut out.
bool walls_stay(const RemadeAsset& made, const RemakeOptions& options) {
  return options.clear_walls && made.baked.wall_share >= hardly_any &&
         std::ranges::none_of(made.baked.images, has_alpha);
}

/// Before the record is written, which says so too.
void warn_of(const RemadeAsset& made, const AssetArguments& arguments, const std::string& folder,
             Session& session) {
  session.warn(made.warnings);
  session.warn(made.losses);
  if (made.whole.by != WholeBy::Wrap && arguments.options.whole.faces != WholeOptions{}.faces) {
    const fs::path map = fs::path(folder) / (stem_or(arguments.input, "mesh") + ".sph.ply");
    session.warn({"--faces is of wraps only, and this is none: it has all its " +
                  counted(made.whole.mapped.mesh().face_count(), "triangle") +
                  "; `sphparam remesh " + shell_file(map.string()) +
                  " --grid ico:5 -o light.sph.ply` makes it lighter"});
  }
  if (made.whole.by != WholeBy::Wrap && arguments.options.clear_walls)
    session.warn({"--clear-walls is of wraps only, and this is none: it has no walls"});
  if (walls_stay(made, arguments.options))
    session.warn({"--clear-walls: " + share_of_walls(made) +
                  ", and stay: it has no base colour whose alpha could cut them out"});
  if (made.viewer_is_missing)
    session.console.warning("this build has no 3D viewer: the page has pictures instead");
}

std::string line_of_walls(const RemadeAsset& made, const RemakeOptions& options) {
  if (made.baked.wall_share < hardly_any || walls_stay(made, options)) return "";
  return share_of_walls(made) + (options.clear_walls
                                     ? ", and cut out of what is seen, by alpha"
                                     : ": --clear-walls cuts them out of what is seen, by alpha");
}

void tell(const RemadeAsset& made, const std::string& folder, const RemakeOptions& options,
          Session& session) {
  for (const Words* lines : {&made.whole.found, &made.whole.done})
    for (const std::string& line : *lines) session.console.say("  " + line);
  for (const std::string& line : made.whole.details) session.console.detail("  " + line);
  if (made.baked.projection)
    session.console.say("  " + line_of(*made.baked.projection, {.source_name = "the asset"}));
  if (const std::string walls = line_of_walls(made, options); !walls.empty())
    session.console.say("  " + walls);
  if (made.parts.size() > 1) session.console.detail("  " + line_of(made.parts));
  if (made.whole.by == WholeBy::Repair && made.whole.area_kept < 1)
    session.console.say("  with --keep 1 the parts that it dropped stay, and all is wrapped");
  if (made.whole.by == WholeBy::Wrap)
    session.console.detail("  a larger --resolution wraps closer, --faces has more of it");
  for (const auto& [stage, seconds] : made.seconds)
    session.console.detail("  " + stage + ": " + short_number(seconds) + " s");
  session.console.say(
      verdict_of(made) + ": " + counted(made.whole.mapped.mesh().face_count(), "triangle") + ", " +
      counted(static_cast<long>(made.baked.images.size()), "image") + " baked, " +
      short_number(session.stopwatch.seconds()) + " s → " + fs::path(folder).append("").string());
  session.console.say("  " + made.sizes);
  for (const std::string& remark : made.remarks) session.console.say("  " + remark);
  session.console.say("  in the .glb: " + counted(made.chart.triangles, "triangle") + ", " +
                      counted(made.chart.vertices, "vertex", "vertices"));
  if (options.textures != TextureFormat::Given)
    session.console.say("  its images: " + words_of(made.textures));
}

/// Before any work. A folder is no file that could be replaced.
void require_sense(const AssetArguments& arguments) {
  std::error_code hidden;  // what cannot be asked is not there, and making it says why
  if (is_mesh_name(arguments.output) && !fs::is_directory(arguments.output, hidden))
    check_places({{"-o", arguments.output}});
  if (is_mesh_name(arguments.output) && !fs::exists(arguments.output, hidden))
    throw UsageMistake("-o: the folder that files go to, not " + arguments.output +
                       ": `export` writes one file");
}

/// What is made of a map or a .glb has its name.
void require_other_folder(const std::string& folder, const std::string& input) {
  for (const char* ending : {".glb", ".sph.ply"}) {
    const std::string made = (fs::path(folder) / (stem_of(input) + ending)).string();
    if (!is_stream(input) && is_same_place(made, input))
      throw UsageMistake("-o: " + made +
                         " is the input, and would be replaced; another folder is " +
                         "needed, as in -o " + shell_word((fs::path(folder) / "made").string()));
  }
}

int run_asset(AssetArguments& arguments) {
  require_sense(arguments);
  std::optional<Folder> place;  // outlives what is pending in it
  Session session(arguments);
  session.hold_signals();
  const Folder& folder = place.emplace(arguments);
  require_other_folder(folder.path(), arguments.input);
  check_places({{"--json", arguments.json}});
  MeshSource asset = read_asset(arguments.input);
  tell_losses(asset, session.console);
  scale_by(arguments.scale, asset.file, session);
  crease(asset.file, arguments.input, arguments.crease, session);
  turn_normals(asset.file, arguments.input, arguments.source_normals_down, session);
  const RemadeAsset made = remade(asset, folder.path(), arguments, session);
  warn_of(made, arguments, folder.path(), session);
  session.add_report([&] { return to_json(asset, made); });
  session.publish();
  tell(made, folder.path(), arguments.options, session);
  tell_size(made.whole.mapped.mesh(), session);
  if (!arguments.options.up.direction && !noted_up(asset.file).direction)
    session.console.say("  z is taken to point up; --up y where it lies on its side");
  return Ok;
}

void declare_options(Declaration& command, AssetArguments& arguments) {
  RemakeOptions& options = arguments.options;
  command.input("FILE", arguments.input, readable_formats("or") + "; - for standard input")
      .text("-o,--output", arguments.output, "FOLDER",
            "Where files go; it is made if need be, in a folder that is there")
      .written()
      .preset("NAME_sphere")
      .number("--size", options.width, "N", {2, 65536}, "Texels a row of images; half as many rows")
      .number("--samples", options.samples, "N", {1, 32}, "N × N samples a texel")
      .flag("--clear-walls", options.clear_walls,
            "Walls that close ways through a wrap are cut out of what is seen, by alpha: the "
            "surface stays closed")
      .flag("--occlusion", options.occlusion, "Ambient occlusion too, by rays")
      .number("--faces", options.whole.faces, "N", {0, 100'000'000},
              "About so many triangles of a wrap; 0: all")
      .number("--resolution", options.whole.resolution, "N", {8, 2000},
              "Voxels of a wrap along the longest side of the box")
      .number("--keep", options.whole.least_kept, "SHARE", {0, 1},
              "Of the area, that a repair must keep; else it is wrapped")
      .flag("--compress", options.compress, "A smaller .glb: EXT_meshopt_compression");
  declare_textures(command, options.textures, options.webp_quality);
  command.crease(arguments.crease)
      .source_normals(arguments.source_normals_down)
      .up(options.up)
      .number("--scale", arguments.scale, "FACTOR", {1e-12, 1e12}, about_scale)
      .flag_off("--no-page", options.page, "Without the page")
      .json(arguments)
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_asset(CLI::App& program) {
  return make_command(program, "asset", summary, declare_options, run_asset);
}

}  // namespace sphparam::cli
