#pragma once

#include <string>
#include <string_view>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// "1.5, 2, 3": a place for people. As many digits as six of a `length` want, so that places on a
/// shape of that length are told apart where the origin is far from it, too.
std::string place_text(const Vector3& place, double length, std::string_view between = ", ");

}  // namespace sphparam
