#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "sphparam/errors.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/sphere/certificate.h"
#include "support/folder.h"

using namespace sphparam;

namespace {

/// The triangles of a grid, quads cut from corner 0 or from corner 1.
Triangles cut(const Polygons& faces, int from) {
  std::vector<int> corners;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const auto polygon = faces.polygon(f);
    const size_t n = polygon.size();
    for (size_t k = 1; k + 1 < n; ++k) {
      for (const size_t i : {size_t{0}, k, k + 1}) {
        corners.push_back(polygon[(i + static_cast<size_t>(from)) % n]);
      }
    }
  }
  return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3),
                                     3);
}

const std::vector<std::string> grids = {
    "ico:0",   "ico:1",    "ico:4",     "ico:f=1",   "ico:f=2",   "ico:f=7",
    "octa:3",  "octa:5",   "octa:7",    "octa:9",    "octa:33",   "octa:35",
    "cube:1",  "cube:2",   "cube:3",    "cube:8",    "cube:11",   "uv:3x2",
    "uv:12x7", "uv:64x32", "healpix:1", "healpix:2", "healpix:3", "healpix:16"};

double edge_ratio(const SphereGrid& grid) {
  double shortest = 4, longest = 0;
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    const auto polygon = grid.faces.polygon(f);
    for (size_t k = 0; k < polygon.size(); ++k) {
      const double length =
          (grid.directions.row(polygon[k]) - grid.directions.row(polygon[(k + 1) % polygon.size()]))
              .norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  }
  return longest / shortest;
}

}  // namespace

TEST_CASE("grids: every one is a certified sphere of as many vertices as it says, cut either way") {
  for (const std::string& name : grids) {
    INFO(name);
    const GridSpec spec = parse_grid(name);
    CHECK(name_of(spec) == name);
    const SphereGrid grid = make_grid(spec);
    REQUIRE(grid.directions.rows() == vertex_count(spec));
    CHECK((grid.directions.rowwise().norm().array() - 1).abs().maxCoeff() < 4e-16);
    for (const int from : {0, 1}) {
      const TriangleMesh mesh{grid.directions, cut(grid.faces, from)};
      REQUIRE(inspect_mesh(mesh).is_sphere());
      CHECK(certify(Topology(mesh), SphereMap{mesh.positions}).bijective());
    }
  }
}

TEST_CASE("grids: triangles and quads are where they are promised") {
  const auto count = [](const std::string& name, int degree) {
    const SphereGrid grid = make_grid(parse_grid(name));
    int found = 0;
    for (std::int64_t f = 0; f < grid.faces.count(); ++f) found += grid.faces.degree(f) == degree;
    return std::pair<int, int>(found, static_cast<int>(grid.faces.count()));
  };
  CHECK(count("ico:3", 3) == std::pair(1280, 1280));
  CHECK(count("octa:17", 3) == std::pair(512, 512));
  CHECK(count("cube:8", 4) == std::pair(384, 384));
  CHECK(count("cube:5", 4) == std::pair(150, 150));
  CHECK(count("uv:10x6", 4) == std::pair(40, 60));
  CHECK(count("healpix:4", 3) == std::pair(8, 194));
}

TEST_CASE("grids: a level is the beginning of the next, and its faces hold four each") {
  for (const auto& [coarse, fine] : {std::pair("ico:3", "ico:4"), {"cube:4", "cube:8"}}) {
    INFO(fine);
    const SphereGrid one = make_grid(parse_grid(coarse)), two = make_grid(parse_grid(fine));
    CHECK(one.directions == two.directions.topRows(one.directions.rows()));
    REQUIRE(two.faces.count() == 4 * one.faces.count());
    for (std::int64_t f = 0; f < two.faces.count(); ++f) {
      std::set<int> shared;  // with the face above: a corner, or none for the middle triangle
      for (const int v : two.faces.polygon(f)) {
        for (const int u : one.faces.polygon(f / 4)) {
          if (u == v) shared.insert(v);
        }
      }
      const bool middle = one.faces.degree(f / 4) == 3 && f % 4 == 3;
      CHECK(shared.size() == (middle ? 0U : 1U));
    }
  }
}

TEST_CASE("grids: vertices lie in the middle of their parents") {
  for (const char* name : {"ico:4", "cube:8", "octa:17"}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name), {.ancestry = true});
    REQUIRE(grid.parents.size() == static_cast<size_t>(grid.directions.rows()));
    REQUIRE(grid.level_vertices.back() == grid.directions.rows());
    for (size_t level = 1; level < grid.level_vertices.size(); ++level) {
      for (int v = grid.level_vertices[level - 1]; v < grid.level_vertices[level]; ++v) {
        Vector3 sum = Vector3::Zero();
        for (const int parent : grid.parents[static_cast<size_t>(v)]) {
          if (parent < 0) continue;
          CHECK(parent < grid.level_vertices[level - 1]);
          sum += grid.directions.row(parent);
        }
        // Exact for the icosahedron; the others are placed by formulas of their own.
        const double angle = (sum.normalized() - grid.directions.row(v).transpose()).norm();
        CHECK(angle < (grid.faces.degree(0) == 3 && name[0] == 'i' ? 1e-15 : 0.2));
      }
    }
    CHECK(grid.parents[0] == std::array<int, 4>{0, -1, -1, -1});
  }
}

TEST_CASE("grids: edges of an icosahedron halved on the sphere differ little") {
  CHECK(edge_ratio(make_grid(parse_grid("ico:6"))) == Approx(1.195).margin(0.005));
}

