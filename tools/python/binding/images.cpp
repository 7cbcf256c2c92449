// Images on meshes: painted, drawn.

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "sphparam/io/body_longitudes.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/paint/paint.h"
#include "sphparam/render/picture.h"
#include "sphparam/texture/equirectangular_image.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam::python {
namespace {

/// What looks wrong with an image on a map.
std::vector<std::string> doubts_about(const std::string& path, const EquirectangularImage& image,
                                      const MappedMesh& mesh, Convention convention, int threads) {
  std::vector<std::string> lines = {warning_of_shape(path, image.width(), image.height()),
                                    image.warning(), warning_of_map(path, image, mesh)};
  if (convention == Convention::Gis) {
    const Vector3 centre = body_centre(planetocentric(mesh.provenance()), std::nullopt);
    lines.push_back(longitudes_off(mesh, centre, true, threads));
  }
  std::erase(lines, "");
  return lines;
}

/// Red, green, blue and perhaps alpha of each vertex, 0 to 255; and warnings.
py::tuple paint(const Mapped& mapped, const FilePath& path, const std::string& convention,
                int threads, const py::object& progress) {
  const Convention longitude = convention_of(convention);
  const auto [channels,
              warnings] = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    const EquirectangularImage image = read_equirectangular(path, longitude, threads);
    const MeshFile painted = paint_vertices(mesh, image, {.threads = threads, .progress = report});
    std::vector<std::vector<double>> found;
    for (const char* name : {"red", "green", "blue", "alpha"}) {
      if (const Property* channel = painted.find_vertex_property(name);
          channel && (found.size() < 3 || image.has_alpha()))
        found.push_back(channel->values);
    }
    return std::pair(std::move(found), doubts_about(path, image, mesh, longitude, threads));
  });
  const std::size_t count = channels.front().size();
  std::vector<std::uint8_t> colours;
  for (std::size_t v = 0; v < count; ++v)
    for (const auto& channel : channels) colours.push_back(static_cast<std::uint8_t>(channel[v]));
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count),
                                       static_cast<py::ssize_t>(channels.size())};
  return py::make_tuple(owning(std::move(colours), shape), as_texts(warnings));
}

py::tuple paint_texture(const Mapped& mapped, const FilePath& path, const std::string& convention,
                        int size, int padding, int threads, const py::object& progress) {
  const Convention longitude = convention_of(convention);
  auto [atlas, warnings] = call(progress, [=, mesh = mapped.mesh()](const Progress& report) {
    const EquirectangularImage image = read_equirectangular(path, longitude, threads);
    PaintedAtlas painted = paint_atlas(
        mesh, image, {.size = size, .padding = padding, .threads = threads, .progress = report});
    std::vector<std::string> told = doubts_about(path, image, mesh, longitude, threads);
    if (std::string line = overlap_warning(painted, mesh.file()); !line.empty())
      told.push_back(std::move(line));
    return std::pair(std::move(painted.image), std::move(told));
  });
  const std::vector<py::ssize_t> shape{atlas.height, atlas.width, atlas.channels};
  return py::make_tuple(owning(std::move(atlas.pixels), shape), as_texts(warnings));
}

/// What is drawn, and the image for the mesh's texture coordinates; empty: its own.
struct Drawing {
  DrawingOptions options;
  std::string texture;

  bool shows_own() const { return options.colouring == Colouring::Own && options.scalar.empty(); }
};

Drawing drawing_of(const py::dict& values) {
  Drawing drawing;
  DrawingOptions& made = drawing.options;
  Settings settings(values);
  made.view = View::Both;
  settings
      .take("view", made.view,
            {{"mesh", View::Mesh}, {"sphere", View::Sphere}, {"both", View::Both}})
      .take("colours", made.colouring,
            {{"own", Colouring::Own},
             {"plain", Colouring::Plain},
             {"normals", Colouring::Normals},
             {"checker", Colouring::Checker},
             {"area", Colouring::Area},
             {"angle", Colouring::Angle}})
      .take_path("texture", drawing.texture)
      .take("scalar", made.scalar)
      .take("range", made.range)
      .take("size", made.size)
      .take("wireframe", made.wireframe)
      .take("graticule", made.graticule)
      .take("occlusion", made.occlusion)
      .take("legend", made.legend)
      .take("transparent", made.transparent)
      .take("threads", made.threads);
  std::optional<std::array<double, 3>> from;
  std::string up, front;
  settings.take("eye", from).take("up", up).take("front", front);
  if (from) made.from = Vector3((*from)[0], (*from)[1], (*from)[2]);
  made.up = up_of(up, front);
  settings.require_all_known();
  return drawing;
}

std::string drawn(const MappedMesh& mesh, const DrawingOptions& options) {
  const UprightAxes axes = upright_axes(mesh.file(), options.up);
  if (!map_is_upright(mesh.provenance(), axes)) return draw_png(mesh.file(), mesh.map(), options);
  // As from a file, which says so.
  return draw_png(attach_map(mesh.file(), mesh.map(), mesh.provenance()), mesh.map(), options);
}

/// The textures that are shown; returns what stands against those of the mesh's file.
std::string take_shown_textures(Drawing& drawing, const MappedMesh& mesh) try {
  ShownTextures shown =
      shown_textures(mesh.file(), mesh.name(), drawing.texture, drawing.options.threads);
  drawing.options.textures = std::move(shown.textures);
  return shown.warning + (shown.left_behind ? "; texture=IMAGE names it" : "");
} catch (const NoTexcoords& error) {
  throw std::invalid_argument(std::string("texture: ") + error.what());
}

/// The bytes of a PNG, and warnings.
py::tuple draw(const Mapped& mapped, const py::dict& values) {
  const Drawing wanted = drawing_of(values);
  const auto [png, told] = call(py::none(), [wanted, mesh = mapped.mesh()](const Progress&) {
    Drawing drawing = wanted;
    std::vector<std::string> warnings;
    if (drawing.shows_own()) warnings.push_back(take_shown_textures(drawing, mesh));
    std::erase(warnings, "");
    return std::pair(drawn(mesh, drawing.options), std::move(warnings));
  });
  return py::make_tuple(py::bytes(png), as_texts(told));
}

}  // namespace

Convention convention_of(const std::string& name) {
  if (const auto convention = convention_named(name)) return *convention;
  std::string known;
  for (const ConventionInfo& info : all_conventions())
    known += (known.empty() ? "'" : ", '") + std::string(info.name) + "'";
  throw py::value_error("convention: no '" + name + "' among " + known);
}

Up up_of(const std::string& up, const std::string& front) {
  const Up wanted{direction_named(up), direction_named(front)};
  if ((!up.empty() && !wanted.direction) || (!front.empty() && !wanted.front))
    throw py::value_error("up, front: " + up + " " + front + " are no directions");
  if (!wanted.direction) return wanted;
  try {
    upright_axes({}, wanted);
  } catch (const FrontError& error) {
    throw py::value_error(error.what());
  }
  return wanted;
}

void declare_images(py::module_& module) {
  module.def("turns_of", [](const std::string& convention) {
    const ConventionInfo& info = info_of(convention_of(convention));
    return py::make_tuple(info.turns, info.offset);
  });
  module.def("paint", paint);
  module.def("paint_texture", paint_texture);
  module.def("draw", draw);
}

}  // namespace sphparam::python
