#include "batch/child.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include "sphparam/batch/run.h"

namespace sphparam {

namespace {

constexpr int crashed = 1;  // an exception that nobody caught

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

pid_t start_child(const std::function<int()>& work) {
  std::fflush(nullptr);  // or both would write it
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw BatchMachineError(std::string("cannot start a process: ") + std::strerror(errno));
  if (child > 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(crashed);  // it ended before it could be told of
  int code = crashed;
  try {
    code = work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sphparam: error: %s\n", error.what());
  }
  std::fflush(nullptr);
  ::_exit(code);
}

ChildEnd wait_for_child(pid_t child) {
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

}  // namespace sphparam
