#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <thread>

/// Work in a process of its own, which has no threads yet.
namespace sphparam::tests {

constexpr auto patience = std::chrono::seconds(60);

/// What waitpid says of a fork that does this and then exits as its answer is, 0 for true; of one
/// that does not end, that it was killed.
template <class Work>
int status_of_fork(const Work& work) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) std::exit(work() ? 0 : 1);
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended < 0) throw std::runtime_error("no end of a process");
    if (ended == child) return status;
    if (std::chrono::steady_clock::now() > end) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Whether work that it does leaves a process with one thread. It ends without what is done at
/// exit: libraries that tests before have opened wait there for threads of theirs, which no fork
/// has.
template <class Work>
bool stays_alone(const Work& work) {
  return status_of_fork([&]() -> bool {
           work();
           const std::filesystem::directory_iterator tasks("/proc/self/task");
           ::_exit(std::distance(begin(tasks), end(tasks)) == 1 ? 0 : 1);
         }) == 0;
}

}  // namespace sphparam::tests
