// Fields of a surface, baked into arrays or files.

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/bake/bake.h"
#include "sphparam/bake/bake_warnings.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/planetocentric.h"

namespace sphparam::python {
namespace {

/// The body whose surface it is, and the directions of its longitudes.
void take_body(Settings& settings, FieldOptions& fields) {
  std::string body;
  double unit = 1;
  std::optional<std::array<double, 3>> centre;
  settings.take("positive_west", fields.positive_west)
      .take("body", body)
      .take("unit", unit)
      .take("centre", centre);
  if (centre) fields.centre = Vector3(centre->data());
  if (body.empty()) return;
  fields.body = body_of(body, unit);
  fields.body->positive_west |= fields.positive_west;
}

void take_fields(Settings& settings, FieldOptions& fields) {
  take_body(settings, fields);
  settings.take("normal_y_down", fields.normal_y_down)
      .take("height_radial", fields.height_radial)
      .take("heat", fields.heat)
      .take("rays", fields.rays)
      .take("max_ray_distance", fields.max_ray_distance)
      .take("range", fields.scalar_range)
      .take("filter", fields.filter,
            {{"nearest", TextureFilter::Nearest},
             {"bilinear", TextureFilter::Bilinear},
             {"bicubic", TextureFilter::Bicubic}});
}

BakeSettings bake_settings(const py::dict& values) {
  BakeSettings made;
  Settings settings(values);
  settings.take("size", made.width)
      .take("samples", made.samples)
      .take_path("texture", made.texture)
      .take("refine_poles", made.refine_poles)
      .take("mip", made.mip)
      .take("threads", made.threads)
      .take("interpolation", made.interpolation,
            {{"uv", Interpolation::Uv}, {"sphere", Interpolation::Sphere}})
      .take("wrap", made.wrap,
            {{"repeat", TextureWrap::Repeat},
             {"mirror", TextureWrap::Mirror},
             {"clamp", TextureWrap::Clamp}});
  take_fields(settings, made.fields);
  std::string convention = info_of(made.convention).name, depth;
  settings.take("convention", convention).take("depth", depth);
  made.convention = convention_of(convention);
  if (!depth.empty()) {
    made.depth = chosen(
        depth,
        by_name({SampleType::Uint8, SampleType::Uint16, SampleType::Half, SampleType::Float}),
        "depth");
  }
  const Mapped* target = nullptr;
  settings.take("target", target);
  if (target) made.target = target->mesh();
  const Source* surface = nullptr;
  settings.take("surface", surface);
  if (surface) {
    made.from = surface->mesh.file;
    made.source_name = surface->mesh.path;
  }
  settings.require_all_known();
  return made;
}

/// A field as numbers, and what they are.
struct BakedArray {
  BakedField field;
  std::vector<float> values;
};

std::vector<BakedArray> bake_arrays(const MappedMesh& source,
                                    const std::vector<std::string>& fields,
                                    const BakeSettings& settings) {
  std::vector<BakedArray> baked(fields.size());
  const auto width = static_cast<std::size_t>(settings.width), height = width / 2;
  bake_values(source, fields, settings,
              [&](std::size_t index, const BakedField& field, int first_row, int rows,
                  const float* values) {
                BakedArray& array = baked[index];
                const std::size_t row = width * static_cast<std::size_t>(field.channels);
                if (array.values.empty()) array = {field, std::vector<float>(row * height)};
                const std::vector<float> turned = in_convention(settings.convention, settings.width,
                                                                field.channels, rows, values);
                std::copy(turned.begin(), turned.end(),
                          array.values.begin() + static_cast<std::ptrdiff_t>(row) * first_row);
              });
  return baked;
}

/// That longitudes of images for geographers are not the body's.
std::string longitude_line(const MappedMesh& source, const BakeSettings& settings) {
  if (settings.convention != Convention::Gis) return "";
  const Vector3 centre = body_centre(planetocentric(source.provenance()), settings.fields.centre);
  return longitudes_off(source, centre, !settings.fields.body, settings.threads);
}

std::vector<std::string> warnings_of_arrays(const MappedMesh& source,
                                            const std::vector<std::string>& fields,
                                            const BakeSettings& settings) {
  std::vector<std::string> lines = bake_warnings(source, fields, settings);
  lines.insert(lines.begin(), longitude_line(source, settings));
  std::erase(lines, "");
  return lines;
}

/// Of each field name, what it is, and numbers; last what there is to warn of.
py::list bake_to_arrays(const Mapped& mapped, const std::vector<std::string>& fields,
                        const py::dict& values, const py::object& progress) {
  BakeSettings settings = bake_settings(values);
  const int width = settings.width;
  auto [baked, warnings] =
      call(progress, [=, mesh = mapped.mesh()](const Progress& report) mutable {
        settings.progress = report;
        return std::pair(bake_arrays(mesh, fields, settings),
                         warnings_of_arrays(mesh, fields, settings));
      });
  py::list list;
  for (BakedArray& array : baked) {
    const int channels = array.field.channels;
    list.append(py::make_tuple(array.field.name, array.field.about,
                               owning(std::move(array.values), {width / 2, width, channels}),
                               array.field.rounding));
  }
  list.append(as_texts(warnings));
  return list;
}

py::list bake_to_files(const Mapped& mapped,
                       const std::vector<std::pair<std::string, FilePath>>& images,
                       const py::dict& values, const py::object& progress) {
  BakeSettings settings = bake_settings(values);
  std::vector<BakeRequest> requests;
  for (const auto& [field, path] : images) requests.push_back({field, path});
  const BakeReport report =
      writing_call(progress, [=, mesh = mapped.mesh()](const Progress& told) mutable {
        settings.progress = told;
        BakeReport made = bake(mesh, requests, settings);
        made.warnings.insert(made.warnings.begin(), longitude_line(mesh, settings));
        std::erase(made.warnings, "");
        return made;
      });
  py::list list;
  for (const BakedImage& image : report.images) {
    const auto beyond = std::isnan(image.beyond) ? std::nullopt : std::optional(image.beyond);
    list.append(py::make_tuple(image.field, image.about, FilePath(image.path),
                               name_of(image.sample_type), image.channels, image.range,
                               FilePath(image.sidecar), beyond));
  }
  list.append(as_texts(report.warnings));
  return list;
}

}  // namespace

void declare_bakes(py::module_& module) {
  module.def("bake_to_arrays", bake_to_arrays);
  module.def("bake_to_files", bake_to_files);
  module.def("fields", [] {
    py::list list;
    for (const FieldInfo& field : all_fields())
      list.append(py::make_tuple(field.name, field.about));
    return list;
  });
}

}  // namespace sphparam::python
