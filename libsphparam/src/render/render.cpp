#include "render/render.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "elementary.h"
#include "image/raster.h"
#include "mesh/vertex_normals.h"
#include "render/surface_colour.h"
#include "sphparam/parallel.h"

// Corners are projected once; triangles are sorted into tiles of the picture; each tile finds the
// nearest triangle of every sample (depth buffer), colours the samples, and averages them in linear
// light. Tiles are independent, so threads change nothing.

namespace sphparam {
namespace {

constexpr int tile_size = 32;  // pixels

/// World to samples: x, y from the upper left, z grows towards the eye and is linear on the screen.
class Projection {
 public:
  Projection(const Camera& camera, int width, int height, int samples)
      : target_(camera.target), half_(0.5 * samples * width, 0.5 * samples * height) {
    const Vector3 back = camera.direction.normalized();
    const Vector3 right = camera.up.cross(back).normalized();
    axes_ << right.transpose(), back.cross(right).transpose(), back.transpose();
    scale_ = samples * height / camera.height;
    if (camera.field_of_view > 0) {
      const double half_angle = camera.field_of_view * std::numbers::pi / 360;
      distance_ = 0.5 * camera.height / elementary::tan(half_angle);
    }
  }

  /// The screen point and 1/w, w the distance from the eye (1 where there is no perspective).
  std::pair<Vector3, double> operator()(const Vector3& point) const {
    const Vector3 p = axes_ * (point - target_);
    const double w = distance_ > 0 ? 1 - p.z() / distance_ : 1;
    // Behind the eye: such triangles are not drawn.
    if (w < 1e-3) return {Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), 1};
    return {{half_.x() + scale_ * p.x() / w, half_.y() - scale_ * p.y() / w,
             distance_ > 0 ? 1 / w : p.z()},
            1 / w};
  }

  /// Directions of the world as the camera sees them: right, up, towards the eye.
  Eigen::Matrix3d axes() const { return axes_; }

 private:
  Vector3 target_;
  Eigen::Vector2d half_;
  Eigen::Matrix3d axes_;
  double scale_;
  double distance_ = 0;
};

/// A mesh ready to be drawn.
struct Drawable {
  const RenderObject* object;
  Points screen;      // #V×3
  VectorX inverse_w;  // #V
  SurfaceColour colour;

  Vector3 corner(Face f, int k) const { return screen.row(object->mesh.triangles(f, k)); }
};

Drawable prepare(const RenderObject& object, const Projection& projection, int pixels,
                 int threads) {
  const Eigen::Index vertices = object.mesh.vertex_count();
  Drawable d{&object, Points(vertices, 3), VectorX(vertices),
             SurfaceColour(object, projection.axes(), pixels, threads)};
  for (Eigen::Index v = 0; v < vertices; ++v) {
    const auto [point, inverse_w] = projection(object.mesh.positions.row(v));
    d.screen.row(v) = point;
    d.inverse_w[v] = inverse_w;
  }
  return d;
}

struct TriangleRef {
  int object;
  Face face;
};

/// Which triangles touch which tile, in drawing order.
class TileLists {
 public:
  TileLists(const std::vector<Drawable>& drawables, int columns, int rows, int tile_samples)
      : columns_(columns),
        rows_(rows),
        size_(tile_samples),
        lists_(static_cast<size_t>(columns * rows)) {
    for (size_t i = 0; i < drawables.size(); ++i) {
      for (Eigen::Index f = 0; f < drawables[i].object->mesh.face_count(); ++f) {
        add(drawables[i], {static_cast<int>(i), static_cast<Face>(f)});
      }
    }
  }

  const std::vector<TriangleRef>& operator[](std::int64_t tile) const {
    return lists_[static_cast<size_t>(tile)];
  }

 private:
  void add(const Drawable& drawable, TriangleRef ref) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = drawable.corner(ref.face, k);
    if (!corners.allFinite()) return;
    const Vector3 low = corners.rowwise().minCoeff() / size_;
    const Vector3 high = corners.rowwise().maxCoeff() / size_;
    const auto clamped = [](double x, int count) {
      return static_cast<int>(std::clamp(std::floor(x), 0.0, count - 1.0));
    };
    if (high.x() < 0 || high.y() < 0 || low.x() > columns_ || low.y() > rows_) return;
    for (int y = clamped(low.y(), rows_); y <= clamped(high.y(), rows_); ++y) {
      for (int x = clamped(low.x(), columns_); x <= clamped(high.x(), columns_); ++x) {
        lists_[static_cast<size_t>(y * columns_ + x)].push_back(ref);
      }
    }
  }

  int columns_, rows_, size_;
  std::vector<std::vector<TriangleRef>> lists_;
};

