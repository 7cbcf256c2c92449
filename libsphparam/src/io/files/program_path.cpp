#include "io/files/program_path.h"

#include <sys/auxv.h>

#include <system_error>

namespace sphparam {

std::filesystem::path program_path(const std::filesystem::path& link) {
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink(link, error);
  if (!error) return program;
  // The kernel leaves it beside the arguments; unlike argv[0] it always is a path.
  const auto* const started = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
  return started ? std::filesystem::canonical(started, error) : std::filesystem::path();
}

}  // namespace sphparam
