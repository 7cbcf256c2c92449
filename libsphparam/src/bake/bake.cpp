// Everything that may fail for the user's reasons comes first; then all images are baked together,
// row by row into files that get their names at the end.

#include "sphparam/bake/bake.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "bake/baked_chart.h"
#include "bake/chart_piece.h"
#include "bake/choose_target.h"
#include "bake/field_registry.h"
#include "bake/georeference/georeference.h"
#include "bake/image_plan.h"
#include "bake/make_scene.h"
#include "bake/projected_surface.h"
#include "bake/source_doubts.h"
#include "bake/texels/calm_walls.h"
#include "bake/write_images.h"
#include "io/attributes/array_lengths.h"
#include "io/attributes/material_comments.h"
#include "io/attributes/one_material.h"
#include "mesh/box.h"
#include "number_text.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

/// A surface to bake from that no reader made. Throws: BakeSettingError.
void require_surface(const BakeSettings& settings) try {
  if (!settings.from) return;
  require_places(settings.from->mesh);
  require_array_lengths(*settings.from);
} catch (const std::invalid_argument& error) {
  throw BakeSettingError("from", error.what());
}

void read_source_textures(const BakeSettings& settings, BakeSource& source) {
  report(settings.progress, "texture", 0);
  if (settings.texture.empty()) {
    source.textures = read_textures(source.file(), settings.threads);
  } else {
    source.textures = {
        read_texture(source.file(), settings.texture, settings.wrap, settings.threads)};
    source.one_texture_for_all = true;
  }
}

BakeScene scene_for(const MappedMesh& source, BakeTarget target, bool with_textures,
                    const BakeSettings& settings) {
  BakeScene scene{settings.from ? make_source(*settings.from) : make_source(source),
                  std::move(target), settings.fields, settings.threads};
  scene.options.centre = body_centre(planetocentric(source.provenance()), settings.fields.centre);
  scene.body_axes = body_axes(source.file());
  scene.calm_beyond = settings.from ? settings.calm_beyond : 0;
  scene.clear_walls = settings.clear_walls;
  scene.mirrored = info_of(settings.convention).turns < 0;
  if (with_textures) read_source_textures(settings, scene.source);
  return scene;
}

/// Farther away on the whole, the two are hardly of one thing.
constexpr double doubtful_distance = 0.05;  // of the diagonal

/// Of the surface baked from, over the mesh's.
double relative_size(const BakeScene& scene) {
  return box_of(scene.source.mesh().positions).longest_side() /
         box_of(scene.target.positions).longest_side();
}

/// Tells how the target finds the surface that is baked on it.
void report_projection(const BakeScene& scene, const BakeSettings& settings, BakeReport& report) {
  if (!settings.from) return;
  report.projection = measure_projection(*scene.source.surface, scene.target, settings.threads);
  if (report.projection->median <= doubtful_distance) return;
  report.warnings.push_back(
      "half of the mesh is more than " + percent(report.projection->median) +
      " of the diagonal away from the surface that is baked from, whose box is " +
      short_number(relative_size(scene)) + " times as long: are they in the same place?");
}

void add_line(BakeReport& report, std::string line) {
  if (!line.empty()) report.warnings.push_back(std::move(line));
}

std::string remark_of(const SurfaceField& field) { return field.remark ? field.remark() : ""; }

std::vector<std::string> fields_of(const std::vector<BakeRequest>& images) {
  std::vector<std::string> names;
  std::ranges::transform(images, std::back_inserter(names), &BakeRequest::field);
  return names;
}

bool needs_textures(const std::string& field) { return field == "basecolor"; }

/// The texture of what is baked may be where its file comes from.
std::string left_behind_line(const MappedMesh& source, const MeshFile& baked,
                             const BakeSettings& settings) {
  const std::string words = left_behind_texture(baked);
  if (words.empty()) return "";
  const std::string name = source_name(source, settings);
  return name + ": baked without its texture, which is not in this file (" + words +
         "): --texture IMAGE names it, or the file that was mapped" +
         (settings.from ? "" : ", with --sphere " + name) + ", has it";
}

