#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mesh/repair/paired_faces.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

RepairOptions keeping() {
  RepairOptions options = RepairOptions::none();
  options.holes = options.keep_holes = options.unused = true;
  return options;
}

/// Without the faces that `drop` tells.
template <class Drop>
TriangleMesh without(const TriangleMesh& mesh, const Drop& drop) {
  std::vector<Face> kept;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    if (!drop(f)) kept.push_back(f);
  }
  TriangleMesh result{mesh.positions, Triangles(std::ssize(kept), 3)};
  for (Eigen::Index i = 0; i < result.face_count(); ++i) {
    result.triangles.row(i) = mesh.triangles.row(kept[static_cast<size_t>(i)]);
  }
  return result;
}

Vector3 middle(const TriangleMesh& mesh, Face f) {
  return (mesh.position(mesh.triangles(f, 0)) + mesh.position(mesh.triangles(f, 1)) +
          mesh.position(mesh.triangles(f, 2))) /
         3;
}

/// A ball that is open where it is higher than this.
TriangleMesh bowl(int level, double height) {
  const TriangleMesh ball = icosphere(level);
  return without(ball, [&](Face f) { return middle(ball, f).z() > height; });
}

/// What keeping holes promises, whatever the mesh.
void check_kept(const TriangleMesh& mesh, const RepairedMesh& closed) {
  CHECK(closed.inspection.is_sphere());
  REQUIRE(std::ssize(closed.fillers) == closed.mesh.face_count());
  for (Face f = 0; f < closed.mesh.face_count(); ++f) {
    const bool filler = closed.fillers[static_cast<size_t>(f)] == 1;
    REQUIRE(filler == (closed.face_origin[static_cast<size_t>(f)] < 0));
    if (filler) continue;
    const Face origin = closed.face_origin[static_cast<size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      const Vertex v = closed.mesh.triangles(f, k);
      REQUIRE(closed.vertex_origin[static_cast<size_t>(v)] == mesh.triangles(origin, k));
      REQUIRE(closed.mesh.position(v) == mesh.position(mesh.triangles(origin, k)));
    }
  }
  CHECK(std::count(closed.fillers.begin(), closed.fillers.end(), 0) == mesh.face_count());
}

long boundary_edges(const TriangleMesh& mesh) {
  for (const MeshDefect& defect : inspect_mesh(mesh).defects) {
    if (defect.kind == DefectKind::BoundaryEdge) return defect.count;
  }
  return 0;
}

int greatest_valence(const TriangleMesh& mesh, Vertex from) {
  std::vector<int> valence(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    ++valence[static_cast<size_t>(mesh.triangles.data()[i])];
  }
  return *std::max_element(valence.begin() + from, valence.end());
}

/// A disk with a thin tongue on every side, up and down in turn: a boundary of twice as many edges.
TriangleMesh comb(int tongues, double length) {
  TriangleMesh mesh{Points(2 * tongues + 1, 3), Triangles(2 * tongues, 3)};
  const Vertex centre = 2 * tongues;
  mesh.positions.row(centre).setZero();
  for (int i = 0; i < tongues; ++i) {
    const double angle = 6.283185307179586 * i / tongues;
    const Vector3 a(std::cos(angle), std::sin(angle), 0);
    const Vertex next = (i + 1) % tongues, tip = tongues + i;
    mesh.positions.row(i) = a;
    mesh.positions.row(tip) = length * a + Vector3(0, 0, length * (i % 2 == 0 ? 1 : -1));
    mesh.triangles.row(2 * i) << centre, i, next;
    mesh.triangles.row(2 * i + 1) << i, tip, next;
  }
  return mesh;
}

}  // namespace

TEST_CASE("kept holes: every length is closed, by a few faces an edge, none with a high valence") {
  for (int n = 3; n <= 70; ++n) {
    // A cone of n faces: its boundary has n edges, and its closure is a sphere.
    TriangleMesh cone{Points(n + 1, 3), Triangles(n, 3)};
    cone.positions.row(n) << 0, 0, 1;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      cone.positions.row(i) << std::cos(angle), std::sin(angle), 0.3 * std::sin(7 * angle);
      cone.triangles.row(i) << i, (i + 1) % n, n;
    }
    INFO(n << " edges");
    const RepairedMesh closed = repair_mesh(cone, keeping());
    check_kept(cone, closed);
    CHECK(closed.mesh.face_count() - n <= 4 * n);
    CHECK(greatest_valence(closed.mesh, n + 1) <= 9);
    for (const CreatedVertex& created : closed.created) CHECK(!created.mean_of.empty());
  }
}

