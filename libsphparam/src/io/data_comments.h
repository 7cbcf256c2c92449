#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What comments tell of attached data (vertex_data.h) follows its properties.

/// Gives a number of the vertices another name, by which comments call it then, too.
/// Requires: a property called `old`, and none called `name`.
void rename_vertex_property(MeshFile& mesh, const std::string& old, const std::string& name);

/// Has a mesh tell, beside what it tells of its own data, what another one tells of its: of the
/// properties that both have by the same names. Data that is called as some of its own is, of one
/// kind, gets a number. Requires: these properties are the other mesh's, carried over.
void tell_data_of(MeshFile& mesh, const MeshFile& other);

}  // namespace sphparam
