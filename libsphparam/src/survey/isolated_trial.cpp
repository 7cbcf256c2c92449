// The other process sends its record through a pipe, whose end says that it is done or gone.

#include "survey/isolated_trial.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "batch/child.h"
#include "number_text.h"
#include "sphparam/batch/run.h"
#include "sphparam/errors.h"
#include "sphparam/stopwatch.h"
#include "survey/survey_record.h"
#include "survey/surveyor.h"

namespace sphparam {
namespace {

constexpr int look_every = 100;  // milliseconds: whether it is to be stopped

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw BatchMachineError(std::string("cannot make a pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_writing() { close(1); }

  int write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(ends_[1], bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return 1;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }

  /// False at the end. Waits no longer than `look_every`.
  bool read_some(std::string& bytes) const {
    pollfd end{ends_[0], POLLIN, 0};
    if (::poll(&end, 1, look_every) <= 0) return true;
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(ends_[0], buffer.data(), buffer.size());
    if (count < 0) return errno == EINTR;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0;
  }

 private:
  void close(std::size_t end) {
    if (ends_[end] >= 0) ::close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_ = {-1, -1};
};

/// Killed and waited for, whatever happens here.
class Child {
 public:
  explicit Child(const std::function<int()>& work) : process_(start_child(work)) {}
  ~Child() {
    if (process_ > 0) kill();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void kill() {
    ::kill(process_, SIGKILL);
    wait();
  }
  int wait() {
    const int code = wait_for_child(process_).code;
    process_ = -1;
    return code;
  }

 private:
  pid_t process_;
};

SurveyedMesh stopped(const std::string& name, const std::string& why) {
  SurveyedMesh mesh;
  mesh.name = name;
  mesh.end = SurveyEnd::Stopped;
  mesh.reasons = {why};
  return mesh;
}

std::string death(int code) {
  return code > 128 ? "the process that tried it was ended by signal " +
                          std::to_string(code - 128) + " (" + ::strsignal(code - 128) + ")"
                    : "the process that tried it ended with code " + std::to_string(code);
}

}  // namespace

SurveyedMesh isolated_trial(const std::string& folder, const std::string& name,
                            const SurveyOptions& options, double done) {
  Pipe pipe;
  Child child([&] {
    SurveyOptions quiet = options;
    quiet.progress = {};
    return pipe.write(record_of(survey_mesh(folder, name, quiet)));
  });
  pipe.close_writing();
  const Stopwatch watch;
  std::string record;
  while (pipe.read_some(record)) {
    report(options.progress, name, done);
    if (options.longest > 0 && watch.seconds() > options.longest) {
      child.kill();
      return stopped(name, "it took more than " + short_number(options.longest) + " s");
    }
  }
  const int code = child.wait();
  std::optional<SurveyedMesh> mesh = surveyed_of(record);
  return mesh ? std::move(*mesh) : stopped(name, death(code));
}

}  // namespace sphparam