TEST_CASE("kept holes: several holes at once, bent ones, and a comb with two thousand edges") {
  const TriangleMesh ball = icosphere(4);
  const TriangleMesh holed = without(ball, [&](Face f) {
    const Vector3 x = middle(ball, f);
    return x.z() > 0.8 || x.x() > 0.9 || (std::abs(x.y()) < 0.05 && x.x() < -0.3) || f == 17;
  });
  const RepairedMesh closed = repair_mesh(holed, keeping());
  check_kept(holed, closed);
  REQUIRE(closed.actions.front().kind == RepairKind::HoleKept);
  CHECK(closed.actions.front().count == inspect_mesh(holed).boundary_loops);

  const TriangleMesh teeth = comb(1000, 3);
  CHECK(boundary_edges(teeth) == 2000);
  check_kept(teeth, repair_mesh(teeth, keeping()));
}

TEST_CASE("kept holes: memory of fillers is linear in the boundary") {
  const RepairedMesh closed = repair_mesh(bowl(6, -0.9), keeping());
  size_t origins = 0;
  for (const CreatedVertex& created : closed.created) origins += created.mean_of.size();
  CHECK(origins <= 4 * closed.created.size());
}

TEST_CASE("kept holes: once closed, nothing is left to do, nothing is turned over") {
  const RepairedMesh once = repair_mesh(bowl(3, -0.5), keeping());
  const RepairedMesh again = repair_mesh(once.mesh, keeping());
  CHECK(again.actions.empty());
  CHECK(again.mesh.triangles == once.mesh.triangles);

  TriangleMesh inside_out = bowl(3, -0.5);
  inside_out.triangles.col(1).swap(inside_out.triangles.col(2));
  RepairOptions options;
  options.keep_holes = true;
  const RepairedMesh closed = repair_mesh(inside_out, options);
  check_kept(inside_out, closed);
  for (Face f = 0; f < inside_out.face_count(); ++f) {
    REQUIRE(closed.face_origin[static_cast<size_t>(f)] == f);
  }
}

TEST_CASE("kept holes: what a filler is cut into are fillers, and what a face is are none") {
  const TriangleMesh mesh = octahedron();
  const Topology topology(mesh);
  RepairState state(mesh);
  std::vector<Halfedge> twin;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) twin.push_back(topology.twin(h));
  state.fillers[0] = 1;
  PairedFaces faces(state, twin);
  faces.split(0);
  REQUIRE(state.face_count() == 10);
  CHECK(std::count(state.fillers.begin(), state.fillers.end(), 1) == 2);
  CHECK(state.fillers[0] + state.fillers[8] + state.fillers[9] == 2);
}

TEST_CASE("kept holes: handles go where there are holes too, along loops on the surface") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const TriangleMesh torus = bumped_torus(16, 48, 0.4, 0.05, seed);
    const Vector3 at = torus.position(static_cast<Vertex>(100 * seed));
    const TriangleMesh holed =
        without(torus, [&](Face f) { return (middle(torus, f) - at).norm() < 0.3; });
    REQUIRE(inspect_mesh(holed).boundary_loops == 1);
    RepairOptions options = keeping();
    options.handles = true;
    options.longest_handle = 10;
    for (const HandleChoice choice :
         {HandleChoice::Shortest, HandleChoice::Cut, HandleChoice::Fill, HandleChoice::Area}) {
      options.handle_choice = choice;
      const RepairedMesh closed = repair_mesh(holed, options);
      INFO("seed " << seed << ", choice " << static_cast<int>(choice));
      CHECK(closed.inspection.is_sphere());
      REQUIRE(closed.handles.size() == 1);
      for (const Vertex v : closed.handles[0].vertices) CHECK(v >= 0);
      // What caps the handle is surface, what closes the hole is not.
      const auto fillers = std::count(closed.fillers.begin(), closed.fillers.end(), 1);
      const auto made = std::count(closed.face_origin.begin(), closed.face_origin.end(), -1);
      CHECK(fillers > 0);
      CHECK(fillers < made);
    }
  }
}

TEST_CASE(
    "kept holes: surface_of drops fillers, surface_in_place makes them points of the surface") {
  const TriangleMesh open = bowl(2, 0.2);
  const RepairedMesh closed = repair_mesh(open, keeping());
  CHECK(surface_of(closed.mesh, {}).triangles == closed.mesh.triangles);
  const TriangleMesh surface = surface_of(closed.mesh, closed.fillers);
  CHECK(surface.face_count() == open.face_count());
  CHECK(boundary_edges(surface) == boundary_edges(open));
  const TriangleMesh in_place = surface_in_place(closed.mesh, closed.fillers);
  REQUIRE(in_place.face_count() == closed.mesh.face_count());
  for (Face f = 0; f < in_place.face_count(); ++f) {
    if (!closed.fillers[static_cast<size_t>(f)]) {
      REQUIRE(in_place.triangles.row(f) == closed.mesh.triangles.row(f));
      continue;
    }
    const Vertex v = in_place.triangles(f, 0);
    REQUIRE((in_place.triangles(f, 1) == v && in_place.triangles(f, 2) == v));
    REQUIRE((surface.triangles.array() == v).any());
  }
}
