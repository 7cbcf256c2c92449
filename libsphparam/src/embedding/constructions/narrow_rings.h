#pragma once

#include <functional>
#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/sweeps/rest_ring.h"
#include "mesh/mesh_hierarchy.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// What a vertex found in its ring.
enum class Room { None, Narrow, Enough };

/// Vertices of a level that have no room where they belong, one at a time: on protrusions and
/// around slivers. What is squeezed in there and left so makes the rings of the next levels'
/// vertices narrower still, and no sweep of whole levels takes that back. Our own.
class NarrowRings {
 public:
  struct Options {
    DistortionEnergy energy;
    RestFloors floors;
    double over_relaxation;
    int threads;
    std::function<void()> ask;  // called now and then; may throw
  };

  /// Borrows all that it is given.
  NarrowRings(const HierarchyLevel& level, std::vector<ImagePoint>& image, const Options& options)
      : level_(level), image_(image), options_(options) {}

  /// Puts the vertex where the energy of its ring is least on the way from the middle of the ring's
  /// kernel to where it lies in its ring on the source.
  Room place(Vertex v);

  /// Relaxes the neighbourhoods of these vertices, by sweeps, or by Newton steps where those do not
  /// help, until they have room or nothing gives way. `pinned` stay. Cost: some 50 sweeps of the
  /// neighbourhoods and a pass over the level; Newton steps: at most 8 patches of 100 vertices.
  void open(std::vector<Vertex> narrow, const std::vector<Vertex>& pinned);

 private:
  struct PlacedRing {
    std::vector<Vector3> image;
    RestRing rest;
  };
  struct Crowd {  // vertices without room
    double energy;
    Vertex vertex;
  };

  PlacedRing placed_ring(Vertex v) const;
  std::vector<Vertex> neighbourhood(std::vector<Vertex> near, int rings) const;
  void relax(const std::vector<Vertex>& near, const std::vector<Vertex>& pinned, int sweeps);
  std::vector<Crowd> crowds_among(const std::vector<Vertex>& near) const;
  void open_by_newton(std::vector<Crowd> crowds, const std::vector<Vertex>& pinned);

  const HierarchyLevel& level_;
  std::vector<ImagePoint>& image_;
  const Options& options_;
};

}  // namespace sphparam
