#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "../bake/scenes.h"
#include "bake/field_registry.h"
#include "charted.h"
#include "gltf/stored_chart.h"
#include "gltf/textured_mesh.h"
#include "io/attributes/hard_edges.h"
#include "io/attributes/shading_normals.h"
#include "io/files/read_back.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "support/mapped.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

Vector3 face_normal(const Points& positions, const int* corners) {
  const Vector3 a = positions.row(corners[0]), b = positions.row(corners[1]),
                c = positions.row(corners[2]);
  return (b - a).cross(c - a).normalized();
}

/// Every corner has the normal of its face.
CornerNormals flat_normals(const TriangleMesh& mesh) {
  CornerNormals normals(mesh.triangles.size(), 3);
  for (Eigen::Index corner = 0; corner < normals.rows(); ++corner)
    normals.row(corner) =
        face_normal(mesh.positions, mesh.triangles.data() + corner / 3 * 3).transpose();
  return normals;
}

CornerNormals smooth_normals(const MeshFile& file) {
  const Points of_vertices = shading_normals(file);
  CornerNormals normals(file.mesh.triangles.size(), 3);
  for (Eigen::Index corner = 0; corner < normals.rows(); ++corner)
    normals.row(corner) = of_vertices.row(file.mesh.triangles.data()[corner]);
  return normals;
}

struct Faceted : Charted {
  explicit Faceted(const ExportChartOptions& options = {}) : Charted(options, 2) {
    file.corner_normals = flat_normals(file.mesh);
    chart.wedge_normals = split_at_hard_edges(chart.chart, file);
  }
};

/// Mean angle, in degrees, between the normals of corners and those of their faces on the source.
double mean_angle(const Faceted& egg, const Surface& surface) {
  double sum = 0;
  for (size_t corner = 0; corner < surface.indices.size(); ++corner) {
    const Eigen::Vector3d n = surface.normals.row(surface.indices[corner]).cast<double>();
    const Face source = egg.chart.chart.source_faces[corner / 3];
    const Vector3 want = egg.file.corner_normals->row(3 * source);
    sum += std::atan2(n.cross(want).norm(), n.dot(want)) * 180 / std::numbers::pi;
  }
  return sum / static_cast<double>(surface.indices.size());
}

}  // namespace

TEST_CASE(
    "hard edges: a faceted mesh keeps the normal of every corner, its chart stays certified") {
  for (const ExportChartOptions& options : {ExportChartOptions{},
                                            {.convention = Convention::Blender},
                                            {.refine_poles = 4},
                                            {.keep_topology = true}}) {
    Faceted egg(options);
    const GeometryOptions lit{.up = {.up = Vector3::UnitY(), .front = Vector3::UnitZ()},
                              .buffers = {.tangents = true}};
    const ExportGeometry hard = egg.geometry(lit);
    CHECK(hard.stored.one_to_one() == !options.keep_topology);
    CHECK(mean_angle(egg, hard.surface) < 1e-4);
    for (Eigen::Index v = 0; v < hard.surface.positions.rows(); ++v) {
      const Eigen::RowVector3f n = hard.surface.normals.row(v),
                               t = hard.surface.tangents.row(v).leftCols(3);
      CHECK(t.norm() == Approx(1));
      CHECK(std::abs(n.dot(t)) < 1e-6F);
    }
    egg.chart.wedge_normals.reset();
    CHECK(mean_angle(egg, egg.geometry(lit).surface) > 5);
  }
}

