#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <thread>

#include "bake/field_registry.h"
#include "bake/fields/attribute_fields.h"
#include "bake/fields/normal_fields.h"
#include "scenes.h"
#include "sphparam/chart/tangent_frame.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;

BakeOptions size(int width, int samples = 1) {
  return {.width = width, .height = width / 2, .samples = samples, .threads = 1};
}

SurfaceField constant(float value, FieldKind kind) {
  SurfaceField field{.name = "constant", .channels = 3, .kind = kind};
  field.evaluate = [value](std::span<const SurfaceSample> samples, float* values) {
    std::fill_n(values, 3 * samples.size(), value);
  };
  return field;
}

/// Bilinear, periodic in u, over a pole half a turn away.
Vector3 looked_up(const std::vector<float>& values, int width, double u, double v) {
  const int height = width / 2;
  const double x = u * width - 0.5, y = v * height - 0.5;
  const auto texel = [&](int column, int row) {
    if (row < 0 || row >= height) {
      row = row < 0 ? -1 - row : 2 * height - 1 - row;
      column += width / 2;
    }
    column = ((column % width) + width) % width;
    const float* p = &values[3 * static_cast<size_t>(row * width + column)];
    return Vector3(p[0], p[1], p[2]);
  };
  const int c = static_cast<int>(std::floor(x)), r = static_cast<int>(std::floor(y));
  const double s = x - c, t = y - r;
  return (1 - t) * ((1 - s) * texel(c, r) + s * texel(c + 1, r)) +
         t * ((1 - s) * texel(c, r + 1) + s * texel(c + 1, r + 1));
}

/// A rounded body that is no sphere, mapped by its directions.
TriangleMesh body() {
  TriangleMesh mesh = icosphere(3);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(static_cast<Vertex>(v));
    mesh.positions.row(v) = (1 + 0.3 * x[0] * x[1] + 0.2 * x[2]) * x;
  }
  return mesh;
}

}  // namespace

TEST_CASE("bake: a constant bakes to that constant, however it is sampled and filtered") {
  const auto scene = sphere_scene(icosphere(4));  // at 16 × 8 texels, many triangles a texel
  for (const int samples : {1, 3}) {
    for (const FieldKind kind : {FieldKind::Data, FieldKind::Label}) {
      for (const int width : {16, 128}) {
        for (const float value : baked(*scene, constant(0.625F, kind), size(width, samples))) {
          REQUIRE(value == Approx(0.625).epsilon(1e-6));
        }
      }
    }
    for (const float value : baked(*scene, constant(0.5F, FieldKind::Colour), size(64, samples))) {
      REQUIRE(value == Approx(0.21404).epsilon(1e-4));  // sRGB ½ is this much light
    }
  }
}

