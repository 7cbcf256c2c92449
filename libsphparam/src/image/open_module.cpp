#include "image/open_module.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

#include "image/image_codec.h"
#include "image/program_path.h"

// A program linked to OpenImageIO takes 0.19 s and 262 shared objects to start. So the codecs live
// in a module that is opened when the first image is touched, and is found beside the program
// (build tree), in ../lib/sphparam (installed) or below ../lib by architecture (Debian packages):
// it moves with the program.

namespace sphparam {
namespace {

constexpr char kModuleName[] = "sphparam_image_oiio.so";

std::filesystem::path find_module() {
  const std::filesystem::path program = program_path();
  if (program.empty()) throw ImageError("cannot tell where this program is: is /proc mounted?");
  const std::filesystem::path folder = program.parent_path();
  const std::filesystem::path prefix = folder.parent_path();
  const std::array<std::filesystem::path, 3> candidates{
      folder / kModuleName, prefix / "lib" / "sphparam" / kModuleName,
      prefix / SPHPARAM_MODULE_OF_PACKAGES / kModuleName};
  std::error_code error;
  for (const auto& candidate : candidates) {
    if (std::filesystem::exists(candidate, error)) return candidate;
  }
  std::string folders;
  for (const auto& candidate : candidates) folders += "\n  " + candidate.parent_path().string();
  throw ImageError(std::string("the image module ") + kModuleName + " is in none of" + folders);
}

const SphparamImageTable& open_module() {
  const std::filesystem::path path = find_module();
  // Never closed: OpenImageIO's threads run in it.
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) throw ImageError(std::string("cannot open the image module: ") + dlerror());
  const auto table =
      reinterpret_cast<SphparamImageTableFunction>(dlsym(module, kSphparamImageTableName));
  if (!table || table()->version != kSphparamImageTableVersion) {
    throw ImageError(path.string() + " belongs to another version of this program");
  }
  return *table();
}

}  // namespace

const SphparamImageTable& image_codecs() {
  static const SphparamImageTable& table = open_module();
  return table;
}

}  // namespace sphparam
