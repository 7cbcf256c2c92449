// Names of grids, and what makes each of them.

#include "remesh/sphere_grid.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "remesh/healpix_grid.h"
#include "remesh/lattice_grid.h"
#include "remesh/subdivided_grid.h"
#include "elementary.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 8192;

struct KindInfo {
  GridKind kind;
  const char* prefix;
  const char* expected;
  int least;
};
constexpr KindInfo kinds[] = {
    {GridKind::IcosahedronCut, "ico:f=", "ico:f=N, N from 1, as in ico:f=37", 1},
    {GridKind::Icosahedron, "ico:", "ico:L, L from 0, as in ico:7", 0},
    {GridKind::Octahedron, "octa:", "octa:N, N odd and from 3, as in octa:129", 3},
    {GridKind::Cube, "cube:", "cube:N, N from 1, as in cube:64", 1},
    {GridKind::Geographic, "uv:", "uv:WxH, W from 3 and H from 2, as in uv:512x256", 3},
    {GridKind::Healpix, "healpix:", "healpix:NSIDE, from 1, as in healpix:64", 1},
};

const KindInfo& info_of(GridKind kind) {
  for (const KindInfo& info : kinds) {
    if (info.kind == kind) return info;
  }
  throw std::logic_error("an unknown kind of grid");
}

/// The whole of a text as a number that is not negative.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool all = error == std::errc{} && stop == text.data() + text.size() && value >= 0;
  return all ? std::optional(value) : std::nullopt;
}

std::optional<GridSpec> read_size(const KindInfo& info, std::string_view text) {
  GridSpec spec{info.kind, 0, 0};
  if (info.kind == GridKind::Geographic) {
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto height = whole_number(text.substr(cross + 1));
    if (!height || *height < 2) return std::nullopt;
    spec.height = *height;
    text = text.substr(0, cross);
  }
  const auto size = whole_number(text);
  if (!size || *size < info.least) return std::nullopt;
  if (info.kind == GridKind::Octahedron && *size % 2 == 0) return std::nullopt;
  spec.size = *size;
  return spec;
}

/// k where n = 2^k.
std::optional<int> exponent_of_two(int n) {
  int k = 0;
  while (n >> k > 1) ++k;
  return n == 1 << k ? std::optional(k) : std::nullopt;
}

template <class Place>
void place_all(SphereGrid& grid, int threads, const Place& place) {
  parallel_for(grid.directions.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      const Vector3 flat = grid.directions.row(v);
      grid.directions.row(v) = place(flat).normalized();
    }
  });
}

/// Of points of the flat cube: equal steps become equal angles at the middle of a side.
Vector3 equal_angles(const Vector3& flat) {
  const double half = flat.cwiseAbs().maxCoeff();
  return flat.unaryExpr([&](double x) {
    return std::abs(x) == half ? std::copysign(1.0, x)
                               : elementary::tan(std::numbers::pi / 4 * x / half);
  });
}

SphereGrid octahedral_grid(int n, const GridOptions& options) {
  const std::optional<int> levels = exponent_of_two(n);
  SphereGrid grid = levels ? subdivide(octahedron(), *levels, Placement::Flat, options)
                           : cut_triangles(octahedron(), n);
  place_all(grid, options.threads, [](const Vector3& flat) { return flat; });
  return grid;
}

SphereGrid cube_grid(int n, const GridOptions& options) {
  const std::optional<int> levels = exponent_of_two(n);
  SphereGrid grid = levels ? subdivide(cube(), *levels, Placement::Flat, options) : cut_cube(n);
  place_all(grid, options.threads, equal_angles);
  return grid;
}

}  // namespace

GridSpec parse_grid(const std::string& text) {
  for (const KindInfo& info : kinds) {
    if (!text.starts_with(info.prefix)) continue;
    const size_t prefix = std::string_view(info.prefix).size();
    const auto spec = read_size(info, std::string_view(text).substr(prefix));
    if (!spec) throw std::invalid_argument(std::string("expected ").append(info.expected));
    if (vertex_count(*spec) > most_grid_vertices) {
      throw std::invalid_argument("more than the " + std::to_string(most_grid_vertices) +
                                  " vertices that are allowed");
    }
    return *spec;
  }
  throw std::invalid_argument(
      "expected ico:L, ico:f=N, octa:N, cube:N, uv:WxH, healpix:NSIDE or like:MESH");
}

std::string name_of(const GridSpec& spec) {
  std::string name = info_of(spec.kind).prefix;
  name.append(std::to_string(spec.size));
  if (spec.kind == GridKind::Geographic) name.append("x").append(std::to_string(spec.height));
  return name;
}

std::int64_t vertex_count(const GridSpec& spec) {
  constexpr std::int64_t beyond = std::int64_t{1} << 24;  // squares of more do not fit
  const std::int64_t n = std::min<std::int64_t>(spec.size, beyond);
  switch (spec.kind) {
    case GridKind::Icosahedron:
      return 10 * (std::int64_t{1} << 2 * std::min<std::int64_t>(n, 24)) + 2;
    case GridKind::IcosahedronCut:
      return 10 * n * n + 2;
    case GridKind::Octahedron:
      return (n - 1) * (n - 1) + 2;
    case GridKind::Cube:
      return 6 * n * n + 2;
    case GridKind::Geographic:
      return std::int64_t{spec.size} * (spec.height - 1) + 2;
    case GridKind::Healpix:
      return 12 * n * n;
  }
  return 0;
}

SphereGrid make_grid(const GridSpec& spec, const GridOptions& options) {
  switch (spec.kind) {
    case GridKind::Icosahedron:
      return subdivide(icosahedron(), spec.size, Placement::Halved, options);
    case GridKind::IcosahedronCut: {
      SphereGrid grid = cut_triangles(icosahedron(), spec.size);
      place_all(grid, options.threads, [](const Vector3& flat) { return flat; });
      return grid;
    }
    case GridKind::Octahedron:
      return octahedral_grid((spec.size - 1) / 2, options);
    case GridKind::Cube:
      return cube_grid(spec.size, options);
    case GridKind::Geographic:
      return cut_longitudes(spec.size, spec.height);
    case GridKind::Healpix:
      return healpix_grid(spec.size);
  }
  throw std::logic_error("an unknown kind of grid");
}

}  // namespace sphparam
