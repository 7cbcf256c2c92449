#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "io/attributes/corner_colours.h"
#include "io/attributes/mixed_colour.h"
#include "io/polygons/welding.h"
#include "io/repair/repaired_file.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/loop_file.h"
#include "sphparam/io/shared_places.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A mesh file whose attributes say where they are: heights of vertices, numbers of faces, corners
/// with their vertex and their face.
MeshFile labelled(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  Property height{"height", ScalarType::Float64, {}}, part{"part", ScalarType::Uint8, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) height.values.push_back(mesh.positions(v, 2));
  for (Face f = 0; f < mesh.face_count(); ++f) part.values.push_back(f % 200);
  file.set_vertex_property(height);
  file.set_face_property(part);
  file.corner_texcoords.emplace(mesh.triangles.size(), 2);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vertex v = mesh.triangles.data()[i];
    file.corner_texcoords->row(i) << mesh.positions(v, 0), mesh.positions(v, 1);
  }
  return file;
}

void check_labels(const MeshFile& before, const MeshFile& after) {
  const auto& height = after.find_vertex_property("height")->values;
  const auto& source = after.find_vertex_property("source_vertex")->values;
  REQUIRE(height.size() == static_cast<size_t>(after.mesh.vertex_count()));
  for (Vertex v = 0; v < after.mesh.vertex_count(); ++v) {
    CHECK(height[v] == Approx(after.mesh.positions(v, 2)));
    if (source[v] >= 0) {
      CHECK(after.mesh.position(v) == before.mesh.position(static_cast<Vertex>(source[v])));
    }
  }
  const auto& part = after.find_face_property("part")->values;
  const auto& source_face = after.find_face_property("source_face")->values;
  REQUIRE(part.size() == static_cast<size_t>(after.mesh.face_count()));
  REQUIRE(after.corner_texcoords->rows() == after.mesh.triangles.size());
  for (Face f = 0; f < after.mesh.face_count(); ++f) {
    if (source_face[f] >= 0) CHECK(part[f] == static_cast<int>(source_face[f]) % 200);
    for (int k = 0; k < 3; ++k) {
      const Vertex v = after.mesh.triangles(f, k);
      if (source[v] < 0) continue;
      CHECK(after.corner_texcoords->row(3 * f + k) == after.mesh.positions.row(v).head<2>());
    }
  }
}

}  // namespace

TEST_CASE("repaired_file: attributes go where their vertices, faces and corners go") {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.conservativeResize(mesh.face_count() - 3, 3);
  std::swap(mesh.triangles(7, 0), mesh.triangles(7, 1));
  mesh.triangles.row(20) = mesh.triangles.row(21).eval();
  const MeshFile file = labelled(mesh);
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.inspection.is_sphere());
  check_labels(file, repaired_file(file, repaired));
}

TEST_CASE("repaired_file: colours of corners go where their corners go") {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.conservativeResize(mesh.face_count() - 3, 3);
  std::swap(mesh.triangles(7, 0), mesh.triangles(7, 1));
  MeshFile file = labelled(mesh);
  for (const char* name : {"red", "green", "blue"})
    file.set_vertex_property(
        {name, ScalarType::Float64, std::vector<double>(static_cast<size_t>(mesh.vertex_count()))});
  CornerColours colours = CornerColours::Zero(mesh.triangles.size(), 4);
  for (Eigen::Index i = 0; i < colours.rows(); ++i)
    colours.row(i).head<3>() = mesh.positions.row(mesh.triangles.data()[i]);
  set_corner_colours(file, colours);
  const RepairedMesh repaired = repair_mesh(mesh);
  const MeshFile after = repaired_file(file, repaired);
  const auto carried = corner_colours(after);
  REQUIRE(carried);
  for (Face f = 0; f < after.mesh.face_count(); ++f) {
    if (repaired.face_origin[static_cast<size_t>(f)] < 0) continue;
    for (int k = 0; k < 3; ++k)
      CHECK(carried->row(3 * f + k).head<3>() ==
            after.mesh.positions.row(after.mesh.triangles(f, k)));
  }
}

