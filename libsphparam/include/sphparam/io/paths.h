#pragma once

#include <string>

namespace sphparam {

/// ".ply" of "STATUE.PLY": in lower case, with its dot; empty where there is none.
std::string extension_of(const std::string& path);

/// ".ply" of "statue.PLY" and of "statue.ply.gz": what is in the file, packed or not.
std::string inner_extension_of(const std::string& path);

/// Whether a file of this name is packed by gzip: "statue.ply.gz".
bool is_packed_name(const std::string& path);

/// Is this path the name of standard input or output?
inline bool is_stream(const std::string& path) { return path == "-"; }

/// A file as people want to see it: no folders; "-" becomes "standard input".
std::string display_name(const std::string& path);

/// The same for a file that is written.
std::string output_name(const std::string& path);

/// "statue" of "folder/statue.ply" and of "folder/statue.sph.ply", packed (.gz) or not.
std::string stem_of(const std::string& path);

/// The path of the file of a part, from 1: NAME_0001.sph.ply of NAME.sph.ply.
std::string path_of_part(const std::string& path, int part);

/// The path of a level of detail's file: {n} becomes its number, else _lodN is added from the
/// second on, before ".ply" as before ".sph.ply"; level 0, the finest, has the path as it is.
std::string level_path(const std::string& path, int level);

}  // namespace sphparam
