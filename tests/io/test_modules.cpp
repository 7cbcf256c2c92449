#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/files/modules.h"
#include "io/files/program_path.h"

using namespace sphparam;

TEST_CASE("image module: the folder that the environment names comes first, the program's next") {
  const std::filesystem::path beside = program_path().parent_path();
  REQUIRE(unsetenv("SPHPARAM_MODULES") == 0);
  const auto usual = module_folders();
  REQUIRE(usual.size() >= 3);
  CHECK(usual[0] == beside);
  CHECK(usual[1] == beside.parent_path() / "lib" / "sphparam");
  for (const auto& folder : usual) CHECK(std::ranges::count(usual, folder) == 1);
  REQUIRE(setenv("SPHPARAM_MODULES", "/some/where", 1) == 0);
  const auto named = module_folders();
  REQUIRE(unsetenv("SPHPARAM_MODULES") == 0);
  REQUIRE(named.size() == usual.size() + 1);
  CHECK(named[0] == "/some/where");
  CHECK(std::equal(usual.begin(), usual.end(), named.begin() + 1));
}

TEST_CASE("image module: what the loader says where memory is short is no missing package") {
  const std::string module = "/lib/sphparam_image_oiio.so";
  const std::string segment = ": failed to map segment from shared object";
  CHECK(says_no_memory("libgeos_c.so.1" + segment, module));
  CHECK(says_no_memory(module + ": cannot map zero-fill pages", module));
  CHECK(says_no_memory("libx.so: cannot create cache: Cannot allocate memory", module));
  CHECK_FALSE(says_no_memory(module + segment, module));  // a disk that nothing may run from
  CHECK_FALSE(
      says_no_memory("libx.so: cannot open shared object file: No such file or directory", module));
}