TEST_CASE("repaired_file: where vertices are welded by nearness, faces keep their own colours") {
  // The faces of the northern half use copies, a little higher and of another colour.
  TriangleMesh mesh = icosphere(3);
  const Vertex copies = static_cast<Vertex>(mesh.vertex_count());
  mesh.positions.conservativeResize(2 * copies, 3);
  for (Vertex v = 0; v < copies; ++v) {
    mesh.positions.row(copies + v) = mesh.positions.row(v);
    mesh.positions(copies + v, 2) += 1e-3;
  }
  for (Face f = 0; f < mesh.face_count(); ++f) {
    double height = 0;
    for (int k = 0; k < 3; ++k) height += mesh.positions(mesh.triangles(f, k), 2);
    if (height > 0) mesh.triangles.row(f).array() += copies;
  }
  const auto colour_of = [&](Vertex v) { return v < copies ? 10.0 : 200.0; };
  MeshFile file;
  file.mesh = mesh;
  for (const char* name : {"red", "green", "blue"}) {
    Property channel{name, ScalarType::Uint8, {}};
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) channel.values.push_back(colour_of(v));
    file.set_vertex_property(channel);
  }
  const RepairedMesh repaired = repair_mesh(mesh, {.weld_length = 2e-3});
  REQUIRE(repaired.inspection.is_sphere());
  const MeshFile after = repaired_file(file, repaired);
  const auto colours = corner_colours(after);
  REQUIRE(colours);
  CHECK(after.find_face_property("corner_red_0")->type == ScalarType::Uint8);
  CHECK_FALSE(after.find_face_property("corner_alpha_0"));
  const std::vector<double>& kept = after.find_vertex_property("red")->values;
  long others = 0;
  for (Face f = 0; f < after.mesh.face_count(); ++f) {
    const double own = colour_of(mesh.triangles(repaired.face_origin[f], 0));
    for (int k = 0; k < 3; ++k) {
      CHECK(colours->row(3 * f + k) == Eigen::RowVector4d(own, own, own, 0));
      others += kept[after.mesh.triangles(f, k)] != own;
    }
  }
  CHECK(others > 20);

  for (const char* name : {"red", "green", "blue"})
    file.set_vertex_property({name, ScalarType::Uint8,
                              std::vector<double>(static_cast<size_t>(mesh.vertex_count()), 90)});
  CHECK_FALSE(corner_colours(repaired_file(file, repaired)));
}

TEST_CASE("repaired_file: a created vertex has the mean of its neighbours and no source") {
  TriangleMesh mesh = octahedron();
  mesh.triangles.conservativeResize(1, 3);
  const MeshFile file = labelled(mesh);
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.created.size() == 1);
  const MeshFile result = repaired_file(file, repaired);
  check_labels(file, result);
  CHECK(result.find_vertex_property("source_vertex")->values.back() == -1);
  CHECK(result.find_face_property("source_face")->values == std::vector<double>{0, -1, -1, -1});
}

TEST_CASE("repaired_file: where edges are halved, everything is there what lies between") {
  MeshFile file = labelled(octahedron());
  std::vector<double> heights;
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v)
    heights.push_back(file.mesh.position(v).z());
  file.set_vertex_property({"height", ScalarType::Float64, heights});
  RepairOptions options = RepairOptions::none();
  options.edge_length = 0.3;
  const RepairedMesh repaired = repair_mesh(file.mesh, options);
  const MeshFile result = repaired_file(file, repaired);
  REQUIRE(result.mesh.vertex_count() > 100);
  const std::vector<double>& between = result.find_vertex_property("height")->values;
  const std::vector<double>& source = result.find_vertex_property("source_vertex")->values;
  for (Vertex v = 0; v < result.mesh.vertex_count(); ++v) {
    CHECK(between[v] == result.mesh.position(v).z());
    CHECK(source[v] == (v < 6 ? v : -1));
  }
  const std::vector<double>& face = result.find_face_property("source_face")->values;
  for (Face f = 0; f < result.mesh.face_count(); ++f) {  // halves of a face name it
    const Vector3 middle = (result.mesh.position(result.mesh.triangles(f, 0)) +
                            result.mesh.position(result.mesh.triangles(f, 1)) +
                            result.mesh.position(result.mesh.triangles(f, 2))) /
                           3;
    const auto whole = static_cast<Face>(face[f]);
    const Vector3 normal = file.mesh.position(file.mesh.triangles(whole, 0)) +
                           file.mesh.position(file.mesh.triangles(whole, 1)) +
                           file.mesh.position(file.mesh.triangles(whole, 2));
    CHECK(middle.dot(normal) == Approx(1).epsilon(1e-12));  // |x| + |y| + |z| = 1 on the octahedron
  }
}

