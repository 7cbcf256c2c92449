#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>

#include "geodesic_sphere.h"
#include "image/image_codec.h"
#include "level_set.h"
#include "noise.h"
#include "relaxation_on_surface.h"
#include "sample_meshes.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "support/places.h"

using namespace sphparam;
using namespace sphparam::samples;
using Catch::Detail::Approx;

namespace {

Vector3 face_normal(const TriangleMesh& mesh, Eigen::Index f) {  // of length twice the area
  const Vector3 a = mesh.position(mesh.triangles(f, 0));
  return (mesh.position(mesh.triangles(f, 1)) - a).cross(mesh.position(mesh.triangles(f, 2)) - a);
}

Vector3 face_centre(const TriangleMesh& mesh, Eigen::Index f) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k) sum += mesh.position(mesh.triangles(f, k));
  return sum / 3;
}

/// 1 for an equilateral triangle, 0 for a degenerate one.
double shape_quality(const TriangleMesh& mesh, Eigen::Index f) {
  double squares = 0;
  for (int k = 0; k < 3; ++k) {
    squares += (mesh.position(mesh.triangles(f, k)) - mesh.position(mesh.triangles(f, (k + 1) % 3)))
                   .squaredNorm();
  }
  return 2 * std::sqrt(3.0) * face_normal(mesh, f).norm() / squares;
}

double mean_quality(const TriangleMesh& mesh) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) sum += shape_quality(mesh, f);
  return sum / static_cast<double>(mesh.face_count());
}

void check_sample(const sphparam::MeshFile& file) {
  const MeshInspection inspection = inspect_mesh(file.mesh);
  CHECK(inspection.is_sphere());
  CHECK(inspection.euler_characteristic == 2);
  CHECK(inspection.defects.empty());
  CHECK(inspection.volume > 0);
  REQUIRE(file.vertex_properties.size() == 3);
  for (const sphparam::Property& colour : file.vertex_properties) {
    CHECK(colour.type == sphparam::ScalarType::Uint8);
    REQUIRE(colour.values.size() == static_cast<size_t>(file.mesh.vertex_count()));
    const auto [low, high] = std::minmax_element(colour.values.begin(), colour.values.end());
    CHECK(*low >= 0);
    CHECK(*high <= 255);
    CHECK(*high - *low > 50);  // not one colour
  }
}

}  // namespace

TEST_CASE("geodesic_sphere: 10f²+2 vertices of length 1, 20f² triangles, closed and genus 0") {
  for (const int f : {1, 2, 3, 7}) {
    const GeodesicSphere sphere = geodesic_sphere(f, 0.03);
    CHECK(sphere.mesh.vertex_count() == 10 * f * f + 2);
    CHECK(sphere.mesh.face_count() == 20 * f * f);
    CHECK(inspect_mesh(sphere.mesh).is_sphere());
    CHECK((sphere.mesh.positions.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
    for (Eigen::Index t = 0; t < sphere.mesh.face_count(); ++t) {
      CHECK(face_normal(sphere.mesh, t).dot(face_centre(sphere.mesh, t)) > 0);
    }
  }
}

TEST_CASE("geodesic_sphere: the atlas shows at each corner's texture coordinates its direction") {
  const GeodesicSphere sphere = geodesic_sphere(6, 0.03);
  for (Eigen::Index f = 0; f < sphere.mesh.face_count(); ++f) {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k) centre += sphere.texcoords.row(3 * f + k) / 3;
    for (int k = 0; k < 3; ++k) {
      // A hair inside the triangle: corners may lie on the border of a square.
      const Eigen::RowVector2d uv = 0.999 * sphere.texcoords.row(3 * f + k) + 0.001 * centre;
      const Vector3 corner = sphere.mesh.position(sphere.mesh.triangles(f, k));
      CHECK((atlas_direction(uv.x(), uv.y(), 0.03) - corner).norm() < 1e-3);
    }
  }
}

TEST_CASE("noise: is 0 at lattice points, smooth, within bounds and not constant") {
  double low = 0, high = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p = 5 * random_direction(1, static_cast<std::uint64_t>(i));
    const double value = noise(p, 7);
    CHECK(std::abs(noise(p + Vector3(1e-6, 0, 0), 7) - value) < 1e-5);
    low = std::min(low, value), high = std::max(high, value);
  }
  CHECK(noise({2, -3, 4}, 7) == 0);
  CHECK(low < -0.5);
  CHECK(high > 0.5);
  CHECK(high < 1.2);
}