TEST_CASE(
    "bake: position, looked up at points of the surface, converges as piecewise linear does") {
  // Mean error ×4 a doubling; the maximum, at kinks, ×2.
  const TriangleMesh mesh = body();
  const auto scene = sphere_scene(mesh);
  const SurfaceField position = make_position(*scene, "");
  const SphericalChart& chart = scene->target.chart;
  std::vector<double> means, maxima;
  for (const int width : {256, 512, 1024, 2048}) {
    const std::vector<float> image = baked(*scene, position, size(width));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    double sum = 0, maximum = 0;
    int count = 0;
    while (count < 20000) {
      const auto f = static_cast<Face>(unit(random) * static_cast<double>(chart.triangles.rows()));
      if (chart.pole_corner(f) >= 0) continue;
      double a = unit(random), b = unit(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const Vector3 weights(a, b, 1 - a - b);
      Eigen::RowVector2d uv(0, 0);
      Vector3 point = Vector3::Zero();
      for (int k = 0; k < 3; ++k) {
        uv += weights[k] * chart.uv.row(chart.wedges(f, k));
        point += weights[k] * scene->target.positions.row(chart.triangles(f, k)).transpose();
      }
      if (uv[1] < 0.1 || uv[1] > 0.9) continue;
      const double error = (looked_up(image, width, uv[0], uv[1]) - point).norm();
      sum += error;
      maximum = std::max(maximum, error);
      ++count;
    }
    means.push_back(sum / count);
    maxima.push_back(maximum);
  }
  for (size_t i = 1; i < means.size(); ++i) {
    INFO(i << ": mean " << means[i] << ", maximum " << maxima[i]);
    CHECK(means[i - 1] / means[i] > 3.2);
    CHECK(maxima[i - 1] / maxima[i] > 1.6);
  }
}

TEST_CASE("bake: what is linear on a triangle is exact at the centres of its texels") {
  const TriangleMesh mesh = body();
  const auto scene = sphere_scene(mesh);
  const int width = 512;
  const std::vector<float> image = baked(*scene, make_position(*scene, ""), size(width));
  const TexelOwners owners(scene->target.chart, width, width / 2);
  for (int b = 0; b < owners.band_count(); ++b) {
    const OwnerBand band = owners.band(b);
    for (size_t i = 0; i < band.faces.size(); ++i) {
      Vector3 point = Vector3::Zero();
      for (int k = 0; k < 3; ++k) {
        point += band.barycentric(i)[k] *
                 scene->target.positions.row(scene->target.chart.triangles(band.faces[i], k))
                     .transpose();
      }
      const float* texel = &image[3 * (static_cast<size_t>(band.first_row * width) + i)];
      REQUIRE((Vector3(texel[0], texel[1], texel[2]) - point).norm() < 1e-6);
    }
  }
}

TEST_CASE("bake: with N x N samples a texel is the mean of what its points show") {
  const auto scene = sphere_scene(icosphere(1));  // no triangle is small, so no texel is crowded
  const int width = 64, n = 3;
  const std::vector<float> image = baked(*scene, make_position(*scene, ""), size(width, n));
  const SphericalChart& chart = scene->target.chart;
  const TexelOwners owners(chart, width, width / 2);
  std::vector<Vector3> sums(image.size() / 3, Vector3::Zero());
  for (int s = 0; s < n * n; ++s) {
    const OwnerBand band = owners.band(0, (s % n + 0.5) / n, (s / n + 0.5) / n);
    for (size_t i = 0; i < sums.size(); ++i)
      for (int k = 0; k < 3; ++k)
        sums[i] += band.barycentric(i)[k] *
                   scene->target.positions.row(chart.triangles(band.faces[i], k)).transpose() /
                   (n * n);
  }
  for (size_t i = 0; i < sums.size(); ++i)
    REQUIRE((Vector3(image[3 * i], image[3 * i + 1], image[3 * i + 2]) - sums[i]).norm() < 1e-6);
}

TEST_CASE("bake: with --interp sphere a texel shows what lies in its direction") {
  const TriangleMesh mesh = body();
  const auto scene = sphere_scene(mesh);
  const SphereLocator locator(scene->source.mapped->topology(), scene->source.mapped->map());
  const int width = 128;
  BakeOptions options = size(width);
  options.interpolation = Interpolation::Sphere;
  const std::vector<float> image = baked(*scene, make_position(*scene, ""), options);
  for (int row = 0; row < width / 2; ++row) {
    for (int column = 0; column < width; ++column) {
      const SurfacePoint at = locator.locate(
          to_cartesian({2 * pi * (column + 0.5) / width, 2 * pi * (row + 0.5) / width}));
      Vector3 point = Vector3::Zero();
      for (int k = 0; k < 3; ++k) {
        point += at.barycentric[k] * mesh.position(mesh.triangles(at.face, k));
      }
      const float* texel = &image[3 * static_cast<size_t>(row * width + column)];
      REQUIRE((Vector3(texel[0], texel[1], texel[2]) - point).norm() < 1e-6);
    }
  }
}

TEST_CASE("bake: for another mesh on the same sphere, detail comes from the source") {
  // The coarse mesh has few triangles; the fine one's positions appear at its texels all the same.
  const TriangleMesh fine = body();
  auto scene = sphere_scene(fine);
  MeshFile low;
  low.mesh = icosphere(1);
  scene->target = make_target(low, Topology(low.mesh), SphereMap{low.mesh.positions}, false, 1);
  const int width = 128;
  const std::vector<float> image = baked(*scene, make_position(*scene, ""), size(width));
  const TexelOwners owners(scene->target.chart, width, width / 2);
  const SphereLocator locator(scene->source.mapped->topology(), scene->source.mapped->map());
  const OwnerBand band = owners.band(1);
  for (size_t i = 0; i < band.faces.size(); ++i) {
    Vector3 direction = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      direction += band.barycentric(i)[k] *
                   scene->target.chart.points.row(scene->target.chart.triangles(band.faces[i], k))
                       .transpose();
    }
    const SurfacePoint at = locator.locate(direction);
    Vector3 point = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      point += at.barycentric[k] * fine.position(fine.triangles(at.face, k));
    }
    const float* texel = &image[3 * (static_cast<size_t>(band.first_row * width) + i)];
    REQUIRE((Vector3(texel[0], texel[1], texel[2]) - point).norm() < 1e-6);
  }
}