TEST_CASE("repaired_file: ids of the file survive a repair of a mesh that was renumbered before") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  MeshFile file = labelled(mesh);
  Property source{"source_vertex", ScalarType::Uint16, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) source.values.push_back(2 * v + 1);
  file.set_vertex_property(source);
  const MeshFile result = repaired_file(file, repair_mesh(mesh));
  CHECK(result.find_vertex_property("source_vertex")->values == source.values);
}

TEST_CASE("repaired_file: nothing done, nothing added") {
  const MeshFile file = labelled(icosphere(1));
  const MeshFile result = repaired_file(file, repair_mesh(file.mesh));
  CHECK_FALSE(result.find_vertex_property("source_vertex"));
  CHECK_FALSE(result.find_face_property("source_face"));
}

namespace {

/// A ball in a four-piece atlas, one a quarter of its longitudes, each of a material of its own and
/// somewhere else in the image: (s, t) are linear in what `place` says of a point, so that the
/// texture of any point of a piece can be told.
struct Atlas {
  MeshFile file;

  explicit Atlas(const TriangleMesh& mesh) {
    file.mesh = mesh;
    file.materials = {"a", "b", "c", "d"};
    file.corner_texcoords.emplace(mesh.triangles.size(), 2);
    Property material{"material", ScalarType::Int32, {}};
    for (Face f = 0; f < mesh.face_count(); ++f) {
      const int piece = piece_of(mesh, f);
      material.values.push_back(piece);
      for (int k = 0; k < 3; ++k)
        file.corner_texcoords->row(3 * f + k) = place(piece, mesh.position(mesh.triangles(f, k)));
    }
    file.set_face_property(std::move(material));
  }

  static int piece_of(const TriangleMesh& mesh, Face f) {
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 3; ++k) middle += mesh.position(mesh.triangles(f, k));
    return (middle.x() > 0 ? 1 : 0) + (middle.y() > 0 ? 2 : 0);
  }

  static Eigen::RowVector2d place(int piece, const Vector3& p) {
    return {10.0 * piece + p.x() + 0.5 * p.z(), 7.0 * piece + p.y() - 0.25 * p.z()};
  }
};

/// How far the texture of a mended mesh is, at the worst corner of the faces that are asked for,
/// from what its own piece has at the corner's vertex.
template <class Asked>
double worst_corner(const MeshFile& mended, Asked&& asked) {
  double worst = 0;
  const std::vector<double>& material = mended.find_face_property("material")->values;
  for (Face f = 0; f < mended.mesh.face_count(); ++f) {
    if (!asked(f)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3 p = mended.mesh.position(mended.mesh.triangles(f, k));
      const auto expected = Atlas::place(static_cast<int>(material[f]), p);
      worst = std::max(worst, (mended.corner_texcoords->row(3 * f + k) - expected).norm());
    }
  }
  return worst;
}

bool is_new(const RepairedMesh& repaired, Face f) { return repaired.face_origin[f] < 0; }

TriangleMesh without_faces(TriangleMesh mesh, const std::vector<Face>& dropped) {
  Triangles kept(mesh.face_count() - std::ssize(dropped), 3);
  Eigen::Index row = 0;
  for (Face f = 0; f < mesh.face_count(); ++f)
    if (std::find(dropped.begin(), dropped.end(), f) == dropped.end())
      kept.row(row++) = mesh.triangles.row(f);
  mesh.triangles = kept;
  return mesh;
}

/// The faces at a vertex.
std::vector<Face> faces_at(const TriangleMesh& mesh, Vertex v) {
  std::vector<Face> faces;
  for (Face f = 0; f < mesh.face_count(); ++f)
    if ((mesh.triangles.row(f).array() == v).any()) faces.push_back(f);
  return faces;
}

/// The vertex nearest to a direction.
Vertex vertex_at(const TriangleMesh& mesh, const Vector3& direction) {
  Eigen::Index v = 0;
  (mesh.positions * direction.normalized()).maxCoeff(&v);
  return static_cast<Vertex>(v);
}

/// The face is given a vertex more on its first side, which its neighbour has not: a T-junction.
TriangleMesh with_junction(TriangleMesh mesh, Face f, double share) {
  const Vertex a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
  const Vertex middle = static_cast<Vertex>(mesh.vertex_count());
  mesh.positions.conservativeResize(middle + 1, 3);
  mesh.positions.row(middle) = (1 - share) * mesh.positions.row(a) + share * mesh.positions.row(b);
  mesh.triangles.conservativeResize(mesh.face_count() + 1, 3);
  mesh.triangles.row(f) << a, middle, c;
  mesh.triangles.bottomRows(1) << middle, b, c;
  return mesh;
}

}  // namespace

