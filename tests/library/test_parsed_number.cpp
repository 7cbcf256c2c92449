#include <catch2/catch.hpp>
#include <cstdint>

#include "parsed_number.h"

using namespace sphparam;

TEST_CASE("parsed_number: all of a text is the number, or it is none") {
  CHECK(parsed<int>("12") == 12);
  CHECK(parsed<int>("-12") == -12);
  CHECK(parsed<double>("2.5e-1") == 0.25);
  CHECK(parsed<float>("0.1") == 0.1F);
  for (const char* text : {"", " 12", "12 ", "+12", "12x", "1.5", "12\n", "x"}) {
    INFO('"' << text << '"');
    CHECK_FALSE(parsed<int>(text));
  }
}

TEST_CASE("parsed_number: what the type does not hold is none") {
  CHECK(parsed<std::uint8_t>("255") == 255);
  CHECK_FALSE(parsed<std::uint8_t>("256"));
  CHECK_FALSE(parsed<unsigned>("-1"));
  CHECK_FALSE(parsed<double>("1e400"));
}