TEST_CASE("bake: a limb that is smaller than a texel has its mean colour there") {
  // A ball with a limb: the limb's faces are shrunk to a hundredth of a texel on the sphere, but
  // have nearly all the surface around there.
  TriangleMesh mesh = icosphere(4);
  SphereMap map{mesh.positions};
  // A place in the middle of a texel of 32 × 16, far from its borders.
  const double theta = 2 * pi * 10.5 / 32, phi = pi * 6.5 / 16;
  const Vector3 tip = to_cartesian({theta, phi});
  std::vector<char> limb(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(static_cast<Vertex>(v));
    const double angle = std::acos(std::clamp(x.dot(tip), -1.0, 1.0));
    if (angle > 0.5) continue;
    limb[static_cast<size_t>(v)] = 1;
    // On the surface: pulled out by 20. On the sphere: pulled together by 100, what is around it
    // fills the gap.
    mesh.positions.row(v) = 20 * x;
    map.points.row(v) = (tip + 0.01 * (x - tip)).normalized();
  }
  MeshFile file;
  file.mesh = mesh;
  Property red{"limb", ScalarType::Float64, {}};
  for (const char is_limb : limb) red.values.push_back(is_limb);
  file.set_vertex_property(red);
  const auto scene = scene_of(file, map);
  REQUIRE(scene->target.chart.certificate.one_to_one());
  const std::vector<float> image = baked(*scene, make_scalar(*scene, "limb"), size(32));
  CHECK(image[6 * 32 + 10] > 0.8F);    // of its surface, nearly all is limb
  CHECK(image[12 * 32 + 26] == 0.0F);  // the other side of the ball knows nothing of it

  // By direction too: on the sphere, and for another mesh.
  BakeOptions options = size(32);
  options.interpolation = Interpolation::Sphere;
  CHECK(baked(*scene, make_scalar(*scene, "limb"), options)[6 * 32 + 10] > 0.5F);
  MeshFile low;
  low.mesh = icosphere(1);
  scene->target = make_target(low, Topology(low.mesh), SphereMap{low.mesh.positions}, false, 1);
  const std::vector<float> other = baked(*scene, make_scalar(*scene, "limb"), size(32));
  CHECK(*std::max_element(other.begin(), other.end()) > 0.5F);
}

TEST_CASE("bake: columns 0 and W − 1 are neighbours, and rows 0 are of the poles") {
  const auto scene = sphere_scene(body());
  const int width = 256;
  const std::vector<float> image = baked(*scene, make_position(*scene, ""), size(width));
  const auto at = [&](int row, int column) {
    const float* p = &image[3 * static_cast<size_t>(row * width + column)];
    return Vector3(p[0], p[1], p[2]);
  };
  double step = 0;  // between neighbours anywhere
  for (int row = 0; row < width / 2; ++row) {
    for (int column = 1; column < width; ++column) {
      step = std::max(step, (at(row, column) - at(row, column - 1)).norm());
    }
  }
  for (int row = 0; row < width / 2; ++row) {
    CHECK((at(row, 0) - at(row, width - 1)).norm() <= step);
  }
  const Vector3 north = scene->target.positions.row(scene->target.chart.north);
  for (int column = 0; column < width; ++column) CHECK((at(0, column) - north).norm() < 0.03);
}

TEST_CASE("bake: same values for any number of threads") {
  const auto scene = sphere_scene(body());
  SurfaceField seeds{.name = "seeds"};
  seeds.evaluate = [](std::span<const SurfaceSample> samples, float* values) {
    for (const SurfaceSample& s : samples) *values++ = static_cast<float>(s.seed >> 40);
  };
  BakeOptions options = size(160, 2);
  const std::vector<float> one = baked(*scene, seeds, options);
  options.threads = 3;
  CHECK(one == baked(*scene, seeds, options));
}

TEST_CASE("bake: a cancelled bake throws") {
  const auto scene = sphere_scene(icosphere(1));
  BakeOptions options = size(64);
  options.progress = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(baked(*scene, make_position(*scene, ""), options), Cancelled);
}

TEST_CASE("bake: a slow field is cancelled within a few samples, not at the end of its rows") {
  const auto scene = sphere_scene(icosphere(1));
  for (const int threads : {1, 3}) {
    std::atomic<int> seen = 0;
    SurfaceField slow{.name = "slow"};
    slow.evaluate = [&seen](std::span<const SurfaceSample> samples, float* values) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::fill_n(values, samples.size(), 0.0F);
      seen += static_cast<int>(samples.size());
    };
    BakeOptions options = size(1024);
    options.threads = threads;
    options.progress = [&seen](std::string_view, double) { return seen == 0; };
    CHECK_THROWS_AS(baked(*scene, slow, options), Cancelled);
    CHECK(seen < 32 * 1024);
  }
}

