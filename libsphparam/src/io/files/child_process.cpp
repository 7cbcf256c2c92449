#include "io/files/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string_view>
#include <system_error>

// The child sends a byte that says how its work ended, then what it made or the error's message. It
// ends by _exit: nothing of the parent's is flushed or destroyed twice.

namespace sphparam {
namespace {

constexpr char done = 'd', failed = 'f';

[[noreturn]] void throw_error(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void send(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(pipe, bytes.data(), bytes.size());
    if (sent < 0 && errno != EINTR) ::_exit(1);
    if (sent > 0) bytes.remove_prefix(static_cast<size_t>(sent));
  }
}

/// Bytes of private memory that the process has, as RLIMIT_DATA counts them.
std::uint64_t data_of_this_process() {
  std::uint64_t pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    unsigned long long data = 0;
    if (std::fscanf(file, "%*s %*s %*s %*s %*s %llu", &data) == 1) pages = data;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void lower(decltype(RLIMIT_CPU) resource, std::uint64_t most, std::uint64_t more_at_the_end) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, most + more_at_the_end);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  ::setrlimit(resource, &limit);
}

void apply(const ChildLimits& limits) {
  // Beyond the first limit comes a signal, a second later the end.
  if (limits.seconds > 0) lower(RLIMIT_CPU, limits.seconds, 1);
#ifndef __SANITIZE_ADDRESS__  // which reserves terabytes
  if (limits.bytes > 0) lower(RLIMIT_DATA, data_of_this_process() + limits.bytes, 0);
#endif
}

[[noreturn]] void work_as_child(int pipe, pid_t parent, const std::function<std::string()>& work,
                                const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it was gone before
  for (const int signal :
       {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGXCPU})
    ::signal(signal, SIG_DFL);
  apply(limits);
  try {
    const std::string made = work();
    send(pipe, {&done, 1});
    send(pipe, made);
  } catch (const std::exception& error) {
    send(pipe, {&failed, 1});
    send(pipe, error.what());
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

std::string all_from(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<size_t>(count));
  }
}

int status_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw_error("waitpid");
  return status;
}

/// What the child made; `status`: how it ended. Throws: ChildEnded; what it failed with.
std::string answer_in(std::string bytes, int status, const ChildLimits& limits) {
  if (WIFSIGNALED(status))
    throw ChildEnded(WTERMSIG(status) == SIGXCPU
                         ? "takes more than " + std::to_string(limits.seconds) + " s"
                         : std::string("ended by ") + ::strsignal(WTERMSIG(status)));
  if (status != 0 || bytes.empty()) throw ChildEnded("ended, perhaps for lack of memory");
  const bool is_done = bytes.front() == done;
  bytes.erase(0, 1);
  if (!is_done) throw std::runtime_error(bytes);
  return bytes;
}

}  // namespace

std::string result_of_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  int ends[2];
  // No program that another thread starts meanwhile holds them open: the reading ends with the
  // child.
  if (::pipe2(ends, O_CLOEXEC) != 0) throw_error("pipe2");
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw_error("fork");
  }
  if (child == 0) {
    ::close(ends[0]);
    work_as_child(ends[1], parent, work, limits);
  }
  ::close(ends[1]);
  std::string bytes;
  try {
    bytes = all_from(ends[0]);
  } catch (...) {  // no memory for it
    ::close(ends[0]);
    status_of(child);
    throw;
  }
  ::close(ends[0]);
  return answer_in(std::move(bytes), status_of(child), limits);
}

}  // namespace sphparam