/// Readers put corners that have no texture coordinates at (0, 0); one that has them may be there,
/// all three are not.
std::string unplaced_line(const BakeSource& source) {
  const MeshFile& file = source.file();
  if (!file.corner_texcoords || source.textures.empty()) return "";
  const auto is_unplaced = [&](Face f) {
    return file.corner_texcoords->middleRows<3>(Eigen::Index{3} * f).isZero(0);
  };
  const bool of_materials = !source.one_texture_for_all;
  const Property* const material = of_materials ? file.find_face_property("material") : nullptr;
  const auto has_image = [&](Face f) {
    const double which = material ? material->values[static_cast<size_t>(f)] : 0;
    const auto count = static_cast<double>(source.textures.size());
    return which >= 0 && which < count && source.textures[static_cast<size_t>(which)].image;
  };
  long unplaced = 0;
  for (Face f = 0; f < file.mesh.face_count(); ++f) unplaced += has_image(f) && is_unplaced(f);
  if (unplaced == 0) return "";
  return counted(unplaced, "triangle has", "triangles have") +
         " no texture coordinates, or all at (0, 0): the texture's corner is seen there";
}

/// Where texels hold several triangles of the mesh that heights are above, these are measured from
/// the plane of one of them, and its bends are counted as heights.
std::string crowded_height_line(const BakeScene& scene, const std::vector<BakeRequest>& images,
                                const BakeSettings& settings) {
  constexpr double least_told = 0.01;  // of the area
  const bool radial = settings.fields.height_radial || scene.target.is_source;
  if (radial || std::ranges::count(images, "height", &BakeRequest::field) == 0) return "";
  const double texel = 2.0 / (static_cast<double>(settings.width) * settings.width);
  double crowded = 0, all = 0;
  for (Face f = 0; f < static_cast<Face>(scene.target.chart.triangles.rows()); ++f) {
    const auto corner = [&](int k) -> Vector3 {
      return scene.target.positions.row(scene.target.chart.triangles(f, k));
    };
    const double area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    all += area;
    if (2 * ChartPiece(scene.target.chart, f).area() < texel) crowded += area;
  }
  if (!(crowded >= least_told * all)) return "";
  return "height: " + percent(crowded / all) +
         " of the mesh has triangles smaller than texels: there heights are means above the plane "
         "of one of several triangles, and how the mesh bends is among them; a larger --size has "
         "less of it";
}

ImageTexts texts_of_all(const MappedMesh& source, const BakeSettings& settings) {
  ImageTexts texts = {{"sphparam:version", version},
                      {"sphparam:source", source_name(source, settings)}};
  const bool linear = settings.interpolation == Interpolation::Uv;
  for (auto& text : texts_of_chart(linear, settings.refine_poles)) {
    texts.push_back(std::move(text));
  }
  for (auto& text : texts_of_map(settings.target ? *settings.target : source,
                                 settings.target ? &source : nullptr))
    texts.push_back(std::move(text));
  if (settings.target) texts.emplace_back("sphparam:for", settings.target->name());
  if (settings.from) texts.emplace_back("sphparam:for", source.name());
  return texts;
}

std::string about_file(const PlannedImage& image) {
  const bool is_moved = image.field.is_far() && image.field.proper_channels() > 1 &&
                        is_integer(image.file.sample_type);
  return image.field.about + (is_moved ? "; less " + origin_text(image.field) : "");
}

/// Of colours that stand for values `beyond` is NaN: their values are not counted.
BakedImage told(const PlannedImage& image, double beyond) {
  return {.field = image.field.name,
          .about = about_file(image),
          .path = image.request.path,
          .sample_type = image.file.sample_type,
          .channels = image.field.channels,
          .range = range_in_file(image.field, image.file.sample_type),
          .beyond = image.field.scale ? std::numeric_limits<double>::quiet_NaN() : beyond};
}

