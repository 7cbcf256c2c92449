#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "chart/sheet.h"

namespace sphparam {

/// Moves single vertices of a sheet, those that wait in a queue, to where the faces around them
/// are less low. What was folded may unfold by it; what was not does not fold.
class Easing {
 public:
  static constexpr double wanted = 4;    // cells: nothing is done for higher faces
  static constexpr double enough = 1.5;  // cells: what rounding to the grid cannot fold

  explicit Easing(Sheet& sheet)
      : sheet_(sheet), is_waiting_(static_cast<size_t>(sheet.vertex_count()), 0) {}

  void add(Vertex v);
  void add_corners(Face f);
  /// Until nothing waits, or so many vertices were looked at. A vertex that moves adds the corners
  /// of faces that are still low.
  void run(std::int64_t most);
  /// Moves v, from where it is, to the best place in a direction, if that is better.
  void slide(Vertex v, const SheetPoint& direction);

 private:
  /// A face around the vertex at hand, which is a corner of it; in the west y is a turn more.
  struct RingFace {
    SheetFace face;
    size_t corner;
    double turn;

    double cost_with(const SheetPoint& p);
  };

  void take_ring(Vertex v);
  /// Of the ring, with its vertex at p; at least `most` where it is not less than that.
  double cost_at(const SheetPoint& p, double most);
  bool ease(Vertex v);
  double longest_spoke(Vertex v) const;
  bool try_place(Vertex v, const SheetPoint& p, double& lowest);

  Sheet& sheet_;
  std::deque<Vertex> waiting_;
  std::vector<char> is_waiting_;
  std::vector<RingFace> ring_;  // of the vertex at hand
  size_t dear_ = 0;             // the face of it that was too dear last: most likely is again
};

}  // namespace sphparam
