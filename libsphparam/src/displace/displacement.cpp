// Row by row: directions, where they are on the mesh and on the base, the normal's way from one to
// the other. Every run of rows starts anew, so that none depends on who did those above it.

#include "displace/displacement.h"

#include <numbers>
#include <span>
#include <vector>

#include "displace/base_normals.h"
#include "displace/filled_rows.h"
#include "displace/place_rows.h"
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
    PlaceFinder patches(base_);
    PlaceRows places(patches);
    LineTable normals(on_mesh.size());
    std::vector<NormalLines::Crossing> crossings(on_mesh.size());
    Tally tally;
    for (std::int64_t row = first; row < last; ++row) {
      const double phi = std::numbers::pi * (static_cast<double>(row) + 0.5) / options_.height;
      directions.leftCols(2) = elementary::sin(phi) * around_;
      directions.col(2).setConstant(elementary::cos(phi));
      locator_.locate_all(directions, std::span(on_mesh), 1);
      places.find_next(directions);
      find_normals(places.places(), patches, normals);
      lines_.find_all(normals, on_mesh, crossings);
      for (size_t c = 0; c < on_mesh.size(); ++c) tally.inexact += !places.exact(c);
      tally.store(crossings, image.pixel(0, static_cast<int>(row)));
    }
    return tally;
  }

 private:
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
