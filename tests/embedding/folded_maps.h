#pragma once

#include <random>
#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/orientation.h"
#include "sphparam/sphere/sphere_map.h"

/// Maps that are wrong on purpose, and what is wrong with them.
namespace sphparam::tests {

inline bool is_folded(const Topology& topology, const SphereMap& map, Face f) {
  return orientation(map.point(topology.vertex(f, 0)), map.point(topology.vertex(f, 1)),
                     map.point(topology.vertex(f, 2))) <= 0;
}

inline std::vector<Face> folded_faces(const Topology& topology, const SphereMap& map) {
  std::vector<Face> faces;
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (is_folded(topology, map, f)) faces.push_back(f);
  }
  return faces;
}

/// The unit directions of a mesh's vertices.
inline SphereMap radial_map(const TriangleMesh& mesh) { return normalised(mesh.positions); }

/// Every point moved by up to `amount` in each coordinate, then normalised.
inline SphereMap with_noise(const SphereMap& map, double amount, unsigned seed) {
  std::mt19937 random(seed);
  Points points = map.points;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    points.data()[i] += amount * (static_cast<double>(random()) / 2147483648.0 - 1);
  }
  return normalised(std::move(points));
}

/// The images of `pairs` vertices exchanged with those of a neighbour each.
inline SphereMap with_swaps(const Topology& topology, SphereMap map, int pairs, unsigned seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < pairs; ++i) {
    const Vertex v = static_cast<Vertex>(random() % static_cast<unsigned>(topology.vertex_count()));
    const Vertex w = topology.target(topology.outgoing(v));
    map.points.row(v).swap(map.points.row(w));
  }
  return map;
}

}  // namespace sphparam::tests
