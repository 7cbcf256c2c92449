#include "io/formats/three_mf/three_mf_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/files/non_finite_advice.h"

namespace sphparam {

void ThreeMfSurface::require_room(std::size_t vertices, std::size_t triangles) const {
  constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
  const auto require = [&](std::size_t count, std::int64_t limit, const char* what) {
    const std::int64_t most = std::min(limit, hard_limit);
    if (count > static_cast<std::size_t>(most))
      throw ReadError(name_, std::string("has more ") + what +
                                 ", all objects placed, than the limit of " + std::to_string(most));
  };
  require(vertices, options_.max_vertices, "vertices");
  require(triangles, options_.max_faces, "triangles");
}

void ThreeMfSurface::append(const ThreeMfObject& object, const ThreeMfGroups& groups,
                            const ThreeMfPlace& place, int item) {
  require_room((positions_.size() + object.positions.size()) / 3,
               item_of_.size() + object.paint.size());
  const auto before = static_cast<int>(positions_.size() / 3);
  for (std::size_t i = 0; i < object.positions.size(); i += 3) {
    const Eigen::RowVector3d given = Eigen::Map<const Eigen::RowVector3d>(&object.positions[i]);
    const Eigen::RowVector3d placed = given * place.topRows<3>() + place.row(3);
    if (!options_.non_finite && !placed.allFinite())
      throw ReadError(
          name_, "a coordinate is not a finite number where it is placed" + non_finite_advice());
    positions_.insert(positions_.end(), placed.begin(), placed.end());
  }
  const bool is_mirrored = place.topRows<3>().determinant() < 0;
  const std::array<std::size_t, 3> order = {0, is_mirrored ? 2U : 1U, is_mirrored ? 1U : 2U};
  for (std::size_t f = 0; f < object.paint.size(); ++f) {
    ThreeMfPaint paint = object.paint[f];
    for (const std::size_t k : order) triangles_.push_back(before + object.triangles[3 * f + k]);
    if (is_mirrored) std::swap(paint.index[1], paint.index[2]);
    colours_.add(paint, groups, name_);
    item_of_.push_back(item);
  }
}

void ThreeMfSurface::attach_to(MeshFile& file) const {
  const auto rows = [](const auto& numbers) {
    return static_cast<Eigen::Index>(numbers.size() / 3);
  };
  file.mesh.positions = Eigen::Map<const Points>(positions_.data(), rows(positions_), 3);
  file.mesh.triangles = Eigen::Map<const Triangles>(triangles_.data(), rows(triangles_), 3);
  if (!item_of_.empty() && item_of_.front() != item_of_.back())
    file.set_face_property({"object", ScalarType::Int32, {item_of_.begin(), item_of_.end()}});
  colours_.attach_to(file);
}

}  // namespace sphparam
