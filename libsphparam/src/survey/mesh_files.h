#pragma once

#include <string>
#include <vector>

namespace sphparam {

/// The mesh files of a folder and of those in it, told by their names, as paths below it, sorted.
///
/// Links are followed, to folders too: a folder is looked into once, as itself where it lies below,
/// else by the first link to it; not one that holds the folder itself. A link that leads nowhere is
/// among them if it is named as a mesh: whoever opens it will tell.
/// Throws: ReadError for a folder that cannot be read, or without mesh files.
std::vector<std::string> mesh_files(const std::string& folder);

}  // namespace sphparam