TEST_CASE("repaired_file: an atlas texture follows the cut of a side at a T-junction") {
  const TriangleMesh mesh = with_junction(with_junction(icosphere(2), 10, 0.3), 200, 0.8);
  const Atlas atlas(mesh);
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.inspection.is_sphere());
  REQUIRE(repaired.blended.size() == 4);
  const MeshFile mended = repaired_file(atlas.file, repaired);
  CHECK(worst_corner(mended, [](Face) { return true; }) < 1e-12);
}

TEST_CASE("repaired_file: a hole within one piece of an atlas is filled as the piece goes on") {
  const TriangleMesh whole = icosphere(3);
  const Vertex v = vertex_at(whole, {1, 1, 0.3});
  const TriangleMesh mesh = without_faces(whole, faces_at(whole, v));
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.inspection.is_sphere());
  const MeshFile mended = repaired_file(Atlas(mesh).file, repaired);
  CHECK(worst_corner(mended, [](Face) { return true; }) < 1e-12);
}

TEST_CASE("repaired_file: a hole across a seam of an atlas has the texture of its rim") {
  const TriangleMesh whole = icosphere(3);
  for (const Vector3& direction : {Vector3(1, 0, 0.2), Vector3(0, 1, 0.1), Vector3(0, 0, 1)}) {
    const TriangleMesh mesh = without_faces(whole, faces_at(whole, vertex_at(whole, direction)));
    const RepairedMesh repaired = repair_mesh(mesh);
    REQUIRE(repaired.inspection.is_sphere());
    const MeshFile mended = repaired_file(Atlas(mesh).file, repaired);
    CHECK(worst_corner(mended, [&](Face f) { return !is_new(repaired, f); }) < 1e-12);
    // A piece of the atlas is 7 from the next; across the hole it is 0.3.
    CHECK(worst_corner(mended, [&](Face f) { return is_new(repaired, f); }) < 0.4);
  }
}

TEST_CASE("repaired_file: caps of a handle that is cut have the texture of their rims") {
  const TriangleMesh mesh = bumped_torus(12, 30, 0.3, 0, 1);
  const RepairedMesh repaired = repair_mesh(mesh, {.longest_handle = 1});
  REQUIRE(repaired.handles.size() == 1);
  const MeshFile mended = repaired_file(Atlas(mesh).file, repaired);
  CHECK(worst_corner(mended, [&](Face f) { return !is_new(repaired, f); }) < 1e-12);
  CHECK(worst_corner(mended, [&](Face f) { return is_new(repaired, f); }) < 1);
}

TEST_CASE(
    "shared_places: rims of a handle that was cut lie on one another, told for what welds them") {
  MeshSource source;
  source.path = "a ring.ply";
  source.file.mesh = bumped_torus(12, 30, 0.3, 0, 1);
  source.inspection = inspect_mesh(source.file.mesh);
  CHECK(shared_places(source.file.mesh).vertices == 0);
  CHECK(shared_places_line(source).empty());
  const MeshSource whole = repaired(source, {.longest_handle = 1});
  REQUIRE(whole.handles.size() == 1);
  // The loop is there twice. Each of its edges has two faces of the surface and one of each cap.
  const long edges = std::ssize(whole.handles[0].vertices);
  const SharedPlaces shared = shared_places(whole.file.mesh);
  CHECK(shared.vertices == edges);
  CHECK(shared.edges == edges);
  CHECK_THAT(shared_places_line(whole),
             Catch::StartsWith(std::to_string(edges) + " vertices lie exactly on others") &&
                 Catch::Contains(std::to_string(edges) + " edges with more than two faces then") &&
                 Catch::Contains("`sphparam wrap 'a ring.ply' -o wrapped.ply`"));
  // So it is for a reader that welds.
  const MeshInspection welded = inspect_mesh(weld_exact(whole.file).file.mesh);
  REQUIRE_FALSE(welded.is_sphere());
  const auto crowded =
      std::ranges::find(welded.defects, DefectKind::NonManifoldEdge, &MeshDefect::kind);
  REQUIRE(crowded != welded.defects.end());
  CHECK(crowded->count == edges);
}

