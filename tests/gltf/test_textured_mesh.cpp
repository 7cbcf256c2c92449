#include <catch2/catch.hpp>

#include "charted.h"
#include "gltf/textured_mesh.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/mesh_writer.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam::tools;

TEST_CASE("textured_mesh: read back from OBJ and PLY, the chart is still certified") {
  for (const Convention convention : {Convention::Sphparam, Convention::Envmap}) {
    const Charted egg({.convention = convention});
    const MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Mesh);
    for (const std::string& bytes : {serialise_ply(mesh), obj_with_library(mesh, "egg.mtl")}) {
      const MeshFile read = read_mesh(bytes, bytes.starts_with("ply") ? "egg.ply" : "egg.obj", {});
      REQUIRE(read.corner_texcoords);
      CHECK(read.mesh.triangles == egg.chart.chart.triangles);
      SphericalChart chart = egg.chart.chart;
      for (Eigen::Index corner = 0; corner < chart.wedges.size(); ++corner) {
        const auto st = read.corner_texcoords->row(corner);
        chart.uv.row(chart.wedges.data()[corner]) << (egg.chart.mirrored ? 1 - st[0] : st[0]),
            1 - st[1];
      }
      CHECK(certify_chart(chart).one_to_one());
    }
  }
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
