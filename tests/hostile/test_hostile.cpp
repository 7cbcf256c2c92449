#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/folder.h"
#include "support/places.h"
#include "support/process.h"

// Files that are wrong, and what the program says of them: see make_files.py. The program runs as
// its users run it, under limits of time and memory.

using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

constexpr double most_seconds = 10;
#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t most_memory = 0;  // the sanitizer reserves terabytes
#else
constexpr std::uint64_t most_memory = 512u << 20;
#endif
constexpr int ok = 0, unreadable = 3, no_mesh = 4;

const fs::path folder = source_folder() / "tests/hostile";

struct HostileFile {
  std::string name;
  int code;
  std::string message;  // a part of it
};

std::vector<HostileFile> table() {
  std::vector<HostileFile> rows;
  std::ifstream in(folder / "expected.tsv");
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    HostileFile row;
    std::string code;
    std::getline(fields, row.name, '\t');
    std::getline(fields, code, '\t');
    std::getline(fields, row.message);
    row.code = std::stoi(code);
    rows.push_back(row);
  }
  return rows;
}

/// What one run did that it should not have; empty when all is well.
std::string complaint_about(const ProcessEnd& end, const HostileFile& file) {
  if (end.timed_out) return "takes more than 10 seconds";
  if (end.code != file.code)
    return "ends with " + std::to_string(end.code) + ", not " + std::to_string(file.code);
  if (end.messages.find(file.message) == std::string::npos) return "does not say " + file.message;
  const bool names_file = end.messages.find(file.name) != std::string::npos;
  if (file.code == 3 && !names_file) return "does not name the file";
  return {};
}

/// Files of numbers a vertex go with a surface of four.
bool is_of_values(const HostileFile& file) { return file.name.starts_with("values_"); }

std::string try_values(const HostileFile& file, const fs::path& scratch) {
  const std::string surface = (folder / "files/freesurfer_ok_plain.white").string();
  const std::string values = (folder / "files" / file.name).string();
  const std::string output = (scratch / (file.name + ".ply")).string();
  const ProcessEnd repair =
      run_process({SPHPARAM_PROGRAM, "repair", surface, "--data", values, "-o", output}, {},
                  {.seconds = most_seconds, .memory = most_memory});
  std::string complaint = complaint_about(repair, file);
  if (!complaint.empty())
    complaint = "repair " + file.name + " " + complaint + ": " + repair.messages;
  if (fs::exists(output) != (file.code == ok)) complaint += file.name + ": output is there or not";
  // Its own file says what it holds whatever the surface, or that it cannot be read.
  const ProcessEnd info = run_process({SPHPARAM_PROGRAM, "info", values}, {},
                                      {.seconds = most_seconds, .memory = most_memory});
  if (info.timed_out || (info.code != no_mesh && (info.code != unreadable || file.code == ok)))
    complaint += "info " + file.name + " ends with " + std::to_string(info.code) + info.messages;
  return complaint;
}

std::string try_file(const HostileFile& file, const fs::path& scratch) {
  if (is_of_values(file)) return try_values(file, scratch);
  const std::string path = (folder / "files" / file.name).string();
  const fs::path output = scratch / (file.name + ".sph.ply");
  const ProcessLimits limits{.seconds = most_seconds, .memory = most_memory};
  const ProcessEnd map = run_process(
      {SPHPARAM_PROGRAM, "map", path, "-o", output.string(), "--threads", "1"}, {}, limits);
  const ProcessEnd info = run_process({SPHPARAM_PROGRAM, "info", path}, {}, limits);
  std::string complaint;
  if (const std::string text = complaint_about(map, file); !text.empty())
    complaint += "map " + file.name + " " + text + ": " + map.messages;
  if (const std::string text = complaint_about(info, file); !text.empty())
    complaint += "info " + file.name + " " + text + ": " + info.messages;
  if (fs::exists(output) != (file.code == ok)) complaint += file.name + ": output is there or not";
  return complaint;
}

/// Every file of the table on all processors; the complaints.
std::string try_all(const std::vector<HostileFile>& files, const fs::path& scratch) {
  std::string complaints;
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < files.size();) {
      const std::string complaint = try_file(files[i], scratch);
      const std::lock_guard lock(mutex);
      if (!complaint.empty()) complaints += complaint + "\n";
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return complaints;
}

}  // namespace

TEST_CASE("hostile: every file of the corpus ends as its line of the table says") {
  const std::vector<HostileFile> files = table();
  REQUIRE(files.size() >= 300);
  const Folder scratch;
  const std::string complaints = try_all(files, scratch.path);
  INFO(complaints);
  CHECK(complaints.empty());
  long accepted = 0, found = 0;
  for (const HostileFile& file : files) accepted += file.code == ok;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch.path)) ++found;
  CHECK(found == accepted);  // no temporary either
}

TEST_CASE("hostile: the table and the folder name the same files") {
  std::set<std::string> expected, there;
  for (const HostileFile& file : table()) expected.insert(file.name);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder / "files")) {
    there.insert(entry.path().filename());
    bytes += entry.file_size();
  }
  CHECK(expected == there);
  CHECK(bytes <= 1u << 20);
}

TEST_CASE("hostile: a survey of a folder of them comes to its end") {
  const Folder scratch;
  fs::create_directory(scratch.path / "files");
  std::size_t count = 0;
  const std::vector<HostileFile> rows = table();
  for (std::size_t i = 0; i < rows.size(); i += 8) {  // an eighth of them
    const fs::path file = folder / "files" / rows[i].name;
    if (!fs::is_regular_file(file)) continue;
    fs::copy(file, scratch.path / "files" / file.filename());
    ++count;
  }
  REQUIRE(count > 100);
  const ProcessLimits limits{.seconds = 300};
  const ProcessEnd end = run_process({SPHPARAM_PROGRAM, "survey", (scratch.path / "files").string(),
                                      "-o", (scratch.path / "page.html").string(), "--size", "32"},
                                     {}, limits);
  INFO(end.messages);
  CHECK(end.code == 4);
  CHECK(end.messages.find(" do not") != std::string::npos);
  CHECK(fs::file_size(scratch.path / "page.html") > 10000);
}
