#include <catch2/catch.hpp>
#include <cmath>

#include "bake/source_tangents.h"

using namespace sphparam;

namespace {

/// Two triangles with the edge 0 1 in common; on the left one s grows along (2, 1).
struct Tent {
  MeshFile file;
  CornerTexcoords texcoords{6, 2};

  Tent() {
    file.mesh.positions = (Points(4, 3) << 0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0).finished();
    file.mesh.triangles = (Triangles(2, 3) << 0, 2, 1, 0, 1, 3).finished();
    texcoords << 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, -1, 0.5;
  }

  /// T and w of a corner, all normals upright.
  Eigen::RowVector4d at(int corner) const {
    const Points upright = Points(4, 3).setZero().rowwise() + Eigen::RowVector3d(0, 0, 1);
    return source_tangents(file, upright, texcoords).tangents.row(corner);
  }
};

const Vector3 right(1, 0, 0), left = Vector3(2, 1, 0).normalized();

bool is(const Eigen::RowVector4d& tangent, const Vector3& wanted, double sign) {
  return (tangent.head<3>().transpose() - wanted).norm() < 1e-12 && tangent[3] == sign;
}

}  // namespace

TEST_CASE("source tangents: faces that go on in (s, t) share a mean by angle, others do not") {
  Tent tent;
  CHECK(is(tent.at(0), (right + left).normalized(), 1));  // both have a right angle there
  CHECK(is(tent.at(3), (right + left).normalized(), 1));
  CHECK(is(tent.at(1), right, 1));
  CHECK(is(tent.at(5), left, 1));
  for (const int along : {0, 1}) {
    Tent seam = tent;
    seam.texcoords.bottomRows(3).col(along).array() += 1;
    CHECK(is(seam.at(0), right, 1));
    CHECK(is(seam.at(3), left, 1));
  }
}

TEST_CASE("source tangents: where (s, t) are mirrored s still grows along them") {
  Tent tent;
  tent.texcoords.bottomRows(3).col(0) *= -1;
  CHECK(is(tent.at(0), right, 1));
  CHECK(is(tent.at(3), -left, -1));
}

TEST_CASE("source tangents: none where (s, t) grow in no direction") {
  Tent tent;
  tent.texcoords.setConstant(0.5);
  CHECK(is(tent.at(0), Vector3::Zero(), 1));
}
