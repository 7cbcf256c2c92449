// One stage after the other; all files wait in one `PendingFiles`, and stages read those before
// them there.

#include "sphparam/asset/remake_asset.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <string_view>

#include "asset/asset_page.h"
#include "asset/nearest_numbers.h"
#include "asset/part_texels.h"
#include "asset/soup.h"
#include "io/attributes/appearance.h"
#include "io/attributes/left_out_image.h"
#include "io/attributes/material_comments.h"
#include "io/attributes/one_material.h"
#include "io/attributes/remarks.h"
#include "mesh/box.h"
#include "option_domain.h"
#include "rays/flat_normal.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/stopwatch.h"
#include "texture/read_textures.h"

namespace sphparam {
namespace {

/// The map stands as the asset does, where its file says how, or `note_up` wrote what is asked for.
WholeOptions whole_options(const MeshSource& asset, const RemakeOptions& options) {
  WholeOptions whole = options.whole;
  whole.upright |= noted_up(asset.file) != Up{};
  return whole;
}

/// What is done last is judged first. Throws: BakeSettingError; std::invalid_argument.
void require_domain(const RemakeOptions& options) {
  require_bakeable({}, {.width = options.width, .samples = options.samples});
  require_one_of("textures", options.textures, TextureFormat::WebpLossless);
  require_between("webp_quality", options.webp_quality, 1, 100);
}

/// A warning as it is of use here, where no option mends a surface that is one already.
std::string advice_for_assets(std::string warning) {
  constexpr std::string_view option = "--repair=orientation turns";
  if (const std::size_t at = warning.find(option); at != std::string::npos)
    warning.replace(at, option.size(), "`sphparam repair` turns");
  return warning;
}

/// Beside the .glb lies a .ply.
std::string advice_for_numbers(const std::string& loss, const std::string& name) {
  constexpr std::string_view of_glb = ": .ply has room for that";
  if (losses_among({loss}).empty() || !loss.ends_with(of_glb)) return loss;
  return loss.substr(0, loss.size() - of_glb.size()) + ", by the .glb: " + name +
         ".sph.ply has that";
}

/// What stages say of one mesh, each with what it means to them: "the mesh is inside out: …".
bool say_the_same(const std::string& one, const std::string& other) {
  const std::size_t end = one.find(": ");
  const bool of_mesh = one.starts_with("the mesh is ") && end != std::string::npos;
  return one == other || (of_mesh && other.starts_with(one.substr(0, end + 2)));
}

constexpr double walls_beyond = 2.5;  // voxels from the asset, which a wrap is one away from

class Remaker {
 public:
  Remaker(const MeshSource& asset, const std::string& folder, const RemakeOptions& options,
          PendingFiles& files)
      : asset_(asset),
        options_(options),
        files_(files),
        stem_((std::filesystem::path(folder) / name()).string()),
        remade_{.whole = with_nearest_numbers(whole_surface(asset, whole_options(asset, options)),
                                              asset, options.whole.threads),
                .baked = {}} {}

  /// `warnings`: what is known before.
  RemadeAsset remake(const std::vector<std::string>& warnings) {
    append(warnings);
    tell_numbers_of_faces();
    lap("surface");
    bake_channels();
    lap("images");
    const Look look = made_look();
    export_asset(look);
    lap("export");
    add_mapped(files_, note(".sph.ply"), remade_.whole.mapped, options_.whole.threads);
    lap("map");
    if (options_.page) add_page(look);
    return std::move(remade_);
  }

 private:
  std::string name() const { return is_stream(asset_.path) ? "mesh" : stem_of(asset_.path); }

  void lap(const char* stage) { remade_.seconds.emplace_back(stage, stopwatch_.lap()); }

  /// The path of a file that is made, which is told.
  std::string note(const std::string& ending) {
    remade_.files.emplace_back(stem_ + ending, 0);
    return remade_.files.back().first;
  }

  bool is_itself() const { return remade_.whole.by == WholeBy::Itself; }

  /// Of a shape without any colour its occlusion, so that there is something to see.
  std::vector<std::string> fields() const {
    std::vector<std::string> names = channels_of(asset_.file, !is_itself());
    const bool bare =
        std::ranges::count(names, "basecolor") + std::ranges::count(names, "orm") == 0;
    if (options_.occlusion || bare) names.emplace_back("ao");
    return names;
  }

  /// Of a wrap, about.
  double voxel() const {
    return longest_side(remade_.whole.mapped.mesh()) / options_.whole.resolution;
  }

