#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// XXH3 with 128 bits as 32 hex digits, what `xxh128sum` prints. It tells what changed by accident
/// or on purpose of its owner; against forgers it is no protection. (Of the kept libraries it is
/// the one that costs nothing beside reading: some 10 GB/s, in a header.)
std::string content_hash(std::string_view bytes);

/// Of a file's bytes. Throws: ReadError.
std::string hash_of_file(const std::string& path);

/// Of the program that runs and of the libraries of sphparam that are loaded in it.
const std::string& program_hash();

/// By what one sees that a file was not touched, without reading it, as git does.
struct FileStamp {
  std::uint64_t size = 0;
  std::int64_t modified = 0;  // nanoseconds
  std::int64_t changed = 0;   // nanoseconds; nobody can set it
  std::uint64_t number = 0;   // inode

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Throws: ReadError.
FileStamp stamp_of(const std::string& path);

/// Could the file be changed once more, and have the same stamp? Within the two seconds that the
/// coarsest clock of a file system takes for one moment. Such a stamp is not to be trusted.
bool is_fresh(const FileStamp& stamp);

}  // namespace sphparam
