#include <catch2/catch.hpp>
#include <cmath>

#include "charted.h"
#include "io/attributes/shading_normals.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

Property constant(const std::string& name, ScalarType type, double value, Eigen::Index count) {
  return {name, type, std::vector<double>(static_cast<size_t>(count), value)};
}

}  // namespace

TEST_CASE("chart_surface: z up becomes y up, and y stays") {
  const Charted egg;
  const Surface z = egg.geometry().surface,
                y = egg.geometry({.up = {.up = Vector3::UnitY(), .front = Vector3::UnitZ()}})
                        .surface;
  for (Eigen::Index v = 0; v < egg.file.mesh.vertex_count(); ++v) {
    const Eigen::RowVector3f p = egg.file.mesh.positions.row(v).cast<float>();
    CHECK(y.positions.row(v) == p);
    CHECK(z.positions.row(v) == Eigen::RowVector3f(p[0], p[2], -p[1]));
  }
}

TEST_CASE("chart_surface: triangles stay counter-clockwise, normals and tangents unit") {
  const Charted egg;
  const Surface surface = egg.geometry({.buffers = {.tangents = true}}).surface;
  for (size_t i = 0; i < surface.indices.size(); i += 3) {
    const Eigen::Vector3f a = surface.positions.row(surface.indices[i]),
                          b = surface.positions.row(surface.indices[i + 1]),
                          c = surface.positions.row(surface.indices[i + 2]);
    CHECK((b - a).cross(c - a).dot(a + b + c) > 0);
  }
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    CHECK(surface.normals.row(v).norm() == Approx(1));
    CHECK(surface.tangents.row(v).head(3).norm() == Approx(1));
  }
}

TEST_CASE("chart_surface: where u is mirrored tangents turn round and bitangents stay") {
  const GeometryOptions options{.buffers = {.tangents = true}};
  // Quarters apart, so that both charts are split alike.
  const Surface east = Charted({.convention = Convention::Three}).geometry(options).surface,
                west = Charted({.convention = Convention::Blender}).geometry(options).surface;
  REQUIRE(east.tangents.rows() == west.tangents.rows());
  CHECK(east.tangents == -west.tangents);
  CHECK((east.texcoords[0].col(0) + west.texcoords[0].col(0)).isOnes(1e-6F));
}

TEST_CASE("chart_surface: a morph ends in the sphere of the same area, and in the rectangle") {
  const Charted egg;
  const Surface surface =
      egg.geometry({.morph = Morph::Flat, .buffers = {.tangents = true}}).surface;
  REQUIRE(surface.targets.size() == 2);
  const FloatRows sphere = surface.positions + surface.targets[0].positions;
  const Eigen::RowVector3f middle = (sphere.colwise().minCoeff() + sphere.colwise().maxCoeff()) / 2;
  const auto radii = (sphere.rowwise() - middle).rowwise().norm();
  CHECK(radii.maxCoeff() / radii.minCoeff() < 1.02F);
  const FloatRows flat = surface.positions + surface.targets[1].positions;
  const auto extent = (flat.colwise().maxCoeff() - flat.colwise().minCoeff()).eval();
  CHECK(extent[0] == Approx(2 * extent[1]));
  CHECK(extent[2] < 1e-6F);
  const FloatRows normals = surface.normals + surface.targets[1].normals;
  CHECK(normals.col(2).isOnes(1e-6F));
}

TEST_CASE("chart_surface: what float32 leaves of a sphere is in _POSITION_LO") {
  const Charted egg;
  const ExportGeometry made =
      egg.geometry({.shape = ShapeKind::Sphere, .buffers = {.position_lo = true}});
  CHECK(made.stored_sphere_folds == 0);
  const Surface& surface = made.surface;
  const FloatRows& low = surface.custom.front().values;
  for (Vertex v = 0; v < static_cast<Vertex>(egg.map.points.rows()); ++v) {
    const Eigen::RowVector3d x = egg.chart.chart.points.row(v);
    const Eigen::RowVector3d sum =
        surface.positions.row(v).cast<double>() + low.row(v).cast<double>();
    CHECK((sum - Eigen::RowVector3d(x[0], x[2], -x[1])).norm() < 1e-14);
  }
}