TEST_CASE("shared_places: sheets that touch in a vertex, and what was there before any repair") {
  // Two tetrahedra with one vertex in common.
  MeshSource source;
  source.path = "two.ply";
  source.file.mesh.positions =
      Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  source.file.mesh.triangles = Triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                                         {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
  source.inspection = inspect_mesh(source.file.mesh);
  RepairOptions split = RepairOptions::none();
  split.non_manifold = true;
  const MeshSource apart = mended(source, split);
  CHECK(shared_places(apart.file.mesh).vertices == 1);
  CHECK(shared_places(apart.file.mesh).edges == 0);
  CHECK_THAT(shared_places_line(apart), Catch::StartsWith("1 vertex lies exactly on another") &&
                                            Catch::Contains("the surface touches itself then"));
  MeshSource before = apart;  // as it would be read
  before.repairs.clear();
  CHECK(shared_places_line(before).empty());
}

TEST_CASE("repaired_file: a texture that goes once around is not swept through where it ends") {
  // s is the longitude: it meets itself at a seam, which a hole at the top and one at the side
  // touch.
  const TriangleMesh whole = icosphere(3);
  for (const Vector3& direction : {Vector3(-1, 0, 0.1), Vector3(0, 0, 1)}) {
    const TriangleMesh mesh = without_faces(whole, faces_at(whole, vertex_at(whole, direction)));
    MeshFile file;
    file.mesh = mesh;
    file.corner_texcoords.emplace(mesh.triangles.size(), 2);
    for (Face f = 0; f < mesh.face_count(); ++f) {
      Vector3 middle = Vector3::Zero();
      for (int k = 0; k < 3; ++k) middle += mesh.position(mesh.triangles(f, k));
      const double around = std::atan2(middle.y(), middle.x());
      for (int k = 0; k < 3; ++k) {
        const Vector3 p = mesh.position(mesh.triangles(f, k));
        const double turn = std::remainder(std::atan2(p.y(), p.x()) - around, 2 * std::numbers::pi);
        file.corner_texcoords->row(3 * f + k) << (around + turn) / (2 * std::numbers::pi), p.z();
      }
    }
    const RepairedMesh repaired = repair_mesh(mesh);
    const MeshFile mended = repaired_file(file, repaired);
    double widest = 0;
    for (Face f = 0; f < mended.mesh.face_count(); ++f) {
      if (!is_new(repaired, f)) continue;
      const auto s = mended.corner_texcoords->col(0).segment<3>(3 * f);
      widest = std::max(widest, s.maxCoeff() - s.minCoeff());
    }
    CHECK(widest < 0.4);
  }
}

TEST_CASE("repaired_file: halves of a face that a flat one cuts in two keep its texture") {
  // The flat face is of another piece of the atlas.
  TriangleMesh mesh = with_junction(icosphere(2), 10, 0.5);
  const Vertex a = mesh.triangles(10, 0), middle = mesh.triangles(10, 1);
  const Vertex b = mesh.triangles(mesh.face_count() - 1, 1);
  mesh.triangles.conservativeResize(mesh.face_count() + 1, 3);
  mesh.triangles.bottomRows(1) << a, b, middle;
  Atlas atlas(mesh);
  const Face flat = static_cast<Face>(mesh.face_count() - 1);
  for (int k = 0; k < 3; ++k) atlas.file.corner_texcoords->row(3 * flat + k) << 500, 500;
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.inspection.is_sphere());
  REQUIRE(repaired.actions.size() == 1);
  CHECK(repaired.actions[0].kind == RepairKind::FlatFaceTurned);
  const MeshFile mended = repaired_file(atlas.file, repaired);
  CHECK(worst_corner(mended, [](Face) { return true; }) < 1e-12);
}

