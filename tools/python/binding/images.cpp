// Images: baked into arrays or files, painted, drawn.

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/bake/bake.h"
#include "sphparam/paint/paint.h"
#include "sphparam/render/picture.h"
#include "sphparam/texture/convention.h"
#include "sphparam/texture/equirectangular_image.h"

namespace sphparam::python {
namespace {

Convention convention_of(const std::string& name) {
  if (const auto convention = convention_named(name)) return *convention;
  std::string known;
  for (const ConventionInfo& info : all_conventions())
    known += (known.empty() ? "'" : ", '") + std::string(info.name) + "'";
  throw py::value_error("convention: no '" + name + "' among " + known);
}

const char* word_of(Interpolation interpolation) {
  return interpolation == Interpolation::Uv ? "uv" : "sphere";
}

const char* word_of(TextureFilter filter) {
  switch (filter) {
    case TextureFilter::Nearest:
      return "nearest";
    case TextureFilter::Bilinear:
      return "bilinear";
    case TextureFilter::Bicubic:
      break;
  }
  return "bicubic";
}

void take_fields(Settings& settings, FieldOptions& fields) {
  settings.take("normal_y_down", fields.normal_y_down)
      .take("height_radial", fields.height_radial)
      .take("heat", fields.heat)
      .take("rays", fields.rays)
      .take("max_ray_distance", fields.max_ray_distance)
      .take("filter", fields.filter,
            {TextureFilter::Nearest, TextureFilter::Bilinear, TextureFilter::Bicubic},
            [](TextureFilter filter) { return word_of(filter); });
}

BakeSettings bake_settings(const py::dict& values) {
  BakeSettings made;
  Settings settings(values);
  settings.take("size", made.width)
      .take("samples", made.samples)
      .take("texture", made.texture)
      .take("refine_poles", made.refine_poles)
      .take("mip", made.mip)
      .take("threads", made.threads)
      .take("interpolation", made.interpolation, {Interpolation::Uv, Interpolation::Sphere},
            [](Interpolation interpolation) { return word_of(interpolation); });
  take_fields(settings, made.fields);
  std::string convention = info_of(made.convention).name, depth;
  settings.take("convention", convention).take("depth", depth);
  made.convention = convention_of(convention);
  if (!depth.empty()) {
    made.depth = named(
        depth, {SampleType::Uint8, SampleType::Uint16, SampleType::Half, SampleType::Float},
        [](SampleType type) { return name_of(type); }, "depth");
  }
  const Mapped* target = nullptr;
  settings.take("target", target);
  if (target) made.target = target->mesh();
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

py::list bake_to_arrays(const Mapped& mapped, const std::vector<std::string>& fields,
                        const py::dict& values, const py::object& progress) {
  BakeSettings settings = bake_settings(values);
  const int width = settings.width;
  std::vector<BakedArray> baked =
      call(progress, [=, mesh = mapped.mesh()](const Progress& report) mutable {
        settings.progress = report;
        return bake_arrays(mesh, fields, settings);
      });
  py::list list;
  for (BakedArray& array : baked) {
    const int channels = array.field.channels;
    list.append(py::make_tuple(array.field.name, array.field.about,
                               owning(std::move(array.values), {width / 2, width, channels})));
  }
  return list;
}

py::list bake_to_files(const Mapped& mapped,
                       const std::vector<std::pair<std::string, std::string>>& images,
                       const py::dict& values, const py::object& progress) {
  BakeSettings settings = bake_settings(values);
  std::vector<BakeRequest> requests;
  for (const auto& [field, path] : images) requests.push_back({field, path});
  const BakeReport report =
      writing_call(progress, [=, mesh = mapped.mesh()](const Progress& told) mutable {
        settings.progress = told;
        return bake(mesh, requests, settings);
      });
  py::list list;
  for (const BakedImage& image : report.images)
    list.append(py::make_tuple(image.field, image.about, image.path, name_of(image.sample_type),
                               image.channels, image.range));
  list.append(report.warnings);
  return list;
}

/// Red, green, blue and perhaps alpha of each vertex, 0 to 255.
py::array paint(const Mapped& mapped, const std::string& path, const std::string& convention,
                int threads, const py::object& progress) {
  const Convention longitude = convention_of(convention);
  std::vector<std::vector<double>> channels =
      call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
        const EquirectangularImage image = read_equirectangular(path, longitude, threads);
        const MeshFile painted =
            paint_vertices(mesh, image, {.threads = threads, .progress = report});
        std::vector<std::vector<double>> found;
        for (const char* name : {"red", "green", "blue", "alpha"}) {
          if (const Property* channel = painted.find_vertex_property(name);
              channel && (found.size() < 3 || image.has_alpha()))
            found.push_back(channel->values);
        }
        return found;
      });
  const std::size_t count = channels.front().size();
  std::vector<std::uint8_t> colours;
  for (std::size_t v = 0; v < count; ++v)
    for (const auto& channel : channels) colours.push_back(static_cast<std::uint8_t>(channel[v]));
  return owning(std::move(colours),
                {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(channels.size())});
}

py::tuple paint_texture(const Mapped& mapped, const std::string& path,
                        const std::string& convention, int size, int padding, int threads,
                        const py::object& progress) {
  const Convention longitude = convention_of(convention);
  auto [atlas, warning] = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    const EquirectangularImage image = read_equirectangular(path, longitude, threads);
    PaintedAtlas painted = paint_atlas(
        mesh, image, {.size = size, .padding = padding, .threads = threads, .progress = report});
    std::string told = overlap_warning(painted, mesh.file());
    return std::pair(std::move(painted.image), std::move(told));
  });
  const std::vector<py::ssize_t> shape{atlas.height, atlas.width, atlas.channels};
  return py::make_tuple(owning(std::move(atlas.pixels), shape), warning);
}

