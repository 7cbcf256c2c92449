#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

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
