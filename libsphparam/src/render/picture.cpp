// A mesh and its sphere in the same colours and from the same side.

#include "sphparam/render/picture.h"

#include <stdexcept>
#include <tuple>
#include <utility>

#include "image/image_codec.h"
#include "io/attributes/shading_normals.h"
#include "option_domain.h"
#include "render/added_outline.h"
#include "render/drawing_size.h"
#include "render/figure.h"
#include "render/geodesic.h"
#include "render/heat.h"
#include "render/own_paint.h"
#include "render/render.h"
#include "render/value_paint.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/upright_frame.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/io/written_map.h"
#include "sphparam/sphere/distortion.h"
#include "texture/source_texture.h"

namespace sphparam {

namespace {

constexpr double margin = 1.06;                    // of the picture around what is drawn
constexpr int least_size = 16, most_size = 16384;  // pixels

/// What a colouring measures, where it measures something.
std::optional<Heat> heat_of(Colouring colouring) {
  if (colouring == Colouring::Area) return Heat::Area;
  if (colouring == Colouring::Angle) return Heat::Angle;
  return std::nullopt;
}

/// Where the eye is: as asked for, or in front, to the right and above, whatever axis is up.
Vector3 eye(const DrawingOptions& options, const UprightAxes& axes) {
  return options.from.value_or(axes.right() + 0.45 * axes.up + 0.6 * axes.front);
}

void require_domain(const DrawingOptions& options) {
  if (options.view) require_one_of("view", *options.view, View::Both);
  require_one_of("colouring", options.colouring, Colouring::Angle);
  require_between("size", options.size, least_size, most_size);
  require_at_least("height", options.height, 0);
  if (const auto& range = options.range; range && !(range->first < range->second))
    throw std::invalid_argument("range: its first number must be the smaller one");
  if (!options.from) return;
  for (const double coordinate : *options.from) require_finite("from", coordinate);
  if (options.from->isZero(0)) throw std::invalid_argument("from: 0, 0, 0 is no direction");
}

/// Looks at the middle of what is seen from a unit direction, all of it in the picture.
Camera framed(const Points& points, const Vector3& from, const Vector3& up) {
  Camera camera;
  camera.direction = from;
  camera.up = up;
  if (camera.up.cross(camera.direction).isZero())
    throw std::invalid_argument("this is the direction that is up");
  const Vector3 right = camera.up.cross(camera.direction).normalized();
  const Vector3 above = camera.direction.cross(right);
  Eigen::Matrix3d axes;  // columns
  axes << right, above, camera.direction;
  const Points seen = points * axes;
  const Vector3 lower = seen.colwise().minCoeff(), upper = seen.colwise().maxCoeff();
  camera.target = axes * (lower + upper) / 2;
  camera.height = margin * (upper - lower).head<2>().maxCoeff();
  return camera;
}

/// Of a sphere with any radius.
SphereMap directions_of(const MeshSource& source, const std::string& sphere,
                        const ReadOptions& options, std::string& warning) {
  WrittenMap written = read_map_of(source, sphere, options);
  for (Eigen::Index v = 0; v < written.map.points.rows(); ++v) {
    if (!written.map.points.row(v).isZero(0)) continue;
    const long number = FileNumbers(written.file).number(static_cast<Vertex>(v));
    throw ReadError(display_name(sphere),
                    "vertex " + std::to_string(number) + " is at the centre, in no direction");
  }
  warning = roundness_warning(written.map);
  if (!warning.empty()) warning = display_name(sphere) + ": " + warning;
  return unit_rays(std::move(written.map));
}

enum class Shape { Mesh, Sphere };

/// What is drawn of a mesh with fillers: its surface. On the sphere fillers have a colour of their
/// own, so that nobody looks inside.
struct Shown {
  MeshFile file;
  std::optional<SphereMap> map;
  std::optional<TriangleMesh> fillers;  // on the sphere
};

Shown shown_surface(const MeshFile& file, const std::optional<SphereMap>& map,
                    const FillerMarks& fillers) {
  Shown shown{map ? without_fillers(attach_map(file, *map, {})) : without_fillers(file),
              std::nullopt, std::nullopt};
  // None is left; their mark may be the number that is to be seen.
  mark_fillers(shown.file, FillerMarks(static_cast<size_t>(shown.file.mesh.face_count()), 0));
  if (!map) return shown;
  shown.map = read_sphere(shown.file);
  FillerMarks surface;
  for (const unsigned char mark : fillers) surface.push_back(mark ? 0 : 1);
  shown.fillers = surface_of({normalised(map->points).points, file.mesh.triangles}, surface);
  return shown;
}

class Drawing {
 public:
  Drawing(const MeshFile& file, const std::optional<SphereMap>& map, const DrawingOptions& options,
          const TriangleMesh* fillers)
      : file_(file),
        map_(map),
        options_(options),
        fillers_(fillers),
        axes_(upright_axes(file, options.up)) {}

