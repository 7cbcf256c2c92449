#pragma once

#include <array>
#include <vector>

#include "binding.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam::python {

/// What is asked of a map. Numbers of vertices are those that the caller's mesh has, before any
/// repair.
struct Request {
  ParameterizeOptions options;
  std::vector<std::array<double, 3>> pins;  // vertex, theta, phi
  bool to_body = false;                     // turned to the directions from the centre
};

/// Reads the options of `sphparam.map`. Throws: py::value_error, py::type_error.
Request map_request_of(const py::dict& values);

/// Poles, meridian and pins as vertices of the mesh; the directions of a body. Throws:
/// NoSuchVertex; VertexAtCentre.
void settle(Request& request, const MeshFile& file);

}  // namespace sphparam::python
