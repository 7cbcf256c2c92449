#include "io/files/child_process.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
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

[[noreturn]] void work_as_child(int pipe, pid_t parent, const std::function<std::string()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it was gone before
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGABRT, SIGFPE})
    ::signal(signal, SIG_DFL);
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

}  // namespace

std::string result_of_child(const std::function<std::string()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) throw_error("pipe");
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw_error("fork");
  }
  if (child == 0) {
    ::close(ends[0]);
    work_as_child(ends[1], parent, work);
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
  const int status = status_of(child);
  if (WIFSIGNALED(status))
    throw ChildEnded(std::string("ended by ") + ::strsignal(WTERMSIG(status)));
  if (status != 0 || bytes.empty()) throw ChildEnded("ended, perhaps for lack of memory");
  const bool is_done = bytes.front() == done;
  bytes.erase(0, 1);
  if (!is_done) throw std::runtime_error(bytes);
  return bytes;
}

}  // namespace sphparam
