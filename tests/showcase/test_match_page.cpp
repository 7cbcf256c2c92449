#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "showcase/match_model.h"
#include "showcase/match_pictures.h"
#include "showcase/side_by_side.h"
#include "sphparam/parameterize.h"
#include "sphparam/report/match_page.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;

MappedMesh ball(int level, double nose, const std::string& name) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) {
    const Vector3 x = file.mesh.position(v);
    file.mesh.positions.row(v) =
        (1 + nose * std::exp(-8 * (x - Vector3(1, 0, 0)).squaredNorm())) * x;
  }
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = name});
}

Match match_of(const SurfaceMap& map) {
  return {.map = map,
          .energy = 2,
          .made_by = "own map",
          .residuals = {},
          .suggestions = {},
          .warnings = {"look <here>"}};
}

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// How many pixels are near a colour.
long pixels_of(const Image& image, const Rgb& colour) {
  long n = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Map<const Rgb> pixel(image.pixel(x, y));
      n += (pixel - colour).cwiseAbs().maxCoeff() < 0.25F;
    }
  }
  return n;
}

RenderObject plain(const TriangleMesh& mesh, const Rgb& colour) {
  return {.mesh = mesh, .paint = UniformPaint{colour}};
}

const PairLook small{.size = 60};

}  // namespace

TEST_CASE("side by side: two balls of one size, one left and one right, nothing cut off") {
  const Rgb red(0.9F, 0.1F, 0.1F), blue(0.1F, 0.1F, 0.9F);
  TriangleMesh far = icosphere(3);
  far.positions.rowwise() += Eigen::RowVector3d(100, 20, -7);
  const Image image = side_by_side(plain(icosphere(3), red), plain(far, blue), {}, small);
  CHECK(image.height == 60);
  CHECK(image.width >= 120);
  const auto is_like = [&](int x, const Rgb& colour) {
    const float* pixel = image.pixel(x, 30);
    return colour[0] > 0.5F ? pixel[0] > 2 * pixel[2] : pixel[2] > 2 * pixel[0];
  };
  CHECK(is_like(image.width / 4, red));
  CHECK(is_like(3 * image.width / 4, blue));
  for (int x = 0; x < image.width; ++x)
    for (const int y : {0, image.height - 1}) CHECK(image.pixel(x, y)[1] > 0.99F);
  for (int y = 0; y < image.height; ++y)
    for (const int x : {0, image.width / 2, image.width - 1}) CHECK(image.pixel(x, y)[1] > 0.99F);
}

TEST_CASE("side by side: a link is seen from end to end, also where its ends are hidden") {
  const Rgb white(0.95F, 0.95F, 0.95F), red(0.8F, 0, 0);
  const TriangleMesh mesh = icosphere(3);
  PairLook look{.view = {0, -1, 0}, .up = {0, 0, 1}, .size = 120};
  const Vector3 hidden(0, 1, 0);  // in the middle of each ball, behind it
  const Image image =
      side_by_side(plain(mesh, white), plain(mesh, white), {{hidden, hidden, red}}, look);
  const auto is_red = [&](int x) {
    for (int y = image.height / 2 - 2; y <= image.height / 2 + 2; ++y)
      if (image.pixel(x, y)[0] - image.pixel(x, y)[1] > 0.1F) return true;
    return false;
  };
  int first = image.width, last = 0, red_columns = 0;
  for (int x = 0; x < image.width; ++x) {
    if (!is_red(x)) continue;
    first = std::min(first, x);
    last = x;
    ++red_columns;
  }
  CHECK(std::abs(first - (image.width - 1 - last)) <= 3);
  CHECK(last - first > image.width / 3);
  CHECK(red_columns == last - first + 1);
}

TEST_CASE("match pictures: colours of places are between dark and light, one channel an axis") {
  Points box(2, 3);
  box << -1, 0, 5, 3, 2, 5;
  const std::vector<Rgb> colours = place_colours(box, box);
  CHECK(colours[0][0] < colours[1][0]);
  CHECK(colours[0][1] < colours[1][1]);
  CHECK(colours[0][2] == colours[1][2]);  // no extent
  const std::vector<Rgb> beyond = place_colours(3 * box, box);
  CHECK(beyond[1][0] == colours[1][0]);
}

