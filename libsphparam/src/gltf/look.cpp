// Images given are embedded as they are; test images are drawn in the convention asked for; what is
// baked comes in u = θ/2π and has its columns moved, by quarters of the width.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "bake/baked_chart.h"
#include "bake/field_registry.h"
#include "bake/fields/material_fields.h"
#include "bake/make_scene.h"
#include "gltf/export_domain.h"
#include "gltf/export_names.h"
#include "gltf/images/material_images.h"
#include "gltf/images/normal_image.h"
#include "gltf/images/texture_format.h"
#include "gltf/images/variant_images.h"
#include "gltf/painted_surfaces.h"
#include "io/attributes/appearance.h"
#include "io/attributes/corner_colours.h"
#include "io/attributes/finish_terms.h"
#include "io/attributes/material_comments.h"
#include "io/attributes/one_material.h"
#include "io/attributes/shading_normals.h"
#include "io/attributes/source_attributes.h"
#include "number_text.h"
#include "sphparam/bake/fields.h"
#include "sphparam/chart/chart_failure.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "texture/baked_texts.h"

namespace sphparam {

namespace {

BakedImages images_given(const LookOptions& options) {
  BakedImages images;
  if (!options.folder.empty()) images = find_baked_images(options.folder);
  if (!options.texture.empty()) images.base_colour = options.texture;
  if (!options.normal.empty()) images.normal = options.normal;
  if (!options.occlusion.empty()) images.occlusion = options.occlusion;
  if (!options.orm.empty()) images.orm = options.orm;
  if (!options.emissive.empty()) images.emissive = options.emissive;
  return images;
}

void require_known(const std::vector<std::string>& names) {
  const std::vector<std::string>& words = variant_names();
  for (const std::string& name : names) {
    if (std::ranges::find(words, name) != words.end()) continue;
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    throw LookError("no variant " + name + " among " + all);
  }
}

/// What a text says, if that is a number that glTF takes.
double number_in(std::string_view text, double otherwise) {
  double number = -1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number >= 0 && std::isfinite(number) ? number : otherwise;
}

/// How an image of the base colour says that its alpha and its surfaces are seen.
void take_sides(Material& material, const GivenImage& image) {
  constexpr std::string_view mask = "mask ";
  const ImageTexts& texts = image.texts;
  const std::string_view alpha = baked_text(texts, alpha_text);
  if (baked_text(texts, "sphparam:map").empty()) material.alpha_mode = alpha_mode_of(image.pixels);
  if (alpha == "blend") material.alpha_mode = AlphaMode::Blend;
  if (alpha.starts_with(mask)) {
    material.alpha_mode = AlphaMode::Mask;
    material.alpha_cutoff = number_in(alpha.substr(mask.size()), material.alpha_cutoff);
  }
  material.double_sided = baked_text(texts, sides_text) == "1";
  material.finish = finish_in(baked_text(texts, finish_text));
}

bool has_colours(const MeshFile& file) { return linear_colours(file).has_value(); }

/// What a mesh's own materials say that an image of their colour alone does not, and no image that
/// is given does.
std::vector<std::string> beyond_colour(const MeshFile& file, const BakedImages& given) {
  const auto any = [&](auto&& says) { return std::ranges::any_of(file.channels, says); };
  using Said = MaterialChannels;
  std::vector<std::string> words;
  if (given.normal.empty() && any([](const Said& said) { return !said.normal.image.empty(); }))
    words.emplace_back("normal maps");
  if (given.orm.empty() && any([](const Said& said) {
        return !said.roughness.image.empty() || said.roughness.factor[0] != 1;
      }))
    words.emplace_back("roughness");
  if (given.orm.empty() && any([](const Said& said) { return said.metallic.factor[0] > 0; }))
    words.emplace_back("metallic");
  if (given.orm.empty() && given.occlusion.empty() &&
      any([](const Said& said) { return !said.occlusion.image.empty(); }))
    words.emplace_back("occlusion");
  const std::vector<std::string> channels = channels_of(file, false);
  if (given.emissive.empty() && std::ranges::count(channels, "emissive") > 0)
    words.emplace_back("emission");
  return words;
}

class LookMaker {
 public:
  LookMaker(const MappedMesh& mapped, const ExportOptions& options)
      : mapped_(mapped), options_(options), wanted_(options.look) {}