/// Colours one sample of a triangle.
Rgb sample_colour(const Drawable& drawable, Face face, double x, double y, int samples) {
  const ScreenTriangle triangle(drawable.corner(face, 0), drawable.corner(face, 1),
                                drawable.corner(face, 2));
  Eigen::Vector3d inverse_w;
  for (int k = 0; k < 3; ++k) {
    inverse_w[k] = drawable.inverse_w[drawable.object->mesh.triangles(face, k)];
  }
  // Barycentric coordinates are linear on the screen before, in the triangle after division by w.
  const auto weights = [&](double px, double py) -> Eigen::Vector3d {
    const Eigen::Vector3d b = triangle.barycentric(px, py).cwiseProduct(inverse_w);
    return b / b.sum();
  };
  ShadedSample sample;
  sample.face = face;
  sample.weights = weights(x, y);
  sample.weights_right = weights(x + samples, y);
  sample.weights_below = weights(x, y + samples);
  for (int k = 0; k < 3; ++k) {
    const double slope = elementary::hypot(triangle.dx[k], triangle.dy[k]) * samples;
    sample.edge_distance[k] = triangle.barycentric(x, y)[k] / slope;
    sample.altitude[k] = 1 / slope;
  }
  const Vector3 a = drawable.corner(face, 0);
  const Vector3 ab = drawable.corner(face, 1) - a, ac = drawable.corner(face, 2) - a;
  sample.front = ab.x() * ac.y() - ab.y() * ac.x() < 0;  // y of the screen points down
  return drawable.colour(sample);
}

struct Picture {
  const RenderScene& scene;
  const std::vector<Drawable>& drawables;
  Image& image;

  /// The nearest triangle of every sample of a tile; object −1 where there is none.
  std::vector<TriangleRef> visible(const std::vector<TriangleRef>& list, int x0, int y0,
                                   int size) const {
    std::vector<double> depth(static_cast<size_t>(size * size),
                              -std::numeric_limits<double>::infinity());
    std::vector<TriangleRef> nearest(depth.size(), {-1, 0});
    for (const TriangleRef& ref : list) {
      const Drawable& d = drawables[static_cast<size_t>(ref.object)];
      const Vector3 a = d.corner(ref.face, 0), b = d.corner(ref.face, 1), c = d.corner(ref.face, 2);
      const Vector3 depths(a.z(), b.z(), c.z());
      for_each_sample(a, b, c, x0, y0, x0 + size, y0 + size,
                      [&](int x, int y, const Eigen::Vector3d& weights) {
                        const auto at = static_cast<size_t>((y - y0) * size + x - x0);
                        const double z = weights.dot(depths);
                        if (z <= depth[at]) return;
                        depth[at] = z;
                        nearest[at] = ref;
                      });
    }
    return nearest;
  }

  void draw_tile(const std::vector<TriangleRef>& list, int column, int row) const {
    const int samples = scene.samples, size = tile_size * samples;
    const int x0 = column * size, y0 = row * size;
    const std::vector<TriangleRef> nearest = visible(list, x0, y0, size);
    for (int y = row * tile_size; y < std::min((row + 1) * tile_size, image.height); ++y) {
      for (int x = column * tile_size; x < std::min((column + 1) * tile_size, image.width); ++x) {
        Rgb sum = Rgb::Zero();
        int covered = 0;
        for (int k = 0; k < samples * samples; ++k) {
          const int sx = x * samples + k % samples, sy = y * samples + k / samples;
          const TriangleRef ref = nearest[static_cast<size_t>((sy - y0) * size + sx - x0)];
          if (ref.object < 0) continue;
          ++covered;
          sum += sample_colour(drawables[static_cast<size_t>(ref.object)], ref.face, sx + 0.5,
                               sy + 0.5, samples);
        }
        write_pixel(x, y, sum, covered);
      }
    }
  }

  void write_pixel(int x, int y, const Rgb& sum, int covered) const {
    const auto total = static_cast<float>(scene.samples * scene.samples);
    float* pixel = image.pixel(x, y);
    Rgb colour = Rgb::Zero();
    if (scene.background && covered == 0) {
      std::copy_n(scene.background->data(), 3, pixel);  // exactly, not by way of linear light
      return;
    }
    if (scene.background) {
      colour = (sum + (total - static_cast<float>(covered)) * to_linear(*scene.background)) / total;
    } else if (covered > 0) {
      colour = sum / static_cast<float>(covered);
    }
    const Rgb srgb = to_srgb(colour);
    std::copy_n(srgb.data(), 3, pixel);
    if (!scene.background) pixel[3] = static_cast<float>(covered) / total;
  }
};

}  // namespace

Image render(const RenderScene& scene, int threads) {
  const Projection projection(scene.camera, scene.width, scene.height, scene.samples);
  std::vector<Drawable> drawables;
  for (const RenderObject& object : scene.objects) {
    drawables.push_back(prepare(object, projection, std::max(scene.width, scene.height), threads));
  }
  const int columns = (scene.width + tile_size - 1) / tile_size,
            rows = (scene.height + tile_size - 1) / tile_size;
  const TileLists lists(drawables, columns, rows, tile_size * scene.samples);
  Image image(scene.width, scene.height, scene.background ? 3 : 4);
  const Picture picture{scene, drawables, image};
  parallel_for(static_cast<std::int64_t>(columns) * rows, 1, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t t = first; t < last; ++t) {
                   picture.draw_tile(lists[t], static_cast<int>(t % columns),
                                     static_cast<int>(t / columns));
                 }
               });
  return image;
}

}  // namespace sphparam
