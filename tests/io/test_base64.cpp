#include <catch2/catch.hpp>
#include <string>

#include "io/files/base64.h"

using sphparam::Base64Reader;
using sphparam::to_base64;

TEST_CASE("base64: what is encoded is decoded, of any length") {
  std::string bytes;
  for (int length = 0; length < 300; ++length) {
    const std::string text = to_base64(bytes);
    CHECK(text.size() == (bytes.size() + 2) / 3 * 4);
    std::string back;
    CHECK(Base64Reader(text).read(bytes.size(), back));
    CHECK(back == bytes);
    CHECK_FALSE(Base64Reader(text).read(bytes.size() + 1, back));
    bytes += static_cast<char>(length * 37);
  }
  CHECK(to_base64("Man") == "TWFu");
  CHECK(to_base64("M") == "TQ==");
}

TEST_CASE("base64: texts in a row are one, each with its filling, and blanks are passed over") {
  const std::string text = to_base64("a") + "\n  " + to_base64("bcde") + " " + to_base64("fgh");
  Base64Reader reader(text);
  std::string bytes;
  CHECK(reader.read(2, bytes));
  CHECK(reader.read(6, bytes));
  CHECK(bytes == "abcdefgh");
  CHECK_FALSE(reader.read(1, bytes));
}

TEST_CASE("base64: what is none is refused") {
  std::string bytes;
  for (const char* text : {"TWF", "TWF*", "T===", "TQ=a", "\xff\xff\xff\xff"})
    CHECK_FALSE(Base64Reader(text).read(1, bytes));
}
