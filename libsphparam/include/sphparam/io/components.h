#pragma once

#include <vector>

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// A connected part of a mesh, as a mesh of its own.
struct MeshPart {
  MeshSource source;      // its vertices and faces have the numbers of the file; the file's notes
  double area_share = 1;  // of all parts; of a mesh without area, its share of the faces
  /// Of what the largest part encloses: its faces look into it, and it is not told to be inside
  /// out.
  bool is_cavity = false;
};

/// Those of the repairs that come before components: the others are for each by itself.
RepairOptions before_components(RepairOptions repairs);

/// The connected parts of a mesh: what hangs together by vertices, once those of these repairs are
/// done that come before components (`repairs` of each part tells them, of the whole mesh). The
/// largest by area first; of equal ones that with more faces, then that with the lowest vertex.
/// Ensures: each vertex and face that a face uses is in one part; a mesh that is one part comes
/// back as it was. Cost: O((#V + #F) log #F), and an inspection of each.
std::vector<MeshPart> connected_parts(MeshSource source,
                                      const RepairOptions& repairs = RepairOptions::none());

/// A part after repairs of its own, as `repaired` mends a mesh; a cavity stays one: with
/// `orientation` its faces look into it, and it is not told to be inside out. Throws: as
/// `repaired`.
MeshSource repaired_part(MeshPart part, RepairOptions repairs);

/// What the components of a mesh need to be mapped each by itself, as `map --all-components` does.
struct PartsTrial {
  long parts = 0, mended = 0;  // of all; of those, that can be mapped then
  double area_share = 1;       // that these have
  bool as_they_are = true;     // nothing is to be mended in any of them
  RepairOptions options;       // that all those take
  bool are_enough() const;     // all can be mapped, or all but specks
};

/// Cost: that of the repairs.
PartsTrial try_parts(const MeshSource& source);

}  // namespace sphparam
