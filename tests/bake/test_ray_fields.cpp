#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "bake/fields/ray_fields.h"
#include "sphparam/parallel.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

using MakeField = SurfaceField(std::shared_ptr<const RayScene>, const TriangleMesh&, const Points&,
                               const RayFieldOptions&);

/// A mesh with smooth normals.
struct Subject {
  TriangleMesh mesh;
  Points normals;

  SurfaceField field(MakeField* make, const RayFieldOptions& options) const {
    return make(std::make_shared<const RayScene>(mesh), mesh, normals, options);
  }
};

Points area_weighted_normals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.triangles.row(f);
    const Vector3 a = mesh.position(corners[0]);
    const Vector3 normal = (mesh.position(corners[1]) - a).cross(mesh.position(corners[2]) - a);
    for (int i = 0; i < 3; ++i) normals.row(corners[i]) += normal;
  }
  normals.rowwise().normalize();
  return normals;
}

Subject ball(int level, double radius = 1) {
  TriangleMesh mesh = icosphere(level);
  const Points normals = mesh.positions;
  mesh.positions *= radius;
  return {mesh, normals};
}

/// A round bowl, open upwards: outside a half ball, inside a deep hollow; closed at the rim. The
/// ring of vertices at the hollow's bottom ends in vertex `bottom`.
Subject cup(int around, double wall, Vertex* bottom) {
  std::vector<Vector3> profile;  // radius, 0, height; outside up, inside down
  for (int i = 0; i <= 8; ++i) profile.emplace_back(1, 0, 2.0 * i / 8);
  for (int i = 8; i >= 1; --i) profile.emplace_back(1 - wall, 0, 2.0 * i / 8);
  const int rings = static_cast<int>(profile.size());
  TriangleMesh mesh{Points(rings * around + 2, 3), Triangles(2 * rings * around, 3)};
  for (int r = 0; r < rings; ++r) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * M_PI * k / around;
      mesh.positions.row(r * around + k) << profile[static_cast<size_t>(r)].x() * std::cos(angle),
          profile[static_cast<size_t>(r)].x() * std::sin(angle),
          profile[static_cast<size_t>(r)].z();
    }
  }
  const int under = rings * around, inner = under + 1;
  mesh.positions.row(under).setZero();
  mesh.positions.row(inner) << 0, 0, profile.back().z();
  int f = 0;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around, last = (rings - 1) * around;
    mesh.triangles.row(f++) << under, next, k;
    mesh.triangles.row(f++) << inner, last + k, last + next;
    for (int r = 0; r + 1 < rings; ++r) {
      const int here = r * around, above = here + around;
      mesh.triangles.row(f++) << here + k, here + next, above + next;
      mesh.triangles.row(f++) << here + k, above + next, above + k;
    }
  }
  *bottom = inner;
  return {mesh, area_weighted_normals(mesh)};
}

SurfaceSample at_middle(Face face, std::uint64_t seed) {
  return {{face, Vector3(0.3, 0.3, 0.4)}, seed};
}

std::vector<SurfaceSample> one_a_face(const TriangleMesh& mesh) {
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < mesh.face_count(); ++f) {
    samples.push_back(at_middle(f, static_cast<std::uint64_t>(f) * 77));
  }
  return samples;
}

std::vector<float> values_of(const SurfaceField& field, const std::vector<SurfaceSample>& samples) {
  std::vector<float> values(samples.size() * static_cast<size_t>(field.channels));
  field.evaluate(samples, values.data());
  return values;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("ray fields: a convex mesh sees all of the sky, however coarse it is") {
  for (const int level : {0, 1, 3}) {
    for (const double size : {1e-6, 1.0, 1e5}) {
      const Subject convex = ball(level, size);
      const auto values = values_of(convex.field(occlusion_field, {.rays = 32, .reach = 1}),
                                    one_a_face(convex.mesh));
      for (const float value : values) CHECK(value == 1);
    }
  }
}

TEST_CASE("ray fields: on a convex mesh the bent normal is the smooth normal") {
  const Subject convex = ball(2);
  const std::vector<SurfaceSample> samples = one_a_face(convex.mesh);
  const auto values = values_of(convex.field(bent_normal_field, {.rays = 16, .reach = 1}), samples);
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto corners = convex.mesh.triangles.row(samples[i].point.face);
    Vector3 normal = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      normal += samples[i].point.barycentric[k] * convex.normals.row(corners[k]).transpose();
    }
    const Eigen::Map<const Eigen::Vector3f> bent(values.data() + 3 * i);
    CHECK(bent.norm() == Approx(1));
    CHECK((bent.cast<double>() - normal.normalized()).norm() < 1e-5);
  }
}

