#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace sphparam {

/// True for the first bytes of a ZIP archive that holds something.
bool looks_like_zip(std::string_view bytes);

/// The files of a ZIP archive in memory: stored or deflated, with the fields of Zip64 or without.
/// Names are as Open Packaging has them: without regard to case in ASCII, with or without a leading
/// slash. Nothing is believed of what the archive says of sizes.
/// Source: PKWARE's APPNOTE.TXT 6.3.
class ZipArchive {
 public:
  /// Requires: `bytes` and `name` outlive the archive. Throws: ReadError where the directory of the
  /// archive is missing or broken.
  ZipArchive(std::string_view bytes, const std::string& name);

  bool has(std::string_view path) const;

  /// What the file of this name holds. Requires: it is there. Throws: ReadError where it is
  /// encrypted, packed in another way, corrupt, or larger than that. Cost: that of what comes out.
  std::string unpacked(std::string_view path, std::uint64_t max_bytes) const;

 private:
  struct Entry {
    std::uint64_t flags, method, check, packed_size, size, offset;
  };

  std::uint64_t number(std::uint64_t at, int width) const;
  void read_entry(std::uint64_t& at);
  void read_large_sizes(std::uint64_t at, std::uint64_t end, Entry& entry) const;
  std::string_view packed(const Entry& entry) const;
  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const;

  std::string_view bytes_;
  const std::string& name_;
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace sphparam
