#include "image/open_module.h"

#include <new>

#include "io/files/modules.h"
#include "sphparam/image/image_format.h"

namespace sphparam {
namespace {

constexpr ModuleWords words = {
    "sphparam_image_oiio.so", "image module",
    "the Debian package libopenimageio2.4 has OpenImageIO, which it opens"};

const SphparamImageTable& open_module() try {
  const auto table = reinterpret_cast<SphparamImageTableFunction>(
      function_of_module(words, sphparam_image_table_name));
  if (!table || table()->version != sphparam_image_table_version)
    throw ImageError(std::string(words.file) + " belongs to another version of this program");
  return *table();
} catch (const ModuleError& error) {
  throw ImageError(error.what());
}

}  // namespace

const SphparamImageTable& image_codecs() {
  static const SphparamImageTable& table = open_module();
  return table;
}

void throw_told(const std::string& prefix, const std::string& told) {
  if (told == sphparam_image_no_memory) throw std::bad_alloc();
  throw ImageError(prefix + told);
}

}  // namespace sphparam
