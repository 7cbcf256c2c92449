#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/vertex_normals.h"
#include "render/drawing_size.h"
#include "render/figure.h"
#include "render/render.h"
#include "render/sky_visibility.h"
#include "sphparam/sphere/sphere_map.h"
#include "support/test_meshes.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using Catch::Detail::Approx;

namespace {

RenderScene ball_scene(int size) {
  RenderScene scene;
  scene.width = scene.height = size;
  scene.camera.height = 2.5;
  RenderObject object;
  object.mesh = tests::icosphere(4);
  scene.objects.push_back(object);
  return scene;
}

bool is_background(const Image& image, int x, int y) {
  const float* p = image.pixel(x, y);
  return p[0] == 1 && p[1] == 1 && p[2] == 1;
}

double share_covered(const Image& rgba) {
  double sum = 0;
  for (int y = 0; y < rgba.height; ++y) {
    for (int x = 0; x < rgba.width; ++x) sum += rgba.pixel(x, y)[3];
  }
  return sum / (rgba.width * rgba.height);
}

SourceTexture texture_of(const Image& image) {
  return {.image = std::make_shared<const TexturePyramid>(image)};
}

/// A square that fills the picture, the whole texture on it.
RenderScene textured_square(const Image& texture, int size) {
  RenderScene scene;
  scene.width = scene.height = size;
  scene.camera = {Vector3(0, 0.5, 0.5), Vector3::UnitX(), Vector3::UnitZ(), 1};
  RenderObject object;
  object.mesh.positions.resize(4, 3);
  object.mesh.positions << 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1;
  object.mesh.triangles.resize(2, 3);
  object.mesh.triangles << 0, 1, 2, 0, 2, 3;
  TexturePaint paint;
  paint.texcoords.corners.resize(6, 2);
  paint.texcoords.corners << 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1;
  paint.textures = {texture_of(texture)};
  object.paint = paint;
  scene.objects.push_back(object);
  return scene;
}

/// Red wins clearly over the other channels.
bool reddish(const float* p) { return p[0] > 2 * p[1] && p[0] > 2 * p[2]; }
bool greenish(const float* p) { return p[1] > 2 * p[0] && p[1] > 2 * p[2]; }

}  // namespace

TEST_CASE("render: a ball covers the disk that it should, corners are background") {
  RenderScene scene = ball_scene(200);
  const Image opaque = render(scene);
  CHECK(opaque.channels == 3);
  CHECK(is_background(opaque, 0, 0));
  CHECK(is_background(opaque, 199, 199));
  CHECK_FALSE(is_background(opaque, 100, 100));
  scene.background.reset();
  // π r² / height² with r = 1
  CHECK(share_covered(render(scene)) == Approx(std::numbers::pi / 6.25).epsilon(0.005));
}

TEST_CASE("render: a perspective eye sees less of a ball, and it looks larger") {
  RenderScene scene = ball_scene(200);
  scene.background.reset();
  scene.camera.field_of_view = 60;
  // Eye at distance 1.25/tan 30°; the silhouette's circle has tangent 1/√(d²−1).
  const double distance = 1.25 / std::tan(std::numbers::pi / 6);
  const double radius = distance / std::sqrt(distance * distance - 1);
  CHECK(share_covered(render(scene)) ==
        Approx(std::numbers::pi * radius * radius / 6.25).epsilon(0.005));
}

TEST_CASE("render: the nearer of two objects is seen, whatever their order") {
  RenderScene scene = ball_scene(50);
  scene.objects[0].paint = UniformPaint{Rgb(0.9F, 0, 0)};
  RenderObject front = scene.objects[0];
  front.mesh.positions *= 0.3;
  front.mesh.positions.col(0).array() += 2;  // the camera looks from +x
  front.paint = UniformPaint{Rgb(0, 0.9F, 0)};
  scene.objects.push_back(front);
  const auto centre = [&] {
    const Image image = render(scene);
    return greenish(image.pixel(25, 25)) && reddish(image.pixel(25, 42));
  };
  CHECK(centre());
  std::swap(scene.objects[0], scene.objects[1]);
  CHECK(centre());
}