  Look make() {
    require_known(wanted_.variants);
    const BakedImages given = images_given(wanted_);
    choose_base_colour(given);
    if (given.base_colour.empty()) add_face_colour_loss(look_.warnings, mapped_.file());
    if (material_.unlit) {
      tell_unlit(given);
    } else {
      add_normals(given.normal);
      add_roughness(given);
      add_occlusion(given.occlusion);
      add_emission(given.emissive);
      // Tangents that no material uses are taken for a mistake: these are used and change nothing.
      if (material_.normal < 0 && wanted_.tangents) material_.normal = add(flat_normals_image());
    }
    look_.materials.push_back(material_);
    for (const std::string& name : wanted_.variants) add_variant(name);
    report(options_.progress, "images", 1);
    encode_textures(look_, wanted_, options_.threads);
    return std::move(look_);
  }

 private:
  /// What the mesh's own materials do not show either is no loss.
  void tell_unlit(const BakedImages& given) {
    if (baked_unlit_) return;
    std::vector<std::string> words;
    for (const auto& [path, what] : {std::pair(&given.normal, "normals"),
                                     {&given.occlusion, "occlusion"},
                                     {&given.orm, "roughness and metallic"},
                                     {&given.emissive, "emission"}})
      if (!path->empty()) words.push_back(display_name(*path) + " (" + what + ")");
    if (!words.empty())
      add_loss(look_.warnings, enumerated(words) + ": without light, colours alone are shown");
  }

  int add(AssetImage image) {
    look_.images.push_back(std::move(image));
    return static_cast<int>(look_.images.size()) - 1;
  }

  /// By its name among the images of the asset: its file may have none yet.
  void remark(const std::string& image, const std::string& what) {
    look_.remarks.push_back("the image " + image + " is one colour: " + what);
  }

  /// One texel where all are the same, which is told.
  int add_small(GivenImage given) {
    if (!uniform_colour(given.pixels) || given.pixels.width * given.pixels.height == 1)
      return add(std::move(given.asset));
    Image texel(1, 1, given.pixels.channels);
    texel.pixels.assign(given.pixels.pixel(0, 0), given.pixels.pixel(0, 0) + texel.channels);
    remark(given.asset.name, "one texel");
    return add(as_png(given.asset.name, texel));
  }

  /// Roughness and metallic are numbers where they are the same all over and no occlusion goes with
  /// them.
  void add_roughness(const BakedImages& images) {
    if (images.orm.empty()) return;
    GivenImage given = read(images.orm, "orm");
    const auto same = uniform_colour(given.pixels);
    const bool shows_occlusion = images.occlusion.empty() && same && (*same)[0] < 1;
    if (!same || shows_occlusion) {
      material_.metallic_roughness = add_small(std::move(given));
      if (images.occlusion.empty()) material_.occlusion = material_.metallic_roughness;
      return;
    }
    constexpr double digits = 1e6;
    const auto factor = [](float x) {
      return std::round(static_cast<double>(x) * digits) / digits;
    };
    material_.roughness = factor((*same)[1]);
    material_.metallic = factor((*same)[2]);
    remark(given.asset.name, "roughness " + short_number(material_.roughness) + " and metallic " +
                                 short_number(material_.metallic) + ", without an image");
  }

  void add_occlusion(const std::string& path) {
    if (path.empty()) return;
    GivenImage given = read(path, "occlusion");
    const auto same = uniform_colour(given.pixels);
    if (same && (*same)[0] == 1)
      return remark(given.asset.name, "it darkens nothing, and is left out");
    material_.occlusion = add_small(std::move(given));
  }

  void add_emission(const std::string& path) {
    if (path.empty()) return;
    GivenImage given = read(path, "emissive");
    if (uniform_colour(given.pixels) == std::array{0.0F, 0.0F, 0.0F})
      return remark(given.asset.name, "no light, and left out");
    const double strength = number_in(baked_text(given.texts, strength_text), 1);
    material_.emissive = add_small(std::move(given));
    material_.emissive_strength = strength;
  }

