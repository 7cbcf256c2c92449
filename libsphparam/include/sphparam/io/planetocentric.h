#pragma once

#include <optional>
#include <string>

#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// Of a map of Method::Radial: θ and π/2 − ϕ of a vertex are its planetocentric longitude and
/// latitude, but for this movement.
struct Planetocentric {
  Vector3 centre;               // in the mesh's coordinates
  double largest_movement = 0;  // of a vertex from its direction, in radians; 0: none was moved
  bool made_anew = false;       // nothing of the directions is left
};

/// The lines that say so in the header of a written map: radial-centre, radial-movement. None of
/// other maps.
Provenance planetocentric_lines(const Parameterization& result);

Provenance planetocentric_lines(const Planetocentric& radial);

/// What such lines say; nothing where there are none, or other things than numbers in them.
std::optional<Planetocentric> planetocentric(const Provenance& provenance);

/// The centre of the body that a mesh is: the given one, else that of a radial map, else the
/// origin.
Vector3 body_centre(const std::optional<Planetocentric>& radial,
                    const std::optional<Vector3>& given);

/// Whether a radial map is about this centre: to a millionth of the mean distance of the vertices.
bool is_about(const Planetocentric& radial, const Vector3& centre, const TriangleMesh& mesh);

/// How a body stands in the coordinates of a file, the rows x, y, z of its own frame: north is what
/// the file says points up (up_axis.h), z where it says nothing; longitude −90° is the file's
/// front, so that glTF has back the frame that it was turned from. The identity where z is up and
/// −y in front, as where the file says neither.
Eigen::Matrix3d body_axes(const MeshFile& file);

/// The mesh and a centre in the body's frame.
struct StandingBody {
  TriangleMesh mesh;
  Vector3 centre;
};
/// Requires: a centre in the mesh's coordinates. Ensures: the bits of the file where z is up, and
/// −y in front.
StandingBody standing_body(const MeshFile& file, const Vector3& centre);

/// `parameterize` of the mesh of a file; by Method::Radial as the body stands, `centre` being in
/// the mesh's coordinates as always.
Parameterization parameterize_standing(const MeshFile& file, const Topology& topology,
                                       const ParameterizeOptions& options);

/// The direction of each vertex from the centre, in the body's frame: where a map with its
/// longitudes and latitudes has the vertex. Throws: as `radial_directions`.
SphereMap body_directions(const MeshFile& file, const Vector3& centre);

/// How far a vertex of the surface (others than fillers have) is from its direction from the
/// centre at most, in radians, measured; infinite where a vertex has none.
double largest_movement(const Vector3& centre, const MeshFile& file, const SphereMap& map);

/// Whether the map is what such lines say, as measured: it is not made anew, and no vertex is
/// farther from its direction (`largest_movement`) than they say, up to rounding.
/// Not so where positions were moved since, or the map turned.
bool is_as_said(const Planetocentric& radial, const MeshFile& file, const SphereMap& map);

/// Whether a line with this key is one of them: it goes where such a map is turned.
bool is_planetocentric(const std::string& key);

}  // namespace sphparam
