#pragma once

#include <filesystem>

/// Where things are, known to one file: so that no other must be compiled anew when the tree moves.
namespace sphparam::tests {

/// The root of the project's sources.
std::filesystem::path source_folder();

/// The meshes of others: SPHPARAM_MESHES, or a folder beside the project; it need not be there.
std::filesystem::path meshes_folder();

}  // namespace sphparam::tests
