// Row by row: directions, where they are on the mesh and on the base, the normal's way from one to
// the other. Every row starts anew, so that none depends on who did the row above.

#include "displace/displacement.h"

#include <numbers>
#include <span>
#include <vector>

#include "displace/filled_rows.h"
#include "elementary.h"

namespace sphparam {

namespace {

class Rows {
 public:
  Rows(const DirectedBase& base, const TriangleMesh& mesh, const Topology& topology,
       const SphereLocator& locator, const DisplacementOptions& options)
      : base_(base), options_(options), locator_(locator), lines_(mesh, topology) {
    around_.resize(options.width, 2);
    for (int c = 0; c < options.width; ++c) {
      const double theta = 2 * std::numbers::pi * (c + 0.5) / options.width;
      around_.row(c) << elementary::cos(theta), elementary::sin(theta);
    }
  }

  Tally fill(std::int64_t first, std::int64_t last, Image& image) const {
    Points directions(options_.width, 3);
    std::vector<SurfacePoint> on_mesh(static_cast<size_t>(options_.width));
    PlaceFinder finder(base_);
    Tally tally;
    for (std::int64_t row = first; row < last; ++row) {
      const double phi = std::numbers::pi * (static_cast<double>(row) + 0.5) / options_.height;
      directions.leftCols(2) = elementary::sin(phi) * around_;
      directions.col(2).setConstant(elementary::cos(phi));
      locator_.locate_all(directions, std::span(on_mesh), 1);
      finder.start_anew();
      float* pixel = image.pixel(0, static_cast<int>(row));
      for (int c = 0; c < options_.width; ++c)
        *pixel++ =
            stored(measure(finder.find(directions.row(c)), on_mesh[static_cast<size_t>(c)], tally));
    }
    return tally;
  }

 private:
  double measure(const PlaceFinder::Found& found, const SurfacePoint& on_mesh, Tally& tally) const {
    tally.inexact += !found.exact;
    return tally.height(lines_, found.patch->surface.evaluate(found.place.s, found.place.t),
                        on_mesh);
  }

  const DirectedBase& base_;
  const DisplacementOptions& options_;
  const SphereLocator& locator_;
  NormalLines lines_;
  Eigen::Matrix<double, Eigen::Dynamic, 2> around_;
};

}  // namespace

Displacement make_displacement(const DirectedBase& base, const TriangleMesh& mesh,
                               const Topology& topology, const SphereLocator& locator,
                               const DisplacementOptions& options) {
  const Rows rows(base, mesh, topology, locator, options);
  return filled_rows(options.width, options.height, options,
                     [&](std::int64_t first, std::int64_t last, Image& image) {
                       return rows.fill(first, last, image);
                     });
}

}  // namespace sphparam