  /// Viewers show 8 bits, also of occlusion.
  BakeSettings bake_settings() const {
    BakeSettings settings{.width = options_.width,
                          .samples = options_.samples,
                          .depth = SampleType::Uint8,
                          .source_name = display_name(asset_.path),
                          .threads = options_.whole.threads,
                          .progress = options_.whole.progress};
    if (!is_itself()) settings.from = with_places(asset_);
    if (remade_.whole.by == WholeBy::Wrap) settings.calm_beyond = walls_beyond * voxel();
    settings.clear_walls = options_.clear_walls;
    return settings;
  }

  void bake_channels() {
    std::vector<BakeRequest> requests;
    for (const std::string& field : fields())
      requests.push_back({field, stem_ + "_" + field + ".png"});
    remade_.baked = bake(remade_.whole.mapped, requests, bake_settings(), files_);
    remade_.parts = texels_of_parts(remade_.whole.mapped, bake_settings());
    append(remade_.baked.warnings);
    tell_other_occlusion();
    for (const BakeRequest& request : requests) remade_.files.emplace_back(request.path, 0);
  }

  /// Which vertices of a wrap get from the asset's nearest points, and its faces do not.
  void tell_numbers_of_faces() {
    if (remade_.whole.by != WholeBy::Wrap) return;
    std::vector<std::string> losses;
    for (const std::string& words : numbers_not_shown(asset_.file))
      if (words.ends_with(" of faces")) add_loss(losses, words + ": a wrap has faces of its own");
    append(losses);
  }

  /// The .glb shows one occlusion.
  void tell_other_occlusion() {
    const bool has_own = std::ranges::any_of(
        asset_.file.channels,
        [](const MaterialChannels& material) { return !material.occlusion.image.empty(); });
    if (options_.occlusion && has_own && !image_of("orm").empty())
      append({"the occlusion of rays is shown instead of the materials' own, which is in red of " +
              name() + "_orm.png: without --occlusion that is shown"});
  }

  /// Where the image of a field lies now; empty: it was not baked.
  std::string image_of(const std::string& field) const {
    for (const BakedImage& image : remade_.baked.images)
      if (image.field == field) return files_.place_of(image.path);
    return "";
  }

  ExportOptions export_options() const {
    ExportOptions options;
    options.name = name();
    options.source = display_name(asset_.path);
    options.look = {.texture = image_of("basecolor"),
                    .normal = image_of("normal-tangent"),
                    .occlusion = image_of("ao"),
                    .orm = image_of("orm"),
                    .emissive = image_of("emissive"),
                    .unlit = one_material(asset_.file).unlit,
                    .textures = options_.textures,
                    .webp_quality = options_.webp_quality};
    options.up = options_.up;
    options.quantise = options_.compress;
    options.threads = options_.whole.threads;
    options.progress = options_.whole.progress;
    return options;
  }

  Look made_look() const { return make_look(remade_.whole.mapped, export_options()); }

  void export_asset(const Look& look) {
    const Asset made = make_asset(remade_.whole.mapped, look, export_options());
    remade_.chart = made.charts.front();
    append(made.warnings);
    const WrittenFiles written =
        add_asset(files_, stem_ + ".glb", made,
                  {.container = GltfContainer::Binary, .compress = options_.compress});
    std::ranges::copy(written, std::back_inserter(remade_.files));
    remade_.sizes = words_of(written, bytes_of(made.images));
    remade_.textures = look.textures;
    remade_.remarks = look.remarks;
  }

  void add_page(const Look& look) {
    ExportOptions shown = export_options();
    shown.quantise = false;
    shown.morph = Morph::Sphere;
    shown.look.textures = TextureFormat::Given;  // of what is made for the page alone
    files_.add(note(".html"),
               asset_page(asset_, remade_, look, shown, image_of("basecolor"), options_.facts));
    remade_.viewer_is_missing = !has_viewer();
    lap("page");
  }

  /// Each once: stages tell the same of one mesh.
  void append(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
      const std::string line = advice_for_numbers(advice_for_assets(warning), name());
      const auto is_said = [&](const std::string& said) { return say_the_same(said, line); };
      std::vector<std::string>& told =
          losses_among({line}).empty() ? remade_.warnings : remade_.losses;
      if (std::ranges::none_of(told, is_said)) told.push_back(line);
    }
  }

