// First each texel finds its triangle, in the order of triangles, so that overlaps are seen. Then
// rows are painted in parallel: weights in the triangle → direction on the sphere → image. Last,
// the colours run over the charts' borders. All in linear light.

#include "paint/paint_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/raster.h"
#include "io/attributes/source_attributes.h"
#include "paint/padding.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

constexpr double least_inside = 1e-9;    // least weight of a centre inside: others are on an edge
constexpr double most_repetitions = 8;   // across one triangle
constexpr std::int64_t grain = 8;        // rows
constexpr std::int64_t slice_size = 64;  // rows between two reports
constexpr std::int64_t samples_at_once = std::int64_t{1} << 22;  // looked at between two reports

/// A triangle's corners in texels, x to the right, y downwards, moved by whole images so that it
/// begins in the first one.
struct AtlasTriangle {
  std::array<Vector3, 3> corners;
  Eigen::Vector2d far;

  AtlasTriangle(const CornerTexcoords& texcoords, Face f, int size) {
    Eigen::Matrix<double, 3, 2> st = texcoords.middleRows<3>(3 * static_cast<Eigen::Index>(f));
    st.col(1) = 1 - st.col(1).array();
    const Eigen::RowVector2d origin = st.colwise().minCoeff().array().floor();
    st.rowwise() -= origin;
    far = st.colwise().maxCoeff();
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<size_t>(k)] = {st(k, 0) * size, st(k, 1) * size, 0};
    }
  }

  /// The first row of its box, and how many columns that has.
  int top() const {
    return static_cast<int>(std::min({corners[0].y(), corners[1].y(), corners[2].y()}));
  }
  std::int64_t width() const {
    const auto [least, most] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x()});
    return static_cast<std::int64_t>(most - least) + 1;
  }

  double area() const {
    return std::abs((corners[1] - corners[0]).cross(corners[2] - corners[0]).z()) / 2;
  }
};

class AtlasPainter {
 public:
  AtlasPainter(const MeshFile& file, CornerTexcoords texcoords, const SphereMap& map,
               const EquirectangularImage& image, const AtlasOptions& options)
      : file_(file), texcoords_(std::move(texcoords)), map_(map), image_(image), options_(options) {
    result_.image = Image(options.size, options.size, 4);
    const size_t texels = result_.image.pixels.size() / 4;
    owners_.assign(texels, -1);
    inside_.assign(texels, 0);
  }

