#include "support/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <stdexcept>

// fork, limits, exec; one pipe for both streams. The pipe's end tells that the process is over, and
// poll's timeout when a signal is due.

extern char** environ;

namespace sphparam::tests {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> result;
  for (const std::string& word : words) result.push_back(const_cast<char*>(word.c_str()));
  result.push_back(nullptr);
  return result;
}

void limit(decltype(RLIMIT_AS) resource, std::uint64_t value) {
  const rlimit both = {value, value};
  if (value > 0) setrlimit(resource, &both);
}

/// What the child does; only calls that are safe after fork in a program with threads.
[[noreturn]] void become(const std::vector<char*>& argv, const std::vector<char*>& environment,
                         const ProcessLimits& limits, int output) {
  limit(RLIMIT_AS, limits.memory);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, SIG_DFL);
  execve(argv[0], argv.data(), environment.data());
  _exit(127);
}

int milliseconds_until(Clock::time_point when) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(when - Clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count() + 1));
}

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& argv,
                       const std::vector<std::string>& environment, const ProcessLimits& limits,
                       const ProcessSignal& signal) {
  std::vector<std::string> variables = environment;
  for (char** variable = environ; *variable; ++variable) variables.push_back(*variable);
  const std::vector<char*> words = pointers(argv), names = pointers(variables);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) become(words, names, limits, ends[1]);
  close(ends[1]);

  const auto after = [start = Clock::now()](double seconds) {
    return start +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  ProcessEnd end;
  bool signalled = signal.number == 0;
  for (;;) {
    constexpr std::size_t kept = 1 << 16;
    char block[4096];
    pollfd readable = {ends[0], POLLIN, 0};
    const auto next = signalled ? after(limits.seconds) : after(signal.after);
    if (poll(&readable, 1, milliseconds_until(next)) > 0) {
      const ssize_t count = read(ends[0], block, sizeof block);
      if (count <= 0) break;
      if (end.messages.size() < kept) end.messages.append(block, static_cast<std::size_t>(count));
    } else if (Clock::now() >= next) {
      end.timed_out = signalled;
      kill(child, signalled ? SIGKILL : signal.number);
      signalled = true;
      if (end.timed_out) break;
    }
  }
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("no end of a process");
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

}  // namespace sphparam::tests
