#include <catch2/catch.hpp>
#include <cstdint>

#include "io/files/stored_zip.h"
#include "io/files/zip_archive.h"

/// Archives as records of bytes, and through the reader of strangers' ones.
namespace sphparam::tests {

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

std::uint32_t number(const std::string& bytes, std::size_t at, int width) {
  std::uint32_t value = 0;
  for (int i = width - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return value;
}

}  // namespace

TEST_CASE("stored zip: every byte of an archive of one file is as APPNOTE.TXT has it") {
  const std::string day = std::string("\0\0\x21\0", 4), crc = "\x26\x39\xF4\xCB",  // of 1...9
      size = std::string("\x09\0\0\0", 4), plain = std::string("\x14\0\0\0\0\0", 6);
  CHECK(stored_zip({{"a", "123456789"}}) ==
        "PK\x03\x04" + plain + day + crc + size + size + std::string("\x01\0\0\0", 4) +
            "a123456789" + "PK\x01\x02" + std::string("\x14\0", 2) + plain + day + crc + size +
            size + std::string("\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18) + "a" +
            std::string("PK\x05\x06\0\0\0\0\x01\0\x01\0\x2F\0\0\0\x28\0\0\0\0\0", 22));
}

TEST_CASE("stored zip: the bytes of each file begin at a multiple of what is asked for") {
  for (std::size_t length = 1; length < 140; ++length) {
    const Files files = {{std::string(length, 'n'), std::string(length * 7, 'a')},
                         {"b/c", std::string(length, 'b')},
                         {"empty", ""}};
    const std::string archive = stored_zip(files, 64);
    std::size_t at = 0;
    for (const auto& [name, bytes] : files) {
      REQUIRE(archive.substr(at, 4) == "PK\x03\x04");
      const std::size_t extra = number(archive, at + 28, 2);
      if (extra > 0) CHECK(number(archive, at + 32 + name.size(), 2) + 4 == extra);
      at += 30 + name.size() + extra;
      CHECK(at % 64 == 0);
      CHECK(archive.substr(at, bytes.size()) == bytes);
      at += bytes.size();
    }
    CHECK(archive.substr(at, 4) == "PK\x01\x02");
    const std::string archive_name = "a.zip";
    const ZipArchive read(archive, archive_name);
    for (const auto& [name, bytes] : files) CHECK(read.unpacked(name, 1000) == bytes);
  }
}

TEST_CASE("stored zip: more files than 16 bits count are refused") {
  Files files(65535, {"a", ""});
  CHECK_NOTHROW(stored_zip(files));
  files.emplace_back("a", "");
  CHECK_THROWS_AS(stored_zip(files), std::length_error);
}

}  // namespace sphparam::tests