  const MeshSource& asset_;
  const RemakeOptions& options_;
  PendingFiles& files_;
  Stopwatch stopwatch_;
  std::string stem_;
  RemadeAsset remade_;
};

/// An OBJ comes out bare where its material libraries could not be read.
void tell_missing_libraries(std::vector<std::string>& told, const MeshFile& file) {
  constexpr std::string_view mark = "colours and textures of ";
  if (!file.base_colours.empty()) return;
  for (const std::string& loss : losses_among(file.notes))
    if (const std::size_t at = loss.find(mark); at != std::string::npos)
      told.push_back("the asset comes out bare: without the " + loss.substr(at));
}

/// Takes images that cannot be used from the materials, which keep their factors; tells of each.
class UnusableImages {
 public:
  explicit UnusableImages(MeshFile& file) : file_(file), has_places_(has_texcoords(file)) {}

  std::vector<std::string> drop() {
    for (size_t i = 0; i < file_.base_colours.size(); ++i) check_colour(file_.base_colours[i], i);
    for (size_t i = 0; i < file_.channels.size(); ++i)
      for (MaterialTexture* texture : file_.channels[i].textures()) check(*texture, i);
    std::ranges::sort(told_);
    told_.erase(std::unique(told_.begin(), told_.end()), told_.end());
    return std::move(told_);
  }

 private:
  /// Empty: it can be used, or there is none. Images are looked at once.
  std::string why_not(const MaterialTexture& texture) {
    if (texture.image.empty()) return "";
    if (!has_places_ && !texture.second) return "the mesh has no texture coordinates";
    if (!texture.problem.empty()) return texture.problem;
    const auto [found, is_new] = known_.try_emplace(origin_of(texture));
    if (is_new) found->second = why_unusable(texture);
    return found->second;
  }

  void check(MaterialTexture& texture, size_t material) {
    const std::string why = why_not(texture);
    if (why.empty()) return;
    told_.push_back("not carried: " + texture.image + " of material " + file_.materials[material] +
                    ": " + why);
    static const MaterialChannels none;
    leave_out_image(texture, material < file_.channels.size() ? file_.channels[material] : none);
  }

  void check_colour(MaterialTexture& colour, size_t material) {
    const bool had_image = !colour.image.empty();
    check(colour, material);
    if (!had_image || !colour.image.empty()) return;
    if (const auto diffuse = diffuse_beside_texture(file_, file_.materials[material]))
      std::ranges::copy(*diffuse, colour.factor.begin());
  }

  MeshFile& file_;
  const bool has_places_;
  std::map<ImageOrigin, std::string> known_;  // why not
  std::vector<std::string> told_;
};

/// glTF says what meshes without materials look like; others get their occlusion to be seen by.
void add_default_material(MeshFile& file) {
  if (!file.format.starts_with("glTF") || !file.channels.empty()) return;
  file.materials = {"default"};
  file.base_colours.resize(1);
  file.channels.resize(1);
  const auto faces = static_cast<size_t>(file.mesh.face_count());
  file.set_face_property({"material", ScalarType::Int32, std::vector<double>(faces, 0)});
}

/// What has no normals is flat: so glTF says, and so it looks where it comes from.
void add_flat_normals(MeshFile& file) {
  const bool has_normals = file.corner_normals || file.find_vertex_property("nx");
  if (has_normals || !file.format.starts_with("glTF")) return;
  CornerNormals normals(3 * file.mesh.face_count(), 3);
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    const auto corner = [&](int k) { return file.mesh.position(file.mesh.triangles(f, k)); };
    const Vector3 normal = flat_normal(corner(0), corner(1), corner(2));
    for (int k = 0; k < 3; ++k)
      normals.row(3 * f + k) = normal.isZero(0) ? Vector3::UnitZ() : normal;
  }
  file.corner_normals = std::move(normals);
}

}  // namespace

RemadeAsset remake_asset(const MeshSource& asset, const std::string& folder,
                         const RemakeOptions& options, PendingFiles& files) {
  require_domain(options);
  MeshSource usable = asset;
  std::vector<std::string> told = UnusableImages(usable.file).drop();
  tell_missing_libraries(told, usable.file);
  add_face_colour_loss(told, usable.file);
  add_default_material(usable.file);
  add_flat_normals(usable.file);
  upright_axes(usable.file, options.up);  // a front that cannot be is told before any work
  note_up(usable.file, options.up);
  return Remaker(usable, folder, options, files).remake(told);
}

}  // namespace sphparam