  Image image() const {
    std::optional<HeatScale> scale = scale_of_colouring();
    Paint paint;
    if (options_.scalar.empty()) {
      paint = make_paint();
    } else {
      std::tie(paint, scale) = paint_of_numbers();
    }
    const auto drawn = [&](Shape shape) { return draw(shape, paint); };
    const View view = options_.view.value_or(map_ ? View::Both : View::Mesh);
    Image image = view == View::Mesh     ? drawn(Shape::Mesh)
                  : view == View::Sphere ? drawn(Shape::Sphere)
                                         : in_a_row({drawn(Shape::Mesh), drawn(Shape::Sphere)});
    if (scale && options_.legend && !options_.transparent) return with_legend(image, *scale);
    return image;
  }

 private:
  std::optional<HeatScale> scale_of_colouring() const {
    const std::optional<Heat> heat = heat_of(options_.colouring);
    return heat ? std::optional(heat_scale(*heat)) : std::nullopt;
  }

  /// Of vertices, else of faces.
  std::pair<Paint, std::optional<HeatScale>> paint_of_numbers() const {
    if (file_.find_vertex_property(options_.scalar)) {
      ValuePaint values = value_paint(file_, options_.scalar, options_.range);
      return {std::move(values.paint), std::move(values.scale)};
    }
    FaceValuePaint values = face_value_paint(file_, options_.scalar, options_.range);
    return {std::move(values.paint), std::move(values.scale)};
  }

  Paint make_paint() const {
    switch (options_.colouring) {
      case Colouring::Own:
        return own_paint(file_, options_.textures ? *options_.textures : MeshTextures{});
      case Colouring::Plain:
        return UniformPaint{};
      case Colouring::Normals:
        return direction_paint(file_);
      case Colouring::Checker:
        return CheckerPaint{.rays = map_.value().points};
      case Colouring::Area:
      case Colouring::Angle:
        return heat_paint(*heat_of(options_.colouring),
                          measure_distortion(file_.mesh, map_.value(), options_.threads));
    }
    return UniformPaint{};
  }

  Image draw(Shape shape, const Paint& paint) const {
    std::vector<RenderObject> objects = {drawn(shape, paint)};
    const Camera camera = framing(shape, objects.front().mesh.positions);
    if (shape == Shape::Sphere && fillers_) objects.push_back(filler_object());
    return render({.objects = std::move(objects),
                   .camera = camera,
                   .width = options_.size,
                   .height = options_.size,
                   .background = options_.transparent ? std::nullopt : RenderScene{}.background},
                  options_.threads);
  }

  RenderObject filler_object() const {
    return {.mesh = *fillers_,
            .normals = fillers_->positions,
            .paint = UniformPaint{{0.30F, 0.30F, 0.32F}}};
  }