  void add_normals(const std::string& path) {
    if (path.empty()) return;
    GivenImage given = read(path, "normal");
    const std::string complaint = complaint_of_normals(path, given);
    if (!complaint.empty()) {
      if (!wanted_.for_text || !wanted_.normal.empty()) throw LookError(complaint);
      return add_loss(look_.warnings, complaint);
    }
    std::string warning =
        warning_of_other_mesh(path, given.texts, {source_name(mapped_, options_), mapped_.name()});
    if (!warning.empty()) look_.warnings.push_back(std::move(warning));
    material_.normal = add(std::move(given.asset));
    look_.normals_given = true;
  }

  /// Refuses what was baked for another chart.
  GivenImage read(const std::string& path, const std::string& name) {
    GivenImage given = read_asset_image(path, name, look_.warnings);
    tell_other_map(path, given.texts);
    const std::optional<int> baked = pole_wedges_of(given.texts);
    if (baked && *baked != options_.refine_poles) throw ImageOfOtherChart(path, *baked);
    const std::optional<Convention> convention = baked_convention_of(given.texts);
    if (convention && *convention != options_.convention) {
      const std::string baked_in = info_of(*convention).name;
      throw LookError(display_name(path) + " is baked in the convention " + baked_in +
                      ", and would be shown in " + info_of(options_.convention).name +
                      ": --convention " + baked_in + " shows it as it is");
    }
    return given;
  }

  /// Once: all images of a folder were baked together.
  void tell_other_map(const std::string& path, const ImageTexts& texts) {
    if (is_other_map_told_) return;
    std::string warning = warning_of_other_map(display_name(path), texts, mapped_);
    is_other_map_told_ = !warning.empty();
    if (is_other_map_told_) look_.warnings.push_back(std::move(warning));
  }

  void choose_base_colour(const BakedImages& given) {
    material_.unlit = wanted_.unlit;
    material_.name = "baked";
    given.base_colour.empty() ? show_own_colours(given) : show_given_colour(given.base_colour);
  }

  void show_given_colour(const std::string& path) {
    GivenImage image = read(path, "basecolor");
    material_.base_colour = add(std::move(image.asset));
    take_sides(material_, image);
    // Who names an image that light falls on wants light.
    const bool lit = !wanted_.normal.empty() || !wanted_.occlusion.empty() ||
                     !wanted_.orm.empty() || !wanted_.emissive.empty() || wanted_.tangents;
    baked_unlit_ = baked_text(image.texts, unlit_text) == "1";
    material_.unlit = material_.unlit || (!lit && baked_unlit_);
  }

  /// Those of the mesh's textures or of its vertices; where it has none, white under a relief, or
  /// a checker.
  void show_own_colours(const BakedImages& given) {
    const MeshFile& file = mapped_.file();
    textures_ = read_textures(file, options_.threads);
    if (!textures_.empty()) take_one_material(given);
    tell_left_behind();
    std::ranges::move(warnings_of(textures_), std::back_inserter(look_.warnings));
    // Vertex colours would tint all variants: where there are some, they are baked too, as are
    // those of vertices that have several.
    const bool baked_colours =
        wanted_.bake_colours || !wanted_.variants.empty() || corner_colours(file);
    if (!textures_.empty() || (has_colours(file) && baked_colours)) {
      material_.base_colour = add(baked("baked"));
    } else if (has_colours(file)) {
      material_.name = "colours";
      material_.base_colour = add(white_asset_image());
      look_.vertex_colours = true;
    } else if (!given.none()) {
      // A relief is to be seen, and a mesh without colours has the one of glTF's own materials.
      material_.name = "plain";
      material_.base_colour = add(white_asset_image());
    } else {
      material_.name = "checker";
      material_.base_colour = add(drawn(TestImage::Checker));
    }
  }

  void tell_left_behind() {
    if (const std::string words = left_behind_texture(mapped_.file()); !words.empty())
      look_.warnings.push_back(source_name(mapped_, options_) +
                               ": shown without its texture, which is not in this file (" + words +
                               ")");
  }

