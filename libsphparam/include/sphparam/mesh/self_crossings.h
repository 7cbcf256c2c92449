#pragma once

#include <array>
#include <cstdint>

#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// Where a surface crosses itself in space.
struct SelfCrossings {
  std::int64_t pairs = 0;                // of faces that cross
  std::int64_t faces = 0;                // that cross another
  FillerMarks marks;                     // #F: 1 where a face does; empty where none does
  std::array<Face, 2> first = {-1, -1};  // the first face that does, and the first that it crosses
  Vector3 place = Vector3::Zero();       // of these: the middle of what their boxes share
  bool all = true;  // false: not all pairs were looked at, and there may be more that cross

  /// It is proved that none cross: their insides are apart, if not their sides.
  bool none() const { return all && pairs == 0; }
};

/// Looks a face that end a soup within a second or so of 100,000 faces, and no surface.
constexpr int usual_looks = 1000;

struct SelfCrossingOptions {
  /// Ends when more pairs were looked at than this many a face, as in soups whose faces all run
  /// across the whole; some 50 are on surfaces as they come. 0: goes on to the end.
  int most_looks = 0;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// Counts the pairs of faces of a mesh that cross: their insides have a point in common. So they
/// pass through one another, or lie over one another in a plane, also beside a corner or a side
/// that they share, as two do that a fold lays together. Sides and corners that only touch do not
/// count, wherever they do, nor faces without area; none names its vertices: those at one place are
/// one. Signs are exact: for the positions as they are none at all is a proof. A fold whose faces
/// lie the rounding of a coordinate apart is none.
///
/// Any mesh; faces that name vertices that are not there, or of which a coordinate is not finite,
/// are left out. Ensures: the same for any number of threads, and for faces in any order, if not
/// cut short. Throws: std::invalid_argument where most_looks < 0; Cancelled. Source: our own, by
/// Guigue and Devillers' test of two triangles (2003) over a tree of boxes. Cost: O(n log n) on
/// surfaces, about 1 µs a face; what is crossed a thousandfold costs its pairs. 150 bytes a face.
SelfCrossings find_self_crossings(const TriangleMesh& mesh,
                                  const SelfCrossingOptions& options = {});

}  // namespace sphparam
