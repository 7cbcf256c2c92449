#include "mesh/sphere_gate.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

// Topology refuses all that is no closed manifold; what is left is counted. Only a mesh that fails
// is inspected, for the reasons.

namespace sphparam {
namespace {

/// Whether every vertex is reached from the first. A closed mesh without handles has χ = 2 a
/// component, so this and χ = 2 together mean genus 0.
bool is_connected(const Topology& topology) {
  std::vector<char> seen(static_cast<size_t>(topology.vertex_count()), 0);
  std::vector<Vertex> stack{0};
  seen[0] = 1;
  long reached = 1;
  while (!stack.empty()) {
    const Vertex v = stack.back();
    stack.pop_back();
    topology.for_each_outgoing(v, [&](Halfedge h) {
      char& mark = seen[static_cast<size_t>(topology.target(h))];
      if (mark) return;
      mark = 1;
      ++reached;
      stack.push_back(topology.target(h));
    });
  }
  return reached == topology.vertex_count();
}

/// Whether any of them is a defect of the surface, or nobody says what is wrong; else there are no
/// faces, or only vertices that do not exist or have no place.
bool are_of_surface(const std::vector<MeshDefect>& defects) {
  return defects.empty() ||
         std::any_of(defects.begin(), defects.end(), [](const MeshDefect& defect) {
           return defect.kind != DefectKind::Empty && defect.kind != DefectKind::IndexOutOfRange &&
                  defect.kind != DefectKind::NonFinitePosition;
         });
}

std::string joined_messages(const std::vector<MeshDefect>& defects) {
  std::string text = are_of_surface(defects) ? "the mesh is not a closed genus-0 manifold"
                                             : "the mesh cannot be used";
  for (const MeshDefect& defect : defects) text += "; " + defect.message;
  return text;
}

}  // namespace

void refuse_mesh(const TriangleMesh& mesh) {
  std::vector<MeshDefect> reasons;
  for (MeshDefect& defect : inspect_mesh(mesh).defects) {
    if (defect.fatal || defect.kind == DefectKind::UnusedVertex) reasons.push_back(defect);
  }
  throw MeshError(std::move(reasons));
}

MeshError::MeshError(std::vector<MeshDefect> defects)
    : std::runtime_error(joined_messages(defects)), defects_(std::move(defects)) {}

Topology require_sphere(const TriangleMesh& mesh, int threads) {
  if (mesh.face_count() < 4 || !mesh.positions.allFinite()) refuse_mesh(mesh);
  Topology topology(mesh, threads);
  require_sphere(mesh, topology);
  return topology;
}

void require_sphere(const TriangleMesh& mesh, const Topology& topology) {
  const int characteristic =
      topology.vertex_count() - topology.edge_count() + topology.face_count();
  // A torus beside two spheres has characteristic 2 as well.
  if (mesh.face_count() < 4 || !mesh.positions.allFinite() || characteristic != 2 ||
      !is_connected(topology)) {
    refuse_mesh(mesh);
  }
}

}  // namespace sphparam
