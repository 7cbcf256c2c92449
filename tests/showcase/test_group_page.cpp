#include <array>
#include <catch2/catch.hpp>
#include <sstream>
#include <string>

#include "image/image_codec.h"
#include "sphparam/group/group.h"
#include "sphparam/records/group_files.h"
#include "support/test_meshes.h"

/// What is told of a group, of shapes whose maps are their own directions.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::Detail::Approx;

constexpr GridSpec grid{GridKind::Icosahedron, 2};

MappedMesh ball(int level, const Vector3& axes) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  file.mesh.positions = file.mesh.positions * axes.asDiagonal();
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

/// A group that is told, with all that its record refers to.
struct Told {
  GroupOptions options = {.start = GroupStart::Maps, .hold = true, .grid = grid};
  Group group;
  GroupRecord record;

  Told(const std::vector<MappedMesh>& shapes, const MappedMesh& reference, bool scale = false)
      : group(make_group(shapes, reference, with(scale))), record{group, options, {}, {}, {}, ""} {
    for (size_t i = 0; i < shapes.size(); ++i) {
      record.names.push_back("shape" + std::to_string(i));
      record.files.push_back(record.names.back() + ".obj");
      record.mapped_now.push_back(false);
    }
  }

 private:
  GroupOptions& with(bool scale) {
    options.scale = scale;
    return options;
  }
};

std::vector<char> from_base64(const std::string& text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<char> bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char letter : text.substr(0, text.find('='))) {
    held = held << 6 | static_cast<unsigned>(letters.find(letter));
    bits += 6;
    if (bits >= 8) bytes.push_back(static_cast<char>(held >> (bits -= 8) & 255));
  }
  return bytes;
}

/// Of each picture of a page, in their order, the pixels that show something.
std::vector<double> drawn_areas(const std::string& page) {
  const std::string begin = "data:image/png;base64,";
  std::vector<double> areas;
  for (size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    const Image image =
        decode_image(from_base64(page.substr(at, page.find('"', at) - at)), "picture");
    double count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) count += image.pixel(x, y)[0] < 0.99F;
    areas.push_back(count);
  }
  return areas;
}

}  // namespace

TEST_CASE("group_page: what differs in size is drawn so, the largest as large as its picture") {
  const std::vector<MappedMesh> shapes = {ball(2, {1, 1, 1}), ball(2, {2, 2, 2}),
                                          ball(2, {4, 4, 4})};
  const Told told(shapes, shapes[0]);
  REQUIRE(told.group.modes.shares[0] > 0.999);
  const std::string page = group_page(told.record, {.size = 96});
  CHECK_THAT(page, Contains("The pictures of a mode are to one scale: the largest fills") &&
                       Contains("Each as it lies on the mean, to one scale: the largest fills"));
  const std::vector<double> areas = drawn_areas(page);
  REQUIRE(areas.size() == 9);  // the mean three times, a mode, the shapes
  const double full = areas[0];
  // The mean is 7/3 large, the mode √(7/3) of it.
  const double mean = 7.0 / 3, end = mean + 2 * std::sqrt(7.0 / 3);
  CHECK(std::max(areas[3], areas[5]) == Approx(full).epsilon(0.03));
  CHECK(areas[4] == Approx(full * mean * mean / (end * end)).epsilon(0.05));
  CHECK(areas[6] == Approx(full / 16).epsilon(0.1));
  CHECK(areas[7] == Approx(full / 4).epsilon(0.05));
  CHECK(areas[8] == Approx(full).epsilon(0.03));
}

TEST_CASE("group_page: shapes brought to one size are drawn so, and that is said") {
  const std::vector<MappedMesh> shapes = {ball(2, {1, 1, 1}), ball(2, {4, 4, 4})};
  const Told told(shapes, shapes[0], true);
  const std::string page = group_page(told.record, {.size = 96});
  CHECK_THAT(page, Contains("Each as it lies on the mean, brought to one size, to one scale:"));
  const std::vector<double> areas = drawn_areas(page);
  REQUIRE(areas.size() >= 2);
  CHECK(areas[areas.size() - 2] == areas.back());
}

TEST_CASE(
    "landmarks_table: the nearest vertex is that, also where it is no corner of much weight") {
  const MappedMesh reference = ball(3, {1, 1, 1}), long_one = ball(1, {30, 1, 1.5});
  Told told({long_one}, reference);
  for (Vertex v = 0; v < reference.mesh().vertex_count(); ++v)
    told.record.landmarks.push_back({std::to_string(v), v});
  std::istringstream table(landmarks_table(told.record));
  std::string line, word;
  std::getline(table, line);
  const TriangleMesh& mesh = long_one.mesh();
  int rows = 0, elsewhere = 0;
  for (; std::getline(table, line); ++rows) {
    std::istringstream row(line);
    row >> word >> word;
    Vector3 point, weights;
    Face face = 0;
    Vertex nearest = 0;
    for (int k = 0; k < 3; ++k) row >> point[k];
    row >> face;
    for (int k = 0; k < 3; ++k) row >> weights[k];
    row >> nearest;
    REQUIRE(row);
    double least = 1e300;
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      least = std::min(least, (mesh.position(v) - point).norm());
    CHECK((mesh.position(nearest) - point).norm() == Approx(least));
    int corner = 0;
    weights.maxCoeff(&corner);
    elsewhere += mesh.triangles(face, corner) != nearest;
  }
  CHECK(rows == reference.mesh().vertex_count());
  CHECK(elsewhere > 0);
}

}  // namespace sphparam::tests
