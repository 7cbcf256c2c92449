#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace sphparam {

/// A module that is in no place where it is looked for, or cannot be opened; says where, and which
/// Debian packages have it and what it opens.
class ModuleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a module is called where it is missing.
struct ModuleWords {
  const char* file;     // "sphparam_image_oiio.so"
  const char* name;     // "image module"
  const char* library;  // "the Debian package libopenimageio2.4 has OpenImageIO, which it opens"
};

/// The address of a module's one function, opened once and never closed. Null: it has none such.
/// Throws: ModuleError; std::bad_alloc where there is no memory for it.
void* function_of_module(const ModuleWords& module, const char* function);

/// Whether what the loader said of a module means that memory is short.
bool says_no_memory(const std::string& said, const std::string& module);

/// Where modules may be, in the order in which they are looked for: in the folder that the
/// environment's SPHPARAM_MODULES names; about the running program; about the shared library that
/// this code is in. What nobody knows is left out; where no folder has it, the loader is asked.
std::vector<std::filesystem::path> module_folders();

}  // namespace sphparam
