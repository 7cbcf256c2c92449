// Row by row: directions, where they are on the mesh and on the base, the normal's way from one to
// the other. Every row starts anew, so that none depends on who did the row above.

#include "displace/displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "displace/normal_line.h"
#include "elementary.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t rows_at_once = 16;   // of a thread
constexpr std::int64_t rows_between = 256;  // looks whether to go on

/// What became of some rows.
struct Tally {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  std::int64_t hits[3] = {}, inexact = 0;

  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  void add(const Tally& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
    for (int i = 0; i < 3; ++i) hits[i] += other.hits[i];
    inexact += other.inexact;
  }
};

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
      constexpr double most = std::numeric_limits<float>::max();
      for (int c = 0; c < options_.width; ++c) {
        const double height =
            measure(finder.find(directions.row(c)), on_mesh[static_cast<size_t>(c)], tally);
        tally.add(height);
        *pixel++ = static_cast<float>(std::clamp(height, -most, most));  // `greatest` tells of it
      }
    }
    return tally;
  }

 private:
  double measure(const PlaceFinder::Found& found, const SurfacePoint& on_mesh, Tally& tally) const {
    tally.inexact += !found.exact;
    const LimitPoint point = found.patch->surface.evaluate(found.place.s, found.place.t);
    const NormalLines::Crossing crossing = lines_.find(point.position, point.normal(), on_mesh);
    ++tally.hits[static_cast<int>(crossing.hit)];
    return crossing.height;
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
  Displacement result;
  result.image = Image(options.width, options.height, 1);
  const Rows rows(base, mesh, topology, locator, options);
  Tally all;
  for (std::int64_t first = 0; first < options.height; first += rows_between) {
    report(options.progress, "displacement", static_cast<double>(first) / options.height);
    const std::int64_t count = std::min<std::int64_t>(rows_between, options.height - first);
    std::vector<Tally> tallies(static_cast<size_t>((count + rows_at_once - 1) / rows_at_once));
    parallel_for(count, rows_at_once, options.threads, [&](std::int64_t from, std::int64_t to) {
      tallies[static_cast<size_t>(from / rows_at_once)] =
          rows.fill(first + from, first + to, result.image);
    });
    for (const Tally& tally : tallies) all.add(tally);
  }
  result.figures.least = all.least;
  result.figures.greatest = all.greatest;
  result.figures.walked = all.hits[static_cast<int>(LineHit::Walk)];
  result.figures.cast = all.hits[static_cast<int>(LineHit::Ray)];
  result.figures.missed = all.hits[static_cast<int>(LineHit::Near)];
  result.figures.inexact = all.inexact;
  return result;
}

}  // namespace sphparam
