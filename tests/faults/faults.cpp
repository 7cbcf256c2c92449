// Runs a subcommand on a small mesh again and again, each time with another fault: the n-th
// allocation or system call fails, a signal comes, the file may not grow. Afterwards every output
// must be what it was or what a run without faults writes, a failed run must have changed nothing,
// and no temporary may be left (after SIGKILL: none after the next run).
//
//   fault_runner PROGRAM SHIM COUNT [ERRAND]
//
// COUNT: how many faults at least; prints how many of which kind. ERRAND: see errands.cpp (default:
// map).

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "faults/errands.h"
#include "support/bytes_of.h"
#include "support/process.h"

namespace {

using namespace sphparam::tests;
namespace fs = std::filesystem;

constexpr double most_seconds = 60;  // then a run counts as hanging
constexpr int killed = 128 + SIGKILL, interrupted = 130;

/// Empty where there is none: a fault may have kept it from being made.
std::string bytes_or_none(const fs::path& path) {
  return fs::exists(path) ? bytes_of(path) : std::string();
}

void write_off(const fs::path& path, const sphparam::TriangleMesh& mesh) {
  std::ofstream file(path);
  file << "OFF\n" << mesh.vertex_count() << ' ' << mesh.face_count() << " 0\n" << mesh.positions;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) file << "\n3 " << mesh.triangles.row(f);
}

/// Numbers a vertex as FreeSurfer has them, all 0.
void write_values(const fs::path& path, const sphparam::TriangleMesh& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << "\xff\xff\xff";
  for (const auto number : {mesh.vertex_count(), mesh.face_count(), Eigen::Index{1}})
    for (int shift = 24; shift >= 0; shift -= 8) file.put(static_cast<char>(number >> shift));
  file << std::string(4 * static_cast<std::size_t>(mesh.vertex_count()), '\0');
}

/// One thing that goes wrong, in the words of the shim or as a limit or a late signal.
struct Fault {
  std::string kind = {};  // for the table
  std::string shim = {};  // SPHPARAM_FAULT
  ProcessLimits limits{.seconds = most_seconds};
  ProcessSignal signal = {};
  std::set<int> codes = {};  // how the run may end
  bool kills = false;        // then outputs are judged one by one, and temporaries may be left
  bool lasts = false;        // no rename works any more, so none can be undone: one by one, too
};