TEST_CASE("render: neighbouring triangles leave no gap") {
  RenderScene scene = ball_scene(150);
  scene.samples = 1;
  const Image image = render(scene);
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 150; ++x) {
      if (std::hypot(x - 74.5, y - 74.5) < 57) CHECK_FALSE(is_background(image, x, y));
    }
  }
}

TEST_CASE("render: the checker is exact in every pixel") {
  RenderScene scene = ball_scene(300);
  scene.camera.direction = Vector3::UnitX();
  scene.objects[0].paint =
      CheckerPaint{scene.objects[0].mesh.positions, 15, Rgb(0.9F, 0, 0), Rgb(0, 0.9F, 0)};
  const Image image = render(scene);
  // Seen from +x: y to the right, z up. The fields about θ = ±7.5° at ϕ = 82.5° and 97.5°.
  const auto at = [&](double theta, double phi) {
    const double t = theta * std::numbers::pi / 180, p = phi * std::numbers::pi / 180;
    const int x = static_cast<int>(150 + std::sin(t) * std::sin(p) * 120);
    const int y = static_cast<int>(150 - std::cos(p) * 120);
    return image.pixel(x, y);
  };
  CHECK(greenish(at(7.5, 82.5)));  // column 0, row 5: odd
  CHECK(reddish(at(7.5, 97.5)));   // column 0, row 6
  CHECK(reddish(at(-7.5, 82.5)));  // column 23, row 5
  CHECK(greenish(at(-7.5, 97.5)));
  CHECK(greenish(at(37.5, 112.5)) == greenish(at(7.5, 112.5)));
}

TEST_CASE("render: the date line runs from pole to pole, and only at θ = 0") {
  RenderScene scene = ball_scene(300);
  scene.objects[0].graticule = Graticule{.rays = scene.objects[0].mesh.positions};
  const Image front = render(scene);
  for (const int y : {60, 100, 137, 180, 240}) CHECK(reddish(front.pixel(150, y)));
  CHECK_FALSE(reddish(front.pixel(110, 137)));
  scene.camera.direction = -Vector3::UnitX();
  const Image back = render(scene);
  for (const int y : {60, 100, 137, 180, 240}) CHECK_FALSE(reddish(back.pixel(150, y)));
}

TEST_CASE("render: a texture is put where its coordinates say, v upwards") {
  Image image_of_four(2, 2, 3);
  image_of_four.pixel(0, 0)[0] = 1;  // upper left red
  image_of_four.pixel(1, 1)[1] = 1;  // lower right green
  const Image image = render(textured_square(image_of_four, 40));
  CHECK(reddish(image.pixel(10, 10)));
  CHECK(greenish(image.pixel(30, 30)));
  CHECK_FALSE(reddish(image.pixel(30, 10)));
  CHECK_FALSE(greenish(image.pixel(10, 30)));
}

TEST_CASE("render: a texture finer than pixels is seen as its mean, not as noise") {
  Image stripes(512, 512, 3), white = stripes;
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0F);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; x += 2) std::fill_n(stripes.pixel(x, y), 3, 1.0F);
  }
  const Image image = render(textured_square(stripes, 20));
  const float mean = image.pixel(10, 10)[1];
  CHECK(mean > 0.2F);
  CHECK(mean < 0.9F * render(textured_square(white, 20)).pixel(10, 10)[1]);
  for (int y = 2; y < 18; ++y) {
    for (int x = 2; x < 18; ++x) {
      CHECK(image.pixel(x, y)[1] == Approx(mean).margin(1.0 / 255));
    }
  }
}

TEST_CASE("render: the same pixels for 1, 2 and 4 threads") {
  RenderScene scene = ball_scene(120);
  scene.objects[0].occlusion = true;
  scene.objects[0].wireframe = Wireframe{};
  scene.objects[0].graticule = Graticule{.rays = scene.objects[0].mesh.positions};
  const Image one = render(scene, 1);
  CHECK((one.pixels == render(scene, 2).pixels));
  CHECK((one.pixels == render(scene, 4).pixels));
}

