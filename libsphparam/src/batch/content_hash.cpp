#include "batch/content_hash.h"

#include <link.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>
#include <system_error>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "io/files/file_bytes.h"
#include "io/files/program_path.h"

namespace sphparam {

namespace {

constexpr std::int64_t second = 1'000'000'000;  // nanoseconds

std::int64_t nanoseconds(const timespec& time) {
  return static_cast<std::int64_t>(time.tv_sec) * second + time.tv_nsec;
}

int note_object(dl_phdr_info* info, size_t, void* paths) {
  const std::string name = info->dlpi_name ? info->dlpi_name : "";
  if (name.find("libsphparam") != std::string::npos)
    static_cast<std::vector<std::string>*>(paths)->push_back(name);
  return 0;
}

}  // namespace

std::string content_hash(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

std::string hash_of_file(const std::string& path) {
  return content_hash(FileBytes(path, std::numeric_limits<std::uint64_t>::max()).view());
}

const std::string& program_hash() {
  static const std::string hash = [] {
    const std::string running = "/proc/self/exe";  // which stays, whatever its file is now
    std::error_code hidden;
    const bool is_mounted = std::filesystem::exists(running, hidden);
    std::vector<std::string> objects = {is_mounted ? running : program_path().string()};
    dl_iterate_phdr(note_object, &objects);
    std::string hashes;
    for (const std::string& object : objects) hashes += hash_of_file(object);
    return content_hash(hashes);
  }();
  return hash;
}

FileStamp stamp_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw ReadError(path, std::strerror(errno));
  return {static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim),
          nanoseconds(status.st_ctim), status.st_ino};
}

bool is_fresh(const FileStamp& stamp) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now) - stamp.changed < 2 * second;
}

}  // namespace sphparam
