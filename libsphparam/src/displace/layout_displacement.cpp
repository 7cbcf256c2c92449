// Row by row: the place of the base that each texel shows, its direction, where that is on the
// mesh, and the normal's way there.

#include <span>
#include <vector>

#include "displace/displacement.h"
#include "displace/filled_rows.h"

namespace sphparam {

namespace {

class Texels {
 public:
  Texels(const DirectedBase& base, const TextureLattice& lattice, const SphereLocator& locator,
         const NormalLines& lines)
      : base_(base), lattice_(lattice), locator_(locator), lines_(lines) {}

  Tally fill(std::int64_t first, std::int64_t last, Image& image) const {
    const auto width = static_cast<size_t>(image.width);
    Points directions(image.width, 3);
    std::vector<LimitPoint> on_base(width);
    std::vector<SurfacePoint> on_mesh(width);
    PlaceFinder patches(base_);
    Tally tally;
    for (auto row = static_cast<int>(first); row < static_cast<int>(last); ++row) {
      for (int c = 0; c < image.width; ++c) {
        const LimitPlace place = base_.on_patches(lattice_.place(c, row));
        const DirectedPatch& patch = patches.patch(place.patch);
        on_base[static_cast<size_t>(c)] = patch.surface.evaluate(place.s, place.t);
        directions.row(c) = patch.direction.evaluate(place.s, place.t).position.normalized();
      }
      locator_.locate_all(directions, std::span(on_mesh), 1);
      float* pixel = image.pixel(0, row);
      for (size_t c = 0; c < width; ++c)
        *pixel++ = stored(tally.height(lines_, on_base[c], on_mesh[c]));
    }
    return tally;
  }

 private:
  const DirectedBase& base_;
  const TextureLattice& lattice_;
  const SphereLocator& locator_;
  const NormalLines& lines_;
};

}  // namespace

Displacement make_displacement(const DirectedBase& base, const TextureLattice& lattice,
                               const TriangleMesh& mesh, const Topology& topology,
                               const SphereLocator& locator, const DisplacementOptions& options) {
  const NormalLines lines(mesh, topology);
  const Texels texels(base, lattice, locator, lines);
  return filled_rows(lattice.layout().width, lattice.layout().height, options,
                     [&](std::int64_t first, std::int64_t last, Image& image) {
                       return texels.fill(first, last, image);
                     });
}

}  // namespace sphparam
