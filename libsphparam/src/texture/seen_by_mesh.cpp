#include "texture/seen_by_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "io/attributes/appearance.h"
#include "sphparam/parallel.h"
#include "texture/wrapped.h"

namespace sphparam {
namespace {

constexpr double most_images = 2;  // that a triangle reaches across
constexpr double most_looks = 64;  // at a texel, in the mean
constexpr double most_texels_away = 1e9;
constexpr std::int64_t grain = 1024;  // faces

using Corners = SeenTexels::Corners;

double length_of(const Corners& corners, size_t axis) {
  const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
  return high - low;
}

/// Where a face looks.
struct Looks {
  const CornerTexcoords* texcoords;
  TexturePlacement placement;
  TextureWrap wrap_s, wrap_t;

  Corners corners(Face f, int width, int height) const {
    Corners result;
    for (int k = 0; k < 3; ++k) {
      const double s = (*texcoords)(3 * f + k, 0), t = (*texcoords)(3 * f + k, 1);
      const auto along = [&](size_t axis) {
        return placement[axis][0] * s + placement[axis][1] * t + placement[axis][2];
      };
      result[static_cast<size_t>(k)] = {width * along(0), height * (1 - along(1))};
    }
    return moved_near(result, width, height);
  }

 private:
  /// To the same texels, such that their numbers are small.
  Corners moved_near(Corners corners, int width, int height) const {
    const double x = corners[0][0] - width * near_zero(corners[0][0] / width, wrap_s),
                 y = corners[0][1] - height * near_zero(corners[0][1] / height, wrap_t);
    for (auto& corner : corners) {
      corner[0] -= x;
      corner[1] -= y;
    }
    return corners;
  }
};

bool is_near(const Corners& corners) {
  return std::ranges::all_of(corners, [](const auto& corner) {
    return std::abs(corner[0]) < most_texels_away && std::abs(corner[1]) < most_texels_away;
  });
}

/// What each face looks at, a list of looks a material; faces without a material have none.
class Lookers {
 public:
  /// `material`: of each face; null: the first of all.
  Lookers(Eigen::Index faces, const Property* material, std::vector<std::vector<Looks>> of_material)
      : faces_(static_cast<Face>(faces)),
        material_(material),
        of_material_(std::move(of_material)) {}

  SeenTexels seen(int width, int height, int threads) const {
    if (!(texels_looked_at(width, height) < most_looks * width * height)) return {};
    SeenTexels seen(width, height);
    parallel_for(faces_, grain, threads, [&](std::int64_t first, std::int64_t last) {
      for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
        for (const Looks& looks : looks_of(f)) {
          const Corners corners = looks.corners(f, width, height);
          if (is_near(corners)) seen.add(corners, looks.wrap_s, looks.wrap_t);
        }
      }
    });
    return seen;
  }

 private:
  const std::vector<Looks>& looks_of(Face f) const {
    static const std::vector<Looks> none;
    const double id = material_ ? material_->values[static_cast<size_t>(f)] : 0;
    const bool known = id >= 0 && id < static_cast<double>(of_material_.size());
    return known ? of_material_[static_cast<size_t>(id)] : none;
  }

  /// At most; infinite where a triangle reaches across several images.
  double texels_looked_at(int width, int height) const {
    double sum = 0;
    for (Face f = 0; f < faces_; ++f) {
      for (const Looks& looks : looks_of(f)) {
        const Corners corners = looks.corners(f, width, height);
        const double x = length_of(corners, 0), y = length_of(corners, 1);
        if (x > most_images * width || y > most_images * height)
          return std::numeric_limits<double>::infinity();
        if (is_near(corners)) sum += (x + 2) * (y + 2);
      }
    }
    return sum;
  }

  Face faces_;
  const Property* material_;
  std::vector<std::vector<Looks>> of_material_;
};

}  // namespace

SeenTexels seen_texels(const MeshFile& file, const ImageOrigin& image, int width, int height,
                       int threads) {
  const std::optional<CornerTexcoords> first = texcoords_of(file);
  std::vector<std::vector<Looks>> of_material(
      std::max(file.base_colours.size(), file.channels.size()));
  bool known = true;
  const auto look = [&](size_t material, const MaterialTexture& texture) {
    if (texture.image.empty() || origin_of(texture) != image) return;
    const auto& texcoords = texture.second ? file.second_texcoords : first;
    known = known && texcoords.has_value();
    if (!known) return;
    of_material[material].push_back(
        {&*texcoords, texture.placement, wrap_of(texture.wrap_s), wrap_of(texture.wrap_t)});
  };
  for (size_t i = 0; i < file.base_colours.size(); ++i) look(i, file.base_colours[i]);
  for (size_t i = 0; i < file.channels.size(); ++i)
    for (const MaterialTexture* texture : file.channels[i].textures()) look(i, *texture);
  if (!known) return {};
  const Lookers lookers(file.mesh.face_count(), file.find_face_property("material"),
                        std::move(of_material));
  return lookers.seen(width, height, threads);
}

SeenTexels seen_texels(const MeshFile& file, TextureWrap wrap, int width, int height, int threads) {
  const std::optional<CornerTexcoords> texcoords = texcoords_of(file);
  if (!texcoords) return {};
  const Looks looks{&*texcoords, MaterialTexture().placement, wrap, wrap};
  return Lookers(file.mesh.face_count(), nullptr, {{looks}}).seen(width, height, threads);
}

}  // namespace sphparam
