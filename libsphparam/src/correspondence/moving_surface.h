#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "correspondence/composed_energy.h"
#include "correspondence/target_surface.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// Values of the source's vertices that are to be those of the target where they lie: weight/k ·
/// Σ |here − there|² is added to the energy of a vertex, over k columns.
struct FeatureTerm {
  Functions here = {};               // #v×k
  VectorX weight = {};               // #v
  const Functions* there = nullptr;  // of the target's vertices, linear in its faces

  bool is_there() const { return there != nullptr; }
};

/// Triangles of a source whose vertices lie at places of a target: what the energy of the
/// composition is a function of. Plain state; borrows all but the places.
class MovingSurface {
 public:
  /// Vertices marked in `held` may not move. `rest`: of the faces, of a source of the area 4π.
  MovingSurface(const Topology& topology, const RestTriangles& rest, const TargetSurface& target,
                std::vector<char> held, std::vector<Place> places, FeatureTerm features = {});

  const Topology& topology() const { return topology_; }
  const RestTriangles& rest() const { return rest_; }
  const TargetSurface& target() const { return target_; }
  bool is_held(Vertex v) const { return held_[static_cast<size_t>(v)] != 0; }
  const Place& place(Vertex v) const { return places_[static_cast<size_t>(v)]; }
  const std::vector<Place>& places() const { return places_; }
  void set(Vertex v, const Place& place) { places_[static_cast<size_t>(v)] = place; }
  void swap_places(std::vector<Place>& places) { places_.swap(places); }

  ComposedTerms terms(Face face, const ComposedEnergy& energy) const {
    return composed_terms(energy, rest_[static_cast<size_t>(face)], corners(face, places_));
  }
  /// What features add at a place of a vertex; and with derivatives in the ways of its frame, of
  /// second order without what bends.
  double feature_energy(Vertex v, const Place& at) const;
  struct FeatureTerms {
    Eigen::Vector2d gradient;
    Eigen::Matrix2d hessian;
  };
  FeatureTerms feature_terms(Vertex v) const;
  /// Whether a face's determinant is certain to be positive, with these places.
  bool certain(Face face, const std::vector<Place>& places) const;
  double energy_of(Face face, const ComposedEnergy& energy, const std::vector<Place>& places) const;
  /// With what features add; +∞ unless every determinant is certain to be positive.
  double energy(const ComposedEnergy& energy, const std::vector<Place>& places, int threads) const;

  /// Of the faces round a vertex, and of its features, if it were at this place; +∞ unless all are
  /// certain.
  double ring_energy(Vertex v, const Place& at, const ComposedEnergy& energy) const;
  /// One Newton step of one vertex, halved until it lowers the energy of its ring and keeps its
  /// triangles; false: none did.
  bool step(Vertex v, const ComposedEnergy& energy);
  /// One step of every vertex that may move, in the order of colours: the same for any number of
  /// threads.
  void sweep(const ComposedEnergy& energy, int threads);
  /// Calls visit(v) for every vertex that may move, never for two neighbours at once, in the order
  /// of colours: the same for any number of threads.
  void for_each_in_turn(int threads, const std::function<void(Vertex)>& visit);
  /// Of these vertices, no two of which are neighbours.
  void sweep(const std::vector<Vertex>& independent, const ComposedEnergy& energy, int threads);

 private:
  void make_colours();
  Places3 corners(Face face, const std::vector<Place>& places) const;

  const Topology& topology_;
  const RestTriangles& rest_;
  const TargetSurface& target_;
  std::vector<char> held_;
  std::vector<Place> places_;
  FeatureTerm features_;
  std::vector<std::vector<Vertex>> colours_;  // made by the first sweep
};

}  // namespace sphparam