TEST_CASE("repaired_file: where a diagonal turns from one piece to another, both keep their own") {
  // A flap on an edge, whose two faces have that edge too.
  TriangleMesh mesh = icosphere(1);
  const Face flap = static_cast<Face>(mesh.face_count());
  const Vertex a = mesh.triangles(0, 0), b = mesh.triangles(0, 1);
  const Vertex tip = static_cast<Vertex>(mesh.vertex_count());
  mesh.positions.conservativeResize(tip + 1, 3);
  mesh.positions.row(tip) = 0.6 * (mesh.positions.row(a) + mesh.positions.row(b)).eval();
  mesh.triangles.conservativeResize(flap + 2, 3);
  mesh.triangles.bottomRows(2) << a, tip, b, b, tip, a;
  const RepairedMesh repaired = repair_mesh(mesh);
  REQUIRE(repaired.actions.back().kind == RepairKind::DiagonalTurned);

  MeshFile file = labelled(mesh);
  check_labels(file, repaired_file(file, repaired));  // of one piece
  const Eigen::RowVector2d elsewhere(500, 500);
  file.corner_texcoords->bottomRows(6).rowwise() = elsewhere;
  const MeshFile mended = repaired_file(file, repaired);
  int turned = 0;
  for (Face f = 0; f < mended.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector2d shown = mended.corner_texcoords->row(3 * f + k);
      const auto corner = [&](int i) { return mended.mesh.triangles(f, (k + i) % 3); };
      const Vector3 here = mended.mesh.position(corner(0)), from = mended.mesh.position(corner(1)),
                    side = mended.mesh.position(corner(2)) - from;
      if (mended.find_face_property("source_face")->values[f] >= flap) {
        CHECK(shown == elsewhere);
      } else if (corner(0) != tip) {
        CHECK(shown == here.head<2>().transpose());
      } else {  // what the side opposite shows nearest to it
        ++turned;
        const Vector3 nearest = from + (here - from).dot(side) / side.squaredNorm() * side;
        CHECK((shown - nearest.head<2>().transpose()).norm() < 1e-12);
      }
    }
  }
  CHECK(turned == 1);
}

TEST_CASE("repaired_file: second coordinates and tangents go where their corners go") {
  const TriangleMesh whole = icosphere(3);
  TriangleMesh mesh = without_faces(whole, faces_at(whole, vertex_at(whole, {1, 1, 0.3})));
  mesh = with_junction(mesh, 10, 0.25);
  Atlas atlas(mesh);
  MeshFile file = atlas.file;
  file.second_texcoords = file.corner_texcoords;
  file.corner_texcoords->setZero();
  file.corner_tangents = CornerTangents::Zero(mesh.triangles.size(), 4);
  file.corner_tangents->col(1).setOnes();
  file.corner_tangents->col(3).setConstant(-1);
  MeshFile mended = repaired_file(file, repair_mesh(mesh));
  CHECK(mended.corner_texcoords->isZero(0));
  REQUIRE(mended.corner_tangents);
  CHECK(mended.corner_tangents->rows() == mended.mesh.triangles.size());
  CHECK(mended.corner_tangents->col(1).isOnes());
  CHECK((mended.corner_tangents->col(3).array() == -1).all());
  mended.corner_texcoords = mended.second_texcoords;
  CHECK(worst_corner(mended, [](Face) { return true; }) < 1e-12);
}

TEST_CASE("repaired_file: texture coordinates of vertices stay there where they can") {
  const TriangleMesh whole = icosphere(2);
  const TriangleMesh mesh = without_faces(whole, faces_at(whole, 5));
  MeshFile file;
  file.mesh = mesh;
  Property s{"s", ScalarType::Float32, {}}, t{"t", ScalarType::Float32, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    s.values.push_back(mesh.positions(v, 0));
    t.values.push_back(mesh.positions(v, 1));
  }
  file.set_vertex_property(s);
  file.set_vertex_property(t);
  const MeshFile mended = repaired_file(file, repair_mesh(mesh));
  CHECK_FALSE(mended.corner_texcoords);
  for (const auto& [name, axis] : {std::pair("s", 0), std::pair("t", 1)}) {
    REQUIRE(mended.find_vertex_property(name));
    const VectorX column = mended.mesh.positions.col(axis);
    CHECK(mended.find_vertex_property(name)->values ==
          std::vector<double>(column.begin(), column.end()));
  }

  // A side that is cut at a vertex from elsewhere in the image: the vertex has two places there.
  MeshFile cut = file;
  cut.mesh = with_junction(whole, 10, 0.5);
  for (Property& property : cut.vertex_properties) property.values.push_back(9);
  const MeshFile closed = repaired_file(cut, repair_mesh(cut.mesh));
  REQUIRE(closed.corner_texcoords);
  CHECK(closed.corner_texcoord_type == ScalarType::Float32);
  CHECK_FALSE(closed.find_vertex_property("s"));
}

