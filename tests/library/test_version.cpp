#include <catch2/catch.hpp>
#include <string>

#include "sphparam/version.h"

TEST_CASE("version: the numbers for the preprocessor are those of the text") {
  CHECK(std::to_string(SPHPARAM_VERSION_MAJOR) + "." + std::to_string(SPHPARAM_VERSION_MINOR) +
            "." + std::to_string(SPHPARAM_VERSION_PATCH) ==
        sphparam::version);
}