TEST_CASE("grids: the steps of a cube's middle lines are equal angles") {
  const SphereGrid grid = make_grid(parse_grid("cube:6"));
  std::multiset<double> longitudes;  // of the side +x, where z = 0
  for (Eigen::Index v = 0; v < grid.directions.rows(); ++v) {
    const Vector3 q = grid.directions.row(v);
    if (q.z() == 0 && q.x() > 0 && std::abs(q.y()) <= q.x()) {
      longitudes.insert(std::atan2(q.y(), q.x()));
    }
  }
  REQUIRE(longitudes.size() == 7);
  double expected = -std::acos(-1.0) / 4;
  for (const double longitude : longitudes) {
    CHECK(longitude == Approx(expected).margin(1e-12));
    expected += std::acos(-1.0) / 12;
  }
}

TEST_CASE("grids: HEALPix centres are where RING order has them") {
  // Górski et al. 2005, equations 2 to 9, written out.
  const double third = 1.0 / 3, pi = std::acos(-1.0);
  struct Known {
    int nside, pixel;
    double z, phi;
  };
  for (const Known& known :
       {Known{1, 0, 2 * third, pi / 4}, Known{1, 4, 0, 0}, Known{1, 5, 0, pi / 2},
        Known{1, 11, -2 * third, 7 * pi / 4}, Known{2, 0, 1 - third / 4, pi / 4},
        Known{2, 4, 2 * third, pi / 8}, Known{2, 12, third, 0}, Known{2, 20, 0, pi / 8},
        Known{2, 47, third / 4 - 1, 7 * pi / 4}, Known{4, 24, 2 * third, pi / 16},
        Known{4, 40, 0.5, 0}, Known{4, 88, 0, pi / 16},
        Known{4, 191, third / 16 - 1, 7 * pi / 4}}) {
    INFO(known.nside << " " << known.pixel);
    const SphereGrid grid = make_grid({GridKind::Healpix, known.nside, 0});
    const Vector3 q = grid.directions.row(known.pixel);
    CHECK(q.z() == Approx(known.z).margin(1e-15));
    const double phi = std::atan2(q.y(), q.x());
    CHECK(std::remainder(phi - known.phi, 2 * pi) == Approx(0).margin(1e-14));
  }
}

TEST_CASE("grids: HEALPix has rings from the north, and its centres balance") {
  const SphereGrid grid = make_grid(parse_grid("healpix:8"));
  for (Eigen::Index v = 1; v < grid.directions.rows(); ++v) {
    CHECK(grid.directions(v, 2) <= grid.directions(v - 1, 2));
  }
  // Equal areas: the mean of z² over equal pixels tends to 1/3 as 1/N².
  CHECK(grid.directions.col(2).squaredNorm() / static_cast<double>(grid.directions.rows()) ==
        Approx(1.0 / 3).margin(0.002));
  CHECK(grid.directions.colwise().sum().norm() < 1e-12);
}

TEST_CASE("grids: names that make no sense are refused") {
  for (const char* name : {"", "ico", "ico:", "ico:-1", "ico:7x", "ico:f=0", "octa:8", "octa:1",
                           "cube:0", "uv:12", "uv:2x4", "uv:12x1", "healpix:0", "dodeca:3",
                           "ico:99999999999", "cube:2000000000", "healpix:2000000000"}) {
    INFO(name);
    CHECK_THROWS_AS(parse_grid(name), std::invalid_argument);
  }
  CHECK(vertex_count(parse_grid("ico:10")) == 10'485'762);
}

TEST_CASE("grids: specs that no name stands for are refused before any work") {
  for (const GridSpec& spec :
       {GridSpec{GridKind::Icosahedron, -3}, GridSpec{GridKind::Icosahedron, 30},
        GridSpec{GridKind::Octahedron, 4}, GridSpec{GridKind::Cube},
        GridSpec{GridKind::Geographic, 12}, GridSpec{GridKind::Healpix, 1 << 20},
        GridSpec{static_cast<GridKind>(9), 3}}) {
    CHECK_THROWS_AS(make_grid(spec), std::invalid_argument);
  }
  CHECK_THROWS_WITH(make_grid({GridKind::Octahedron, 4}),
                    "octa:4: expected octa:N, N odd and from 3, as in octa:129");
}

TEST_CASE("grids: a file's vertices about the origin are directions of any length, or refused") {
  const tests::Folder folder;
  const std::string path = folder / "grid.off";
  const auto write = [&](const char* top) {
    std::ofstream(path) << "OFF\n6 8 0\n3 0 0\n-3 0 0\n0 2 0\n0 -2 0\n0 0 " << top
                        << "\n0 0 -0.5\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n"
                           "3 3 1 5\n3 0 3 5\n";
  };
  write("1e-3");
  const SphereGrid grid = load_grid(path);
  CHECK(grid.directions.rowwise().norm() == VectorX::Ones(6));
  CHECK(grid.faces.count() == 8);
  CHECK(grid.warning ==
        "grid.off: these points are not on a sphere about the origin: their radius is "
        "1.75 in the mean, and up to 99.9 % more or less; their directions are "
        "judged");
  write("-0.1");
  CHECK_THROWS_AS(load_grid(path), NotCertifiedError);
  CHECK_THROWS_WITH(load_grid(path),
                    Catch::Contains(": its map is one: `sphparam map grid.off -o grid.sph.ply`, "
                                    "then like:grid.sph.ply\n"));
}

TEST_CASE("grids: the same bytes for any number of threads") {
  for (const char* name : {"ico:6", "cube:32"}) {
    const SphereGrid one = make_grid(parse_grid(name), {.threads = 1});
    const SphereGrid three = make_grid(parse_grid(name), {.threads = 3});
    CHECK(one.directions == three.directions);
    CHECK(one.faces.corners == three.faces.corners);
  }
}
