#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

struct WeldResult {
  MeshFile file;
  std::vector<int> new_vertex;  // #V of the input: where each vertex went
  long merged = 0;              // vertices that are no longer there
};

/// Makes vertices of the same position (bit for bit, −0 = +0) one vertex, in the order of the first
/// copies.
///
/// Normals and texture coordinates that differ between the copies move to the corners; colours are
/// there too then (corner_colours.h). Of all other properties the first copy counts that a face
/// uses, and `source_vertex` names it. Faces stay, also those that now
/// name a vertex twice: `inspect_mesh` lists them.
/// Cost: O(#V + #F), expected.
WeldResult weld_exact(const MeshFile& file);

/// Drops vertices that no face names; `source_vertex` keeps the ids of the others. Returns the same
/// mesh file when all are used.
MeshFile drop_unused_vertices(MeshFile file);

/// A mesh file as the map takes it.
struct MappableMesh {
  MeshFile file;
  std::optional<Topology> topology;  // nothing where the faces are no closed manifold
};

/// Welded if its faces as indexed have boundary edges (a closed
/// mesh is never welded: that breaks those that touch themselves), then without unused vertices.
/// `notes`, where given, gets a line for each action.
/// Requires: indices in range, as readers ensure. Cost: that of `Topology`; where there is none,
/// sorting the stars of vertices by id.
MappableMesh make_mappable(MeshFile file, std::vector<std::string>* notes = nullptr);
/// Those of the notes that it made: vertices of the mesh are not the rows of its file.
std::vector<std::string> renumberings_among(const std::vector<std::string>& notes);
/// As `make_mappable`, without the topology.
MeshFile prepare_for_mapping(MeshFile file, std::vector<std::string>* notes = nullptr);

}  // namespace sphparam