  PaintedAtlas paint() {
    for (Face f = 0; f < file_.mesh.face_count(); ++f) claim(f);
    if (result_.painted == 0) {
      throw AtlasError("the texture coordinates hold no texel's centre: they have no area, or " +
                       std::to_string(options_.size) + " texels are too few");
    }
    for (std::int64_t row = 0; row < options_.size; row += slice_size) {
      report(options_.progress, "painting the atlas", static_cast<double>(row) / options_.size);
      const std::int64_t rows = std::min<std::int64_t>(slice_size, options_.size - row);
      parallel_for(rows, grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t y = row + first; y < row + last; ++y) paint_row(static_cast<int>(y));
      });
    }
    std::vector<std::uint8_t> painted(owners_.size());
    std::ranges::transform(owners_, painted.begin(), [](Face f) { return f >= 0; });
    pad(result_.image, painted, options_.padding);
    to_srgb();
    return std::move(result_);
  }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(options_.size) + static_cast<size_t>(x);
  }

  AtlasTriangle triangle(Face f) const { return AtlasTriangle(texcoords_, f, options_.size); }

  /// Texels that nobody has; those in a triangle already are overlaps, if inside both. Boxes of
  /// triangles are looked at in bands of rows.
  void claim(Face f) {
    const AtlasTriangle t = triangle(f);
    if (!(t.far.array() <= most_repetitions).all()) {
      throw AtlasError("triangle " + std::to_string(f) +
                       ": its texture coordinates run over more than 8 repetitions of the image");
    }
    const int right = static_cast<int>(std::ceil(t.far.x() * options_.size));
    const int bottom = static_cast<int>(std::ceil(t.far.y() * options_.size));
    const int rows = static_cast<int>(1 + samples_at_once / t.width());
    for (int row = t.top(), next = 0; row < bottom; row = next) {
      next = std::min(bottom, row + rows);
      report_samples((next - row) * t.width());
      for_each_sample(t.corners[0], t.corners[1], t.corners[2], 0, row, right, next,
                      [&](int x, int y, const Eigen::Vector3d& weights) {
                        claim_texel(f, index(x % options_.size, y % options_.size),
                                    weights.minCoeff() > least_inside);
                      });
    }
  }

  void report_samples(std::int64_t count) {
    samples_ += count;
    if (samples_ < samples_at_once) return;
    samples_ = 0;
    report(options_.progress, "painting the atlas", 0);
  }

  void claim_texel(Face f, size_t texel, bool inside) {
    if (owners_[texel] < 0) {
      owners_[texel] = f;
      ++result_.painted;
    } else if (inside && inside_[texel] == 1) {
      if (result_.overlapping++ == 0) result_.rivals = {owners_[texel], f};
      inside_[texel] = 2;  // counted
    }
    if (inside && owners_[texel] == f && inside_[texel] == 0) inside_[texel] = 1;
  }

  void paint_row(int y) {
    for (int x = 0; x < options_.size;) {
      const Face f = owners_[index(x, y)];
      int end = x + 1;
      while (end < options_.size && owners_[index(end, y)] == f) ++end;
      if (f >= 0) paint_run(f, x, end, y);
      x = end;
    }
  }

  void paint_run(Face f, int first, int last, int y) {
    const AtlasTriangle t = triangle(f);
    const ScreenTriangle screen(t.corners[0], t.corners[1], t.corners[2]);
    Eigen::Matrix3d rays;  // columns
    for (int k = 0; k < 3; ++k) rays.col(k) = map_.point(file_.mesh.triangles(f, k));
    const double on_sphere =
        (rays.col(1) - rays.col(0)).cross(rays.col(2) - rays.col(0)).norm() / 2;
    const double width = std::sqrt(on_sphere / t.area());
    for (int x = first; x < last; ++x) {
      const std::array<float, 4> colour = image_.look_up(rays * weights_at(t, screen, x, y), width);
      std::ranges::copy(colour, result_.image.pixel(x, y));
    }
  }

  /// Of the texel's centre, in whichever repetition the triangle holds it.
  Eigen::Vector3d weights_at(const AtlasTriangle& t, const ScreenTriangle& screen, int x,
                             int y) const {
    for (int j = 0; j < t.far.y(); ++j) {
      for (int i = 0; i < t.far.x(); ++i) {
        const Eigen::Vector3d weights =
            screen.barycentric(x + i * options_.size + 0.5, y + j * options_.size + 0.5);
        if (weights.minCoeff() >= 0) return weights;
      }
    }
    return Eigen::Vector3d::Constant(1.0 / 3);
  }

  void to_srgb() {
    const SrgbCurves& curves = SrgbCurves::get();
    std::vector<float>& values = result_.image.pixels;
    for (size_t i = 0; i < values.size(); ++i) {
      if (i % 4 != 3) values[i] = curves.to_srgb(values[i]);
    }
  }

  const MeshFile& file_;
  CornerTexcoords texcoords_;
  const SphereMap& map_;
  const EquirectangularImage& image_;
  const AtlasOptions& options_;
  PaintedAtlas result_;
  std::vector<Face> owners_;          // of each texel; −1: none
  std::vector<std::uint8_t> inside_;  // its centre lies inside the owner, 2: and in another
  std::int64_t samples_ = 0;          // looked at since the last report
};

}  // namespace

PaintedAtlas paint_atlas(const MeshFile& file, const SphereMap& map,
                         const EquirectangularImage& image, const AtlasOptions& options) {
  std::optional<CornerTexcoords> texcoords = texcoords_of(file);
  if (!texcoords) {
    throw AtlasError("the mesh has no texture coordinates of its own to paint for");
  }
  return AtlasPainter(file, std::move(*texcoords), map, image, options).paint();
}

}  // namespace sphparam
