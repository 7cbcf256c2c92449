#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "sphparam/group/surface_size.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// The unit cube, each face cut into its own number of strips, not all as wide.
TriangleMesh cube(const std::vector<int>& strips) {
  std::vector<Vector3> points;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, count = strips[size_t(side)];
    for (int i = 0; i <= count; ++i) {
      for (const double across : {0.0, 1.0}) {
        Vector3 x;
        x[axis] = side % 2;
        x[(axis + 1) % 3] = std::pow(double(i) / count, 1.5);
        x[(axis + 2) % 3] = across;
        points.push_back(x);
      }
    }
  }
  TriangleMesh mesh{Points(Eigen::Index(points.size()), 3), {}};
  std::vector<Eigen::RowVector3i> faces;
  int first = 0;
  for (const int count : strips) {
    for (int i = 0; i < count; ++i, first += 2) {
      faces.emplace_back(first, first + 2, first + 3);
      faces.emplace_back(first, first + 3, first + 1);
    }
    first += 2;
  }
  for (size_t v = 0; v < points.size(); ++v) mesh.positions.row(Eigen::Index(v)) = points[v];
  mesh.triangles.resize(Eigen::Index(faces.size()), 3);
  for (size_t f = 0; f < faces.size(); ++f) mesh.triangles.row(Eigen::Index(f)) = faces[f];
  return mesh;
}

TriangleMesh pear() {
  TriangleMesh mesh = icosphere(2);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions.row(v) *= 1 + 0.5 * mesh.positions(v, 0);
  return mesh;
}

/// Sums over n² small triangles of each triangle, each at its middle.
double summed_size(const TriangleMesh& mesh, int n) {
  std::vector<std::pair<double, Vector3>> pieces;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0)),
                  b = mesh.position(mesh.triangles(f, 1)) - a,
                  c = mesh.position(mesh.triangles(f, 2)) - a;
    const double area = b.cross(c).norm() / 2 / (n * n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        pieces.emplace_back(area, a + ((i + 1 / 3.0) * b + (j + 1 / 3.0) * c) / n);
        if (i + j < n - 1)
          pieces.emplace_back(area, a + ((i + 2 / 3.0) * b + (j + 2 / 3.0) * c) / n);
      }
  }
  double area = 0, squares = 0;
  Vector3 centre = Vector3::Zero();
  for (const auto& [share, x] : pieces) area += share, centre += share * x;
  centre /= area;
  for (const auto& [share, x] : pieces) squares += share * (x - centre).squaredNorm();
  return std::sqrt(squares / area);
}

}  // namespace

TEST_CASE("surface_size: of a cube √(5/12), however its faces are cut") {
  const double exact = std::sqrt(5.0 / 12);
  CHECK(surface_size(cube({1, 1, 1, 1, 1, 1})) == Approx(exact).epsilon(1e-14));
  CHECK(surface_size(cube({1, 40, 3, 1, 7, 2})) == Approx(exact).epsilon(1e-13));
}

TEST_CASE("surface_size: what sums over ever smaller pieces go to") {
  const TriangleMesh mesh = pear();
  const double size = surface_size(mesh), coarse = summed_size(mesh, 4),
               fine = summed_size(mesh, 16);
  CHECK(std::abs(fine - size) < 1e-4 * size);
  CHECK(fine - size == Approx((coarse - size) / 16).epsilon(1e-2));
}

TEST_CASE("surface_size: as large as the surface, wherever it lies, at any magnitude") {
  const TriangleMesh mesh = pear();
  const double size = surface_size(mesh);
  TriangleMesh other = mesh;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  other.positions =
      (3 * mesh.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(1e6, 2, 3);
  CHECK(surface_size(other) == Approx(3 * size).epsilon(1e-8));
  for (const double scale : {1e-200, 1e200}) {
    other.positions = scale * mesh.positions;
    CHECK(surface_size(other) == Approx(scale * size).epsilon(1e-13));
  }
}

TEST_CASE("surface_size: vertices of no face count for nothing, and what has no area has no size") {
  TriangleMesh mesh = icosahedron();
  const double size = surface_size(mesh);
  mesh.positions.conservativeResize(13, 3);
  mesh.positions.row(12) = Vector3(100, 0, 0);
  CHECK(surface_size(mesh) == size);
  mesh.positions.setOnes();
  CHECK(surface_size(mesh) == 0);
  mesh.positions = mesh.positions * 0;
  mesh.positions.col(1).setLinSpaced(0, 12);  // a line
  CHECK(surface_size(mesh) == 0);
  CHECK(surface_size(TriangleMesh{}) == 0);
}
