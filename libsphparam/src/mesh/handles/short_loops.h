#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "mesh/handles/loop_basis.h"

namespace sphparam {

/// A simple closed path of edges that does not separate the surface.
struct EdgeLoop {
  double length = 0;
  std::uint64_t label = 0;  // of its class, never 0
  std::vector<Vertex> vertices;
};

/// The length of a closed path, as it is.
double length_of(const std::vector<Vertex>& loop, const std::vector<Vector3>& places);

/// Searches for short loops that do not separate a surface. Lengths are of `places`, a little more
/// an edge, so that none is 0. May be asked by several threads.
class ShortLoops {
 public:
  /// What is given outlives this.
  ShortLoops(const Topology& topology, const LoopBasis& basis, const std::vector<Vector3>& places);
  ~ShortLoops();
  ShortLoops(const ShortLoops&) = delete;
  ShortLoops& operator=(const ShortLoops&) = delete;

  /// The shortest loop through (or, cut short, beside) a vertex of each class that has one of at
  /// most this length; of many classes the first found. Cost: the stars within half the length.
  std::vector<EdgeLoop> through(Vertex vertex, double longest) const;

  /// From the vertices of the basis: what is no longer than `reach` edges of the basis loop that it
  /// crosses, give or take a quarter, one a class, shortest first.
  std::vector<EdgeLoop> crossing_basis(double reach) const;

  /// Whether any loop of this length is found with this reach, and whether any loop at all is.
  bool reaches(double length, double reach) const;
  bool reaches_all(double reach) const;

  /// A loop of the same class that no vertex tried has a shorter one through.
  EdgeLoop tightened(EdgeLoop loop) const;

 private:
  class Queue;
  struct Scratch;
  class Lease;
  struct Base {
    Vertex vertex;
    double longest;
  };
  /// An edge as a vertex sees it. What a search reads of the mesh lies together.
  struct Arc {
    Vertex target;
    double length;
    std::uint64_t label;
  };
  struct Closing {
    Vertex from, to;
    double length;
    std::uint64_t label;  // of the whole loop
  };
  void list_arcs(const Topology& topology, const std::vector<Vector3>& places);
  static void keep_shortest(const Closing& found, std::vector<Closing>& of_each_label);
  EdgeLoop closed_by(const Scratch& scratch, const Closing& closing) const;
  std::vector<Base> candidates(double reach) const;
  std::vector<Base> bases(double reach) const;
  void cover(std::vector<char>& covered, Vertex vertex, double radius) const;

  const LoopBasis& basis_;
  const std::vector<Vector3>& places_;
  std::vector<size_t> first_arc_;  // per vertex, and the end
  std::vector<Arc> arcs_;
  std::vector<double> loop_lengths_;  // of the basis
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Scratch>> idle_;
};

}  // namespace sphparam
