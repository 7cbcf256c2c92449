#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <stdexcept>

#include "remesh/subdivision/limit_vertices.h"
#include "remesh/subdivision/patch_net.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/remesh/subdivision.h"

using namespace sphparam;

namespace {

Scheme scheme_of(const PatchNet& net) {
  return net.degree() == 3 ? Scheme::Loop : Scheme::CatmullClark;
}

}  // namespace

TEST_CASE("patch net: crossing an edge leads to the same points of the surface, and back") {
  for (const char* name : {"ico:2", "octa:5", "cube:3"}) {
    const SphereGrid grid = make_grid(parse_grid(name));
    const PatchNet net(grid.faces);
    const LimitSurface surface(grid.faces, grid.directions, scheme_of(net));
    constexpr double out = 1e-4;
    const double far = net.degree() == 3 ? 0.6 : 1;
    for (int p = 0; p < net.patch_count(); ++p) {
      for (const LimitPlace& place : {LimitPlace{p, 0.4, -out},
                                      {p, -out, 0.4},
                                      {p, far + out, net.degree() == 3 ? 0.4 : 0.3},
                                      {p, net.degree() == 3 ? 0.4 : 0.3, far + out}}) {
        INFO(name << ", patch " << p << ", " << place.s << " " << place.t);
        CHECK(net.beyond(place) == Approx(out));
        const LimitPlace there = net.cross(place);
        CHECK(there.patch != p);
        CHECK(net.beyond(there) <= 0);
        const Vector3 inside = surface.evaluate(clamped(place, net.degree())).position;
        CHECK((surface.evaluate(there).position - inside).norm() < 10 * out);
      }
    }
  }
}

TEST_CASE("tessellate: a closed manifold of n² pieces a patch, its vertices on the surface once") {
  for (const char* name : {"ico:1", "cube:2", "octa:3"}) {
    const SphereGrid grid = make_grid(parse_grid(name));
    const auto vertices = static_cast<int>(grid.directions.rows());
    const PatchNet net(grid.faces);
    const LimitSurface surface(grid.faces, grid.directions, scheme_of(net));
    for (const int n : {1, 2, 3, 5}) {
      INFO(name << ", " << n);
      const Tessellation fine = tessellate(grid.faces, vertices, n);
      CHECK(fine.faces.count() == grid.faces.count() * n * n);
      const std::int64_t edges = std::ssize(fine.faces.corners) / 2;
      CHECK(std::ssize(fine.vertices) - edges + fine.faces.count() == 2);
      CHECK_NOTHROW(PatchNet(fine.faces));  // closed, each edge twice
      Points points(std::ssize(fine.vertices), 3);
      for (size_t v = 0; v < fine.vertices.size(); ++v) {
        points.row(static_cast<Eigen::Index>(v)) = surface.evaluate(fine.vertices[v]).position;
      }
      // Each piece, as its own patch has it, has the corners that its neighbours gave it.
      double longest = 0;
      for (std::int64_t f = 0; f < fine.faces.count(); ++f) {
        const auto polygon = fine.faces.polygon(f);
        for (size_t k = 0; k < polygon.size(); ++k) {
          longest = std::max(
              longest,
              (points.row(polygon[k]) - points.row(polygon[(k + 1) % polygon.size()])).norm());
        }
      }
      CHECK(longest < 1.6 / n);
    }
  }
}

TEST_CASE("tessellate: orientation is kept") {
  for (const char* name : {"ico:1", "cube:2"}) {
    const SphereGrid grid = make_grid(parse_grid(name));
    const Tessellation fine = tessellate(grid.faces, static_cast<int>(grid.directions.rows()), 3);
    const LimitSurface surface(grid.faces, grid.directions, scheme_of(PatchNet(grid.faces)));
    for (std::int64_t f = 0; f < fine.faces.count(); ++f) {
      const auto polygon = fine.faces.polygon(f);
      const auto at = [&](size_t k) {
        return surface.evaluate(fine.vertices[static_cast<size_t>(polygon[k])]).position;
      };
      CHECK((at(1) - at(0)).cross(at(2) - at(0)).dot(at(0)) > 0);
    }
  }
}

TEST_CASE("patches: faces are patches where a surface has as many, and once divided") {
  const std::pair<const char*, Scheme> subjects[] = {{"ico:1", Scheme::Loop},
                                                     {"cube:2", Scheme::CatmullClark},
                                                     {"uv:5x3", Scheme::CatmullClark},
                                                     {"ico:1", Scheme::CatmullClark}};
  for (const auto& [name, scheme] : subjects) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const LimitTopology topology(grid.faces, static_cast<int>(grid.directions.rows()), scheme);
    CHECK(faces_are_patches(grid.faces, scheme) == (topology.patch_count() == grid.faces.count()));
    const Polygons quads = subdivide_to_quads({grid.faces, {grid.directions}}).faces;
    CHECK(faces_are_patches(quads, Scheme::CatmullClark));
  }
}

TEST_CASE("fine limit mesh: closed, outward and as fine as asked, on the surface") {
  for (const auto& [name, scheme] : {std::pair("ico:2", Scheme::Loop),
                                     {"cube:3", Scheme::CatmullClark},
                                     {"uv:8x6", Scheme::CatmullClark}}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const auto vertices = static_cast<int>(grid.directions.rows());
    SubdivisionFit fit;
    fit.topology = std::make_shared<LimitTopology>(grid.faces, vertices, scheme);
    fit.control = grid.directions;
    const TriangleMesh mesh = fine_limit_mesh(fit, grid.faces, 10'000, 1);
    CHECK(mesh.face_count() >= 10'000);
    const MeshInspection inspection = inspect_mesh(mesh);
    CHECK(inspection.is_sphere());
    CHECK(inspection.volume > 2);  // of 4π/3: the surface is inside of its control points
    const LimitVertices limit =
        limit_at_vertices(LimitSurface(fit.topology, fit.control), grid.faces);
    CHECK((mesh.positions.topRows(vertices) - limit.positions).rowwise().norm().maxCoeff() < 1e-4);
    for (const std::int64_t pieces : {std::int64_t{1} << 40, std::int64_t{1} << 62})
      CHECK_THROWS_WITH(fine_limit_mesh(fit, grid.faces, pieces, 1), Catch::Contains("more than"));
  }
}

TEST_CASE("patch net: mixed faces and open meshes are refused") {
  CHECK_THROWS_AS(PatchNet(make_grid(parse_grid("uv:5x3")).faces), std::invalid_argument);
  Polygons open = make_grid(parse_grid("cube:1")).faces;
  open.starts.pop_back();
  open.corners.resize(20);
  CHECK_THROWS_AS(PatchNet(open), std::invalid_argument);
  const SphereGrid ball = make_grid(parse_grid("ico:1"));
  CHECK_THROWS_WITH(tessellate(ball.faces, 42, 1 << 13), Catch::Contains("more than"));
  CHECK_THROWS_WITH(tessellate(ball.faces, 42, 1 << 20), Catch::Contains("more than"));
}
