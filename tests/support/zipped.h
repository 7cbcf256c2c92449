#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sphparam::tests {

inline void put_little_endian(std::string& bytes, std::uint64_t number, int width) {
  for (int i = 0; i < width; ++i) bytes.push_back(static_cast<char>(number >> 8 * i));
}

/// As ISO 3309 has it.
inline std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

/// Deflated as one block that is stored (RFC 1951, 3.2.4). Requires: at most 65,535 bytes.
inline std::string in_a_stored_block(const std::string& bytes) {
  std::string packed = "\x01";
  put_little_endian(packed, bytes.size(), 2);
  put_little_endian(packed, ~bytes.size(), 2);
  return packed + bytes;
}

/// How files are packed.
struct Packing {
  bool deflated = false, large = false;  // large: sizes and places stand in fields of Zip64
};

/// A ZIP archive of files by their names, as APPNOTE.TXT has it.
inline std::string zipped(const std::vector<std::pair<std::string, std::string>>& files,
                          Packing how = {}) {
  std::string bytes, directory;
  for (const auto& file : files) {
    const std::string &name = file.first, &text = file.second;
    const std::string packed = how.deflated ? in_a_stored_block(text) : text;
    const std::size_t offset = bytes.size();
    const auto common = [&](std::string& to, std::uint64_t packed_size, std::uint64_t size) {
      put_little_endian(to, 20, 2), put_little_endian(to, 0, 2),
          put_little_endian(to, how.deflated ? 8 : 0, 2), put_little_endian(to, 0, 4);
      put_little_endian(to, crc_of(text), 4), put_little_endian(to, packed_size, 4),
          put_little_endian(to, size, 4);
      put_little_endian(to, name.size(), 2);
    };
    bytes += "PK\3\4";
    common(bytes, packed.size(), text.size());
    put_little_endian(bytes, 0, 2);
    bytes += name + packed;
    directory += "PK\1\2";
    put_little_endian(directory, 20, 2);
    if (how.large) {
      common(directory, 0xFFFFFFFF, 0xFFFFFFFF);
      put_little_endian(directory, 28, 2), put_little_endian(directory, 0, 2),
          put_little_endian(directory, 0, 8), put_little_endian(directory, 0xFFFFFFFF, 4);
      directory += name;
      put_little_endian(directory, 1, 2), put_little_endian(directory, 24, 2);
      for (const std::size_t number : {text.size(), packed.size(), offset})
        put_little_endian(directory, number, 8);
    } else {
      common(directory, packed.size(), text.size());
      put_little_endian(directory, 0, 2), put_little_endian(directory, 0, 2),
          put_little_endian(directory, 0, 8), put_little_endian(directory, offset, 4);
      directory += name;
    }
  }
  const std::size_t start = bytes.size();
  bytes += directory;
  if (how.large) {
    const std::size_t record = bytes.size();
    bytes += "PK\6\6";
    put_little_endian(bytes, 44, 8), put_little_endian(bytes, 45, 2),
        put_little_endian(bytes, 45, 2), put_little_endian(bytes, 0, 8);
    put_little_endian(bytes, files.size(), 8), put_little_endian(bytes, files.size(), 8),
        put_little_endian(bytes, directory.size(), 8);
    put_little_endian(bytes, start, 8);
    bytes += "PK\6\7";
    put_little_endian(bytes, 0, 4), put_little_endian(bytes, record, 8),
        put_little_endian(bytes, 1, 4);
  }
  bytes += "PK\5\6";
  put_little_endian(bytes, 0, 4), put_little_endian(bytes, how.large ? 0xFFFF : files.size(), 2);
  put_little_endian(bytes, how.large ? 0xFFFF : files.size(), 2),
      put_little_endian(bytes, directory.size(), 4);
  put_little_endian(bytes, how.large ? 0xFFFFFFFF : start, 4), put_little_endian(bytes, 0, 2);
  return bytes;
}

}  // namespace sphparam::tests
