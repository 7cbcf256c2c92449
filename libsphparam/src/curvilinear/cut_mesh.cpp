#include "curvilinear/cut_mesh.h"

// Walk around each inner vertex v of the date line, counter-clockwise seen from outside. From the
// edge that goes on south to the edge that came from north lie the faces of the eastern bank
// (turn 0), from there back to the first edge those of the western bank (turn 1): their corners at
// v get θ(v) + 2π.

namespace sphparam {
namespace {

/// The link of a pole from `first`, counter-clockwise or clockwise seen from outside.
std::vector<Vertex> link_from(const Topology& topology, Vertex pole, Vertex first,
                              bool counter_clockwise) {
  std::vector<Vertex> link;
  const Halfedge start = topology.find_halfedge(pole, first);
  Halfedge h = start;
  do {
    link.push_back(topology.target(h));
    h = counter_clockwise ? topology.rotate_ccw(h) : topology.rotate_cw(h);
  } while (h != start);
  return link;
}

}  // namespace

CutMesh::CutMesh(const Topology& topology, DateLine date_line)
    : date_line_(std::move(date_line)),
      vertex_count_(topology.vertex_count()),
      faces_(static_cast<size_t>(topology.face_count()), 0) {
  const std::vector<Vertex>& path = date_line_.path;
  for (const Vertex pole : {path.front(), path.back()}) {
    topology.for_each_outgoing(
        pole, [&](Halfedge h) { faces_[static_cast<size_t>(Topology::face(h))] |= removed_bit; });
  }
  // Seen from outside, east of north lies counter-clockwise, east of south clockwise.
  north_link_ = link_from(topology, path.front(), path[1], true);
  south_link_ = link_from(topology, path.back(), path[path.size() - 2], false);
  open_banks(topology);
}

void CutMesh::open_banks(const Topology& topology) {
  const std::vector<Vertex>& path = date_line_.path;
  std::vector<Halfedge> western;  // those that leave the date line in a western face
  for (size_t i = 1; i + 1 < path.size(); ++i) {
    const Halfedge to_south = topology.find_halfedge(path[i], path[i + 1]);
    const Halfedge to_north = topology.find_halfedge(path[i], path[i - 1]);
    for (Halfedge h = to_north; h != to_south; h = topology.rotate_ccw(h)) {
      faces_[static_cast<size_t>(Topology::face(h))] |=
          static_cast<std::uint8_t>(1 << Topology::corner(h));
      if (h != to_north) western.push_back(h);
    }
  }
  for (const Halfedge h : western) {
    // On a path with chords both ends can be western, and then nothing jumps.
    if (jump(h) == 0 || is_pole(topology.target(h))) continue;
    const Halfedge twin = topology.twin(h);
    jumps_.push_back({h, jump(h)});
    jumps_.push_back({twin, -jump(h)});
  }
}

}  // namespace sphparam
