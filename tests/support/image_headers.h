#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

/// What image files say of themselves, read from their specifications and by nobody's library: a
/// judge that shares no mistake with the codec that wrote them. What is broken throws.
namespace sphparam::tests {

struct ImageHeader {
  std::uint64_t width = 0, height = 0, bits = 0, channels = 0;
  bool floating = false, tiled = false;
  bool operator==(const ImageHeader&) const = default;
};

/// Numbers at places of a file; out of it is an error.
class FileNumbers {
 public:
  FileNumbers(std::string_view bytes, bool big_endian) : bytes_(bytes), big_(big_endian) {}
  std::uint64_t at(std::uint64_t place, int size) const {
    if (place + static_cast<std::uint64_t>(size) > bytes_.size())
      throw std::runtime_error("points beyond the end of the file");
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) {
      const int k = big_ ? i : size - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes_[place + static_cast<unsigned>(k)]);
    }
    return value;
  }
  std::string text(std::uint64_t place) const {
    const size_t end = bytes_.find('\0', place);
    if (end == std::string_view::npos) throw std::runtime_error("a name does not end");
    return std::string(bytes_.substr(place, end - place));
  }
  std::uint64_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  bool big_;
};

inline void require(bool holds, const char* otherwise) {
  if (!holds) throw std::runtime_error(otherwise);
}

/// The first value of each tag of a TIFF directory (6.0, section 2), and how many it has.
struct TiffDirectory {
  std::map<unsigned, std::uint64_t> first, count, place;
  std::uint64_t next = 0;
};

inline TiffDirectory tiff_directory(const FileNumbers& file, std::uint64_t at) {
  constexpr std::array<int, 14> sizes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4};
  TiffDirectory directory;
  const std::uint64_t entries = file.at(at, 2);
  require(entries > 0, "an empty directory");
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t entry = at + 2 + 12 * i;
    const auto tag = static_cast<unsigned>(file.at(entry, 2));
    const std::uint64_t type = file.at(entry + 2, 2), count = file.at(entry + 4, 4);
    require(type > 0 && type < sizes.size(), "a tag of no type");
    const auto size = static_cast<std::uint64_t>(sizes[type]);
    const std::uint64_t place = count * size <= 4 ? entry + 8 : file.at(entry + 8, 4);
    require(place + count * size <= file.size(), "a tag beyond the end");
    directory.first[tag] = file.at(place, std::min(sizes[type], 8));
    directory.count[tag] = count;
    directory.place[tag] = place;
  }
  directory.next = file.at(at + 2 + 12 * entries, 4);
  return directory;
}

inline ImageHeader tiff_header(std::string_view bytes) {
  const FileNumbers file(bytes, bytes.starts_with("MM"));
  require(file.at(2, 2) == 42, "no TIFF");
  const TiffDirectory main = tiff_directory(file, file.at(4, 4));
  for (const unsigned tag : {256U, 257U, 258U, 259U, 262U, 273U, 277U, 279U})
    require(main.first.contains(tag), "a required tag is missing");
  require(main.next == 0, "another directory");
  require(main.count.at(273) == main.count.at(279), "strips without sizes");
  const auto number = [&](unsigned tag, std::uint64_t i) {
    const int size = main.count.at(tag) * 2 <= 4 && main.place.at(tag) % 4 != 0 ? 2 : 4;
    return file.at(main.place.at(tag) + i * static_cast<unsigned>(size), size);
  };
  if (main.count.at(273) == 1)
    require(number(273, 0) + number(279, 0) <= file.size(), "a strip beyond the end");
  if (main.first.contains(34665)) tiff_directory(file, main.first.at(34665));  // EXIF
  return {.width = main.first.at(256),
          .height = main.first.at(257),
          .bits = main.first.at(258),
          .channels = main.first.at(277),
          .floating = main.first.contains(339) && main.first.at(339) == 3};
}

inline std::uint32_t png_checksum(std::string_view bytes) {
  std::uint32_t value = ~0U;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? (value >> 1) ^ 0xedb88320U : value >> 1;
  }
  return ~value;
}

inline ImageHeader png_header(std::string_view bytes) {
  const FileNumbers file(bytes, true);
  std::string kind;
  for (std::uint64_t at = 8; at < file.size();) {
    require(kind != "IEND", "something after the end");
    const std::uint64_t size = file.at(at, 4);
    require(file.at(at + 8 + size, 4) == png_checksum(bytes.substr(at + 4, size + 4)),
            "a wrong checksum");
    kind = bytes.substr(at + 4, 4);
    at += 12 + size;
  }
  require(kind == "IEND", "no end");
  constexpr std::array<std::uint64_t, 7> channels = {1, 0, 3, 1, 2, 0, 4};
  return {.width = file.at(16, 4),
          .height = file.at(20, 4),
          .bits = file.at(24, 1),
          .channels = channels.at(file.at(25, 1))};
}

inline ImageHeader exr_header(std::string_view bytes) {
  const FileNumbers file(bytes, false);
  ImageHeader header;
  header.tiled = (file.at(4, 4) & 0x200) != 0;
  for (std::uint64_t at = 8; file.at(at, 1) != 0;) {
    const std::string name = file.text(at), type = file.text(at + name.size() + 1);
    at += name.size() + type.size() + 2;
    const std::uint64_t size = file.at(at, 4), value = at + 4;
    if (name == "dataWindow") {
      header.width = file.at(value + 8, 4) - file.at(value, 4) + 1;
      header.height = file.at(value + 12, 4) - file.at(value + 4, 4) + 1;
    }
    if (name == "channels") {
      for (std::uint64_t channel = value; file.at(channel, 1) != 0; ++header.channels) {
        channel += file.text(channel).size() + 1;
        header.floating = true;
        header.bits = file.at(channel, 4) == 1 ? 16 : 32;
        channel += 16;
      }
    }
    at = value + size;
  }
  return header;
}

inline ImageHeader jpeg_header(std::string_view bytes) {
  const FileNumbers file(bytes, true);
  require(bytes.ends_with("\xff\xd9"), "no end");
  for (std::uint64_t at = 2;; at += 2 + file.at(at + 2, 2)) {
    const std::uint64_t marker = file.at(at, 2);
    if (marker == 0xffc0 || marker == 0xffc2) {
      return {.width = file.at(at + 7, 2),
              .height = file.at(at + 5, 2),
              .bits = file.at(at + 4, 1),
              .channels = file.at(at + 9, 1)};
    }
  }
}

/// Of the kind that the first bytes tell.
inline ImageHeader image_header(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return png_header(bytes);
  if (bytes.starts_with("\x76\x2f\x31\x01")) return exr_header(bytes);
  if (bytes.starts_with("\xff\xd8\xff")) return jpeg_header(bytes);
  if (bytes.starts_with("II") || bytes.starts_with("MM")) return tiff_header(bytes);
  throw std::runtime_error("no image");
}

}  // namespace sphparam::tests
