#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "charted.h"
#include "gltf/textured_mesh.h"
#include "gltf/written_check.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

TEST_CASE("textured_mesh: read back from OBJ and PLY, the chart is still certified") {
  for (const Convention convention : {Convention::Sphparam, Convention::Envmap}) {
    const Charted egg({.convention = convention});
    const MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Mesh);
    for (const std::string& bytes : {serialise_ply(mesh), obj_with_library(mesh, "egg.mtl")}) {
      const std::string name = bytes.starts_with("ply") ? "egg.ply" : "egg.obj";
      CHECK(certify_written(bytes, name, egg.chart).one_to_one());
    }
  }
}

TEST_CASE("certify_written: what stands in the file counts, not what was meant") {
  const Charted egg;
  MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Mesh);
  for (Eigen::Index corner = 0; corner < mesh.corner_texcoords->rows(); ++corner) {
    // As a writer of two digits would.
    auto st = mesh.corner_texcoords->row(corner);
    st << std::round(100 * st[0]) / 100, std::round(100 * st[1]) / 100;
  }
  CHECK_FALSE(certify_written(serialise_ply(mesh), "egg.ply", egg.chart).one_to_one());
  mesh.corner_texcoords.reset();
  CHECK_THROWS_WITH(certify_written(serialise_ply(mesh), "egg.ply", egg.chart),
                    Catch::Contains("no texture coordinates"));
}

TEST_CASE("textured_mesh: properties come along, the map's own are left out") {
  Charted egg;
  const auto count = static_cast<size_t>(egg.file.mesh.vertex_count());
  egg.file.set_vertex_property({"red", ScalarType::Uint8, std::vector<double>(count, 77)});
  egg.file.set_vertex_property({"sx", ScalarType::Float64, std::vector<double>(count, 1)});
  const MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Sphere);
  REQUIRE(mesh.find_vertex_property("red"));
  CHECK(mesh.find_vertex_property("red")->values.back() == 77);
  CHECK_FALSE(mesh.find_vertex_property("sx"));
  CHECK((mesh.mesh.positions.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("textured_mesh: of labels a new vertex has one of its corners', colours are mixed") {
  Charted egg;
  std::vector<double> sides;
  for (Vertex v = 0; v < egg.file.mesh.vertex_count(); ++v) sides.push_back(v % 2 == 0 ? 0 : 100);
  for (const char* name : {"label", "red"})
    egg.file.set_vertex_property({name, ScalarType::Int32, sides});
  egg.file.set_vertex_property({"depth", ScalarType::Float32, sides});
  const MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Mesh);
  const auto mixed = [&](const char* name) {
    return std::ranges::count_if(mesh.find_vertex_property(name)->values,
                                 [](double value) { return value > 0 && value < 100; });
  };
  REQUIRE(mixed("depth") > 10);
  CHECK(mixed("red") > 10);
  CHECK(mixed("label") == 0);
  const auto& points = egg.chart.chart.surface_points;
  for (size_t v = 0; v < points.size(); ++v) {
    double all = 0;  // the weight of 100
    for (int k = 0; k < 3; ++k)
      if (egg.file.mesh.triangles(points[v].face, k) % 2 == 1) all += points[v].barycentric[k];
    if (std::abs(all - 0.5) > 1e-9)
      CHECK(mesh.find_vertex_property("label")->values[v] == (all > 0.5 ? 100 : 0));
  }
}

TEST_CASE("textured_mesh: the library names the image for the material that the OBJ uses") {
  const Charted egg({}, 1);
  const std::string obj =
      obj_with_library(textured_mesh(egg.chart, egg.file, ShapeKind::Mesh), "egg.mtl");
  CHECK(obj.starts_with("mtllib egg.mtl\n"));
  CHECK(obj.find("usemtl sphparam\n") != std::string::npos);
  const std::string library = material_library("egg_checker.png");
  CHECK(library.find("newmtl sphparam\n") != std::string::npos);
  CHECK(library.find("map_Kd egg_checker.png\n") != std::string::npos);
}
