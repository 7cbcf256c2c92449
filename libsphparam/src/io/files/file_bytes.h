#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// The bytes of a file: mapped into memory where it is a regular file, read where it is a pipe or
/// standard input (path "-").
class FileBytes {
 public:
  /// Throws: ReadError when the file cannot be opened, is a directory or is over `max_bytes`.
  FileBytes(const std::string& path, std::uint64_t max_bytes);
  /// The same for `options.max_file_bytes`; the message says how to raise it.
  FileBytes(const std::string& path, const ReadOptions& options);
  /// All bytes of a file that is open already, and stays so; `name` is for messages.
  FileBytes(int descriptor, std::string name);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::string_view view() const { return view_; }
  const std::string& name() const { return name_; }  // for messages

 private:
  FileBytes(const std::string& path, std::uint64_t max_bytes, std::string limit);
  void map_or_read(int descriptor, std::uint64_t max_bytes);
  void read_all(int descriptor, std::uint64_t max_bytes);

  std::string name_, limit_;  // for messages
  std::string_view view_;
  void* mapping_ = nullptr;
  std::string copy_;
};

}  // namespace sphparam