TEST_CASE("id: labels have colours of their own in 8 bits, and none has none's") {
  MeshFile file;
  file.mesh = icosphere(5);
  Property polygons{"source_face", ScalarType::Int32, {}};
  // Numbers far apart and near each other.
  for (Face f = 0; f < file.mesh.face_count(); ++f) polygons.values.push_back(819 * f);
  file.set_face_property(polygons);
  const SphereMap map = normalised(file.mesh.positions);
  const auto scene = scene_of(file, map);
  scene->ids_as_colours = true;
  const SurfaceField field = make_id(*scene, "face");
  CHECK(field.range == std::pair(0.0, 1.0));
  std::set<std::array<int, 3>> colours = {{0, 0, 0}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    const SurfaceRun run{f, 1, Vector3(1, 0, 0), Vector3::Zero(), Vector3::Zero()};
    std::array<float, 3> rgb;
    field.evaluate_runs(std::span(&run, 1), rgb.data());
    std::array<int, 3> bytes;
    for (size_t c = 0; c < 3; ++c) bytes[c] = static_cast<int>(std::lround(255 * rgb[c]));
    colours.insert(bytes);
  }
  CHECK(std::ssize(colours) == file.mesh.face_count() + 1);
}

TEST_CASE("scalar: whole numbers are labels, never mixed, of two corners and one the two win") {
  MeshFile file;
  file.mesh = icosphere(2);
  Property parcel{"parcel", ScalarType::Int32, {}}, patch{"patch", ScalarType::Uint8, {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) parcel.values.push_back(100 * (v % 3) - 7);
  for (Face f = 0; f < file.mesh.face_count(); ++f) patch.values.push_back(f % 2 ? 9 : 200);
  file.set_face_property(patch);
  file.vertex_properties.push_back(parcel);
  const SphereMap map = normalised(file.mesh.positions);
  const auto scene = scene_of(file, map);
  const std::set<float> parcels = {-7, 93, 193}, patches = {9, 200};
  for (const int samples : {1, 3}) {
    for (const float value : baked(*scene, make_scalar(*scene, "parcel"), size(64, samples))) {
      REQUIRE(parcels.count(value) == 1);
    }
    for (const float value : baked(*scene, make_scalar(*scene, "patch"), size(64, samples))) {
      REQUIRE(patches.count(value) == 1);
    }
  }

  Property two_and_one{"label", ScalarType::Int8, {}};
  two_and_one.values.resize(static_cast<size_t>(file.mesh.vertex_count()), 3);
  for (const int corner : {0, 1}) {
    two_and_one.values[static_cast<size_t>(file.mesh.triangles(0, corner))] = 5;
  }
  file.vertex_properties.front() = two_and_one;
  const auto labelled = scene_of(file, map);
  const auto at = [&](const Vector3& weights) {
    const SurfaceRun run{0, 1, weights, Vector3::Zero(), Vector3::Zero()};
    float label = 0;
    make_scalar(*labelled, "label").evaluate_runs(std::span(&run, 1), &label);
    return label;
  };
  CHECK(at({0.3, 0.3, 0.4}) == 5);
  CHECK(at({0.2, 0.2, 0.6}) == 3);
  CHECK(at({0.25, 0.25, 0.5}) == 3);  // the lowest of several
}

TEST_CASE("basecolor: a face without a material is white, also where there is but one material") {
  MeshFile file;
  file.mesh = icosphere(2);
  Property material{"material", ScalarType::Int32, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) material.values.push_back(f % 2 == 0 ? 0 : -1);
  file.set_face_property(material);
  const SphereMap map = normalised(file.mesh.positions);
  const auto scene = scene_of(file, map);
  scene->source.textures = {{.factor = {0.25F, 0, 0, 1}}};
  const auto red = [&](Face f) {
    const SurfaceRun run{f, 1, Vector3::Constant(1 / 3.0), Vector3::Zero(), Vector3::Zero()};
    std::array<float, 3> rgb;
    make_field("basecolor", *scene).evaluate_runs(std::span(&run, 1), rgb.data());
    return rgb[0];
  };
  CHECK(red(0) == Approx(0.25));
  CHECK(red(1) == Approx(1));
  scene->source.one_texture_for_all = true;
  CHECK(red(1) == Approx(0.25));
}

TEST_CASE("normal-tangent: of the mesh itself it is (0, 0, 1), and a viewer gets back any normal") {
  const auto scene = sphere_scene(icosphere(3));
  const std::vector<float> own = baked(*scene, make_tangent_normal(*scene, ""), size(128));
  for (size_t i = 0; i < own.size(); i += 3) REQUIRE(own[i + 2] > 0.9999F);

  auto turned = sphere_scene(icosphere(3));
  for (auto normal : turned->source.normals.rowwise()) {
    normal = (normal + Eigen::RowVector3d(0.1, -0.2, 0.15)).normalized();
  }
  const int width = 64;
  const std::vector<float> object = baked(*turned, make_object_normal(*turned, ""), size(width)),
                           tangent = baked(*turned, make_tangent_normal(*turned, ""), size(width));
  const SphericalChart& chart = turned->target.chart;
  const ShadingFrame frame = tangent_frame(chart, turned->target.positions, turned->target.normals);
  const TexelOwners owners(chart, width, width / 2);
  const OwnerBand band = owners.band(0);
  for (size_t i = 0; i < band.faces.size(); ++i) {
    Vector3 t = Vector3::Zero(), n = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int wedge = chart.wedges(band.faces[i], k);
      t += band.barycentric(i)[k] * frame.tangents.row(wedge).head<3>();
      n += band.barycentric(i)[k] * frame.normals.row(wedge);
    }
    const float* texel = &tangent[3 * i];
    const Vector3 read =
        (static_cast<double>(texel[0]) * t + static_cast<double>(texel[1]) * n.cross(t) +
         static_cast<double>(texel[2]) * n)
            .normalized();
    REQUIRE((read - Vector3(object[3 * i], object[3 * i + 1], object[3 * i + 2])).norm() < 1e-5);
  }
}

