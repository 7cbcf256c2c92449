#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A FreeSurfer triangle surface: coordinates as float32, triangles, and what comments that start
/// with "freesurfer" say of its making and of the volume. Nothing else has a place in it.
///
/// Coordinates that are no float32 numbers are rounded to the nearest: `losses_of_writing` tells.
/// Throws: WriteError for coordinates beyond the range of float32.
std::string serialise_freesurfer(const MeshFile& file);

}  // namespace sphparam
