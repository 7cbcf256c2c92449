#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// Reads OBJ, PLY, OFF, STL, 3MF, glTF, GLB, FBX, COLLADA, 3DS, X3D, polydata of VTK, GIFTI,
/// FreeSurfer, MZ3, ICQ or a PDS plate table, as it is or in gzip; "-" is standard input.
///
/// The format is told by the content, then by the extension of the name. Other formats are refused
/// by their names. The limit on bytes holds for the file and for what gzip unpacks to. Only a glTF
/// read from a file may have buffers in other files, next to it. A file that breaks the rules of
/// its format is refused with the place; a mesh that is no closed surface is read all the same,
/// `inspect_mesh` tells. What the file carries and a `MeshFile` does not is among the notes
/// (losses.h). Ensures: all indices are in range, all numbers finite (but coordinates where options
/// let others pass), no triangle names a vertex twice (but where options let that pass, and for
/// STL, where corners of the same coordinates are one vertex). Throws: ReadError. Cost: about 0.1
/// µs a triangle of text, 0.02 µs of binary data.
MeshFile read_mesh(const std::string& path, const ReadOptions& options = {});

/// The formats that are read: "OBJ, PLY, … and PDS plate table", or with another last word.
std::string readable_formats(const std::string& conjunction = "and");

/// Whether a file of this name would be a mesh, packed by gzip or not.
bool is_mesh_name(const std::string& path);

/// Reads a mesh from memory. `name` stands in messages; its extension decides where the content
/// does not.
MeshFile read_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options);

}  // namespace sphparam
