#include "batch/publication.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/files/temporary_file.h"
#include "sphparam/batch/run.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path) {
  throw BatchMachineError(path + ": cannot rename: " + std::strerror(errno));
}

bool rename_to(const std::string& from, const std::string& to) {
  return ::rename(from.c_str(), to.c_str()) == 0;
}

/// What another plan left makes room; the new one has its place in the same step where the file
/// system can.
void replace(const std::string& staged, const std::string& target) {
  if (::renameat2(AT_FDCWD, staged.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return;
  if (!rename_to(target, staged + "-old") || !rename_to(staged, target)) fail(target);
}

/// Are these results of the same steps, of the input as it was before? Those of other steps are
/// another plan's; those of this input stay good when a later attempt fails, as of another program
/// or with less time.
bool is_outdated_by(const BatchRecord& failure, const std::string& results) {
  const auto bytes = small_file(results + "/record.json");
  const auto head = bytes ? read_head(*bytes) : std::nullopt;
  if (!head || head->options != failure.head.options) return false;
  return head->planned != failure.head.planned;
}

}  // namespace

bool publish_results(const std::string& folder, const std::string& staged, const BatchItem& item) {
  const std::string target = result_folder(folder, item.id);
  if (!rename_to(staged, target)) {
    if (errno != EEXIST && errno != ENOTEMPTY) fail(target);
    if (has_results(folder, item)) return false;
    replace(staged, target);
  }
  sync_folder(folder + "/results", target);
  ::unlink(failure_path(folder, item.id).c_str());
  return true;
}

bool has_results(const std::string& folder, const BatchItem& item) {
  const auto there = record_about(folder, item);
  return there && !there->head.failed() && there->head.program == program_hash() &&
         has_its_files(result_folder(folder, item.id), there->head.files);
}

void publish_failure(const std::string& folder, const std::string& staged,
                     const BatchRecord& record) {
  publish_failure_bytes(folder, staged, record.id, to_json(record));
  const std::string results = result_folder(folder, record.id);
  if (!is_outdated_by(record, results)) return;
  if (!rename_to(results, staged + "/outdated") && errno != ENOENT) fail(results);
}

void publish_failure_bytes(const std::string& folder, const std::string& staged,
                           const std::string& id, std::string bytes) {
  const std::string file = staged + "/failure.json", target = failure_path(folder, id);
  write_file(file, std::move(bytes));
  if (!rename_to(file, target)) fail(target);
  sync_folder(folder + "/failed", target);
}

bool has_its_files(const std::string& folder, const std::vector<BatchFile>& files) {
  return std::ranges::all_of(files, [&](const BatchFile& file) {
    struct stat status {};
    return ::stat((folder + "/" + file.name).c_str(), &status) == 0 &&
           static_cast<std::uint64_t>(status.st_size) == file.size;
  });
}

std::vector<BatchFile> files_below(const std::string& folder) {
  std::vector<BatchFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files.push_back({entry.path().lexically_relative(folder).string(), entry.file_size(),
                     hash_of_file(entry.path().string())});
  }
  std::ranges::sort(files, {}, &BatchFile::name);
  return files;
}

std::string reason_of_end(int code, std::string_view log) {
  if (code <= 128) return reason_in(log);
  const int signal = code - 128;
  const char* const name = ::sigabbrev_np(signal);
  return "killed by signal " + std::to_string(signal) +
         (name ? std::string(" (SIG") + name + ")" : std::string()) +
         (signal == 9 ? ": out of memory on this machine, or somebody's kill" : "");
}

}  // namespace sphparam
