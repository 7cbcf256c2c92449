// A head before each file, with an extra field that fills up to where its bytes begin; a directory
// of all behind them.

#include "io/files/stored_zip.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace sphparam {

namespace {

constexpr std::size_t head_size = 30, field_head = 4;
constexpr std::uint32_t first_day = 1 << 5 | 1;  // of 1980

/// Numbers of two and of four bytes, the least first.
class Record {
 public:
  explicit Record(std::string_view signature) : bytes_(signature) {}

  Record& two(std::size_t number) { return put(number, 2); }
  Record& four(std::size_t number) { return put(number, 4); }
  const std::string& bytes() const { return bytes_; }

 private:
  Record& put(std::size_t number, int width) {
    for (int byte = 0; byte < width; ++byte)
      bytes_ += static_cast<char>(number >> (8 * byte) & 255U);
    return *this;
  }

  std::string bytes_;
};

/// How long the extra field of a head is; `end`: of what comes before it.
std::size_t filling(std::size_t end, std::size_t alignment) {
  const std::size_t lacks = (alignment - end % alignment) % alignment;
  return lacks == 0 || lacks >= field_head ? lacks : lacks + alignment;
}

/// What both records of a file say of it.
void describe(Record& record, const std::string& name, const std::string& bytes) {
  constexpr std::size_t version = 20, flags = 0, stored = 0, midnight = 0;
  record.two(version).two(flags).two(stored).two(midnight).two(first_day);
  record.four(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  record.four(bytes.size()).four(bytes.size()).two(name.size());
}

/// Bytes that say nothing, under a number that nobody has.
std::string field_of(std::size_t size) {
  constexpr std::size_t nobody = 0x1986;
  if (size == 0) return {};
  return Record("").two(nobody).two(size - field_head).bytes() + std::string(size - field_head, 0);
}

void require_room(std::size_t size, std::size_t count) {
  if (size > std::numeric_limits<std::uint32_t>::max() ||
      count > std::numeric_limits<std::uint16_t>::max())
    throw std::length_error("more than a ZIP archive of 4 GiB holds");
}

}  // namespace

std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files,
                       std::size_t alignment) {
  std::string archive, directory;
  for (const auto& [name, bytes] : files) {
    Record entry("PK\x01\x02");
    describe(entry.two(20), name, bytes);
    entry.two(0).two(0).two(0).two(0).four(0).four(archive.size());
    directory += entry.bytes() + name;
    const std::size_t extra = filling(archive.size() + head_size + name.size(), alignment);
    Record head("PK\x03\x04");
    describe(head, name, bytes);
    archive += head.two(extra).bytes() + name + field_of(extra) + bytes;
    require_room(archive.size() + directory.size(), files.size());
  }
  Record end("PK\x05\x06");
  end.two(0).two(0).two(files.size()).two(files.size());
  end.four(directory.size()).four(archive.size()).two(0);
  return archive + directory + end.bytes();
}

}  // namespace sphparam
