#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What a file carries and a mesh file has no room for is told, never dropped in silence: a note of
// its own kind, so that a program can tell these unasked and the harmless ones when asked.

/// Notes "not carried: WHAT". `what` says how many, or which.
void add_loss(std::vector<std::string>& notes, const std::string& what);

/// Those of the notes that `add_loss` made, in their order.
std::vector<std::string> losses_among(const std::vector<std::string>& notes);

/// What a mesh file lost where it was written: `read` is what reading those bytes gave. Lines as
/// `add_loss` makes them, with the share where only part is lost; the rays of a map and what is
/// said of it are not among them. Cost: O(#V + #F) a property.
std::vector<std::string> losses_of_writing(const MeshFile& written, const MeshFile& read);

/// Adds that polygons are cut into triangles, where a mesh has others.
void add_polygon_loss(std::vector<std::string>& notes, const MeshFile& file);

/// Adds what a mesh that is sampled anew leaves with its source, and a mesh file could hold or
/// name: what its materials show, second texture coordinates, tangents.
void add_sampling_losses(std::vector<std::string>& notes, const MeshFile& source);

/// Adds what is lost where a mesh becomes images, or is shown: colours of its faces, which nothing
/// bakes or draws. Cost: O(#F log #F).
void add_face_colour_loss(std::vector<std::string>& notes, const MeshFile& file);

/// "a, b and c"; of more than eight words the first ones, and how many others.
std::string enumerated(const std::vector<std::string>& words);

}  // namespace sphparam
