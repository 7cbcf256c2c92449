#include "crew.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <deque>
#include <stdexcept>
#include <vector>

// A child gets a batch of items and writes a line for each: the item's number when it begins, the
// result when it is done. Whoever's pipe ends early has crashed in the item begun last; the rest of
// its batch goes back to the queue.

namespace sphparam::campaign {
namespace {

using Clock = std::chrono::steady_clock;

/// Since it began; 0 when it has ended.
double processor_seconds(pid_t process) {
  clockid_t clock;
  timespec time;
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

constexpr int poll_milliseconds = 200;
constexpr double patience = 10;  // wall time to processor time: the machine may be busy

struct Batch {
  std::int64_t next, last;
};

struct Worker {
  pid_t process;
  int pipe;
  Batch batch;  // `next`: the item it is at, or will begin
  std::string unread;
  Clock::time_point begun = Clock::now();  // the item
  double seconds_before = 0;               // of processor time
  bool stopped = false;                    // by us, for taking too long
};

void write_line(int pipe, std::string line) {
  line += '\n';
  for (size_t done = 0; done < line.size();) {
    const ssize_t n = write(pipe, line.data() + done, line.size() - done);
    if (n <= 0) _exit(1);  // the parent is gone
    done += static_cast<size_t>(n);
  }
}

class Crew {
 public:
  using Work = std::function<std::string(std::int64_t)>;
  using Report = std::function<void(std::int64_t, const std::string&)>;

  Crew(const Assignment& assignment, const Work& work, const Report& on_result,
       const Report& on_loss)
      : assignment_(assignment), work_(work), on_result_(on_result), on_loss_(on_loss) {
    for (std::int64_t i = assignment.first; i < assignment.last; i += assignment.batch) {
      queue_.push_back({i, std::min(i + assignment.batch, assignment.last)});
    }
  }

  void run() {
    while (!queue_.empty() || !workers_.empty()) {
      while (!queue_.empty() && std::ssize(workers_) < assignment_.jobs) hire();
      listen();
    }
  }

 private:
  void hire() {
    const Batch batch = queue_.front();
    queue_.pop_front();
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe for another process");
    std::fflush(nullptr);
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no further process");
    if (process == 0) {
      close(ends[0]);
      for (std::int64_t i = batch.next; i < batch.last; ++i) {
        write_line(ends[1], "begin");
        write_line(ends[1], work_(i));
      }
      _exit(0);
    }
    close(ends[1]);
    workers_.push_back({process, ends[0], batch, {}});
  }

  void listen() {
    std::vector<pollfd> pipes;
    for (const Worker& worker : workers_) pipes.push_back({worker.pipe, POLLIN, 0});
    poll(pipes.data(), pipes.size(), poll_milliseconds);
    for (size_t i = workers_.size(); i-- > 0;) {
      const bool ended = pipes[i].revents != 0 && !read_lines(workers_[i]);
      if (ended) {
        dismiss(workers_[i]);
        workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        stop_if_late(workers_[i]);
      }
    }
  }

  /// False at the end of the pipe.
  bool read_lines(Worker& worker) {
    char buffer[4096];
    const ssize_t n = read(worker.pipe, buffer, sizeof buffer);
    if (n <= 0) return false;
    worker.unread.append(buffer, static_cast<size_t>(n));
    for (size_t end; (end = worker.unread.find('\n')) != std::string::npos;) {
      const std::string line = worker.unread.substr(0, end);
      worker.unread.erase(0, end + 1);
      worker.begun = Clock::now();
      worker.seconds_before = processor_seconds(worker.process);
      if (line != "begin") on_result_(worker.batch.next++, line);
    }
    return true;
  }

  void stop_if_late(Worker& worker) const {
    const std::chrono::duration<double> spent = Clock::now() - worker.begun;
    const double worked = processor_seconds(worker.process) - worker.seconds_before;
    const bool late =
        worked > assignment_.time_limit || spent.count() > patience * assignment_.time_limit;
    if (worker.stopped || !late) return;
    worker.stopped = true;
    kill(worker.process, SIGKILL);
  }

  std::string reason(const Worker& worker, int status) const {
    if (worker.stopped) {
      return "over " + std::to_string(static_cast<int>(assignment_.time_limit)) + " s";
    }
    if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
    return "ended with code " + std::to_string(WEXITSTATUS(status));
  }

  void dismiss(const Worker& worker) {
    close(worker.pipe);
    int status = 0;
    waitpid(worker.process, &status, 0);
    Batch rest = worker.batch;
    if (rest.next == rest.last) return;
    const int limit = static_cast<int>(assignment_.time_limit);
    on_loss_(rest.next, worker.stopped ? "over " + std::to_string(limit) + " s"
                        : WIFSIGNALED(status)
                            ? "signal " + std::to_string(WTERMSIG(status))
                            : "ended with code " + std::to_string(WEXITSTATUS(status)));
    if (++rest.next < rest.last) queue_.push_front(rest);
  }

  const Assignment& assignment_;
  const Work& work_;
  const Report& on_result_;
  const Report& on_loss_;
  std::deque<Batch> queue_;
  std::vector<Worker> workers_;
};

}  // namespace

void run_crew(const Assignment& assignment, const std::function<std::string(std::int64_t)>& work,
              const std::function<void(std::int64_t, const std::string&)>& on_result,
              const std::function<void(std::int64_t, const std::string&)>& on_loss) {
  Crew(assignment, work, on_result, on_loss).run();
}

}  // namespace sphparam::campaign
