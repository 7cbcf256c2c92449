#pragma once

#include <array>
#include <string>
#include <vector>

#include "binding.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/topology.h"

namespace sphparam::python {

/// What is asked of a map. Numbers of vertices are those that the caller's mesh has, before any
/// repair.
struct Request {
  ParameterizeOptions options;
  std::vector<std::array<double, 3>> pins;  // vertex, theta, phi
  bool to_body = false;                     // turned to the directions from the centre
  Up up;                                    // how the mesh stands
  bool stands = false;                      // something was said of it
  bool upright_poles = false;               // top and bottom
};

/// Reads the options of `sphparam.map`. Throws: py::value_error, py::type_error.
Request map_request_of(const py::dict& values);

/// Poles, meridian and pins as vertices of the mesh; the directions of a body; how the mesh stands,
/// which its file says then; returns what looks wrong with that. Throws: NoSuchVertex;
/// VertexAtCentre; FrontError.
std::vector<std::string> settle(Request& request, MeshFile& file, const Topology& topology);

}  // namespace sphparam::python