TEST_CASE(
    "render: texture coordinates that are no numbers, or beyond all, take no other's memory") {
  RenderScene scene = ball_scene(40);
  CornerTexcoords texcoords =
      CornerTexcoords::Constant(3 * scene.objects[0].mesh.face_count(), 2, 0.5);
  texcoords.topRows(600).setConstant(std::nan(""));
  texcoords.middleRows(600, 600).setConstant(std::numeric_limits<double>::infinity());
  texcoords.middleRows(1200, 600).setConstant(-1e300);
  scene.objects[0].paint = TexturePaint{{texcoords, {}}, {texture_of(Image(2, 2, 3))}};
  for (const float value : render(scene).pixels) {
    CHECK(value >= 0);
    CHECK(value <= 1);
  }
}

TEST_CASE("render: degenerate triangles and points behind the eye are passed over") {
  RenderScene scene = ball_scene(40);
  scene.objects[0].mesh.positions.row(3) = scene.objects[0].mesh.positions.row(4).eval();
  scene.objects[0].mesh.positions(5, 0) = 1e6;
  scene.camera.field_of_view = 40;
  const Image image = render(scene);
  for (const float value : image.pixels) {
    CHECK(value >= 0);
    CHECK(value <= 1);
  }
}

TEST_CASE("vertex_normals: of a sphere are its points") {
  const TriangleMesh mesh = tests::icosphere(3);
  CHECK((vertex_normals(mesh) - mesh.positions).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("angle_weighted_normals: of a box's corner the same however its sides are cut in two") {
  TriangleMesh box;
  box.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) box.positions.row(v) << (v & 1), (v >> 1 & 1), (v >> 2 & 1);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (unsigned cuts = 0; cuts < 64; ++cuts) {
    box.triangles.resize(12, 3);
    for (int q = 0; q < 6; ++q) {
      const int turn = cuts >> q & 1;
      const auto at = [&](int k) { return quads[q][(k + turn) % 4]; };
      box.triangles.row(2 * q) << at(0), at(1), at(2);
      box.triangles.row(2 * q + 1) << at(0), at(2), at(3);
    }
    const Points outward = (box.positions.array() - 0.5).matrix() * (2 / std::sqrt(3.0));
    CHECK((angle_weighted_normals(box) - outward).cwiseAbs().maxCoeff() < 1e-15);
  }
}

TEST_CASE("sky_visibility: a convex shape sees all of its sky, a pit only a part") {
  TriangleMesh mesh = tests::icosphere(4);
  CHECK(sky_visibility(mesh, vertex_normals(mesh)).minCoeff() > 0.97F);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const double z = mesh.positions(v, 2);
    if (z > 0.85) mesh.positions.row(v) *= 0.45;  // a pit at the north pole
  }
  const Eigen::VectorXf light = sky_visibility(mesh, vertex_normals(mesh));
  Eigen::Index north = 0, south = 0;
  mesh.positions.col(2).minCoeff(&south);
  mesh.positions.rowwise().normalized().eval().col(2).maxCoeff(&north);
  CHECK(light[north] < 0.8F);
  CHECK(light[south] > 0.97F);
}

