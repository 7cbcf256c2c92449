#include <catch2/catch.hpp>
#include <filesystem>

#include "io/files/program_path.h"

using sphparam::program_path;

TEST_CASE(
    "program path: the name that the program was started by leads to the same file as /proc") {
  const std::filesystem::path without_proc = program_path("/no/such/link");
  CHECK(without_proc.is_absolute());
  CHECK(without_proc == std::filesystem::read_symlink("/proc/self/exe"));
  CHECK(program_path() == without_proc);
}
