#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True for the magic number of a FreeSurfer file: a surface, or one of values.
bool looks_like_freesurfer(std::string_view bytes);

/// Reads a FreeSurfer triangle surface (lh.white, rh.pial, …): FF FF FE, a line that says who made
/// it, numbers of vertices and triangles, coordinates as big-endian float32, indices.
///
/// Coordinates are taken as written. The line becomes a comment "freesurfer created …", the volume
/// geometry of the footer comments "freesurfer geometry LINE", useRealRAS "freesurfer real_ras N":
/// `serialise_freesurfer` writes them back. The hemisphere, of which the name alone tells, is one
/// as GIFTI has it. What follows the geometry (command lines) is told as
/// not carried.
/// Refused by name: quadrangle surfaces and files of values (curv, thickness), FF FF FD and FF FF
/// FF. Throws: ReadError with the byte. Cost: near a copy of the bytes.
MeshFile read_freesurfer(std::string_view bytes, const std::string& name,
                         const ReadOptions& options = {});

}  // namespace sphparam
