// The place of a direction q: D(s, t) = λq, by Newton. A step (δs, δt) solves
//   D + δs Dₛ + δt Dₜ = λ q,  so  δs = −det(D, Dₜ, q) / det(Dₛ, Dₜ, q),
//                                 δt = −det(Dₛ, D, q) / det(Dₛ, Dₜ, q)
// and goes over into the next patch where it leaves its own. Along a row of texels the two places
// before tell where the next one is, and one step is enough.

#include "displace/directed_base.h"

#include <array>
#include <cmath>

namespace sphparam {

namespace {

constexpr size_t kept_patches = 1024;   // of 2 kB
constexpr int most_steps = 24;          // of Newton, patches crossed included
constexpr double last_step = 1e-5;      // in parameters: the next one would be some 1e-10
constexpr double longest_step = 0.75;   // in parameters: beyond, a patch says nothing
constexpr double edge_rounding = 1e-9;  // beyond the edge of a patch, and still in it

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

PlaceFinder::PlaceFinder(const DirectedBase& base) : base_(base), kept_(kept_patches) {}

const DirectedPatch& PlaceFinder::patch(int index) {
  auto& kept = kept_[static_cast<size_t>(index) % kept_patches];
  if (!kept || kept->surface.index() != index) {
    kept = std::make_unique<DirectedPatch>(
        DirectedPatch{base_.surface().patch(index), base_.directions().patch(index)});
  }
  return *kept;
}

std::optional<LimitPlace> PlaceFinder::newton(const Vector3& q, LimitPlace place) {
  const PatchNet& net = base_.net();
  for (int step = 0; step < most_steps; ++step) {
    if (net.beyond(place) > edge_rounding) {
      place = net.cross(place);
      if (net.beyond(place) > 0) place = clamped(place, net.degree());
    }
    const LimitPlace inside = clamped(place, net.degree());
    const LimitPoint d = patch(inside.patch).direction.evaluate(inside.s, inside.t);
    const Vector3 across = d.by_s.cross(d.by_t);
    const double det = across.dot(q);
    if (!(det > 0) || !(d.position.dot(q) > 0)) return std::nullopt;
    double ds = d.by_t.cross(d.position).dot(q) / det, dt = d.position.cross(d.by_s).dot(q) / det;
    const double length = std::abs(ds) + std::abs(dt);
    if (!(length < 1e6)) return std::nullopt;
    if (length > longest_step) {
      ds *= longest_step / length;
      dt *= longest_step / length;
    }
    place = {inside.patch, inside.s + ds, inside.t + dt};
    if (length < last_step && net.beyond(place) <= edge_rounding)
      return clamped(place, net.degree());
  }
  return std::nullopt;
}

PlaceFinder::Found PlaceFinder::find(const Vector3& direction) {
  std::optional<LimitPlace> place;
  if (last_) {
    LimitPlace start = *last_;
    if (before_last_ && before_last_->patch == start.patch) {
      start.s += start.s - before_last_->s;
      start.t += start.t - before_last_->t;
    }
    place = newton(direction, start);
  }
  if (!place) place = newton(direction, base_.guess(direction));
  before_last_ = last_;
  last_ = place;
  const LimitPlace found = place ? *place : clamped(base_.guess(direction), base_.net().degree());
  return {found, &patch(found.patch), place.has_value()};
}

}  // namespace sphparam
