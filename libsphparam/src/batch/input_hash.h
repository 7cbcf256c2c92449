#pragma once

#include <string>

namespace sphparam {

/// An input by its content: of the file, and of those beside it that it names.
struct InputHash {
  std::string hash;   // of a file that names no others that are there: `hash_of_file`
  bool alone = true;  // it names no others: its own stamp tells whether anything was touched
};

/// Buffers and images of glTF, libraries of OBJ and their images, images of PLY, COLLADA and FBX
/// count, of a link also those beside the file that it leads to; what is named and is not there
/// does as soon as it is. Meshes are not read for it. Throws: ReadError where the file itself
/// cannot be read. Cost: reading all these files once.
InputHash hash_of_input(const std::string& path);

}  // namespace sphparam
