// Images given are embedded as they are; test images are drawn in the convention asked for; what is
// baked comes in u = θ/2π and has its columns moved, by quarters of the width.

#include "commands/export_look.h"

#include <algorithm>
#include <optional>

#include "bake/baked_chart.h"
#include "bake/make_scene.h"
#include "bake/map_kinds.h"
#include "io/attributes/source_attributes.h"
#include "console/paths.h"
#include "arguments/suggestion.h"
#include "gltf/material_images.h"
#include "gltf/variant_images.h"
#include "io/attributes/shading_normals.h"
#include "showcase/surfaces.h"

namespace sphparam::cli {

namespace {

BakedImages images_given(const ExportArguments& arguments) {
  BakedImages images;
  if (!arguments.textures.empty()) images = find_baked_images(arguments.textures);
  if (!arguments.texture.empty()) images.base_colour = arguments.texture;
  if (!arguments.normal.empty()) images.normal = arguments.normal;
  if (!arguments.occlusion.empty()) images.occlusion = arguments.occlusion;
  return images;
}

void require_known(const std::vector<std::string>& names) {
  const std::vector<std::string>& words = export_variants();
  for (const std::string& name : names) {
    if (std::ranges::find(words, name) != words.end()) continue;
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    const std::string meant = nearest_word(name, words);
    throw UsageMistake("--variants: no " + name + " among " + all +
                       (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

bool has_colours(const MeshFile& file) { return linear_colours(file).has_value(); }

class LookMaker {
 public:
  LookMaker(const ExportArguments& arguments, const MappedMesh& mapped, Console& console)
      : arguments_(arguments), mapped_(mapped), console_(console) {}

  ExportLook make() {
    require_known(arguments_.variants);
    const BakedImages given = images_given(arguments_);
    choose_base_colour(given);
    if (!arguments_.unlit) {
      material_.normal = add_file(given.normal, "normal");
      look_.normals_given = material_.normal >= 0;
      material_.occlusion = add_file(given.occlusion, "occlusion");
      // Tangents that no material uses are taken for a mistake: these are used and change nothing.
      if (material_.normal < 0 && arguments_.tangents) material_.normal = add(flat_normals_image());
    }
    look_.materials.push_back(material_);
    for (const std::string& name : arguments_.variants) add_variant(name);
    return std::move(look_);
  }

 private:
  int add(AssetImage image) {
    look_.images.push_back(std::move(image));
    return static_cast<int>(look_.images.size()) - 1;
  }

  int add_file(const std::string& path, const std::string& name) {
    if (path.empty()) return -1;
    ImageTexts texts;
    AssetImage image = read_asset_image(path, name, &texts);
    require_same_chart(path, texts);
    return add(std::move(image));
  }

  /// Texels of `bake` belong to triangles of its chart: on those of another they tear at the poles.
  void require_same_chart(const std::string& path, const ImageTexts& texts) const {
    const std::optional<int> baked = pole_wedges_of(texts);
    if (!baked || *baked == arguments_.refine_poles) return;
    throw UsageMistake("--refine-poles: " + display_name(path) + " is baked for --refine-poles " +
                       std::to_string(*baked) + ", and belongs to the triangles of that chart: `" +
                       "sphparam bake --refine-poles " + std::to_string(arguments_.refine_poles) +
                       "` makes it for this one, or export with --refine-poles " +
                       std::to_string(*baked));
  }

  void choose_base_colour(const BakedImages& given) {
    const MeshFile& file = mapped_.file();
    material_.unlit = arguments_.unlit;
    material_.name = "baked";
    if (!given.base_colour.empty()) {
      material_.base_colour = add_file(given.base_colour, "basecolor");
      return;
    }
    textures_ = read_textures(file, arguments_.threads);
    // Vertex colours would tint all variants: where there are some, they are baked too.
    if (!textures_.empty() || (has_colours(file) && !arguments_.variants.empty())) {
      material_.base_colour = add(baked("baked"));
    } else if (has_colours(file)) {
      material_.name = "colours";
      material_.base_colour = add(white_asset_image());
      look_.vertex_colours = true;
    } else if (!given.normal.empty() || !given.occlusion.empty()) {
      // A relief is to be seen, and a mesh without colours has the one of glTF's own materials.
      material_.name = "plain";
      material_.base_colour = add(white_asset_image());
    } else {
      material_.name = "checker";
      material_.base_colour = add(drawn(TestImage::Checker));
    }
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
    return test_asset_image(image, arguments_.image_width, arguments_.convention,
                            arguments_.threads);
  }

  /// "baked", "area" or "angle".
  AssetImage baked(const std::string& name) {
    if (surfaces_.empty()) bake_surfaces();
    const auto found = std::ranges::find(surfaces_, name, &PaintedSurface::name);
    return as_png(name, in_convention(found->image, arguments_.convention));
  }

  void bake_surfaces() {
    console_.progress("bake", 0);
    const MeshFile& file = mapped_.file();
    const Topology topology(file.mesh);
    const BakeScene scene{.source = {file, mapped_.map(), topology, shading_normals(file), textures_},
                          .target = make_target(file, topology, mapped_.map(), true,
                                                arguments_.threads, arguments_.refine_poles),
                          .options = {.heat = true},
                          .threads = arguments_.threads};
    try {
      surfaces_ = painted_surfaces(scene, arguments_.image_width,
                                   [&](std::string_view stage, double fraction) {
                                     return console_.progress(stage, fraction);
                                   });
    } catch (const MapError& error) {
      throw UsageMistake(display_name(arguments_.input) + ": " + error.what());
    }
  }

  const ExportArguments& arguments_;
  const MappedMesh& mapped_;
  Console& console_;
  ExportLook look_;
  Material material_;
  std::vector<SourceTexture> textures_;
  std::vector<PaintedSurface> surfaces_;
};

}  // namespace

const std::vector<std::string>& export_variants() {
  static const std::vector<std::string> words = {"axes", "checker", "graticule", "area", "angle"};
  return words;
}

ExportLook without_given_normals(ExportLook look) {
  if (!look.normals_given) return look;
  const int dropped = look.materials.front().normal;
  look.images.erase(look.images.begin() + dropped);
  for (Material& material : look.materials) {
    material.normal = -1;
    for (int* image : {&material.base_colour, &material.occlusion}) {
      if (*image > dropped) --*image;
    }
  }
  look.normals_given = false;
  return look;
}

ExportLook make_export_look(const ExportArguments& arguments, const MappedMesh& mapped,
                            Console& console) {
  return LookMaker(arguments, mapped, console).make();
}

}  // namespace sphparam::cli