TEST_CASE("ray fields: at hard edges rays are about the normals of the corners") {
  const Subject round = ball(1);  // as vertices have it; the file says that every face is flat
  const auto flat = std::make_shared<CornerNormals>(3 * round.mesh.face_count(), 3);
  for (Face f = 0; f < round.mesh.face_count(); ++f) {
    const auto corner = [&](int k) { return round.mesh.position(round.mesh.triangles(f, k)); };
    const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    for (int k = 0; k < 3; ++k) flat->row(3 * f + k) = normal;
  }
  const auto bent =
      values_of(round.field(bent_normal_field, {.rays = 16, .reach = 1, .corner_normals = flat}),
                {{{3, Vector3::UnitX()}, 5}, {{7, Vector3(0.1, 0.7, 0.2)}, 6}});
  for (int c = 0; c < 3; ++c) {
    CHECK(bent[static_cast<size_t>(c)] == Approx((*flat)(9, c)).margin(1e-6));
    CHECK(bent[static_cast<size_t>(3 + c)] == Approx((*flat)(21, c)).margin(1e-6));
  }
}

TEST_CASE("ray fields: at the bottom of a cup the sky is what its mouth shows of it") {
  Vertex bottom = 0;
  const Subject deep = cup(64, 0.1, &bottom);
  const SurfaceField ao = deep.field(occlusion_field, {.rays = 64, .reach = 1});
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < deep.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (deep.mesh.triangles(f, k) != bottom) continue;
      Vector3 weights = Vector3::Zero();
      weights[k] = 1;
      samples.push_back({{f, weights}, static_cast<std::uint64_t>(f)});
    }
  }
  REQUIRE(samples.size() == 64);
  // A disk of radius r at height h fills r²/(r² + h²) of the cosine-weighted sky.
  const double r = 0.9, h = 2 - 0.25;
  CHECK(mean(values_of(ao, samples)) == Approx(r * r / (r * r + h * h)).margin(0.01));
  // Nothing is met within a hundredth of the box.
  CHECK(mean(values_of(deep.field(occlusion_field, {.reach = 0.01}), samples)) == 1);
  // What is seen of the sky is straight above, and on the wall it is up and inwards.
  const auto bent = values_of(deep.field(bent_normal_field, {.reach = 1}), samples);
  for (size_t i = 0; i < samples.size(); ++i) CHECK(bent[3 * i + 2] > 0.9f);
}

TEST_CASE("ray fields: the bent normal of a wall leans towards the opening") {
  Vertex bottom = 0;
  const Subject deep = cup(64, 0.1, &bottom);
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < deep.mesh.face_count(); ++f) {
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 3; ++k) middle += deep.mesh.position(deep.mesh.triangles(f, k)) / 3;
    const double radius = middle.head<2>().norm();
    if (radius > 0.85 && radius < 0.95 && middle.z() > 0.8 && middle.z() < 1.2) {
      samples.push_back({{f, Vector3::Constant(1.0 / 3)}, static_cast<std::uint64_t>(f)});
    }
  }
  REQUIRE(samples.size() > 20);
  const auto bent = values_of(deep.field(bent_normal_field, {.reach = 1}), samples);
  for (size_t i = 0; i < samples.size(); ++i) CHECK(bent[3 * i + 2] > 0.3f);
}

