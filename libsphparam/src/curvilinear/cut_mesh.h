#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "mesh/laplace_system.h"
#include "sphparam/curvilinear/date_line.h"

namespace sphparam {

/// A copy of a vertex across the cut: θ(wedge) = θ(vertex) + 2π·turn. Only the inner vertices of
/// the date line have two; turn 0 is their eastern bank, where θ begins, turn 1 the western one.
enum class Wedge : int {};

/// The mesh without its poles, cut open along the date line: a disk.
/// Paper: Section 3, "the mesh resulting from cutting along the date line and removing the poles".
///
/// Faces keep their numbers; each corner knows its wedge, one byte a face.
class CutMesh {
 public:
  /// Requires: the path leaves and enters the poles' links once; no vertex twice. Cost: O(#F).
  CutMesh(const Topology& topology, DateLine date_line);

  const DateLine& date_line() const { return date_line_; }
  Poles poles() const { return {date_line_.path.front(), date_line_.path.back()}; }
  bool is_pole(Vertex v) const { return v == poles().north || v == poles().south; }

  /// Is f one of the triangles around a pole, which are not part of the disk?
  bool removed(Face f) const { return (faces_[static_cast<size_t>(f)] & removed_bit) != 0; }
  /// The turn of the corner at h's origin in h's face.
  int turn(Halfedge h) const {
    return faces_[static_cast<size_t>(Topology::face(h))] >> Topology::corner(h) & 1;
  }
  /// The wedge of that corner. Wedges of turn 0 have their vertex's number.
  Wedge wedge(const Topology& topology, Halfedge h) const {
    return Wedge{topology.origin(h) + turn(h) * vertex_count()};
  }
  Vertex vertex(Wedge w) const { return static_cast<int>(w) % vertex_count(); }
  int turn(Wedge w) const { return static_cast<int>(w) / vertex_count(); }

  /// The jump of θ along h = (i → j): 2π times (turn of j − turn of i), the same seen from both
  /// faces at h. Meaningless for edges at a pole.
  double jump(Halfedge h) const {
    return 2 * std::numbers::pi * (turn(Topology::next(h)) - turn(h));
  }
  /// All half-edges whose jump is not zero: those between the western bank and its neighbours.
  const std::vector<Jump>& jumps() const { return jumps_; }

  /// The rims of the disk: the poles' links, eastward (θ grows), from the date line.
  const std::vector<Vertex>& north_link() const { return north_link_; }
  const std::vector<Vertex>& south_link() const { return south_link_; }

 private:
  static constexpr std::uint8_t removed_bit = 8;
  int vertex_count() const { return vertex_count_; }
  void open_banks(const Topology& topology);

  DateLine date_line_;
  int vertex_count_;
  std::vector<std::uint8_t> faces_;  // bit c: turn of corner c; removed_bit
  std::vector<Jump> jumps_;
  std::vector<Vertex> north_link_, south_link_;
};

}  // namespace sphparam