/// None: none are wanted, or there are none.
std::shared_ptr<const CalmWalls> walls_of(const BakeScene& scene, const BakeSettings& settings) {
  if (!settings.from || !(settings.calm_beyond > 0)) return nullptr;
  return CalmWalls::find(scene, settings.calm_beyond);
}

BakedField told(const SurfaceField& field, const BakeScene& scene) {
  return {field.name, field.about, field.channels, rounding_line(field, scene)};
}

}  // namespace

BakeReport bake(const MappedMesh& source, const std::vector<BakeRequest>& images,
                const BakeSettings& settings, PendingFiles& files) {
  require_bakeable(images, settings);
  require_surface(settings);
  ChosenTarget chosen = choose_target(source, settings);
  BakeReport report{
      .images = {}, .target_distance = chosen.distance, .warnings = std::move(chosen.warnings)};
  for (std::string& warning : doubts_about(source, fields_of(images), settings))
    report.warnings.push_back(std::move(warning));
  const bool with_textures =
      std::ranges::any_of(images, [](const auto& image) { return needs_textures(image.field); });
  BakeScene scene = scene_for(source, std::move(chosen.target), with_textures, settings);
  for (std::string& warning : warnings_of(scene.source.textures))
    report.warnings.push_back(std::move(warning));
  report_projection(scene, settings, report);
  if (with_textures && settings.texture.empty()) {
    for (std::string& warning : one_material(scene.source.file()).warnings)
      report.warnings.push_back(std::move(warning));
    add_line(report, left_behind_line(source, scene.source.file(), settings));
  }
  if (with_textures) add_line(report, unplaced_line(scene.source));
  add_line(report, crowded_height_line(scene, images, settings));
  scene.walls = walls_of(scene, settings);
  if (scene.walls) report.wall_share = scene.walls->area_share();
  std::vector<PlannedImage> plan;
  for (const BakeRequest& request : images) plan.push_back(plan_image(request, scene, settings));
  for (PlannedImage& image : plan) CalmWalls::calm(scene.walls, image.field);
  for (std::string& warning : warnings_of(plan, scene, settings))
    report.warnings.push_back(std::move(warning));
  find_ranges(plan, scene, settings);
  const std::vector<double> beyond =
      write_images(plan, scene, settings, texts_of_all(source, settings), files);
  for (const PlannedImage& image : plan) add_line(report, remark_of(image.field));
  for (size_t i = 0; i < plan.size(); ++i) report.images.push_back(told(plan[i], beyond[i]));
  add_sidecars(plan, source, scene, settings, files, report);
  return report;
}

BakeReport bake(const MappedMesh& source, const std::vector<BakeRequest>& images,
                const BakeSettings& settings) {
  PendingFiles files;
  BakeReport report = bake(source, images, settings, files);
  files.publish();
  return report;
}

std::vector<BakedField> bake_values(const MappedMesh& source, const std::vector<std::string>& names,
                                    const BakeSettings& settings, const BakedRows& rows) {
  std::vector<BakeRequest> none;
  require_bakeable(none, settings);
  require_surface(settings);
  BakeScene scene = scene_for(source, choose_target(source, settings).target,
                              std::ranges::any_of(names, needs_textures), settings);
  std::vector<SurfaceField> fields;
  std::vector<BakedField> baked;
  scene.walls = walls_of(scene, settings);
  for (const std::string& name : names) {
    fields.push_back(make_covered_field(name, scene));
    CalmWalls::calm(scene.walls, fields.back());
    baked.push_back(told(fields.back(), scene));
  }
  if (fields.empty()) return baked;
  bake(scene, fields, engine_options(settings, "bake"),
       [&](size_t field, int first_row, int count, const float* values) {
         if (!fields[field].is_far()) return rows(field, baked[field], first_row, count, values);
         std::vector<float> moved(
             values, values + std::ptrdiff_t{count} * settings.width * fields[field].channels);
         add_origin(fields[field], moved);
         rows(field, baked[field], first_row, count, moved.data());
       });
  return baked;
}

}  // namespace sphparam