  RenderObject drawn(Shape shape, const Paint& paint) const {
    RenderObject object = {.mesh = file_.mesh, .normals = shading_normals(file_), .paint = paint};
    object.corner_normals = corner_shading_normals(file_, *object.normals);
    object.occlusion = options_.occlusion;
    if (options_.wireframe) object.wireframe = Wireframe{};
    if (options_.repairs) object.wireframe = added_outline(file_);
    if (options_.graticule) object.graticule = Graticule{.rays = map_.value().points};
    if (shape == Shape::Sphere) object = on_sphere(object, normalised(map_.value().points).points);
    return object;
  }

  Camera framing(Shape shape, const Points& points) const {
    const Vector3 from = eye(options_, axes_).normalized();
    if (shape == Shape::Sphere) return framed(points, beside_the_sphere(from), Vector3::UnitZ());
    Camera camera = framed(points, from, axes_.up);
    if (options_.height > 0) camera.height = options_.height;
    return camera;
  }

  /// North is up on the sphere: it is seen from where the mesh is once its axis has been turned to
  /// z, and what is in front of it to θ = 0 where the map says so.
  Vector3 beside_the_sphere(const Vector3& from) const {
    const Vector3 seen = upright_rotation(axes_) * from;  // right, up, front
    return map_is_upright(file_, axes_) ? Vector3(seen.z(), seen.x(), seen.y())
                                        : Vector3(seen.x(), -seen.z(), seen.y());
  }

  const MeshFile& file_;
  const std::optional<SphereMap>& map_;
  const DrawingOptions& options_;
  const TriangleMesh* const fillers_;  // on the sphere; null: there are none
  const UprightAxes axes_;
};

}  // namespace

DrawnMesh load_drawn(const std::string& path, const std::string& sphere,
                     const ReadOptions& options) {
  if (!sphere.empty()) return drawn_mesh(read_source(path, options), sphere, options);
  MeshSource source;
  source.path = path;
  source.file = read_mesh(path, options);
  keep_companions(source.file);
  return drawn_mesh(std::move(source));
}

DrawnMesh drawn_mesh(MeshSource source, const std::string& sphere, const ReadOptions& options) {
  if (source.file.mesh.face_count() == 0)
    throw ReadError(display_name(source.path), "there are no triangles to draw");
  DrawnMesh drawn;
  drawn.map = sphere.empty() ? read_sphere(source.file)
                             : directions_of(source, sphere, options, drawn.warning);
  drawn.file = std::move(source.file);
  drawn.file.mesh = at_drawing_size(std::move(drawn.file.mesh));
  return drawn;
}

bool draws_without_map(const DrawingOptions& options) {
  return options.view.value_or(View::Mesh) == View::Mesh && !options.graticule &&
         options.colouring != Colouring::Checker && !heat_of(options.colouring);
}

double height_to_see(const MeshFile& file, const DrawingOptions& options) {
  require_domain(options);
  const UprightAxes axes = upright_axes(file, options.up);
  const Vector3 from = eye(options, axes).normalized();
  return framed(without_fillers(file).mesh.positions, from, axes.up).height;
}

std::string draw_png(const MeshFile& file, const std::optional<SphereMap>& map,
                     const DrawingOptions& options) {
  require_domain(options);
  if (!map && !draws_without_map(options)) throw std::invalid_argument("this needs a map");
  if (!options.scalar.empty() && !file.find_vertex_property(options.scalar) &&
      !file.find_face_property(options.scalar))
    throw std::invalid_argument("the mesh has no property '" + options.scalar + "'");
  const FillerMarks fillers = fillers_of(file);
  std::optional<Shown> shown;
  if (!fillers.empty()) shown = shown_surface(file, map, fillers);
  const Image image =
      shown ? Drawing(shown->file, shown->map, options, shown->fillers ? &*shown->fillers : nullptr)
                  .image()
            : Drawing(file, map, options, nullptr).image();
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  return {png.begin(), png.end()};
}

}  // namespace sphparam
