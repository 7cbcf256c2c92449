#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "render/geodesic.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

using namespace sphparam;
using Catch::Detail::Approx;

namespace {

using std::numbers::pi;

double arc(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0)), b = mesh.position(mesh.triangles(f, 1)),
                  c = mesh.position(mesh.triangles(f, 2));
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

RenderObject octahedron() { return {.mesh = tests::octahedron()}; }

}  // namespace

TEST_CASE("on_sphere: large triangles become a closed mesh of small ones that covers the sphere") {
  const RenderObject coarse = octahedron();
  const RenderObject sphere = on_sphere(coarse, coarse.mesh.positions);
  CHECK(area(coarse.mesh) < 7);
  CHECK(area(sphere.mesh) == Approx(4 * pi).epsilon(0.001));
  CHECK(inspect_mesh(sphere.mesh).is_sphere());
  CHECK((sphere.mesh.positions.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
  CHECK(*sphere.normals == sphere.mesh.positions);
  CHECK(sphere.mesh.face_count() < 40000);
}

TEST_CASE("on_sphere: a sphere of small triangles stays as it is") {
  const RenderObject fine = {.mesh = tests::icosphere(6)};
  const RenderObject sphere = on_sphere(fine, fine.mesh.positions);
  CHECK(sphere.mesh.triangles == fine.mesh.triangles);
  CHECK(sphere.mesh.positions == fine.mesh.positions);
}

TEST_CASE("on_sphere: the wireframe is that of the whole triangles") {
  RenderObject object = octahedron();
  object.wireframe = Wireframe{};
  const RenderObject sphere = on_sphere(object, object.mesh.positions);
  REQUIRE(std::ssize(sphere.wireframe->hidden_sides) == sphere.mesh.face_count());
  double shown = 0;
  for (Eigen::Index f = 0; f < sphere.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (sphere.wireframe->hidden_sides[static_cast<size_t>(f)] >> k & 1) continue;
      shown += arc(sphere.mesh.position(sphere.mesh.triangles(f, (k + 1) % 3)),
                   sphere.mesh.position(sphere.mesh.triangles(f, (k + 2) % 3)));
    }
  }
  CHECK(shown == Approx(2 * 12 * pi / 2));  // twelve quarter circles, from both sides
}

TEST_CASE("on_sphere: colours and texture coordinates are linear on the chords") {
  RenderObject object = octahedron();
  VertexPaint colours;
  for (const auto& p : object.mesh.positions.rowwise()) {
    colours.colours.push_back(p.cast<float>().transpose());
  }
  object.paint = colours;
  // f(Σ λᵢ vᵢ) = Σ λᵢ xᵢ / |…|: a colour that is the place itself points to the new place.
  const RenderObject sphere = on_sphere(object, object.mesh.positions);
  const auto& refined = std::get<VertexPaint>(sphere.paint).colours;
  REQUIRE(std::ssize(refined) == sphere.mesh.vertex_count());
  for (Eigen::Index v = 0; v < sphere.mesh.vertex_count(); ++v) {
    const Vector3 colour = refined[static_cast<size_t>(v)].cast<double>();
    CHECK((colour.normalized() - sphere.mesh.positions.row(v).transpose()).norm() < 1e-6);
  }
  const TriangleMesh& coarse = object.mesh;
  TexturePaint texture;
  texture.texcoords.corners = CornerTexcoords(24, 2);
  for (Eigen::Index corner = 0; corner < 24; ++corner) {
    const Vector3 p = coarse.position(coarse.triangles(corner / 3, corner % 3));
    texture.texcoords.corners.row(corner) << p.x(), p.y();
  }
  object.paint = texture;
  const RenderObject textured = on_sphere(object, object.mesh.positions);
  const auto& uv = std::get<TexturePaint>(textured.paint).texcoords.corners;
  for (Eigen::Index corner = 0; corner < uv.rows(); ++corner) {
    const Vector3 p = textured.mesh.position(textured.mesh.triangles(corner / 3, corner % 3));
    CHECK(std::abs(uv(corner, 0) * p.y() - uv(corner, 1) * p.x()) < 1e-6);
  }
}

TEST_CASE("on_sphere: sides of pieces are seams where they are part of one") {
  RenderObject object = octahedron();
  TexturePaint texture;
  texture.texcoords.corners = CornerTexcoords::Zero(24, 2);
  for (const unsigned wanted : {7u, 7u << 3}) {
    texture.texcoords.seams.assign(8, static_cast<std::uint8_t>(wanted));
    object.paint = texture;
    const RenderObject sphere = on_sphere(object, object.mesh.positions);
    const SeamedTexcoords& cut = std::get<TexturePaint>(sphere.paint).texcoords;
    REQUIRE(sphere.mesh.face_count() > 8);
    REQUIRE(std::ssize(cut.seams) == sphere.mesh.face_count());
    for (Face f = 0; f < sphere.mesh.face_count(); ++f) {
      unsigned sides = 0;  // those in the planes of the octahedron's
      for (int k = 0; k < 3; ++k) {
        const Vector3 a = sphere.mesh.position(sphere.mesh.triangles(f, (k + 1) % 3)),
                      b = sphere.mesh.position(sphere.mesh.triangles(f, (k + 2) % 3));
        if (((a.array() == 0) && (b.array() == 0)).any()) sides |= 1u << k;
      }
      CHECK(cut.seams_of(f) == (wanted == 7 ? sides : sides << 3));
    }
  }
}

TEST_CASE("on_sphere: opposite and equal rays do not keep it busy") {
  RenderObject object = octahedron();
  Points rays = object.mesh.positions;
  rays.row(1) = -rays.row(0);
  rays.row(2) = rays.row(3).eval();
  rays.row(4) = -rays.row(5) + Eigen::RowVector3d(1e-15, 0, 0);
  const RenderObject sphere = on_sphere(object, rays);
  CHECK(sphere.mesh.face_count() < 1000000);
}
