#pragma once

#include <vector>

#include "sphparam/io/file_numbers.h"

namespace sphparam {

/// The vertex of a file that is nearest to a point. It need not be a corner of the triangle that
/// holds the point: triangles may be long. What repair added has no number there, and is none.
/// Cost: n log n once; then those within a slab about the point, as thick as the nearest is far.
class NearestVertex {
 public:
  NearestVertex(const TriangleMesh& mesh, const FileNumbers& numbers);

  /// By its number in the file, the least of equals; −1: there is none.
  long at(const Vector3& point) const;

 private:
  struct Place {
    Vector3 position;
    long number;
  };
  std::vector<Place> places_;  // by x
};

}  // namespace sphparam