TEST_CASE("chart_surface: colours are sRGB, in bytes, 16 bits or floats, whatever they came from") {
  Charted egg;
  for (const char* name : {"red", "green", "blue"})
    egg.file.set_vertex_property(
        constant(name, ScalarType::Uint8, 188, egg.file.mesh.vertex_count()));
  const GeometryOptions options{.buffers = {.colours = true}};
  // 188 of 255 in sRGB is half of the light.
  CHECK(egg.geometry(options).surface.colours[7][1] / 65535.0 == Approx(0.5).epsilon(0.01));
  CHECK(egg.geometry(options).surface.colours[7][3] == 65535);
  egg.file.format = "glTF";
  CHECK(egg.geometry(options).surface.colours[7][1] / 65535.0 == Approx(0.5).epsilon(0.01));
  const Eigen::Index count = egg.file.mesh.vertex_count();
  for (const char* name : {"red", "green", "blue"})
    egg.file.set_vertex_property(constant(name, ScalarType::Uint16, 188 * 257, count));
  egg.file.set_vertex_property(constant("alpha", ScalarType::Uint16, 0.25 * 65535, count));
  CHECK(egg.geometry(options).surface.colours[7][1] / 65535.0 == Approx(0.5).epsilon(0.01));
  CHECK(egg.geometry(options).surface.colours[7][3] / 65535.0 == Approx(0.25).epsilon(0.01));
}

TEST_CASE("chart_surface: the mesh's own texture coordinates come along, seams and all") {
  Charted egg;
  const Eigen::Index corners = egg.file.mesh.triangles.size();
  egg.file.corner_texcoords = CornerTexcoords(corners, 2);
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    const int v = egg.file.mesh.triangles.data()[corner];
    // A seam between the first face and all others.
    egg.file.corner_texcoords->row(corner) << 0.001 * v + (corner < 3 ? 5 : 0), 0.25;
  }
  const Surface surface = egg.geometry({.buffers = {.source_texcoords = true}}).surface;
  REQUIRE(surface.texcoords.size() == 2);
  CHECK(surface.texcoords[1].col(1).isConstant(0.75F));
  CHECK(surface.positions.rows() > egg.chart.chart.wedge_count());
  CHECK(surface.positions.rows() < egg.chart.chart.wedge_count() + 20);
}

TEST_CASE("chart_surface: a position beyond float32 is refused") {
  Charted egg;
  egg.file.mesh.positions *= 1e39;
  CHECK_THROWS_AS(egg.geometry(), std::range_error);
}

TEST_CASE("chart_surface: a mesh too small for float32 is refused, its sphere is not") {
  Charted egg, small;
  small.file.mesh.positions *= 1e-30;
  const FloatRows same = small.geometry().surface.positions * 1e30F;
  CHECK(same.isApprox(egg.geometry().surface.positions, 1e-6F));
  for (const double size : {1e-32, 1e-45, 1e-160}) {
    small.file.mesh.positions = size * egg.file.mesh.positions;
    CHECK_THROWS_WITH(small.geometry(), Catch::Contains("glTF: the mesh is too small for numbers "
                                                        "of 32 bits, its extent is "));
    CHECK_NOTHROW(small.geometry({.shape = ShapeKind::Sphere}));  // has a size of its own
  }
}

TEST_CASE("shading_normals: those of the file where they are usable, else the faces'") {
  Charted egg;
  const Points by_faces = shading_normals(egg.file);
  for (const char* name : {"nx", "ny", "nz"})
    egg.file.set_vertex_property(constant(name, ScalarType::Float64,
                                          std::string(name) == "ny" ? 2 : 0,
                                          egg.file.mesh.vertex_count()));
  egg.file.vertex_properties[1].values[5] = 0;
  const Points own = shading_normals(egg.file);
  CHECK(own.row(3) == Eigen::RowVector3d(0, 1, 0));
  CHECK(own.row(5) == by_faces.row(5));
}
