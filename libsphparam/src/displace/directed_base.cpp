// A guess is where the flat faces of the grid have the direction; corners of a face become those of
// its patch.

#include "displace/directed_base.h"

#include <array>

namespace sphparam {

namespace {

std::array<double, 2> corner_parameters(int degree, int corner) {
  if (degree == 3) return {corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0};
  return {corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0};
}

}  // namespace

DirectedBase::DirectedBase(const SphereGrid& grid, const Points& control, Scheme scheme,
                           int threads)
    : divided_(!faces_are_patches(grid.faces, scheme)),
      grid_faces_(grid.faces),
      cut_(triangulate(grid.directions, grid.faces)),
      grid_map_{grid.directions} {
  // Refuses what no surface is made for before it is divided.
  auto topology =
      std::make_shared<const LimitTopology>(grid.faces, static_cast<int>(control.rows()), scheme);
  ControlMesh mesh{grid.faces, {control, grid.directions}};
  if (divided_) {
    mesh = subdivide_to_quads(mesh);
    topology = std::make_shared<const LimitTopology>(
        mesh.faces, static_cast<int>(mesh.points[0].rows()), scheme);
  }
  faces_ = std::move(mesh.faces);
  net_ = std::make_unique<PatchNet>(faces_);
  surface_ = std::make_unique<LimitSurface>(topology, std::move(mesh.points[0]));
  directions_ = std::make_unique<LimitSurface>(topology, std::move(mesh.points[1]));
  grid_topology_ = std::make_unique<Topology>(cut_.triangles,
                                              static_cast<int>(grid_map_.points.rows()), threads);
  locator_ = std::make_unique<SphereLocator>(*grid_topology_, grid_map_, threads);
}

LimitPlace DirectedBase::guess(const Vector3& direction) const {
  const SurfacePoint point = locator_->locate(direction);
  const auto polygon = static_cast<int>(cut_.polygon_of(point.face));
  const int first = grid_faces_.starts[static_cast<size_t>(polygon)];
  if (divided_) {
    int nearest = 0;
    point.barycentric.maxCoeff(&nearest);
    constexpr double a_third = 1.0 / 3;
    return {static_cast<int>(cut_.corner_of(3 * std::int64_t{point.face} + nearest)), a_third,
            a_third};
  }
  LimitPlace place{polygon, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const auto corner = static_cast<int>(cut_.corner_of(3 * std::int64_t{point.face} + k)) - first;
    const auto [s, t] = corner_parameters(net_->degree(), corner);
    place.s += point.barycentric[k] * s;
    place.t += point.barycentric[k] * t;
  }
  return place;
}

}  // namespace sphparam
