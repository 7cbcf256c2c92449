#include "io/files/modules.h"

#include <dlfcn.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "io/files/program_path.h"

// A program linked to OpenImageIO takes 0.19 s and 262 shared objects to start. So what drags in
// much lives in modules that are opened when they are needed. Our own program has them beside it
// (build tree), in ../lib/sphparam (installed) or below ../lib by architecture (Debian packages):
// they move with the program. A user's program may be anywhere; there the library leads to it, a
// shared one by its own place, a static one by the rpath that its CMake targets and pkg-config
// files add.

namespace sphparam {
namespace {

using Path = std::filesystem::path;

void add(std::vector<Path>& folders, const Path& folder) {
  if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
}

/// Of an installation that has this file in bin/ or lib/.
void add_about(std::vector<Path>& folders, const Path& file) {
  const Path folder = file.parent_path(), prefix = folder.parent_path();
  add(folders, folder);
  add(folders, prefix / "lib" / "sphparam");
  add(folders, prefix / SPHPARAM_MODULE_OF_PACKAGES);
}

/// The file that this code was loaded from: the program, or a shared library. Empty: unknown.
Path own_file() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&module_folders), &info) == 0 || !info.dli_fname) {
    return {};
  }
  std::error_code error;
  return std::filesystem::canonical(info.dli_fname, error);
}

/// The bare name where no folder has it: what a program was linked with may lead the loader to it.
Path find_module(const char* file) {
  std::error_code error;
  for (const Path& folder : module_folders()) {
    Path module = folder / file;
    if (std::filesystem::exists(module, error)) return module;
  }
  return file;
}

/// Every place that was looked at, the last with what the loader said.
std::string all_places(const std::string& said) {
  std::string places;
  for (const Path& folder : module_folders()) places += "\n  " + folder.string();
  return places + "\n  where the loader looks: " + said +
         "\nthe Debian package sphparam-image has it; the environment variable SPHPARAM_MODULES "
         "may "
         "name the folder where it lies";
}

}  // namespace

bool says_no_memory(const std::string& said, const std::string& module) {
  const auto contains = [&](const char* words) { return said.find(words) != std::string::npos; };
  // Of a library of the system it is memory; of the module, a disk that forbids to run what it has
  // sounds the same.
  const bool of_library = !said.starts_with(module + ":");
  return contains("Cannot allocate memory") || contains("cannot map zero-fill pages") ||
         (of_library && contains("failed to map segment from shared object"));
}

std::vector<Path> module_folders() {
  std::vector<Path> folders;
  if (const char* const named = secure_getenv("SPHPARAM_MODULES"); named && *named) {
    add(folders, named);
  }
  const Path program = program_path(), own = own_file();
  if (!own.empty() && own != program) {  // first: that of the same version
    add(folders, own.parent_path() / "sphparam");
    add_about(folders, own);
  }
  if (!program.empty()) add_about(folders, program);
  return folders;
}

void* function_of_module(const ModuleWords& words, const char* function) {
  const Path path = find_module(words.file);
  // Never closed: threads of its libraries may run in it.
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module) return dlsym(module, function);
  const std::string said = dlerror();
  if (says_no_memory(said, path.string())) throw std::bad_alloc();
  if (said.find(std::strerror(EMFILE)) != std::string::npos)
    throw ModuleError(std::string("cannot open the ") + words.name + ": " + said);
  if (path.has_parent_path())
    throw ModuleError(std::string("cannot open the ") + words.name + ": " + said + "; " +
                      words.library);
  throw ModuleError(std::string("the ") + words.name + " " + words.file + " is in none of" +
                    all_places(said));
}

}  // namespace sphparam
