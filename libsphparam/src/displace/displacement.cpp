// Row by row: directions, where they are on the mesh and on the base, the normal's way from one to
// the other. Every run of rows starts anew, so that none depends on who did those above it.

#include "displace/displacement.h"

#include <numbers>
#include <vector>

#include "displace/filled_rows.h"
#include "displace/place_rows.h"
#include "elementary.h"

namespace sphparam {

namespace {

class Rows {
 public:
  Rows(const DirectedBase& base, const TriangleMesh& mesh, const Topology& topology,
       const SphereLocator& locator, const DisplacementOptions& options)
      : options_(options), locator_(locator), lines_(mesh, topology), finders_(base) {
    for (int c = 0; c < options.width; ++c) {
      const double theta = 2 * std::numbers::pi * (c + 0.5) / options.width;
      cosines_.push_back(elementary::cos(theta));
      sines_.push_back(elementary::sin(theta));
    }
  }

  Tally fill(std::int64_t first, std::int64_t last, Image& image) const {
    const size_t width = cosines_.size();
    DirectionTable directions(width);
    PointTable on_mesh(width);
    LineTable normals(width);
    std::vector<NormalLines::Crossing> crossings(width);
    const FinderPool::Lent patches = finders_.lend();
    PlaceRows places(*patches);
    Tally tally;
    for (std::int64_t row = first; row < last; ++row) {
      find_directions(row, directions);
      locator_.locate(directions, on_mesh);
      places.find_next(directions, normals);
      lines_.find_all(normals, on_mesh, crossings);
      for (size_t c = 0; c < width; ++c) tally.inexact += !places.exact(c);
      tally.store(crossings, image.pixel(0, static_cast<int>(row)));
    }
    return tally;
  }

 private:
  void find_directions(std::int64_t row, DirectionTable& directions) const {
    const double phi = std::numbers::pi * (static_cast<double>(row) + 0.5) / options_.height,
                 sine = elementary::sin(phi), cosine = elementary::cos(phi);
    for (size_t c = 0; c < directions.count; ++c) {
      directions.x[0][c] = sine * cosines_[c];
      directions.x[1][c] = sine * sines_[c];
      directions.x[2][c] = cosine;
    }
  }

  const DisplacementOptions& options_;
  RowLocator locator_;
  NormalLines lines_;
  FinderPool finders_;
  std::vector<double> cosines_, sines_;  // of the columns
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
