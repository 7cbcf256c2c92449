// Row by row: the place of the base that each texel shows, its direction, where that is on the
// mesh, and the normal's way there.

#include <span>
#include <vector>

#include "displace/base_normals.h"
#include "displace/displacement.h"
#include "displace/filled_rows.h"
#include "remesh/subdivision/limit_runs.h"

namespace sphparam {

namespace {

class Texels {
 public:
  Texels(const DirectedBase& base, const TextureLattice& lattice, const SphereLocator& locator,
         const NormalLines& lines)
      : base_(base), lattice_(lattice), locator_(locator), lines_(lines), finders_(base) {}

  Tally fill(std::int64_t first, std::int64_t last, Image& image) const {
    const auto width = static_cast<size_t>(image.width);
    std::vector<LimitPlace> places(width);
    DirectionTable directions(width);
    PointTable on_mesh(width);
    LineTable normals(width);
    std::vector<NormalLines::Crossing> crossings(width);
    const FinderPool::Lent patches = finders_.lend();
    Tally tally;
    for (auto row = static_cast<int>(first); row < static_cast<int>(last); ++row) {
      for (int c = 0; c < image.width; ++c)
        places[static_cast<size_t>(c)] = base_.on_patches(lattice_.place(c, row));
      find_normals(places, *patches, normals);
      directions_at(places, *patches, directions);
      locator_.locate(directions, on_mesh);
      lines_.find_all(normals, on_mesh, crossings);
      tally.store(crossings, image.pixel(0, row));
    }
    return tally;
  }

 private:
  static void directions_at(std::span<const LimitPlace> places, PlaceFinder& patches,
                            DirectionTable& directions) {
    LimitPoints points;
    for_each_run(places, [&](const LimitRun& run) {
      patches.patch(places[run.first].patch).direction.evaluate(run.s, run.t, run.count, points);
      for (size_t i = 0; i < run.count; ++i) {
        const Vector3 direction = points[i].position.normalized();
        for (size_t k = 0; k < 3; ++k)
          directions.x[k][run.first + i] = direction[static_cast<int>(k)];
      }
    });
  }

  const DirectedBase& base_;
  const TextureLattice& lattice_;
  RowLocator locator_;
  const NormalLines& lines_;
  FinderPool finders_;
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
