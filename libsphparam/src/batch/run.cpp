// One thread hands out items to processes and waits for their ends, which it sees by pipes that
// close: no handler of signals is changed, and none interrupts it. An item's process leads a group
// of its own, so that it can be stopped with its step.

#include "sphparam/batch/run.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <list>
#include <numeric>

#include "batch/child.h"
#include "batch/content_hash.h"
#include "batch/input_hash.h"
#include "batch/item_run.h"
#include "batch/options_hash.h"
#include "batch/publication.h"
#include "batch/staging.h"
#include "option_domain.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/parallel.h"
#include "sphparam/stopwatch.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr int look_around = 100;  // milliseconds until `progress` is asked again

double own_cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  double sum = 0;
  for (const timeval& time : {usage.ru_utime, usage.ru_stime})
    sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  return sum;
}

/// The numbers of the items of a run, the largest first: the last to end are small then, and no
/// core waits for long.
std::vector<std::size_t> items_of(const BatchPlan& plan, const BatchRunOptions& options) {
  std::vector<std::size_t> items = options.only;
  if (items.empty()) {
    const auto chunk = static_cast<std::size_t>(plan.chunk);
    const std::size_t first = options.task > 0 ? chunk * (options.task - 1) : 0;
    const std::size_t end =
        options.task > 0 ? std::min(plan.items.size(), first + chunk) : plan.items.size();
    items.resize(end > first ? end - first : 0);
    std::iota(items.begin(), items.end(), first);
  }
  std::ranges::stable_sort(items, std::ranges::greater{},
                           [&](std::size_t i) { return plan.items[i].size; });
  return items;
}

/// Is the input the one that the record is about? Read again where times do not tell.
bool has_same_input(const BatchRecordHead& head, const std::string& path, bool rehash) try {
  const FileStamp none;
  if (!rehash && !(head.stamp == none) && stamp_of(path) == head.stamp) return true;
  return !head.input.empty() && hash_of_input(path).hash == head.input;
} catch (const ReadError&) {
  return head.input.empty();  // it could not be read then either
}

struct RunningItem {
  std::size_t item;
  pid_t child;
  int pipe;             // closes when the child ends
  std::string message;  // of a machine's error
};

class BatchRun {
 public:
  BatchRun(const std::string& folder, const BatchPlan& plan, const BatchRunOptions& options)
      : folder_(fs::absolute(folder).lexically_normal().string()),
        plan_(plan),
        options_(options),
        items_(items_of(plan, options)),
        workers_(resolve_threads(options.workers)),
        setting_{folder_, plan, options.run_step, threads_of_item()} {
    while (folder_.size() > 1 && folder_.ends_with('/')) folder_.pop_back();
  }

  BatchRunSummary run() {
    const Stopwatch stopwatch;
    const double cpu_before = own_cpu_seconds();
    program_hash();  // once, before there are children that would each read the program for it
    make_folders();
    remove_left_staging(folder_);
    summary_.items = items_.size();
    try {
      run_items();
      stop_all();
    } catch (...) {  // nobody else would look after those that run
      stop_all_whatever_happens();
      throw;
    }
    if (!machine_error_.empty()) throw BatchMachineError(machine_error_);
    summary_.seconds = stopwatch.seconds();
    summary_.own_cpu_seconds = own_cpu_seconds() - cpu_before;
    return summary_;
  }

 private:
  void run_items() {
    for (std::size_t next = 0; next < items_.size() || !running_.empty();) {
      summary_.interrupted |= !goes_on();
      if (summary_.interrupted) break;
      if (next == items_.size() || static_cast<int>(running_.size()) == workers_) {
        wait_for_ends();
      } else if (!is_settled(items_[next++])) {
        start(items_[next - 1]);
      }
    }
  }

  void make_folders() const try {
    for (const char* const name : {"results", "failed", "staging"})
      fs::create_directories(fs::path(folder_) / name);
  } catch (const fs::filesystem_error& error) {
    throw BatchMachineError(folder_ + ": " + error.code().message());
  }

  int threads_of_item() const {
    const int items = static_cast<int>(std::min<std::size_t>(items_.size(), 4096));
    return std::max(1, workers_ / std::max(1, items));
  }

  bool goes_on() const {
    if (!machine_error_.empty()) return false;
    return !options_.progress || options_.progress(ended_, items_.size());
  }

  void note_failure(std::size_t item, int code) {
    if (summary_.first_failure != 0 && item > first_failed_) return;
    first_failed_ = item;
    summary_.first_failure = code;
  }

  /// Needs it no run? Counted then.
  bool is_settled(std::size_t number) {
    const BatchItem& item = plan_.items[number];
    const auto record = record_about(folder_, item);
    if (!record || record->head.retry) return false;
    const BatchRecordHead& head = record->head;
    if (head.program != program_hash() && !options_.any_program) {
      summary_.other_program += !head.failed();
      return false;
    }
    if (!has_same_input(head, item.path, options_.rehash) || !has_same_options(item)) return false;
    if (!has_its_files(result_folder(folder_, item.id), head.files)) return false;
    ++(head.failed() ? summary_.skipped_failed : summary_.skipped);
    if (head.failed()) note_failure(number, head.code);
    ++ended_;
    return true;
  }

