// healpix:NSIDE: the 12·NSIDE² pixel centres in RING order, and the mesh they span: a face for each
// point where pixels meet, four of them but at eight points, where three do.
// Source: Górski et al., "HEALPix: a framework for high-resolution discretization and fast
// analysis of data distributed on the sphere" (2005), Section 5.
//
// Rings i = 1 … 4N − 1 from the north. In the caps ring i has 4i pixels at 1 − z = i²/3N², in the
// belt 4N at z = 4/3 − 2i/3N, every other ring turned by half a pixel. The faces come from the
// other view of the same pixels: 12 base squares of N×N, x to the north-east and y to the
// north-west, so that each lies on ring (k + 2)N − x − y − 1 for row k = 0, 1, 2 of base squares.

#include <cmath>
#include <numbers>

#include "elementary.h"
#include "remesh/grids/grid_family.h"

namespace sphparam {

namespace {

struct Pixel {
  int base, x, y;
};

class Rings {
 public:
  explicit Rings(int n) : n_(n) {}

  int last() const { return 4 * n_ - 1; }
  bool in_north_cap(int ring) const { return ring < n_; }
  bool in_south_cap(int ring) const { return ring > 3 * n_; }

  /// Pixels of a ring, over four.
  int quarter(int ring) const {
    return in_north_cap(ring) ? ring : in_south_cap(ring) ? 4 * n_ - ring : n_;
  }
  int first(int ring) const {
    if (in_north_cap(ring)) return 2 * ring * (ring - 1);
    if (in_south_cap(ring)) return 12 * n_ * n_ - 2 * (4 * n_ - ring) * (4 * n_ - ring + 1);
    return 2 * n_ * (n_ - 1) + 4 * n_ * (ring - n_);
  }
  /// Does the ring's first pixel lie at half a pixel's longitude, or at zero?
  bool half(int ring) const {
    return in_north_cap(ring) || in_south_cap(ring) || (ring - n_) % 2 == 0;
  }

  int number(const Pixel& pixel) const {
    const int row = pixel.base / 4, column = pixel.base % 4;
    const int ring = (row + 2) * n_ - pixel.x - pixel.y - 1, q = quarter(ring);
    // Longitude in half pixels: the base square's middle, and x − y from there.
    const int middle = 2 * column + (row != 1);
    const int place = middle * q + pixel.x - pixel.y - (half(ring) ? 1 : 0);
    return first(ring) + (place / 2 + 4 * q) % (4 * q);
  }

  Points centres() const {
    Points points(12 * n_ * n_, 3);
    for (int ring = 1; ring <= last(); ++ring) {
      const int q = quarter(ring);
      const bool cap = in_north_cap(ring) || in_south_cap(ring);
      const double from_pole = q * static_cast<double>(q) / (3.0 * n_ * n_);  // 1 − |z| in a cap
      const double z =
          cap ? std::copysign(1 - from_pole, 2 * n_ - ring) : (2 * n_ - ring) * 2.0 / (3.0 * n_);
      const double radius = std::sqrt(cap ? from_pole * (2 - from_pole) : 1 - z * z);
      for (int j = 0; j < 4 * q; ++j) {
        const double longitude = std::numbers::pi / (2 * q) * (j + (half(ring) ? 0.5 : 0.0));
        points.row(first(ring) + j) =
            Vector3(radius * elementary::cos(longitude), radius * elementary::sin(longitude), z);
      }
    }
    return points;
  }

 private:
  int n_;
};

class Faces {
 public:
  explicit Faces(int n) : n_(n), rings_(n) {}

  Polygons all() {
    for (int base = 0; base < 12; ++base) inside(base);
    for (int i = 0; i < 4; ++i) {
      seams(i);
      corners(i);
    }
    const int top = n_ - 1;
    add({{0, top, top}, {1, top, top}, {2, top, top}, {3, top, top}});
    add({{11, 0, 0}, {10, 0, 0}, {9, 0, 0}, {8, 0, 0}});
    return std::move(faces_);
  }

 private:
  void add(std::initializer_list<Pixel> pixels) {
    for (const Pixel& pixel : pixels) faces_.corners.push_back(rings_.number(pixel));
    faces_.starts.push_back(static_cast<int>(faces_.corners.size()));
  }

  void inside(int b) {
    for (int y = 1; y < n_; ++y) {
      for (int x = 1; x < n_; ++x)
        add({{b, x - 1, y - 1}, {b, x, y - 1}, {b, x, y}, {b, x - 1, y}});
    }
  }

  /// Between base squares: north i, and the south one below it, with their neighbours.
  void seams(int i) {
    const int top = n_ - 1, east = (i + 1) % 4;
    const int belt = 4 + i, belt_east = 4 + east, south = 8 + i, south_east = 8 + east;
    for (int t = 1; t < n_; ++t) {
      const int s = t - 1;
      add({{i, top, s}, {east, s, top}, {east, t, top}, {i, top, t}});
      add({{belt, top, s}, {i, 0, s}, {i, 0, t}, {belt, top, t}});
      add({{belt_east, s, top}, {belt_east, t, top}, {i, t, 0}, {i, s, 0}});
      add({{south, top, s}, {belt_east, 0, s}, {belt_east, 0, t}, {south, top, t}});
      add({{south, s, top}, {south, t, top}, {belt, t, 0}, {belt, s, 0}});
      add({{south_east, 0, s}, {south_east, 0, t}, {south, t, 0}, {south, s, 0}});
    }
  }

  /// Where base squares meet: four on the equator, three at the ends of the belt's.
  void corners(int i) {
    const int top = n_ - 1, west = (i + 3) % 4;
    add({{i, 0, 0}, {4 + i, top, 0}, {8 + i, top, top}, {4 + (i + 1) % 4, 0, top}});
    add({{4 + i, top, top}, {i, 0, top}, {west, top, 0}});
    add({{4 + i, 0, 0}, {8 + west, top, 0}, {8 + i, 0, top}});
  }

  int n_;
  Rings rings_;
  Polygons faces_;
};

std::int64_t vertices(const GridSpec& spec) { return 12 * std::int64_t{spec.size} * spec.size; }

SphereGrid make(const GridSpec& spec, const GridOptions& /*options*/) {
  SphereGrid grid;
  grid.directions = Rings(spec.size).centres();
  grid.faces = Faces(spec.size).all();
  return grid;
}

}  // namespace

const GridFamily healpix_family = {.kind = GridKind::Healpix,
                                   .prefix = "healpix:",
                                   .pattern = "healpix:NSIDE",
                                   .sizes = "from 1, as in healpix:64",
                                   .has_quads = true,
                                   .is_size = [](const GridSpec& spec) { return spec.size >= 1; },
                                   .vertex_count = vertices,
                                   .make = make};

}  // namespace sphparam