TEST_CASE("repaired_file: fillers of before stay, and those of the holes that are kept join them") {
  const TriangleMesh whole = icosphere(2);
  MeshFile file = labelled(without_faces(whole, faces_at(whole, 5)));
  FillerMarks marks(static_cast<size_t>(file.mesh.face_count()), 0);
  marks[0] = marks[7] = 1;
  mark_fillers(file, marks);
  const RepairedMesh repaired = repair_mesh(file.mesh, {.keep_holes = true});
  REQUIRE(repaired.inspection.is_sphere());
  marks.resize(repaired.face_origin.size(), 1);
  CHECK(fillers_of(repaired_file(file, repaired)) == marks);
}

TEST_CASE("loop_file: loops are closed lines in OBJ and PLY, and have no other names") {
  for (const char* name : {"a.obj", "b.ply", "folder.stl/C.PLY"}) CHECK(is_loop_file(name));
  for (const char* name : {"a.txt", "obj", "a.obj.off", ""}) CHECK_FALSE(is_loop_file(name));
  std::vector<HandleLoop> loops(2);
  loops[0].points = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
  loops[1].points = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  loops[1].filled = true;
  const std::string obj = serialise_loops("a.obj", loops);
  CHECK(obj.starts_with("# loops that handles were cut along\n# 1: cut along "));
  CHECK(obj.find("\no cut_1\nv 0 0 0\nv 1 0 0\nv 0 0.1 0\nl 1 2 3 1\n# 2: closed along ") !=
        std::string::npos);
  CHECK(obj.ends_with("\no fill_2\nv 0 0 2\nv 1 0 2\nv 0 1 2\nl 4 5 6 4\n"));
  const std::string ply = serialise_loops("a.ply", loops);
  CHECK(ply.starts_with("ply\n"));
  CHECK(
      ply.ends_with("\nend_header\n0 0 0\n1 0 0\n0 0.1 0\n0 0 2\n1 0 2\n0 1 2\n"
                    "0 1 1 0\n1 2 1 0\n2 0 1 0\n3 4 2 1\n4 5 2 1\n5 3 2 1\n"));
}

namespace {

/// With normals of vertices, corners and faces: the directions of their vertices, times `side`.
MeshFile with_normals(const TriangleMesh& mesh, double side) {
  MeshFile file;
  file.mesh = mesh;
  for (const auto& [name, axis] : {std::pair("nx", 0), std::pair("ny", 1), std::pair("nz", 2)}) {
    Property of_vertices{name, ScalarType::Float32, {}}, of_faces = of_vertices;
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      of_vertices.values.push_back(side * mesh.positions(v, axis));
    for (Face f = 0; f < mesh.face_count(); ++f)
      of_faces.values.push_back(side * mesh.positions(mesh.triangles(f, 0), axis));
    file.set_vertex_property(of_vertices);
    file.set_face_property(of_faces);
  }
  file.corner_normals.emplace(mesh.triangles.size(), 3);
  file.corner_tangents = CornerTangents::Zero(mesh.triangles.size(), 4);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    file.corner_normals->row(i) = side * mesh.positions.row(mesh.triangles.data()[i]);
    file.corner_tangents->row(i) << 1, 0, 0, -1;
  }
  return file;
}

/// All normals are the directions of vertices, to the last bit.
void check_outward(const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  for (const auto& [name, axis] : {std::pair("nx", 0), std::pair("ny", 1), std::pair("nz", 2)}) {
    const auto& of_vertices = file.find_vertex_property(name)->values;
    const auto& of_faces = file.find_face_property(name)->values;
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      CHECK(of_vertices[static_cast<size_t>(v)] == mesh.positions(v, axis));
    for (Face f = 0; f < mesh.face_count(); ++f)
      CHECK(of_faces[static_cast<size_t>(f)] == mesh.positions(mesh.triangles(f, 0), axis));
  }
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    CHECK(file.corner_normals->row(i) == mesh.positions.row(mesh.triangles.data()[i]));
}

void turn_over(TriangleMesh& mesh, Face f) {
  std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
}

}  // namespace

TEST_CASE("repaired_file: normals of vertices that halve edges are unit ones") {
  const MeshFile file = with_normals(octahedron(), 1);
  RepairOptions options = RepairOptions::none();
  options.edge_length = 1;
  const RepairedMesh repaired = repair_mesh(file.mesh, options);
  const MeshFile result = repaired_file(file, repaired);
  REQUIRE(repaired.created.size() >= 12);
  for (Vertex v = 0; v < result.mesh.vertex_count(); ++v) {
    Vector3 normal;
    for (const auto& [name, axis] : {std::pair("nx", 0), std::pair("ny", 1), std::pair("nz", 2)})
      normal[axis] = result.find_vertex_property(name)->values[static_cast<size_t>(v)];
    CHECK(normal.isApprox(result.mesh.position(v).normalized(), 1e-15));
  }
}

