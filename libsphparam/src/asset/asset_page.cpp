#include "asset/asset_page.h"

#include <array>
#include <filesystem>

#include "gltf/export_chart.h"
#include "gltf/textured_mesh.h"
#include "io/uri.h"
#include "number_text.h"
#include "report/page.h"
#include "report/svg.h"
#include "report/viewer.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/records/bake_record.h"
#include "sphparam/render/picture.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/words.h"
#include "texture/read_textures.h"

namespace sphparam {
namespace {

constexpr int picture_size = 640, panel_width = 300, image_width = 420;  // pixels

/// A channel that can be switched to: the image of the look, shown as it is.
struct Channel {
  const char* name;
  const char* label;
  int Material::*image;
};
constexpr std::array<Channel, 5> channels = {
    {{"basecolor", "Base colour", &Material::base_colour},
     {"normals", "Normal map", &Material::normal},
     {"orm", "Occlusion, roughness, metallic", &Material::metallic_roughness},
     {"emission", "Emission", &Material::emissive},
     {"occlusion", "Occlusion", &Material::occlusion}}};

/// The look with a material more for each channel, unlit. Images are not repeated.
Look with_channels(Look look, std::vector<ViewedSurface>& surfaces) {
  const Material seen = look.materials.front();
  surfaces.push_back({seen.name, "The asset"});
  for (const Channel& channel : channels) {
    const int image = seen.*channel.image;
    const bool twice = channel.image == &Material::occlusion && image == seen.metallic_roughness;
    if (image < 0 || twice) continue;
    look.materials.push_back({.name = channel.name, .base_colour = image, .unlit = true});
    surfaces.push_back({channel.name, channel.label});
  }
  return look;
}

class AssetPage {
 public:
  AssetPage(const MeshSource& asset, const RemadeAsset& remade, const Look& look,
            const ExportOptions& shown, const std::string& base_colour)
      : asset_(asset), remade_(remade), look_(look), shown_(shown), base_colour_(base_colour) {}

  std::string html(const std::vector<std::pair<std::string, std::string>>& facts) {
    Page page(shown_.name);
    page.verdict(verdict_of(remade_), true);
    const std::string after = picture_after();
    add_model(page, after);
    what_was_done(page);
    side_by_side(page, after);
    images(page);
    figures(page, facts);
    return page.html();
  }

 private:
  const MappedMesh& mapped() const { return remade_.whole.mapped; }

  void add_model(Page& page, const std::string& picture) {
    const std::optional<ViewerScript> script = installed_viewer();
    std::vector<ViewedSurface> surfaces;
    ViewedModel model{.name = "",
                      .alt = "Model of " + shown_.name + " that changes into its sphere",
                      .glb = "",
                      .picture = picture};
    if (script) {
      ExportOptions options = shown_;
      options.look.variants = {"checker", "graticule"};
      const Look variants = make_look(mapped(), options);
      Look look = with_channels(look_, surfaces);
      add_variants(variants, look, surfaces);
      model.glb = glb_bytes(make_asset(mapped(), look, shown_));
    }
    add_viewer(page, {model}, surfaces, script, {.turns = true, .takes_pictures = true});
    if (!script) page.insert("<p class=\"hint\">" + escaped(words_without_viewer(true)) + "</p>\n");
  }

  /// Those of the test images, from a look that has nothing else new.
  void add_variants(const Look& from, Look& look, std::vector<ViewedSurface>& surfaces) const {
    for (std::size_t i = 1; i < from.materials.size(); ++i) {
      Material material = from.materials[i];
      look.images.push_back(from.images[static_cast<std::size_t>(material.base_colour)]);
      material.base_colour = static_cast<int>(look.images.size()) - 1;
      material.normal = material.occlusion = material.metallic_roughness = material.emissive = -1;
      material.roughness = 1, material.metallic = 0;
      surfaces.push_back({material.name, material.name == "checker" ? "Checker" : "Graticule"});
      look.materials.push_back(std::move(material));
    }
  }

  DrawingOptions drawing() const {
    DrawingOptions options;
    options.view = View::Mesh;
    options.up = up();
    options.transparent = true;  // it lies on the viewer's own background until that has loaded
    options.size = picture_size;
    options.threads = shown_.threads;
    return options;
  }

  /// As asked for, else as the asset's own file says.
  Up up() const { return noted_up(asset_.file); }