const char* word_of(View view) {
  return view == View::Mesh ? "mesh" : view == View::Sphere ? "sphere" : "both";
}

const char* word_of(Colouring colouring) {
  switch (colouring) {
    case Colouring::Own:
      return "own";
    case Colouring::Plain:
      return "plain";
    case Colouring::Normals:
      return "normals";
    case Colouring::Checker:
      return "checker";
    case Colouring::Area:
      return "area";
    case Colouring::Angle:
      break;
  }
  return "angle";
}

DrawingOptions drawing_options(const py::dict& values) {
  DrawingOptions made;
  Settings settings(values);
  View view = View::Both;
  settings.take("view", view, {View::Mesh, View::Sphere, View::Both},
                [](View word) { return word_of(word); });
  made.view = view;
  settings
      .take("colours", made.colouring,
            {Colouring::Own, Colouring::Plain, Colouring::Normals, Colouring::Checker,
             Colouring::Area, Colouring::Angle},
            [](Colouring word) { return word_of(word); })
      .take("size", made.size)
      .take("wireframe", made.wireframe)
      .take("graticule", made.graticule)
      .take("occlusion", made.occlusion)
      .take("legend", made.legend)
      .take("threads", made.threads);
  std::optional<std::array<double, 3>> from;
  std::string up;
  settings.take("eye", from).take("up", up);
  if (from) made.from = Vector3((*from)[0], (*from)[1], (*from)[2]);
  if (!up.empty()) made.up = up == "y" ? Up::Y : Up::Z;
  settings.require_all_known();
  return made;
}

/// The bytes of a PNG.
py::bytes draw(const Mapped& mapped, const py::dict& values) {
  const DrawingOptions options = drawing_options(values);
  return call(py::none(), [=, mesh = mapped.mesh()](const Progress&) {
    return draw_png(mesh.file(), mesh.map(), options);
  });
}

}  // namespace

void declare_images(py::module_& module) {
  module.def("bake_to_arrays", bake_to_arrays);
  module.def("bake_to_files", bake_to_files);
  module.def("paint", paint);
  module.def("paint_texture", paint_texture);
  module.def("draw", draw);
  module.def("fields", [] {
    py::list list;
    for (const FieldInfo& field : all_fields())
      list.append(py::make_tuple(field.name, field.about));
    return list;
  });
}

}  // namespace sphparam::python