TEST_CASE("repaired_file: normals turn over with their faces") {
  TriangleMesh inward = icosphere(2);
  inward.triangles.col(1).swap(inward.triangles.col(2));

  SECTION("all of them") {
    const MeshFile turned = repaired_file(with_normals(inward, -1), repair_mesh(inward));
    check_outward(turned);
    CHECK((turned.corner_tangents->col(3).array() == 1).all());
    CHECK((turned.corner_tangents->col(0).array() == 1).all());
  }
  SECTION("with a hole that is filled") {
    const TriangleMesh open = without_faces(inward, faces_at(inward, 5));
    const RepairedMesh repaired = repair_mesh(open);
    REQUIRE(repaired.inspection.volume > 0);
    const MeshFile turned = repaired_file(with_normals(open, -1), repaired);
    for (Eigen::Index i = 0; i < turned.mesh.triangles.size(); ++i) {
      const Eigen::RowVector3d p = turned.mesh.positions.row(turned.mesh.triangles.data()[i]);
      CHECK(turned.corner_normals->row(i).dot(p) > 0.7);
    }
  }
  SECTION("not where they had been on that side alone") {
    const MeshFile turned = repaired_file(with_normals(inward, 1), repair_mesh(inward));
    check_outward(turned);
    CHECK((turned.corner_tangents->col(3).array() == -1).all());
  }
  SECTION("those of one patch: a vertex of both kinds goes by its faces") {
    TriangleMesh mixed = icosphere(2);
    for (const Face f : {0, 1, 2, 3, 90}) turn_over(mixed, f);
    MeshFile file = with_normals(mixed, 1);
    file.corner_tangents->col(3).setOnes();
    for (const Face f : {0, 1, 2, 3, 90}) {  // as a program does that takes them from the faces
      file.corner_normals->middleRows<3>(3 * f) *= -1;
      for (const char* name : {"nx", "ny", "nz"}) {
        Property of_faces = *file.find_face_property(name);
        of_faces.values[static_cast<size_t>(f)] *= -1;
        file.set_face_property(of_faces);
      }
    }
    for (const char* name : {"nx", "ny", "nz"}) {
      Property normals = *file.find_vertex_property(name);
      const int axis = name[1] - 'x';
      for (const Face f : {0, 1, 2, 3, 90}) {
        const Vertex v = mixed.triangles(f, 0);
        normals.values[static_cast<size_t>(v)] = -mixed.positions(v, axis);
      }
      file.set_vertex_property(normals);
    }
    const RepairedMesh repaired = repair_mesh(mixed);
    REQUIRE(repaired.actions.at(0).count == 5);
    const MeshFile turned = repaired_file(file, repaired);
    check_outward(turned);
    for (Face f = 0; f < mixed.face_count(); ++f) {
      const bool was_turned = f < 4 || f == 90;
      CHECK((*turned.corner_tangents)(3 * f, 3) == (was_turned ? -1 : 1));
    }
  }
}

TEST_CASE(
    "mixed colours: half of black and half of white is half the light, in the channel's type") {
  const std::array<std::pair<double, double>, 2> bytes{{{0, 0.5}, {255, 0.5}}},
      reals{{{0, 0.5}, {1, 0.5}}};
  CHECK(mixed_colour("green", ScalarType::Uint8, bytes) == 188);
  CHECK(mixed_colour("alpha", ScalarType::Uint8, bytes) == 128);
  CHECK(mixed_colour("green", ScalarType::Float64, reals) == Approx(0.735357).margin(1e-5));
}

TEST_CASE("mixed colours: a real number called red that is alone is a number like others") {
  const auto column = [](const char* name, ScalarType type) { return Property{name, type, {0.5}}; };
  const Property real = column("red", ScalarType::Float32), byte = column("red", ScalarType::Uint8);
  const std::vector<Property> three{real, column("green", ScalarType::Float32),
                                    column("blue", ScalarType::Float32)};
  CHECK_FALSE(is_of_colour(real, {real}));
  CHECK(is_of_colour(byte, {byte}));  // never a mean of labels
  for (const Property& channel : three) CHECK(is_of_colour(channel, three));
  CHECK_FALSE(is_of_colour(column("height", ScalarType::Float32), three));
}