TEST_CASE("level_set: two merged balls are one closed oriented surface, vertices on it") {
  const Field balls = [](const Vector3& p) {
    return std::min((p - Vector3(0.5, 0, 0)).norm(), (p + Vector3(0.5, 0, 0)).norm()) - 0.8;
  };
  const TriangleMesh mesh = level_set(balls, {-1.6, -1.1, -1.1}, {1.6, 1.1, 1.1}, 0.17);
  const MeshInspection inspection = inspect_mesh(mesh);
  CHECK(inspection.is_sphere());
  // Two balls less the lens: two caps of height 0.8 − 0.5.
  const double pi = std::numbers::pi, cap = pi * 0.3 * 0.3 * (3 * 0.8 - 0.3) / 3;
  CHECK(inspection.volume == Approx(2 * (4 * pi / 3 * 0.512 - cap)).epsilon(0.03));
}

TEST_CASE(
    "relaxed_on_surface: triangles get better, stay on the surface, and the sphere a sphere") {
  const Field ellipsoid = [](const Vector3& p) {
    return Vector3(p.x() / 2, p.y(), p.z()).norm() - 1;
  };
  const TriangleMesh rough = level_set(ellipsoid, {-2.2, -1.2, -1.2}, {2.2, 1.2, 1.2}, 0.25);
  const TriangleMesh mesh = relaxed_on_surface(rough, ellipsoid, {.rounds = 15});
  CHECK(inspect_mesh(mesh).is_sphere());
  CHECK(mesh.face_count() == rough.face_count());
  CHECK(mean_quality(rough) < 0.85);
  CHECK(mean_quality(mesh) > 0.93);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(std::abs(ellipsoid(mesh.positions.row(v))) < 1e-3);
  }
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    CHECK(face_normal(mesh, f).dot(face_centre(mesh, f)) > 0);
  }
}

TEST_CASE("samples: the body is a sphere of the asked size, star-shaped, with its atlas") {
  const sphparam::MeshFile body = make_body(12);
  check_sample(body);
  CHECK(body.mesh.face_count() == 20 * 12 * 12);
  for (Eigen::Index f = 0; f < body.mesh.face_count(); ++f) {
    CHECK(face_normal(body.mesh, f).dot(face_centre(body.mesh, f)) > 0);
  }
  REQUIRE(body.corner_texcoords);
  CHECK(body.corner_texcoords->rows() == 3 * body.mesh.face_count());
  CHECK(body.corner_texcoords->minCoeff() > 0);
  CHECK(body.corner_texcoords->maxCoeff() < 1);
}

TEST_CASE("samples: the body's texture agrees with its vertex colours") {
  const sphparam::MeshFile body = make_body(12);
  const sphparam::Image texture = make_body_texture(176);
  double worst = 0, sum = 0;
  for (Eigen::Index c = 0; c < 3 * body.mesh.face_count(); ++c) {
    const Vertex v = body.mesh.triangles(c / 3, static_cast<int>(c % 3));
    const double u = (*body.corner_texcoords)(c, 0), w = (*body.corner_texcoords)(c, 1);
    const float* texel = texture.pixel(static_cast<int>(u * texture.width),
                                       static_cast<int>((1 - w) * texture.height));
    const double difference =
        std::abs(texel[0] - body.vertex_properties[0].values[static_cast<size_t>(v)] / 255);
    worst = std::max(worst, difference);
    sum += difference;
  }
  CHECK(sum / static_cast<double>(3 * body.mesh.face_count()) < 0.01);
  CHECK(worst < 0.3);  // the rim of a fresh crater lies within one texel
}