TEST_CASE("ray fields: the mean chord of a ball is 4/3 of its radius, a slab is twice its depth") {
  for (const double radius : {1e-3, 1.0, 1e6}) {
    const Subject round = ball(4, radius);
    const auto values =
        values_of(round.field(thickness_field, {.reach = 1}), one_a_face(round.mesh));
    CHECK(mean(values) / radius == Approx(4.0 / 3).margin(0.01));
  }
  TriangleMesh sheets{Points(6, 3), Triangles(2, 3)};  // above one another, looking away
  sheets.positions << -4e3, -4e3, 1, 4e3, -4e3, 1, 0, 4e3, 1, -4e3, -4e3, 0, 0, 4e3, 0, 4e3, -4e3,
      0;
  sheets.triangles << 0, 1, 2, 3, 4, 5;
  const Subject slab = {sheets, area_weighted_normals(sheets)};
  std::vector<SurfaceSample> middle;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    middle.push_back(at_middle(static_cast<Face>(seed % 2), seed));
  }
  // ∫ 1/cosθ over the cosine's density is 2.
  CHECK(mean(values_of(slab.field(thickness_field, {.reach = 1}), middle)) ==
        Approx(2).margin(0.05));
}

TEST_CASE("ray fields: rays that meet nothing are as long as their reach") {
  TriangleMesh sheet{Points(3, 3), Triangles(1, 3)};
  sheet.positions << 0, 0, 0, 3, 0, 0, 0, 4, 0;  // diagonal 5
  sheet.triangles << 0, 1, 2;
  const Subject open = {sheet, area_weighted_normals(sheet)};
  const auto values = values_of(open.field(thickness_field, {.reach = 0.5}), {at_middle(0, 1)});
  CHECK(values[0] == Approx(2.5));
}

TEST_CASE("ray fields: how many rays inwards met nothing is told") {
  TriangleMesh sheet{Points(3, 3), Triangles(1, 3)};
  sheet.positions << 0, 0, 0, 3, 0, 0, 0, 4, 0;
  sheet.triangles << 0, 1, 2;
  const Subject open = {sheet, area_weighted_normals(sheet)};
  const SurfaceField field = open.field(thickness_field, {.reach = 1});
  CHECK(field.remark().empty());  // none were cast yet
  values_of(field, {at_middle(0, 1)});
  CHECK(field.remark() ==
        "thickness: 100 % of the rays met nothing, and count as the mesh's whole diagonal: it has "
        "holes there, or is inside out");
  const Subject round = ball(2);
  const SurfaceField closed = round.field(thickness_field, {.reach = 1});
  values_of(closed, one_a_face(round.mesh));
  CHECK(closed.remark().empty());
}

TEST_CASE("ray fields: the same bytes whoever evaluates them and in whatever parts") {
  Vertex bottom = 0;
  const Subject deep = cup(32, 0.2, &bottom);
  const std::vector<SurfaceSample> samples = one_a_face(deep.mesh);
  for (MakeField* make : {occlusion_field, bent_normal_field, thickness_field}) {
    const SurfaceField field = deep.field(make, {.rays = 20});
    const std::vector<float> whole = values_of(field, samples);
    std::vector<float> parts(whole.size());
    const auto channels = static_cast<size_t>(field.channels);
    parallel_for(static_cast<std::int64_t>(samples.size()), 7, 4,
                 [&](std::int64_t first, std::int64_t last) {
                   const auto start = static_cast<size_t>(first);
                   field.evaluate({samples.data() + start, static_cast<size_t>(last) - start},
                                  parts.data() + channels * start);
                 });
    CHECK(parts == whole);
  }
}

TEST_CASE("ray fields: triangles without area and opposed normals give numbers all the same") {
  Subject odd = ball(1);
  odd.mesh.positions.row(3) = odd.mesh.positions.row(odd.mesh.triangles(0, 0));
  odd.normals.row(5) *= -1;
  odd.normals.row(7).setZero();
  for (MakeField* make : {occlusion_field, bent_normal_field, thickness_field}) {
    for (const float value : values_of(odd.field(make, {.rays = 8}), one_a_face(odd.mesh))) {
      CHECK(std::isfinite(value));
    }
  }
}

}  // namespace sphparam