/// A folder with a mesh and old outputs, and what a run without faults makes of them.
class Scene {
 public:
  Scene(std::string program, std::string shim, Errand errand)
      : program_(std::move(program)), shim_(std::move(shim)), errand_(std::move(errand)) {
    std::string name = (fs::temp_directory_path() / "sphparam_faults_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder_ = name;
    fs::create_directory(folder_ / "scans");
    write_off(folder_ / "scans/mesh.off", errand_.mesh);
    write_values(folder_ / "rh.depth", errand_.mesh);
    if (!errand_.given.empty())
      fs::copy_file(fs::path(SPHPARAM_HOSTILE_FILES) / errand_.given,
                    folder_ / ("given" + errand_.given.substr(errand_.given.find('.'))));
    for (const Words& command : errand_.before) {
      const ProcessEnd end = run_process(command_line(command), {}, {.seconds = most_seconds});
      if (end.code != 0) throw std::runtime_error("before: " + end.messages);
    }
    reset(true);
    const auto start = std::chrono::steady_clock::now();
    const ProcessEnd end = run({}, {"SPHPARAM_FAULT_COUNTS=" + (folder_ / "counts").string()});
    if (end.code != 0) throw std::runtime_error("without a fault: " + end.messages);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::ifstream counts(folder_ / "counts");
    for (std::string call; counts >> call;) counts >> calls[call];
    for (const auto& entry : fs::directory_iterator(folder_ / "found"))
      if (entry.is_regular_file() && entry.path().extension() != ".json")
        errand_.outputs.push_back("found/" + entry.path().filename().string());
    for (const std::string& output : errand_.outputs) new_[output] = bytes_of(folder_ / output);
    if (errand_.map.empty()) return;
    const ProcessEnd proof = run_process({program_, "verify", (folder_ / errand_.map).string()});
    if (proof.code != 0) throw std::runtime_error("not certified: " + proof.messages);
  }
  ~Scene() { fs::remove_all(folder_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// What is wrong after this fault; empty when nothing is. Counts it if it happened.
  std::string survive(const Fault& fault, bool fresh) {
    reset(fresh);
    const fs::path log = folder_ / "log";
    std::vector<std::string> environment;
    if (!fault.shim.empty())
      environment = {"SPHPARAM_FAULT=" + fault.shim, "SPHPARAM_FAULT_LOG=" + log.string()};
    const ProcessEnd end = run(fault, environment);
    const bool came = fault.shim.empty() || fs::remove(log);
    if (came) ++happened[fault.kind];
    std::string complaint = judge(came ? fault : Fault{.codes = {0}}, end, fresh);
    if (fault.kills && complaint.empty()) complaint = judge_next_run();
    if (complaint.empty()) return {};
    return fault.kind + " (" + fault.shim + (fresh ? ", new files): " : ", old files): ") +
           complaint + "; the program ended with " + std::to_string(end.code) + ": " + end.messages;
  }

  std::size_t largest_output() const {
    std::size_t largest = 1;
    for (const auto& [output, bytes] : new_) largest = std::max(largest, bytes.size());
    return largest;
  }

  double seconds = 0;                    // of a run without faults
  std::map<std::string, long> calls;     // in it
  std::map<std::string, long> happened;  // by kind

 private:
  std::vector<std::string> command_line(const Words& command) const {
    std::vector<std::string> words = {program_};
    for (const std::string& word : command)
      words.push_back(word.starts_with("@") ? (folder_ / word.substr(1)).string() : word);
    words.push_back("-q");
    return words;
  }

  ProcessEnd run(const Fault& fault, std::vector<std::string> environment) {
    if (!environment.empty()) environment.push_back("LD_PRELOAD=" + shim_);
    return run_process(command_line(errand_.words), environment, fault.limits, fault.signal);
  }

  void reset(bool fresh) {
    fs::remove_all(folder_ / "found");
    fs::create_directory(folder_ / "found");
    for (const std::string& output : errand_.outputs) {
      fs::remove(folder_ / output);
      if (!fresh && output != errand_.unnamed) std::ofstream(folder_ / output) << "old " << output;
    }
  }

  /// Of reports, which hold times, and of pages, which tell of faults, only the ends are known.
  bool is_new(const std::string& output) const {
    const std::string bytes = bytes_or_none(folder_ / output);
    if (output.ends_with(".html"))
      return bytes.starts_with("<!DOCTYPE html>") && bytes.ends_with("</html>\n");
    if (output != "report.json") return bytes == new_.at(output);
    return bytes.starts_with("{") && bytes.ends_with("}\n");
  }

  /// Records appear whole or not at all.
  std::string half_record() const {
    for (const auto& entry : fs::directory_iterator(folder_ / "found")) {
      if (entry.path().extension() != ".json") continue;
      const std::string bytes = bytes_of(entry.path());
      if (!bytes.starts_with("{") || !bytes.ends_with("}\n"))
        return entry.path().filename().string();
    }
    return {};
  }

  bool is_old(const std::string& output, bool fresh) const {
    if (fresh || output == errand_.unnamed) return !fs::exists(folder_ / output);
    return bytes_or_none(folder_ / output) == "old " + output;
  }

  std::vector<std::string> temporaries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.path().string().find(".sphparam-") != std::string::npos)
        names.push_back(entry.path().filename());
    return names;
  }

  std::string judge(const Fault& fault, const ProcessEnd& end, bool fresh) const {
    if (end.timed_out) return "it hangs";
    const bool went_on = errand_.other_codes.contains(end.code);
    if (!went_on && !fault.codes.contains(end.code)) return "that is no documented exit code";
    for (const std::string& output : errand_.outputs) {
      const bool complete = is_new(output), untouched = is_old(output, fresh);
      if (!complete && !untouched) return output + " is half written";
      if ((end.code == 0 || went_on) && !complete) return output + " is missing";
      if (end.code != 0 && !went_on && !fault.kills && !fault.lasts && !untouched)
        return output + " was changed";
    }
    if (const std::string name = half_record(); !name.empty()) return name + " is half written";
    if (!fault.kills && !temporaries().empty()) return "left " + temporaries().front();
    const bool silent = end.code != 0 && end.code != interrupted && end.messages.empty();
    if (silent && !fault.kills) return "not a word was said";
    return {};
  }

  std::string judge_next_run() {
    const ProcessEnd end = run({.limits = {.seconds = most_seconds}}, {});
    if (end.code != 0) return "the next run ends with " + std::to_string(end.code);
    if (!temporaries().empty()) return "the next run leaves " + temporaries().front();
    return {};
  }

  std::string program_, shim_;
  Errand errand_;
  fs::path folder_;
  std::map<std::string, std::string> new_;
};

/// The n-th call of each kind with each way to go wrong: all of them.
std::vector<Fault> call_faults(const Scene& scene) {
  const std::map<std::string, std::vector<int>> errors = {{"open", {EACCES, EMFILE, EINTR, EIO}},
                                                          {"read", {EIO, EINTR}},
                                                          {"map", {ENOMEM, ENODEV}},
                                                          {"thread", {EAGAIN}},
                                                          {"load", {ENOENT}},
                                                          {"mkdir", {EACCES, ENOSPC}},
                                                          {"write", {ENOSPC, EIO, EINTR, EDQUOT}},
                                                          {"fsync", {EIO, ENOSPC, EINTR}},
                                                          {"fcntl", {ENOLCK, EMFILE, EINTR}},
                                                          {"close", {EIO, EINTR}},
                                                          {"rename", {EIO, ENOSPC, EACCES}}};
  std::vector<Fault> faults;
  for (const auto& [call, numbers] : errors) {
    for (long n = 1; n <= scene.calls.at(call); ++n) {
      const std::string turn = call + " " + std::to_string(n) + " ";
      const std::set<int> codes = call == "thread" ? std::set{0, 1, 3} : std::set{0, 3};
      for (const int number : numbers) {
        const std::string error = std::string(strerrorname_np(number));
        faults.push_back({.kind = call + " " + error,
                          .shim = turn + "E" + std::to_string(number),
                          .codes = codes});
        if (number != EINTR)
          faults.push_back({.kind = call + " " + error + " from then on",
                            .shim = turn + "A" + std::to_string(number),
                            .codes = codes,
                            .lasts = call == "rename"});
      }
      if (call == "write")
        faults.push_back({.kind = "short write", .shim = turn + "s0", .codes = {0}});
      for (const char when : {'S', 'T'}) {
        const std::string at = std::string(when == 'S' ? " before " : " after ") + call;
        faults.push_back(
            {.kind = "SIGKILL" + at, .shim = turn + when + "9", .codes = {killed}, .kills = true});
        faults.push_back(
            {.kind = "SIGINT" + at, .shim = turn + when + "2", .codes = {0, interrupted}});
        faults.push_back(
            {.kind = "SIGTERM" + at, .shim = turn + when + "15", .codes = {0, interrupted}});
      }
    }
  }
  return faults;
}

Fault allocation_fault(long n, bool from_then_on) {
  return {.kind = from_then_on ? "allocation, from then on" : "allocation",
          .shim = "malloc " + std::to_string(n) + (from_then_on ? " A12" : " E12"),
          .codes = {0, 1, 3}};
}

/// `count` faults: all calls first or, where there are more of these, every k-th; allocations
/// spread over the run; signals at any time; files that may not grow.
std::vector<Fault> choose_faults(const Scene& scene, long count, std::mt19937& random) {
  std::vector<Fault> faults = call_faults(scene);
  std::shuffle(faults.begin(), faults.end(), random);
  if (static_cast<long>(faults.size()) > count / 2)
    faults.resize(static_cast<std::size_t>(count / 2));
  const long left = count - static_cast<long>(faults.size());
  const long allocations = scene.calls.at("malloc");
  for (long i = 0; i < left / 2; ++i)
    faults.push_back(allocation_fault(1 + i * allocations / (left / 2), i % 3 == 2));
  std::uniform_real_distribution<double> moment(0, 1.2 * scene.seconds);
  for (long i = 0; i < left / 6; ++i)
    faults.push_back({.kind = "SIGKILL at a random moment",
                      .signal = {SIGKILL, moment(random)},
                      .codes = {0, killed},
                      .kills = true});
  for (long i = 0; i < left / 6; ++i)
    faults.push_back({.kind = "SIGINT at a random moment",
                      .signal = {SIGINT, moment(random)},
                      .codes = {0, interrupted}});
  while (static_cast<long>(faults.size()) < count) {
    const std::uint64_t bytes = 1 + random() % scene.largest_output();
    faults.push_back({.kind = "limit on file sizes (disk full)",
                      .limits = {.seconds = most_seconds, .file_bytes = bytes},
                      .codes = {0, 3}});
  }
  return faults;
}

int run_faults(const std::string& program, const std::string& shim, long count,
               const std::string& errand) {
  Scene scene(program, shim, errand_named(errand));
  std::mt19937 random(2006);
  long failures = 0;
  for (const Fault& fault : choose_faults(scene, count, random)) {
    const std::string complaint = scene.survive(fault, random() % 2);
    if (complaint.empty()) continue;
    ++failures;
    std::printf("FAILED %s\n", complaint.c_str());
  }
  long total = 0;
  for (const auto& [kind, times] : scene.happened) {
    std::printf("%6ld  %s\n", times, kind.c_str());
    total += times;
  }
  std::printf("%ld faults, %ld failures\n", total, failures);
  return failures == 0 && total > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) {
    std::fprintf(stderr, "fault_runner PROGRAM SHIM COUNT [ERRAND]\n");
    return 2;
  }
  try {
    return run_faults(argv[1], argv[2], std::atol(argv[3]), argc > 4 ? argv[4] : "map");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
