#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// "folder/name" of "folder/statue.obj" and a name.
std::string path_beside(const std::string& path, const std::string& name);

/// "statue" of "folder/statue.obj".
std::string stem_of_export(const std::string& path);

/// The .mtl of an .obj.
std::string library_of(const std::string& obj);

/// Throws: WriteError where `file`, beside `path`, which is written itself, is there, no export of
/// that name wrote it, and it holds other bytes than those that it is to hold, as far as they are
/// known.
void require_own_file(const std::string& path, const std::string& file,
                      std::string_view bytes = {});

/// Throws: WriteError where the name of a text that names files beside it cannot stand in a line.
void require_name_of_line(const std::string& path);

}  // namespace sphparam
