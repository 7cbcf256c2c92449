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
      : base_(base), lattice_(lattice), locator_(locator), lines_(lines) {}

  Tally fill(std::int64_t first, std::int64_t last, Image& image) const {
    const auto width = static_cast<size_t>(image.width);
    std::vector<LimitPlace> places(width);
    Points directions(image.width, 3);
    std::vector<SurfacePoint> on_mesh(width);
    LineTable normals(width);
    std::vector<NormalLines::Crossing> crossings(width);
    PlaceFinder patches(base_);
    Tally tally;
    for (auto row = static_cast<int>(first); row < static_cast<int>(last); ++row) {
      for (int c = 0; c < image.width; ++c)
        places[static_cast<size_t>(c)] = base_.on_patches(lattice_.place(c, row));
      find_normals(places, patches, normals);
      directions_at(places, patches, directions);
      locator_.locate_all(directions, std::span(on_mesh), 1);
      lines_.find_all(normals, on_mesh, crossings);
      tally.store(crossings, image.pixel(0, row));
    }
    return tally;
  }

 private:
  static void directions_at(std::span<const LimitPlace> places, PlaceFinder& patches,
                            Points& directions) {
    LimitPoints points;
    for_each_run(places, [&](const LimitRun& run) {
      patches.patch(places[run.first].patch).direction.evaluate(run.s, run.t, run.count, points);
      for (size_t i = 0; i < run.count; ++i) {
        directions.row(static_cast<Eigen::Index>(run.first + i)) = points[i].position.normalized();
      }
    });
  }

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
