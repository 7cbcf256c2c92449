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
};

/// The lines that say so in the header of a written map: radial-centre, radial-movement. None of
/// other maps.
Provenance planetocentric_lines(const Parameterization& result);

/// What such lines say; nothing where there are none, or other things than numbers in them.
std::optional<Planetocentric> planetocentric(const Provenance& provenance);

/// The centre of the body that a mesh is: the given one, else that of a radial map, else the
/// origin.
Vector3 body_centre(const std::optional<Planetocentric>& radial,
                    const std::optional<Vector3>& given);

/// Whether a radial map is about this centre: to a millionth of the mean distance of the vertices.
bool is_about(const Planetocentric& radial, const Vector3& centre, const TriangleMesh& mesh);

/// Whether a line with this key is one of them: it goes where such a map is turned.
bool is_planetocentric(const std::string& key);

}  // namespace sphparam
