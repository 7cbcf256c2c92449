#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam::samples {

/// sRGB, each channel in [0, 1].
using Colour = Eigen::Vector3d;

Colour mix(const Colour& a, const Colour& b, double t);

/// Adds the properties red, green, blue (Uint8). Requires: a colour a vertex.
void add_vertex_colours(const std::vector<Colour>& colours, sphparam::MeshFile& file);

}  // namespace sphparam::samples
