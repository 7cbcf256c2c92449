#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// How a map came about: version, method, stage, options, poles, verdict, in this order.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// A mesh with its map, ready to be written as .sph.ply: double vertex properties theta, phi
/// (radians, the project's convention) and sx, sy, sz (the rays), and comments
/// "sphparam KEY VALUE". Properties and comments of an earlier map are replaced.
/// Requires: one ray a vertex; keys without blanks.
MeshFile attach_map(MeshFile file, const SphereMap& map, const Provenance& provenance);

/// The mesh for a format that has no room for rays: their properties go, and with them the verdict
/// on them; the other comments stay.
MeshFile without_map(MeshFile file);

/// Whether there is a map in a file: rays, or positions that are the rays, as in a bare sphere.
bool has_map(const MeshFile& file);

/// The map in sx, sy, sz; nothing if one is missing. Throws: std::invalid_argument for its length.
std::optional<SphereMap> read_sphere(const MeshFile& file);

/// The comments "sphparam KEY VALUE", in the order of the file.
Provenance read_provenance(const MeshFile& file);

/// The bare sphere: the triangles of the mesh on the rays of the map, and the provenance.
MeshFile sphere_mesh(const MeshFile& file, const SphereMap& map, const Provenance& provenance);

}  // namespace sphparam