TEST_CASE("vertex_normals, sky_visibility: the same at every size that doubles have") {
  const TriangleMesh ball = tests::icosphere(2);
  const Points normals = vertex_normals(ball), by_angle = angle_weighted_normals(ball);
  const Eigen::VectorXf light = sky_visibility(ball, normals, 32);
  for (const int exponent : {-1000, -500, 500, 1000, 1023}) {
    INFO("2^" << exponent);
    TriangleMesh sized = ball;
    for (double& x : sized.positions.reshaped()) x = std::ldexp(x, exponent);
    CHECK(vertex_normals(sized) == normals);
    CHECK((angle_weighted_normals(sized) - by_angle).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(sky_visibility(sized, normals, 32) == light);
  }
}

TEST_CASE(
    "vertex_normals, sky_visibility: unit normals and shares of light for any finite points") {
  const TriangleMesh ball = tests::icosphere(1);
  for (const double far : {1.0, 1e160, -1.7e308}) {
    TriangleMesh hurt = ball;
    hurt.positions.topRows(12).rowwise() = Vector3(1, 2, 3).transpose();
    hurt.positions.row(20) = Vector3(far, 1, -far);
    TriangleMesh point = ball;
    point.positions.rowwise() = Vector3(far, 2, 3).transpose();
    for (const TriangleMesh& mesh : {hurt, point}) {
      const Points normals = vertex_normals(mesh);
      CHECK((normals.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-12);
      const Eigen::VectorXf light = sky_visibility(mesh, normals, 32);
      CHECK(light.minCoeff() >= 0);
      CHECK(light.maxCoeff() <= 1);
    }
    CHECK(sky_visibility(point, vertex_normals(point), 32).minCoeff() == 1);
  }
}

TEST_CASE(
    "at_drawing_size: ordinary meshes stay, others come to about unit size about the origin") {
  const TriangleMesh ball = tests::icosphere(1);
  CHECK(at_drawing_size(ball).positions == ball.positions);
  for (const double size : {1.7e308, 1e160, 1e-160, 1e-310}) {
    TriangleMesh sized = ball;
    sized.positions *= size;
    const Points drawn = at_drawing_size(sized).positions;
    CHECK(drawn.cwiseAbs().maxCoeff() <= 2);
    CHECK(drawn.cwiseAbs().maxCoeff() >= 1e-6);
  }
  TriangleMesh point = ball;
  point.positions.setConstant(1e300);
  CHECK(at_drawing_size(point).positions == Points::Zero(ball.vertex_count(), 3));
}

TEST_CASE("colour: linear light and back is the identity, the maps have their ends and middle") {
  for (const float value : {0.0F, 0.02F, 0.5F, 1.0F}) {
    CHECK(to_srgb(to_linear(Rgb::Constant(value)))[0] == Approx(value).margin(1e-6));
  }
  CHECK(viridis(0)[2] > viridis(0)[0]);
  CHECK(viridis(1)[0] > 0.95F);
  CHECK(diverging(-1)[2] > 2 * diverging(-1)[0]);
  CHECK(diverging(1)[0] > 2 * diverging(1)[2]);
  const Eigen::VectorXd ratios = (Eigen::VectorXd(4) << 1, 8, 1.0 / 8, 0).finished();
  const auto colours = ratio_colours(ratios, 8);
  CHECK(colours[0].minCoeff() > 0.95F);
  CHECK(colours[1] == diverging(1));
  CHECK(colours[2] == diverging(-1));
  CHECK(colours[3] == diverging(-1));
}

TEST_CASE("map_figure: mesh and sphere side by side, both seen, the sphere turned to correspond") {
  MeshFile file;
  file.mesh = tests::icosphere(4);
  // Red where y > 0; the mesh is looked at from +y, the map turns y to z.
  const char* names[] = {"red", "green", "blue"};
  for (int k = 0; k < 3; ++k) {
    Property property{names[k], ScalarType::Uint8, {}};
    for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
      const bool red = file.mesh.positions(v, 1) > 0;
      property.values.push_back(k == 0 && red ? 230 : k == 1 && !red ? 230 : 20);
    }
    file.vertex_properties.push_back(property);
  }
  SphereMap map{file.mesh.positions};
  map.points.col(2) = file.mesh.positions.col(1);
  map.points.col(1) = file.mesh.positions.col(0);
  map.points.col(0) = file.mesh.positions.col(2);
  FigureOptions options{.graticule = false, .size = 100, .samples = 2, .both_sides = true};
  options.view = Vector3::UnitY();
  const Image image = map_figure(file, map, options);
  CHECK(image.width == 300);
  CHECK(image.height == 100);
  CHECK(reddish(image.pixel(50, 50)));
  CHECK(reddish(image.pixel(150, 50)));
  CHECK(greenish(image.pixel(250, 50)));
}
