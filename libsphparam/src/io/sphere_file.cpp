#include "sphparam/io/sphere_file.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "io/formats/freesurfer_comments.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "take_word.h"

// sx, sy, sz are what is certified; theta and phi are derived from them for the convenience of
// viewers, and cannot hold the seam (0 and 2π are one longitude).

namespace sphparam {
namespace {

constexpr std::string_view prefix = "sphparam ";
constexpr std::string_view verdict = "sphparam verdict ";
constexpr double rounding_of_floats = 1e-6;  // relative, of a ray's length in numbers of 32 bits
constexpr std::array radii = {1.0, 100.0};   // of bare spheres; GIFTI's are the larger ones
constexpr std::array ray_names = {"sx", "sy", "sz"};

/// What holds for the sphere too: which hemisphere it is, which brain viewers ask for, and of which
/// volume.
bool is_of_sphere(std::string_view comment) {
  return comment.starts_with("gifti AnatomicalStructurePrimary") || is_of_volume(comment);
}

void replace_provenance(MeshFile& file, const Provenance& provenance) {
  std::erase_if(file.comments,
                [](const std::string& comment) { return comment.starts_with(prefix); });
  for (const auto& [key, value] : provenance)
    file.comments.push_back(std::string(prefix) + key + " " + value);
}

}  // namespace

MeshFile attach_map(MeshFile file, const SphereMap& map, const Provenance& provenance) {
  const auto count = static_cast<std::size_t>(map.points.rows());
  Property theta{"theta", ScalarType::Float64, std::vector<double>(count)};
  Property phi{"phi", ScalarType::Float64, std::vector<double>(count)};
  for (std::size_t v = 0; v < count; ++v) {
    const SphericalCoordinates coordinates = to_spherical(map.point(static_cast<Vertex>(v)));
    theta.values[v] = coordinates.theta;
    phi.values[v] = coordinates.phi;
  }
  file.set_vertex_property(std::move(theta));
  file.set_vertex_property(std::move(phi));
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = map.points.col(axis);
    file.set_vertex_property(
        {ray_names[axis], ScalarType::Float64, {column.begin(), column.end()}});
  }
  replace_provenance(file, provenance);
  return file;
}

MeshFile without_map(MeshFile file) {
  remove_properties(file.vertex_properties, {"theta", "phi", "sx", "sy", "sz"});
  std::erase_if(file.comments,
                [](const std::string& comment) { return comment.starts_with(verdict); });
  return file;
}

bool has_map(const MeshFile& file) {
  if (std::all_of(ray_names.begin(), ray_names.end(),
                  [&](const char* name) { return file.find_vertex_property(name); }))
    return true;
  const Points& positions = file.mesh.positions;
  const Eigen::ArrayXd lengths = positions.rowwise().norm();
  return positions.rows() > 0 && std::any_of(radii.begin(), radii.end(), [&](double radius) {
           return ((lengths - radius).abs() <= rounding_of_floats * radius).all();
         });
}

std::optional<SphereMap> read_sphere(const MeshFile& file) {
  SphereMap map{Points(file.mesh.vertex_count(), 3)};
  for (int axis = 0; axis < 3; ++axis) {
    const Property* const ray = file.find_vertex_property(ray_names[axis]);
    if (!ray) return std::nullopt;
    if (std::ssize(ray->values) != map.points.rows())
      throw std::invalid_argument(std::string(ray_names[axis]) + ": a map has one ray a vertex");
    map.points.col(axis) = Eigen::Map<const VectorX>(ray->values.data(), file.mesh.vertex_count());
  }
  return map;
}

Provenance read_provenance(const MeshFile& file) {
  Provenance provenance;
  for (std::string_view comment : file.comments) {
    if (!comment.starts_with(prefix)) continue;
    comment.remove_prefix(prefix.size());
    const std::string_view key = take_word(comment);
    provenance.emplace_back(key, comment);
  }
  return provenance;
}

MeshFile sphere_mesh(const MeshFile& file, const SphereMap& map, const Provenance& provenance) {
  MeshFile sphere;
  sphere.mesh = {map.points, file.mesh.triangles};
  for (const std::string& comment : file.comments)
    if (is_of_sphere(comment)) sphere.comments.push_back(comment);
  replace_provenance(sphere, provenance);
  return sphere;
}

}  // namespace sphparam
