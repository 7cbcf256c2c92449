#pragma once

#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::cli {

/// Of the box about points: what distances are told against.
double diagonal_of(const Points& points);

/// "0.123 %": a length as a share of the diagonal.
std::string percent_of(double diagonal, double length);

}  // namespace sphparam::cli
