#include "showcase/match_model.h"

#include <algorithm>
#include <utility>

#include "bake/bake_rows.h"
#include "bake/fields/linear_field.h"
#include "bake/make_scene.h"
#include "gltf/images/variant_images.h"
#include "render/heat.h"
#include "showcase/match_pictures.h"
#include "sphparam/gltf/morph.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

/// Light of a colour a face.
SurfaceField face_colours(FacePaint paint) {
  SurfaceField field{.name = "heat", .channels = 3, .kind = FieldKind::Colour};
  field.evaluate_runs = [paint = std::move(paint)](std::span<const SurfaceRun> runs,
                                                   float* values) {
    for (const SurfaceRun& run : runs) {
      const Rgb light = to_linear(paint.colours[static_cast<size_t>(run.face)]);
      for (int i = 0; i < run.count; ++i) values = std::copy_n(light.data(), 3, values);
    }
  };
  return field;
}

/// Light of a colour a vertex.
SurfaceField vertex_colours(const TriangleMesh& mesh, std::vector<Rgb> colours) {
  for (Rgb& colour : colours) colour = to_linear(colour);
  return linear_field<3>(
      {.name = "places", .kind = FieldKind::Colour},
      [&mesh, colours = std::move(colours)](Face f, int k, std::array<double, 3>& value) {
        const Rgb& light = colours[static_cast<size_t>(mesh.triangles(f, k))];
        for (int c = 0; c < 3; ++c) value[static_cast<size_t>(c)] = static_cast<double>(light[c]);
      });
}

void copy_light(const float* light, int count, float* out) {
  const SrgbCurves& curves = SrgbCurves::get();
  for (int i = 0; i < count; ++i) out[i] = curves.to_srgb(light[i]);
}

/// Fields of a surface as images of its map.
std::vector<Image> images_of(const MappedMesh& mapped, const std::vector<SurfaceField>& fields,
                             const ExportOptions& options) {
  const int width = options.look.image_width;
  const BakeScene scene{.source = make_source(mapped),
                        .target = make_target(mapped, true, options.threads),
                        .options = {},
                        .threads = options.threads};
  std::vector<Image> images(fields.size(), Image(width, width / 2, 3));
  bake(scene, fields,
       {.width = width,
        .height = width / 2,
        .samples = 2,
        .threads = options.threads,
        .progress = options.progress},
       [&](size_t field, int first_row, int rows, const float* values) {
         copy_light(values, 3 * rows * width, images[field].pixel(0, first_row));
       });
  return images;
}

/// One more surface to switch to: with an image instead of the colours that the asset shows.
void add_surface(Asset& asset, const std::string& name, const Image& image) {
  Material material{.name = name, .base_colour = static_cast<int>(asset.images.size())};
  asset.images.push_back(as_png(name, image));
  asset.materials.push_back(std::move(material));
}

std::string label_of(const std::string& material) {
  if (material == "checker") return "Checker";
  if (material == "places") return "Places";
  if (material == "area") return "Area";
  if (material == "angle") return "Angle";
  return "Colours of " + material;
}

}  // namespace

MatchModel match_model(const SurfaceMap& map, const Distortion& distortion, ExportOptions options) {
  options.look.bake_colours = true;
  options.look.variants = {"checker"};
  Asset asset = make_morph(map, Placement::Scaled, options);
  const Points& box = map.to().mesh().positions;
  const std::vector<Image> of_second =
      images_of(map.to(), {vertex_colours(map.to().mesh(), place_colours(box, box))}, options);
  const std::vector<Image> of_first = images_of(map.from(),
                                                {face_colours(heat_paint(Heat::Area, distortion)),
                                                 face_colours(heat_paint(Heat::Angle, distortion))},
                                                options);
  add_surface(asset, "places", of_second[0]);
  add_surface(asset, "area", of_first[0]);
  add_surface(asset, "angle", of_first[1]);
  MatchModel model{glb_bytes(asset), {}, asset.warnings};
  for (const Material& material : asset.materials)
    model.surfaces.push_back({material.name, label_of(material.name)});
  return model;
}

}  // namespace sphparam