TEST_CASE("normal-tangent: x turns round with u, y where it is asked to") {
  auto scene = sphere_scene(icosphere(2));
  for (auto normal : scene->source.normals.rowwise()) {
    normal = (normal + Eigen::RowVector3d(0.2, 0.1, 0.3)).normalized();
  }
  const std::vector<float> plain = baked(*scene, make_tangent_normal(*scene, ""), size(32));
  scene->mirrored = scene->options.normal_y_down = true;
  const std::vector<float> turned = baked(*scene, make_tangent_normal(*scene, ""), size(32));
  for (size_t i = 0; i < plain.size(); i += 3) {
    CHECK(turned[i] == -plain[i]);
    CHECK(turned[i + 1] == -plain[i + 1]);
    CHECK(turned[i + 2] == plain[i + 2]);
  }
}

TEST_CASE("uv: the texture coordinates of the corners, t upwards, and a range that holds them") {
  MeshFile file;
  file.mesh = icosphere(1);
  file.corner_texcoords.emplace(3 * file.mesh.face_count(), 2);
  for (Eigen::Index i = 0; i < file.corner_texcoords->rows(); ++i) {
    const auto x = static_cast<double>(i);
    file.corner_texcoords->row(i) << x, -2 * x;
  }
  const auto scene = scene_of(file, SphereMap{file.mesh.positions});
  const SurfaceField field = make_field("uv", *scene);
  CHECK(field.range == std::pair(-2.0 * (3.0 * 80 - 1), 3.0 * 80 - 1));
  for (const Face f : {0, 7, 79}) {
    const SurfaceRun run{f, 1, {0.5, 0.3, 0.2}, Vector3::Zero(), Vector3::Zero()};
    std::array<float, 3> value{};
    field.evaluate_runs(std::span(&run, 1), value.data());
    CHECK(value[0] == Approx(3 * f + 0.7));
    CHECK(value[1] == Approx(-2 * (3 * f + 0.7)));
    CHECK(value[2] == 0);
  }
}

TEST_CASE("maps: what a mesh has not is said, with what it has") {
  const auto scene = sphere_scene(icosphere(1));
  const auto complaint = [&](const std::string& map) -> std::string {
    try {
      make_field(map, *scene);
      return "";
    } catch (const FieldError& error) {
      return error.what();
    }
  };
  CHECK(complaint("position").empty());
  CHECK(complaint("basecolor").find("no texture and no colours") != std::string::npos);
  CHECK(complaint("vcolor").find("no colours") != std::string::npos);
  CHECK(complaint("uv").find("no texture coordinates") != std::string::npos);
  CHECK(complaint("scalar:heat").find("no such property") != std::string::npos);
  CHECK(complaint("id:material").find("no materials") != std::string::npos);
  CHECK(complaint("position:what").find("nothing can follow") != std::string::npos);
  CHECK(complaint("basecolor:nonsense").find("nothing can follow") != std::string::npos);
  CHECK(complaint("ao:").find("nothing can follow") != std::string::npos);
  CHECK(complaint("id:colour").find("id:face") != std::string::npos);
}