  /// Are the files that the options name those that were planned? Files have no stamps in records:
  /// they are read, each once.
  bool has_same_options(const BatchItem& item) try {
    return options_hash_.of(item) == item.options;
  } catch (const ReadError&) {
    return false;
  }

  void start(std::size_t number) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw BatchMachineError(std::string("cannot make a pipe: ") + std::strerror(errno));
    running_.push_back({number, 0, ends[0], ""});
    try {
      running_.back().child = start_child([&] { return work(plan_.items[number], ends[1]); });
    } catch (...) {
      running_.pop_back();
      for (const int end : ends) ::close(end);
      throw;
    }
    ::setpgid(running_.back().child, running_.back().child);
    ::close(ends[1]);
  }

  /// In the process of an item. Its result must not be lost where the disk is full.
  int work(const BatchItem& item, int pipe) {
    ::setpgid(0, 0);
    try {
      return run_item(setting_, item);
    } catch (const std::exception& error) {
      const std::string message = item.id + ": " + error.what();
      [[maybe_unused]] const auto told = ::write(pipe, message.data(), message.size());
      return ItemMachineError;
    }
  }

  void wait_for_ends() {
    std::vector<pollfd> pipes;
    for (const RunningItem& running : running_) pipes.push_back({running.pipe, POLLIN, 0});
    if (::poll(pipes.data(), pipes.size(), look_around) <= 0) return;
    auto running = running_.begin();
    for (const pollfd& pipe : pipes) {
      const auto one = running++;
      if (pipe.revents == 0 || !has_ended(*one)) continue;
      const RunningItem ended = std::move(*one);
      running_.erase(one);  // also where its end cannot be noted
      take_end(ended);
    }
  }

  /// Takes what the pipe tells.
  static bool has_ended(RunningItem& running) {
    char text[4096];
    const ssize_t count = ::read(running.pipe, text, sizeof text);
    if (count > 0) running.message.append(text, static_cast<std::size_t>(count));
    return count == 0 || (count < 0 && errno != EINTR);
  }

  void take_end(const RunningItem& ended) {
    ::close(ended.pipe);
    const std::string staged =
        folder_ + "/staging/" + staging_name(plan_.items[ended.item].id, ended.child);
    note_end(ended, wait_for_child(ended.child), staged);
  }

  void note_end(const RunningItem& running, const ChildEnd& end, const std::string& staged) {
    summary_.item_cpu_seconds += end.cpu_seconds;
    ++ended_;
    switch (end.code) {
      case ItemDone:
        ++summary_.done;
        return;
      case ItemDoneElsewhere:
        ++summary_.done_elsewhere;
        return;
      case ItemInterrupted:
        summary_.interrupted = true;
        return;
      case ItemMachineError:
        machine_error_ = running.message;
        return;
      case ItemFailed:
        break;
      default:
        if (stopping_) return;
        if (!record_crash(setting_, plan_.items[running.item], staged, end.code, end.cpu_seconds)) {
          ++summary_.done;
          return;
        }
    }
    ++summary_.failed;
    const auto record = record_about(folder_, plan_.items[running.item]);
    note_failure(running.item, record ? record->head.code : end.code);
  }

  /// In good order first: steps remove what they wrote.
  void stop_all() {
    stopping_ = true;
    for (const RunningItem& running : running_) ::kill(-running.child, SIGTERM);
    while (!running_.empty()) wait_for_ends();
  }

  /// Something went wrong before, which is what is told.
  void stop_all_whatever_happens() {
    while (!running_.empty()) {
      try {
        stop_all();
      } catch (const std::exception&) {
      }
    }
  }

  std::string folder_;
  const BatchPlan& plan_;
  const BatchRunOptions& options_;
  const std::vector<std::size_t> items_;
  const int workers_;
  const ItemSetting setting_;
  OptionsHash options_hash_{plan_};
  std::list<RunningItem> running_;
  BatchRunSummary summary_;
  std::size_t ended_ = 0, first_failed_ = 0;
  std::string machine_error_;
  bool stopping_ = false;
};

}  // namespace

BatchRunSummary run_batch(const std::string& folder, const BatchPlan& plan,
                          const BatchRunOptions& options) {
  if (options.task < 0 || options.task > plan.tasks())
    throw BatchInputError("task " + std::to_string(options.task) + ": plan " + plan.name +
                          " has tasks 1 to " + std::to_string(plan.tasks()));
  for (const std::size_t item : options.only)
    require_between("only", static_cast<double>(item), 0,
                    static_cast<double>(plan.items.size()) - 1);
  return BatchRun(folder, plan, options).run();
}

}  // namespace sphparam
