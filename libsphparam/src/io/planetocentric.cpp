#include "sphparam/io/planetocentric.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/sphere/radial_directions.h"

namespace sphparam {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr std::string_view centre_key = "radial-centre", movement_key = "radial-movement";

/// Numbers with blanks between, all of the text and finite.
template <size_t Count>
std::optional<std::array<double, Count>> numbers(std::string_view text) {
  std::array<double, Count> values;
  const char *at = text.data(), *const end = at + text.size();
  for (double& value : values) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    at = next;
  }
  return at == end ? std::optional(values) : std::nullopt;
}

const std::string* value_of(const Provenance& provenance, std::string_view key) {
  for (const auto& [name, value] : provenance)
    if (name == key) return &value;
  return nullptr;
}

}  // namespace

Provenance planetocentric_lines(const Parameterization& result) {
  if (!result.radial) return {};
  return planetocentric_lines(
      Planetocentric{result.radial->centre, result.radial->largest_movement});
}

Provenance planetocentric_lines(const Planetocentric& radial) {
  const Vector3& c = radial.centre;
  return {
      {std::string(centre_key), shortest(c.x()) + " " + shortest(c.y()) + " " + shortest(c.z())},
      {std::string(movement_key), shortest(radial.largest_movement)}};
}

bool is_planetocentric(const std::string& key) { return key == centre_key || key == movement_key; }

std::optional<Planetocentric> planetocentric(const Provenance& provenance) {
  const std::string* const centre = value_of(provenance, centre_key);
  const std::string* const movement = value_of(provenance, movement_key);
  if (!centre || !movement) return std::nullopt;
  const auto c = numbers<3>(*centre);
  const auto radians = numbers<1>(*movement);
  if (!c || !radians || radians->front() < 0) return std::nullopt;
  return Planetocentric{
      {(*c)[0], (*c)[1], (*c)[2]}, radians->front(), value_of(provenance, "anew") != nullptr};
}

Vector3 body_centre(const std::optional<Planetocentric>& radial,
                    const std::optional<Vector3>& given) {
  return given.value_or(radial ? radial->centre : Vector3(0, 0, 0));
}

bool is_about(const Planetocentric& radial, const Vector3& centre, const TriangleMesh& mesh) {
  constexpr double rounding = 1e-6;  // of positions in float32, of centres as they are typed
  const double radius =
      (mesh.positions.rowwise() - radial.centre.transpose()).rowwise().norm().mean();
  return (centre - radial.centre).norm() <= rounding * radius;
}

Eigen::Matrix3d body_axes(const MeshFile& file) {
  const UprightAxes axes = upright_axes(file);
  Eigen::Matrix3d rows = Eigen::Matrix3d::Identity();
  if (axes.up == Vector3::UnitZ() && axes.front == -Vector3::UnitY()) return rows;
  rows << axes.right().transpose(), -axes.front.transpose(), axes.up.transpose();
  return rows;
}

StandingBody standing_body(const MeshFile& file, const Vector3& centre) {
  const Eigen::Matrix3d axes = body_axes(file);
  if (axes.isIdentity(0)) return {file.mesh, centre};
  return {{file.mesh.positions * axes.transpose(), file.mesh.triangles}, axes * centre};
}

Parameterization parameterize_standing(const MeshFile& file, const Topology& topology,
                                       const ParameterizeOptions& options) {
  if (options.method != Method::Radial) return parameterize(file.mesh, topology, options);
  const StandingBody body = standing_body(file, options.centre);
  ParameterizeOptions there = options;
  there.centre = body.centre;
  Parameterization result = parameterize(body.mesh, topology, there);
  result.radial->centre = options.centre;
  return result;
}

SphereMap body_directions(const MeshFile& file, const Vector3& centre) {
  const StandingBody body = standing_body(file, centre);
  return radial_directions(body.mesh, body.centre);
}

double largest_movement(const Vector3& centre, const MeshFile& file, const SphereMap& map) try {
  const SphereMap directions = body_directions(file, centre);
  const Triangles surface = surface_of(file.mesh, fillers_of(file)).triangles;
  double largest = 0;
  for (Face f = 0; f < surface.rows(); ++f) {
    for (const Vertex v : surface.row(f)) {
      const double off = angle_between(map.point(v), directions.point(v));
      if (!(off <= largest)) largest = std::isnan(off) ? unknown : off;
    }
  }
  return largest;
} catch (const VertexAtCentre&) {
  return unknown;
}

bool is_as_said(const Planetocentric& radial, const MeshFile& file, const SphereMap& map) {
  constexpr double rounding = 1e-5;  // of positions in float32 near the centre
  return !radial.made_anew &&
         largest_movement(radial.centre, file, map) <= radial.largest_movement + rounding;
}

}  // namespace sphparam