TEST_CASE("hard edges: only where normals differ are there more wedges, and (u, v) stay") {
  Charted egg({}, 2);
  const SphericalChart before = egg.chart.chart;
  SphericalChart smooth = before;
  CHECK_FALSE(split_at_hard_edges(smooth, egg.file));
  egg.file.corner_normals = smooth_normals(egg.file);
  const std::optional<Points> same = split_at_hard_edges(smooth, egg.file);
  REQUIRE(same);
  CHECK(smooth.wedges == before.wedges);
  CHECK(smooth.uv == before.uv);

  // One face looks elsewhere: its corners get wedges of their own, but for those that come first.
  const Face odd = before.source_faces.back();
  for (int k = 0; k < 3; ++k) egg.file.corner_normals->row(3 * odd + k) << 0, 0, 1;
  SphericalChart hard = before;
  const std::optional<Points> normals = split_at_hard_edges(hard, egg.file);
  REQUIRE(normals);
  CHECK(normals->rows() == hard.wedge_count());
  CHECK(hard.wedge_count() > before.wedge_count());
  CHECK(hard.uv.topRows(before.uv.rows()) == before.uv);
  for (Eigen::Index corner = 0; corner < hard.wedges.size(); ++corner) {
    const int w = hard.wedges.data()[corner], old = before.wedges.data()[corner];
    CHECK(hard.uv.row(w) == before.uv.row(old));
    CHECK(hard.wedge_kinds[static_cast<size_t>(w)] == before.wedge_kinds[static_cast<size_t>(old)]);
    const bool is_odd = before.source_faces[static_cast<size_t>(corner / 3)] == odd;
    CHECK((normals->row(w) == Eigen::RowVector3d(0, 0, 1)) == is_odd);
  }
  CHECK(certify_chart(hard).one_to_one());
}

TEST_CASE("hard edges: a corner without a usable normal has that of its vertex") {
  Charted egg({}, 1);
  egg.file.corner_normals = CornerNormals::Zero(egg.file.mesh.triangles.size(), 3);
  egg.file.corner_normals->row(4).setConstant(std::nan(""));
  const std::optional<Points> normals = split_at_hard_edges(egg.chart.chart, egg.file);
  REQUIRE(normals);
  const Points of_vertices = shading_normals(egg.file);
  for (Vertex v = 0; v < egg.file.mesh.vertex_count(); ++v)
    CHECK((normals->row(v) - of_vertices.row(v)).norm() < 1e-12);
}

TEST_CASE("hard edges: OBJ and PLY have the normals of corners") {
  const Faceted egg;
  const MeshFile mesh = textured_mesh(egg.chart, egg.file, ShapeKind::Mesh);
  for (const std::string& bytes : {serialise_ply(mesh), obj_with_library(mesh, "egg.mtl")}) {
    const std::string name = bytes.starts_with("ply") ? "egg.ply" : "egg.obj";
    const MeshFile read = read_mesh(bytes, name, own_file);
    REQUIRE(read.corner_normals);
    for (Eigen::Index corner = 0; corner < read.corner_normals->rows(); ++corner) {
      const Face source = egg.chart.chart.source_faces[static_cast<size_t>(corner / 3)];
      CHECK((read.corner_normals->row(corner) - egg.file.corner_normals->row(3 * source)).norm() <
            1e-6);
    }
  }
}

TEST_CASE("hard edges: in its own tangent frame a faceted mesh is flat") {
  const Faceted egg;
  const auto scene = scene_of(egg.file, egg.map);
  REQUIRE(scene->target.wedge_normals);
  const std::vector<float> normals =
      baked(*scene, make_field("normal-tangent", *scene), {.width = 64, .height = 32});
  for (size_t i = 0; i < normals.size(); i += 3) CHECK(normals[i + 2] > 0.9999F);
}

TEST_CASE("hard edges: object normals are baked facet by facet") {
  const Faceted egg;
  const auto scene = scene_of(egg.file, egg.map);
  const std::vector<float> normals =
      baked(*scene, make_field("normal-object", *scene), {.width = 128, .height = 64});
  long of_facets = 0;
  for (size_t i = 0; i < normals.size(); i += 3) {
    const Eigen::RowVector3d normal =
        Eigen::Map<const Eigen::RowVector3f>(normals.data() + i).cast<double>();
    of_facets += (egg.file.corner_normals->rowwise() - normal).rowwise().norm().minCoeff() < 1e-5;
  }
  // But for texels at the poles that hold several facets, and show their mean.
  CHECK(100 * of_facets > 97 * std::ssize(normals) / 3);
}

