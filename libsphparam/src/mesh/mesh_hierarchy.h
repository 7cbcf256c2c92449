#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

/// One level of a hierarchy: a closed triangle mesh stored as the rings of its vertices.
///
/// A vertex that the next coarser level lacks keeps its ring here, and all of that ring survives:
/// going back up, the vertex is put into its ring without any surgery on the mesh.
struct HierarchyLevel {
  Points positions;        // of the source, centred and scaled to total area 4π: see MeshHierarchy
  std::vector<int> start;  // #v+1: ring of v is ring[start[v]] … ring[start[v + 1] − 1]
  std::vector<Vertex> ring;     // neighbours, counter-clockwise seen from outside
  std::vector<Vertex> removed;  // of this level's vertices, those the next coarser level lacks
  std::vector<Vertex> finer;    // #v: each vertex's name one level finer; empty on the finest level

  int vertex_count() const { return static_cast<int>(start.size()) - 1; }
  int valence(Vertex v) const {
    return start[static_cast<size_t>(v) + 1] - start[static_cast<size_t>(v)];
  }
  const Vertex* ring_begin(Vertex v) const { return ring.data() + start[static_cast<size_t>(v)]; }
};

/// Vertices that stay as long as a level has more than `until` vertices, unless nothing else can be
/// removed.
struct KeptVertices {
  std::vector<Vertex> vertices;
  int until = 0;
};

/// Levels from the mesh itself (first) down to a tetrahedron (last). The last level has the
/// positions of all its vertices, the others those of `removed`, in that order: on the way up every
/// level gets the rest from the one below it, by `complete_positions`.
using MeshHierarchy = std::vector<HierarchyLevel>;

/// Builds the hierarchy by batches of half-edge collapses: each batch removes an independent set of
/// cheap vertices, about a fifth of all. Short edges go first; high valences are avoided.
/// Vertex names of level 0 are the mesh's own.
/// Ensures: every level is a closed genus-0 triangulation without double edges; same levels for any
///          number of threads.
/// Requires: genus 0, finite positions; no vertex kept twice. Throws: Cancelled, between batches.
/// Cost: linear for any valences; about 0.2 µs a triangle. Our own: the full levels of a multigrid
/// method, with the collapses of Hoppe, "Progressive meshes" (1996), so that batches run in
/// parallel and nothing has to be undone.
MeshHierarchy build_hierarchy(const TriangleMesh& mesh, const Topology& topology, int threads = 0,
                              const KeptVertices& keep = {}, const Progress& progress = {});

/// Makes `level.positions` those of all its vertices. Requires: `coarser`, the next level, is
/// complete.
void complete_positions(HierarchyLevel& level, const HierarchyLevel& coarser, int threads = 0);

/// The name of a level's vertex on the next coarser level; −1 where it was removed.
Vertex coarser_name(const HierarchyLevel& coarser, Vertex v);

/// A complete level as a mesh of its own, with the same vertex names.
TriangleMesh triangle_mesh(const HierarchyLevel& level);

}  // namespace sphparam
