#include "program_run.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "console/program.h"

// The kernel keeps the limits: RLIMIT_CPU ends a run by SIGXCPU, an alarm one that sleeps; memory
// beyond RLIMIT_DATA is std::bad_alloc, which the program answers with exit code 1.

namespace sphparam::campaign {
namespace {

constexpr double patience = 10;  // wall time to processor time: the machine may be busy
constexpr const char* messages_file = "messages.txt";

void limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  const rlimit both = {value, value};
  setrlimit(resource, &both);
}

[[noreturn]] void become(const std::string& folder, const std::vector<std::string>& words,
                         const RunLimits& limits) {
  const int nowhere = open("/dev/null", O_RDWR);
  if (chdir(folder.c_str()) != 0) _exit(127);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(open(messages_file, O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)));
  limit(RLIMIT_DATA, limits.bytes);
  alarm(static_cast<unsigned>(std::ceil(patience * limits.seconds)));
  std::vector<char*> arguments;
  std::string name = "sphparam";
  arguments.push_back(name.data());
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int code =
      sphparam::cli::run_sphparam(static_cast<int>(words.size()) + 1, arguments.data());
  std::fflush(nullptr);
  _exit(code);  // destructors of the image module would wait for threads that the parent has
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string first_bytes(const std::string& path, size_t most) {
  std::ifstream in(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  text.resize(std::min(text.size(), most));
  return text;
}

}  // namespace

RunEnd run_in_child(const std::string& folder, const std::vector<std::string>& words,
                    const RunLimits& limits) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no further process");
  if (child == 0) become(folder, words, limits);
  int status = 0;
  rusage used = {};
  if (wait4(child, &status, 0, &used) != child) throw std::runtime_error("a process got lost");
  RunEnd end;
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  end.bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  end.messages = first_bytes(folder + "/" + messages_file, 2000);
  return end;
}

}  // namespace sphparam::campaign