  /// Drawn as the .glb is, with its texture coordinates and its base colour.
  std::string picture_after() const {
    ExportChart chart = export_chart(mapped().mesh(), mapped().topology(), mapped().map(),
                                     {.threads = shown_.threads, .made = mapped().chart()});
    const MeshFile mesh =
        textured_mesh(chart, mapped().file(), ShapeKind::Mesh, up(), shown_.threads);
    DrawingOptions options = drawing();
    if (!base_colour_.empty()) {
      MeshTextures textures;
      textures.of_materials = {
          read_texture(mesh, base_colour_, TextureWrap::Repeat, shown_.threads)};
      textures.one_for_all = true;
      options.textures = std::make_shared<const MeshTextures>(std::move(textures));
    }
    return draw_png(mesh, std::nullopt, options);
  }

  /// Read again: where vertices were welded, normals that were theirs alone are at corners now.
  std::string picture_before() const {
    const MeshFile file =
        is_stream(asset_.path) ? asset_.file : load_drawn(asset_.path, "", lenient()).file;
    DrawingOptions options = drawing();
    options.textures = shown_textures(file, display_name(asset_.path), "", shown_.threads).textures;
    return draw_png(file, std::nullopt, options);
  }

  static ReadOptions lenient() {
    ReadOptions options;
    options.repeated_corners = options.non_finite = true;
    return options;
  }

  void what_was_done(Page& page) {
    if (!remade_.whole.found.empty()) {
      page.heading("What stood in the way");
      page.list(remade_.whole.found);
    }
    std::vector<std::string> lines = remade_.whole.done;
    if (remade_.baked.projection)
      lines.push_back(line_of(*remade_.baked.projection, {.source_name = "the asset"}));
    lines.insert(lines.end(), remade_.warnings.begin(), remade_.warnings.end());
    lines.insert(lines.end(), remade_.losses.begin(), remade_.losses.end());
    const std::vector<std::string> losses = losses_among(asset_.file.notes);
    lines.insert(lines.end(), losses.begin(), losses.end());
    if (lines.empty()) return;
    page.heading("What was done");
    page.list(lines);
  }

  void side_by_side(Page& page, const std::string& after) {
    page.heading("Before and after");
    page.figures(
        {{data_uri("image/png", picture_before()), "The asset as it was",
          display_name(asset_.path) + ": " + grouped(asset_.file.mesh.face_count()) + " triangles"},
         {data_uri("image/png", after), "The asset as it is now",
          shown_.name + ".glb: " + grouped(remade_.chart.triangles) + " triangles"}},
        panel_width);
  }

  void images(Page& page) {
    std::vector<PageFigure> figures;
    for (const BakedImage& image : remade_.baked.images) {
      const std::string name = std::filesystem::path(image.path).filename().string();
      figures.push_back({uri_of_file(name), image.about, name});
    }
    if (figures.empty()) return;
    page.heading("Its images");
    page.paragraph(
        "Longitude runs from left to right and the north pole is above. They lie beside this "
        "page.");
    page.figures(figures, image_width);
  }

  void figures(Page& page, const std::vector<std::pair<std::string, std::string>>& facts) {
    page.insert("<details><summary>All figures</summary>\n");
    const Distortion distortion =
        measure_distortion(mapped().surface(), mapped().map(), shown_.threads);
    std::vector<std::pair<std::string, std::string>> all = {
        {"map", verdict(mapped().certificate())},
        {"distortion", distortion_line(summarise(distortion, shown_.threads))},
        {"surface", word_of(remade_.whole.by)},
        {"area kept", percent(remade_.whole.area_kept)},
        {"triangles", grouped(mapped().mesh().face_count())},
        {"in the .glb", grouped(remade_.chart.triangles) + " triangles, " +
                            grouped(remade_.chart.vertices) + " vertices"}};
    all.insert(all.end(), facts.begin(), facts.end());
    page.facts(all);
    if (!remade_.whole.details.empty()) page.list(remade_.whole.details);
    page.insert("</details>\n");
    if (const auto script = installed_viewer())
      page.folded_text("Licence of the 3D viewer, <model-viewer>", script->licence);
  }

  const MeshSource& asset_;
  const RemadeAsset& remade_;
  const Look& look_;
  const ExportOptions& shown_;
  const std::string& base_colour_;
};

}  // namespace

bool has_viewer() { return installed_viewer().has_value(); }

std::string asset_page(const MeshSource& asset, const RemadeAsset& remade, const Look& look,
                       const ExportOptions& shown, const std::string& base_colour,
                       const std::vector<std::pair<std::string, std::string>>& facts) {
  return AssetPage(asset, remade, look, shown, base_colour).html(facts);
}

}  // namespace sphparam