TEST_CASE("match pictures: points are spread, landmarks among them, none twice") {
  const TriangleMesh mesh = icosphere(3);
  const std::vector<Vertex> spread = spread_vertices(mesh, {7, 9}, 50);
  REQUIRE(spread.size() == 50);
  CHECK(spread[0] == 7);
  CHECK(spread[1] == 9);
  double least = 2;
  for (size_t i = 2; i < spread.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      least = std::min(least, (mesh.position(spread[i]) - mesh.position(spread[k])).norm());
  CHECK(least > 0.3);  // fifty even spots have a distance of about 0.5
  CHECK(spread_vertices(tetrahedron(), {}, 50).size() == 4);
}

TEST_CASE("match pictures: corresponding places have one colour on both") {
  const SurfaceMap map(ball(3, 0.5, "a"), ball(3, 0.5, "b"));
  MatchPictures pictures(map, {}, {.size = 64});
  const Image image = pictures.spheres();
  double most = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width / 2; ++x)
      for (int c = 0; c < 3; ++c)
        most += std::abs(static_cast<double>(image.pixel(x, y)[c]) -
                         static_cast<double>(image.pixel(x + image.width / 2, y)[c]));
  CHECK(most / (3 * image.height * image.width / 2) < 0.02);
}

TEST_CASE("match pictures: an isometry is white, what grows is red") {
  const Rgb red = heat_colour(Heat::Area, 8);
  const MappedMesh plain_ball = ball(3, 0, "a");
  const MatchPictures same({plain_ball, plain_ball}, {}, {.size = 64});
  const MatchPictures grown({plain_ball, ball(3, 3, "b")}, {}, {.view = {1, -1, 0}, .size = 64});
  CHECK(pixels_of(same.heat(Heat::Area, false), red) == 0);
  CHECK(pixels_of(grown.heat(Heat::Area, false), red) > 20);
}

TEST_CASE("match page: all pictures, tables and warnings are there, and texts are escaped") {
  const Match match = match_of({ball(2, 0.5, "one <a>.obj"), ball(3, 0.9, "two.obj")});
  const MatchPageOptions options{
      .landmarks = {{3, 4}, {5, 6}}, .viewer = false, .size = 64, .facts = {{"command", "x & y"}}};
  const std::string page = make_match_page(match, options);
  CHECK(count(page, "data:image/png;base64,") == 8);
  CHECK(count(page, "data:image/svg+xml;base64,") == 2);
  CHECK_THAT(page, Contains("One-to-one") && Contains("look &lt;here&gt;") &&
                       Contains("one &lt;a&gt;") && Contains("x &amp; y") &&
                       Contains("<th scope=\"row\">3</th><td>4</td>") && !Contains("<script"));
  CHECK(count(page, "src=\"") == count(page, "src=\"data:"));
  CHECK(page == make_match_page(match, options));
}

TEST_CASE("match page: a size that cannot be is refused before any work") {
  const Match match = match_of({ball(1, 0.5, "one.obj"), ball(1, 0.9, "two.obj")});
  for (const int size : {-4, 0, 60, 66, 8196}) {
    const MatchPageOptions options{
        .viewer = false, .size = size, .progress = [](std::string_view, double) {
          FAIL("work was begun");
          return false;
        }};
    CHECK_THROWS_AS(make_match_page(match, options), std::invalid_argument);
  }
}

TEST_CASE("match page: what was searched for is listed, with its confidence") {
  Match match = match_of({ball(2, 0.5, "one.obj"), ball(2, 0.9, "two.obj")});
  match.suggestions = {{{{1, 2}}, 2.5, 0.75, 0.625}};
  match.confidence = 0.25;
  const std::string page = make_match_page(match, {.viewer = false, .size = 64});
  CHECK_THAT(page, Contains("1 – 2") && Contains("confidence") && Contains("0.625"));
}

TEST_CASE("match model: a surface for each thing to be seen, the same bytes for any threads") {
  const SurfaceMap map(ball(2, 0.5, "one.obj"), ball(3, 0.9, "two.obj"));
  const Distortion distortion = measure_distortion(map);
  ExportOptions options{.threads = 1};
  options.look.image_width = 64;
  const MatchModel model = match_model(map, distortion, options);
  std::vector<std::string> labels;
  for (const ViewedSurface& surface : model.surfaces) labels.push_back(surface.label);
  CHECK(labels == std::vector<std::string>{"Checker", "Places", "Area", "Angle"});
  options.threads = 3;
  CHECK(model.glb == match_model(map, distortion, options).glb);
}

}  // namespace sphparam::tests