  /// Of the mesh's own materials what is no image.
  void take_one_material(const BakedImages& given) {
    OneMaterial one = one_material(mapped_.file());
    material_.finish = one.finish;
    material_.unlit = material_.unlit || (one.unlit && given.none() && !wanted_.tangents);
    look_.warnings = std::move(one.warnings);
    tell_losses(given, one.alpha_mode);
  }

  /// The colour that is baked here has no alpha, and light is left as it falls on plain paper.
  void tell_losses(const BakedImages& given, AlphaMode alpha) {
    std::vector<std::string> words;
    if (!material_.unlit) words = beyond_colour(mapped_.file(), given);
    if (alpha != AlphaMode::Opaque) words.emplace_back("alpha");
    material_.double_sided =
        std::ranges::any_of(mapped_.file().channels, &MaterialChannels::double_sided);
    if (words.empty()) return;
    add_loss(look_.warnings,
             enumerated(words) + " of its materials: `bake --map channels` makes images of all");
  }

  void add_variant(const std::string& name) {
    for (const Material& there : look_.materials) {
      if (there.name == name) return;
    }
    Material variant = material_;
    variant.name = name;
    const std::optional<TestImage> test = test_image_named(name);
    variant.base_colour = add(test ? drawn(*test) : baked(name));
    look_.materials.push_back(variant);
  }

  AssetImage drawn(TestImage image) const {
    return test_asset_image(image, wanted_.image_width, options_.convention, options_.threads,
                            options_.progress);
  }

  /// "baked", "area" or "angle".
  AssetImage baked(const std::string& name) {
    if (surfaces_.empty()) bake_surfaces();
    const auto found = std::ranges::find(surfaces_, name, &PaintedSurface::name);
    return as_png(name, in_convention(found->image, options_.convention), options_.progress);
  }

  void bake_surfaces() {
    report(options_.progress, "bake", 0);
    const BakeScene scene{
        .source = {mapped_, shading_normals(mapped_.file()), textures_},
        .target = make_target(mapped_, true, options_.threads, options_.refine_poles),
        .options = {.heat = true},
        .threads = options_.threads};
    require_one_to_one(scene.target.chart, source_name(mapped_, options_));
    try {
      surfaces_ = painted_surfaces(scene, wanted_.image_width, options_.progress);
    } catch (const FieldError& error) {
      throw LookError(source_name(mapped_, options_) + ": " + error.what());
    }
  }

  const MappedMesh& mapped_;
  const ExportOptions& options_;
  const LookOptions& wanted_;
  Look look_;
  Material material_;
  bool baked_unlit_ = false;  // what the base colour says
  bool is_other_map_told_ = false;
  std::vector<SourceTexture> textures_;
  std::vector<PaintedSurface> surfaces_;
};

}  // namespace

ImageOfOtherChart::ImageOfOtherChart(const std::string& path, int refine_poles)
    : std::runtime_error(display_name(path) + " is baked for triangles at the poles cut into " +
                         std::to_string(refine_poles) +
                         ", and belongs to the triangles of that chart"),
      path_(path),
      refine_poles_(refine_poles) {}

const std::vector<std::string>& variant_names() {
  static const std::vector<std::string> words = {"axes", "checker", "graticule", "area", "angle"};
  return words;
}

Look make_look(const MappedMesh& made, const MappedMesh& source, const ExportOptions& options) {
  const bool textured = has_texcoords(made.file()) && !source.file().base_colours.empty();
  return make_look(textured ? source : made, options);
}

Look without_given_normals(Look look) {
  if (!look.normals_given) return look;
  const int dropped = look.materials.front().normal;
  look.images.erase(look.images.begin() + dropped);
  if (!look.textures.empty()) look.textures.erase(look.textures.begin() + dropped);
  for (Material& material : look.materials) {
    material.normal = -1;
    for (int* image : material.frameless_images()) {
      if (*image > dropped) --*image;
    }
  }
  look.normals_given = false;
  return look;
}

Look make_look(const MappedMesh& mapped, const ExportOptions& options) {
  require_look_domain(options);
  report(options.progress, "images", 0);
  return LookMaker(mapped, options).make();
}

}  // namespace sphparam