TEST_CASE(
    "tangents: a low mesh lit by its normal map in glTF's way has the normals of the source") {
  Charted egg({}, 4);
  for (auto row : egg.file.mesh.positions.rowwise())
    row *= 1 + 0.1 * std::sin(5 * row[0] + 3 * row[1]);
  const Charted low({}, 1);
  const MappedMesh source({.file = egg.file, .map = egg.map}, 1);
  const MappedMesh coarse({.file = low.file, .map = low.map}, 1);
  const BakeScene scene{
      {source, shading_normals(egg.file), {}}, make_target(coarse, false, 1), {}, 1};
  constexpr int width = 1024, height = 512;
  const std::vector<float> texels =
      baked(scene, make_field("normal-tangent", scene), {.width = width, .height = height});
  const GeometryOptions lit{.up = {.up = Vector3::UnitY(), .front = Vector3::UnitZ()},
                            .buffers = {.tangents = true}};
  const Surface surface = low.geometry(lit).surface;
  const SphericalChart& chart = low.chart.chart;
  double sum = 0, flat = 0;
  int count = 0;
  for (size_t f = 0; f < surface.indices.size(); f += 3) {
    for (const Vector3& weights :
         {Vector3(0.6, 0.2, 0.2), Vector3(0.2, 0.5, 0.3), Vector3(0.1, 0.1, 0.8)}) {
      Vector3 normal = Vector3::Zero(), tangent = Vector3::Zero();
      Eigen::Vector2d uv = Eigen::Vector2d::Zero();
      double sign = 0;
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<Eigen::Index>(surface.indices[f + static_cast<size_t>(k)]);
        normal += weights[k] * surface.normals.row(v).cast<double>().transpose();
        tangent += weights[k] * surface.tangents.row(v).head<3>().cast<double>().transpose();
        uv += weights[k] * surface.texcoords[0].row(v).cast<double>().transpose();
        sign = static_cast<double>(surface.tangents(v, 3));
      }
      const auto texel =
          3 * (static_cast<size_t>(uv[1] * height) * width + static_cast<size_t>(uv[0] * width));
      const Vector3 seen =
          (texels[texel] * tangent + texels[texel + 1] * sign * normal.cross(tangent) +
           texels[texel + 2] * normal)
              .normalized();
      Vector3 direction = Vector3::Zero();
      for (int k = 0; k < 3; ++k)
        direction += weights[k] * chart.points.row(chart.triangles(static_cast<Face>(f / 3), k));
      const SurfacePoint there = source.locator().locate(direction.normalized());
      Vector3 truth = Vector3::Zero();
      for (int k = 0; k < 3; ++k)
        truth += there.barycentric[k] *
                 scene.source.normals.row(egg.file.mesh.triangles(there.face, k)).transpose();
      const auto degrees = [&](const Vector3& n) {
        return std::atan2(n.cross(truth).norm(), n.dot(truth)) * 180 / std::numbers::pi;
      };
      sum += degrees(seen);
      flat += degrees(normal);
      ++count;
    }
  }
  CHECK(sum / count < 0.5);
  CHECK(flat / count > 8);
}

TEST_CASE("hard edges: those of a mesh are none of the sphere that is shown in its place") {
  Charted egg({}, 2);
  const auto vertices = [&](ShapeKind shape) {
    return make_asset(mapped(egg.file, egg.map), {.look = {.image_width = 16}, .shape = shape})
        .levels[0]
        .vertex_count();
  };
  const auto smooth = vertices(ShapeKind::Mesh), sphere = vertices(ShapeKind::Sphere);
  CHECK(smooth == sphere);
  egg.file.corner_normals = flat_normals(egg.file.mesh);
  CHECK(vertices(ShapeKind::Mesh) > smooth);
  CHECK(vertices(ShapeKind::Sphere) == sphere);
}
