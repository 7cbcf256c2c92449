#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Vertices by their numbers in the file, from 0: welding, repair and dropping what no face uses
/// renumber the mesh, and people name vertices as their other programs show them.
class FileNumbers {
 public:
  /// Cost: O(#V log #V) where vertices were renumbered, else nothing.
  explicit FileNumbers(const MeshFile& file);

  /// The vertex of the mesh, or −1 where it has none: see `absence`.
  Vertex vertex(long number) const;

  /// The number in the file of a vertex of the mesh.
  long number(Vertex vertex) const;

  /// "the mesh has no vertex 99; they are 0 to 41".
  std::string absence(long number) const;

 private:
  Vertex vertices_;
  std::vector<double> numbers_;  // by vertex; empty: vertices have their numbers
  std::vector<std::pair<double, Vertex>> by_number_;  // sorted; the first of equal ones counts
};

}  // namespace sphparam
