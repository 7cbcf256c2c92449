// A process is told apart from all others by the boot of its machine, its space of process numbers
// (containers have their own), its number, and the moment of its start, as numbers come again.

#include "batch/staging.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "batch/content_hash.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

std::string first_word_of(const std::string& path) {
  std::ifstream in(path);
  std::string word;
  in >> word;
  return word;
}

struct ProcessLine {
  char state = 'X';   // as in ps; X: there is none
  std::string start;  // in ticks since the boot
};

ProcessLine line_of_process(const std::string& pid) {
  std::ifstream in("/proc/" + pid + "/stat");
  std::string line;
  std::getline(in, line);
  const std::size_t name_end = line.rfind(')');  // what the process calls itself may hold anything
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  ProcessLine process;
  fields >> process.state;
  constexpr int fields_between = 19;  // of 22, three are before or are this one
  for (int i = 0; i < fields_between; ++i) fields >> process.start;
  return process;
}

/// Does it run? One that ended may stand there for as long as nobody has asked how it did.
bool lives(const std::string& pid, const std::string& start) {
  const ProcessLine process = line_of_process(pid);
  return process.state != 'Z' && process.state != 'X' && process.start == start;
}

std::string boot_of_machine() {
  return first_word_of("/proc/sys/kernel/random/boot_id").substr(0, 8);
}

/// Machines may be called alike ("localhost"), and then share a folder. Empty: nobody can tell, as
/// in many containers.
std::string number_of_machine() {
  const std::string id = first_word_of("/etc/machine-id");  // not to be shown as it is
  return id.empty() ? "" : content_hash(id).substr(0, 8);
}

std::string process_space() {
  struct stat status {};
  return ::stat("/proc/self/ns/pid", &status) == 0 ? std::to_string(status.st_ino) : "0";
}

/// Machine, boot, space: of whom processes can be looked up here.
const std::vector<std::string>& here() {
  static const std::vector<std::string> parts = {host_name() + "." + number_of_machine(),
                                                 boot_of_machine(), process_space()};
  return parts;
}

/// The parts after the id, which has no '~'.
std::vector<std::string> owner_parts(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream in(name);
  for (std::string part; std::getline(in, part, '~');) parts.push_back(part);
  if (!parts.empty()) parts.erase(parts.begin());
  return parts;
}

std::vector<fs::path> staging_folders(const std::string& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(fs::path(folder) / "staging", error), end;
       !error && entry != end; entry.increment(error))
    folders.push_back(entry->path());
  return folders;
}

}  // namespace

const std::string& host_name() {
  static const std::string name = [] {
    char text[256] = "";
    ::gethostname(text, sizeof text - 1);
    std::string host(text);
    std::ranges::replace(host, '~', '-');
    std::ranges::replace(host, '/', '-');
    return host;
  }();
  return name;
}

std::string staging_name(const std::string& id) { return staging_name(id, ::getpid()); }

std::string staging_name(const std::string& id, pid_t process) {
  const std::string pid = std::to_string(process);
  return id + "~" + here()[0] + "~" + here()[1] + "~" + here()[2] + "~" + pid + "~" +
         line_of_process(pid).start;
}

StagingOwner owner_of_staging(const std::string& name) {
  const std::vector<std::string> parts = owner_parts(name);
  const bool can_look = !here()[1].empty();  // not where nobody mounted /proc
  if (parts.size() != 5 || !can_look) return StagingOwner::Unknown;
  const bool same_boot = parts[1] == here()[1], same_space = parts[2] == here()[2];
  if (same_boot && same_space)
    return lives(parts[3], parts[4]) ? StagingOwner::Lives : StagingOwner::IsGone;
  const bool same_machine = parts[0] == here()[0] && !parts[0].ends_with('.');
  return same_machine && !same_boot ? StagingOwner::IsGone : StagingOwner::Unknown;
}

int remove_left_staging(const std::string& folder) {
  int count = 0;
  for (const fs::path& path : staging_folders(folder)) {
    if (owner_of_staging(path.filename().string()) != StagingOwner::IsGone) continue;
    std::error_code hidden;  // another run may be removing it too
    fs::remove_all(path, hidden);
    ++count;
  }
  return count;
}

int count_staging(const std::string& folder) {
  return static_cast<int>(std::ranges::count_if(staging_folders(folder), [](const fs::path& path) {
    return owner_of_staging(path.filename().string()) != StagingOwner::IsGone;
  }));
}

}  // namespace sphparam