TEST_CASE("samples: the texture in textures/ is the one that the program makes") {
  const auto path = tests::source_folder() / "textures" / "body.png";
  const sphparam::Image stored = sphparam::read_image(path.string());
  const sphparam::Image made = make_body_texture();
  REQUIRE(stored.width == made.width);
  REQUIRE(stored.height == made.height);
  REQUIRE(stored.channels == 3);
  double sum = 0;
  for (size_t i = 0; i < made.pixels.size(); ++i) {
    sum += std::abs(made.pixels[i] - stored.pixels[i]);
  }
  // Rounding to bytes alone gives ¼ of a step; another libm may add a little.
  CHECK(sum / static_cast<double>(made.pixels.size()) < 0.5 / 255);
}

TEST_CASE("samples: the creature is a sphere with limbs and triangles of good shape") {
  const sphparam::MeshFile creature = make_creature();
  check_sample(creature);
  CHECK(creature.mesh.face_count() > 15000);
  CHECK(creature.mesh.face_count() < 25000);
  CHECK(mean_quality(creature.mesh) > 0.93);
  // Limbs: the shape fills little of its hull's box.
  const MeshInspection inspection = inspect_mesh(creature.mesh);
  CHECK(inspection.volume < 0.1 * (inspection.upper - inspection.lower).prod());
}

TEST_CASE("samples: the cortex is a sphere, deeply folded, with overhangs") {
  const sphparam::MeshFile cortex = make_cortex();
  check_sample(cortex);
  CHECK(cortex.mesh.face_count() == 40500);
  const MeshInspection inspection = inspect_mesh(cortex.mesh);
  // Area against that of the ball of the same volume.
  const double ball = std::cbrt(36 * std::numbers::pi * inspection.volume * inspection.volume);
  CHECK(inspection.area > 1.8 * ball);
  double hanging = 0;
  for (Eigen::Index f = 0; f < cortex.mesh.face_count(); ++f) {
    const Vector3 normal = face_normal(cortex.mesh, f);
    if (normal.dot(face_centre(cortex.mesh, f)) < 0) hanging += normal.norm() / 2;
  }
  CHECK(hanging > 0.05 * inspection.area);
}

TEST_CASE("samples: the comet is a sphere of two lobes, with cliffs that hang over") {
  const sphparam::MeshFile comet = make_comet();
  check_sample(comet);
  CHECK(comet.mesh.face_count() > 10000);
  CHECK(comet.mesh.face_count() < 60000);
  CHECK(mean_quality(comet.mesh) > 0.9);
  double hanging = 0, area = 0;
  for (Eigen::Index f = 0; f < comet.mesh.face_count(); ++f) {
    const Vector3 normal = face_normal(comet.mesh, f);
    area += normal.norm();
    if (normal.dot(face_centre(comet.mesh, f)) < 0) hanging += normal.norm();
  }
  CHECK(hanging > 0.01 * area);
  CHECK(hanging < 0.1 * area);
}

TEST_CASE("samples: each vertex of the cortex has a lobe that the label table names") {
  sphparam::MeshFile cortex = make_cortex();
  add_lobes(cortex);
  const sphparam::Property* lobe = cortex.find_vertex_property("lobe");
  REQUIRE(lobe != nullptr);
  CHECK(lobe->type == sphparam::ScalarType::Int32);
  REQUIRE(lobe->values.size() == static_cast<size_t>(cortex.mesh.vertex_count()));
  const std::set<double> used(lobe->values.begin(), lobe->values.end());
  CHECK(used == std::set<double>{1, 2, 3, 4, 5, 6, 7, 8});
  REQUIRE(cortex.comments.size() == 8);
  for (size_t i = 0; i < 8; ++i) {
    CHECK(cortex.comments[i].rfind("gifti label " + std::to_string(i + 1) + " ", 0) == 0);
    const char* side = i % 2 == 0 ? " left " : " right ";
    CHECK(cortex.comments[i].find(side) != std::string::npos);
  }
}

TEST_CASE("samples: every run makes the same numbers") {
  CHECK(make_body(9).mesh.positions == make_body(9).mesh.positions);
  CHECK((make_body_texture(20).pixels == make_body_texture(20).pixels));
}
