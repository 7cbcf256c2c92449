#include "io/files/zip_archive.h"

#include <zlib.h>

#include <algorithm>

#include "io/files/gzip.h"
#include "lower_case.h"
#include "sphparam/io/read_options.h"

// An archive is read from its end: a record there says where the directory begins, which says where
// the files are. Numbers are little-endian; those that do not fit are all ones, and stand in a
// field of Zip64.

namespace sphparam {
namespace {

constexpr std::string_view of_file = "PK\3\4", of_directory = "PK\1\2", of_end = "PK\5\6",
                           of_large_end = "PK\6\6", of_locator = "PK\6\7";
constexpr std::uint64_t file_bytes = 30, entry_bytes = 46, end_bytes = 22, locator_bytes = 20;
constexpr std::uint64_t most_comment = 0xFFFF;
constexpr std::uint64_t elsewhere = 0xFFFFFFFF;  // a number that stands in a field of Zip64
constexpr std::uint64_t stored = 0, deflated = 8;

std::string plain(std::string_view path) {
  return in_lower_case(path.substr(std::min(path.find_first_not_of('/'), path.size())));
}

}  // namespace

bool looks_like_zip(std::string_view bytes) { return bytes.starts_with(of_file); }

ZipArchive::ZipArchive(std::string_view bytes, const std::string& name)
    : bytes_(bytes), name_(name) {
  const std::size_t end = bytes.rfind(of_end);
  if (end == std::string_view::npos || bytes.size() - end < end_bytes ||
      bytes.size() - end > end_bytes + most_comment)
    throw ReadError(name, "is a ZIP archive without its directory: it is cut short");
  std::uint64_t count = number(end + 10, 2), at = number(end + 16, 4);
  const bool is_large =
      end >= locator_bytes && bytes.substr(end - locator_bytes).starts_with(of_locator);
  if (is_large) {
    const std::uint64_t record = number(end - locator_bytes + 8, 8);
    if (record > bytes.size() || !bytes.substr(record).starts_with(of_large_end))
      fail(end - locator_bytes, "the end of the ZIP directory is not where it is said to be");
    count = number(record + 32, 8);
    at = number(record + 48, 8);
  }
  for (std::uint64_t i = 0; i < count; ++i) read_entry(at);
}

std::uint64_t ZipArchive::number(std::uint64_t at, int width) const {
  if (at > bytes_.size() || bytes_.size() - at < static_cast<std::uint64_t>(width))
    fail(std::min<std::uint64_t>(at, bytes_.size()), "the file ends within its ZIP directory");
  std::uint64_t value = 0;
  for (int i = width - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes_[at + static_cast<std::uint64_t>(i)]);
  return value;
}

/// Moves on to the next one.
void ZipArchive::read_entry(std::uint64_t& at) {
  if (at > bytes_.size() || !bytes_.substr(at).starts_with(of_directory))
    fail(std::min<std::uint64_t>(at, bytes_.size()), "no entry of the ZIP directory is here");
  Entry entry{.flags = number(at + 8, 2),
              .method = number(at + 10, 2),
              .check = number(at + 16, 4),
              .packed_size = number(at + 20, 4),
              .size = number(at + 24, 4),
              .offset = number(at + 42, 4)};
  const std::uint64_t name = at + entry_bytes, extra = name + number(at + 28, 2),
                      comment = extra + number(at + 30, 2);
  if (comment > bytes_.size()) fail(at, "an entry of the ZIP directory runs past the end");
  read_large_sizes(extra, comment, entry);
  entries_.try_emplace(plain(bytes_.substr(name, extra - name)), entry);
  at = comment + number(at + 32, 2);
}

/// What stands in a field of Zip64, in this order.
void ZipArchive::read_large_sizes(std::uint64_t at, std::uint64_t end, Entry& entry) const {
  constexpr std::uint64_t zip64 = 1, header = 4;
  while (end - at >= header) {
    const std::uint64_t kind = number(at, 2), size = number(at + 2, 2);
    std::uint64_t value = at + header;
    at = std::min(value + size, end);
    if (kind != zip64) continue;
    for (std::uint64_t* wanted : {&entry.size, &entry.packed_size, &entry.offset}) {
      if (*wanted != elsewhere || at - value < 8) continue;
      *wanted = number(value, 8);
      value += 8;
    }
  }
}

bool ZipArchive::has(std::string_view path) const { return entries_.contains(plain(path)); }

std::string_view ZipArchive::packed(const Entry& entry) const {
  if (entry.offset > bytes_.size() || !bytes_.substr(entry.offset).starts_with(of_file))
    fail(std::min<std::uint64_t>(entry.offset, bytes_.size()),
         "no file of the ZIP archive is here");
  const std::uint64_t start =
      entry.offset + file_bytes + number(entry.offset + 26, 2) + number(entry.offset + 28, 2);
  if (start > bytes_.size() || entry.packed_size > bytes_.size() - start)
    fail(entry.offset, "a file of the ZIP archive runs past the end");
  return bytes_.substr(start, entry.packed_size);
}

std::string ZipArchive::unpacked(std::string_view path, std::uint64_t max_bytes) const {
  const Entry& entry = entries_.find(plain(path))->second;
  const std::string name = name_ + "/" + std::string(path);
  if ((entry.flags & 1) != 0) throw ReadError(name, "is encrypted");
  if (entry.method != stored && entry.method != deflated)
    throw ReadError(name, "is packed by method " + std::to_string(entry.method) +
                              " of ZIP, which is not supported; deflate is");
  const std::string_view packed_bytes = packed(entry);
  if (entry.method == stored && packed_bytes.size() > max_bytes)
    throw ReadError(name, "is larger than " + file_limit(max_bytes));
  std::string result =
      entry.method == stored ? std::string(packed_bytes) : inflated(packed_bytes, name, max_bytes);
  const auto* const first = reinterpret_cast<const Bytef*>(result.data());
  if (crc32_z(0, first, result.size()) != entry.check)
    throw ReadError(name, "its ZIP data is corrupt");
  return result;
}

void ZipArchive::fail(std::uint64_t at, const std::string& what) const {
  throw ReadError::at_byte(name_, at, what);
}

}  // namespace sphparam
