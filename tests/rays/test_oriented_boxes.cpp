#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "rays/oriented_boxes.h"
#include "rays/triangle_distance.h"
#include "support/hedgehog.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

double squared_distance(const TriangleMesh& mesh, Face face, const Vector3& point) {
  const auto corners = mesh.triangles.row(face);
  return nearest_on_triangle(point, mesh.position(corners[0]), mesh.position(corners[1]),
                             mesh.position(corners[2]))
      .squared_distance;
}

OrientedBoxes boxes_of(const TriangleMesh& mesh, double scale = 1) {
  std::vector<Face> faces(static_cast<size_t>(mesh.face_count()));
  std::iota(faces.begin(), faces.end(), 0);
  return {mesh, faces, scale};
}

}  // namespace

TEST_CASE("oriented boxes: every face within reach is come to once, wherever the mesh lies") {
  for (const double scale : {1e-80, 1.0, 1e80}) {
    TriangleMesh mesh = hedgehog(40, 3, 1);
    mesh.positions.array() = scale * (mesh.positions.array() + 1e4);
    const OrientedBoxes boxes = boxes_of(mesh, 1 / scale);
    for (int v = 0; v < mesh.vertex_count(); v += 17) {
      const Vector3 point = 0.7 * mesh.position(v) + 0.3 * mesh.position(0);
      const double within = scale * scale;
      std::vector<int> times(static_cast<size_t>(mesh.face_count()), 0);
      boxes.visit(
          point, [&] { return within; },
          [&](Face face) {
            ++times[static_cast<size_t>(face)];
            return false;
          });
      for (Face f = 0; f < mesh.face_count(); ++f) {
        const int came = times[static_cast<size_t>(f)];
        CHECK(came <= 1);
        if (squared_distance(mesh, f, point) < within * (1 - 1e-9)) CHECK(came == 1);
      }
    }
  }
}

TEST_CASE("oriented boxes: the visit ends when it is told that this is enough") {
  const TriangleMesh mesh = hedgehog(20, 3, 1);
  int came = 0;
  boxes_of(mesh).visit(
      Vector3::Zero(), [] { return 1e9; }, [&](Face) { return ++came == 3; });
  CHECK(came == 3);
}

TEST_CASE("oriented boxes: of a brush whose hairs point everywhere, a place sees a few triangles") {
  const TriangleMesh mesh = hedgehog(1000, 12, 1);
  const OrientedBoxes boxes = boxes_of(mesh);
  std::int64_t came = 0, places = 0;
  for (Face f = 0; f < mesh.face_count(); f += 97) {
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 3; ++k) middle += mesh.position(mesh.triangles(f, k)) / 3;
    double best = squared_distance(mesh, f, middle);
    boxes.visit(
        middle, [&] { return best + 1e-9; },
        [&](Face face) {
          ++came;
          best = std::min(best, squared_distance(mesh, face, middle));
          return false;
        });
    ++places;
  }
  CHECK(came < 16 * places);
}

}  // namespace sphparam
