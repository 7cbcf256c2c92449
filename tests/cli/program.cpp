#include "program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern char** environ;

namespace sphparam::tests {

namespace {

std::string number(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const std::string& standard_input,
                 const std::string& output) {
  write_bytes(folder_ / "in", standard_input);
  std::vector<char*> words = {const_cast<char*>("sphparam")};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);

  const std::string standard_output = output.empty() ? folder_ / "out" : output;
  constexpr int create = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 0, (folder_ / "in").c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&streams, 1, standard_output.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&streams, 2, (folder_ / "err").c_str(), create, 0600);
  posix_spawnattr_t heeding_signals;  // also where the tests run beside a script
  posix_spawnattr_init(&heeding_signals);
  sigset_t heeded;
  sigemptyset(&heeded);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&heeded, number);
  posix_spawnattr_setsigdefault(&heeding_signals, &heeded);
  posix_spawnattr_setflags(&heeding_signals, POSIX_SPAWN_SETSIGDEF);
  const int failed =
      posix_spawn(&pid_, SPHPARAM_PROGRAM, &streams, &heeding_signals, words.data(), environ);
  posix_spawnattr_destroy(&heeding_signals);
  posix_spawn_file_actions_destroy(&streams);
  if (failed) throw std::runtime_error("cannot run " SPHPARAM_PROGRAM);
}

void Running::signal(int number) const { kill(pid_, number); }

std::string Running::err_so_far() const { return bytes_of(folder_ / "err"); }

Ended Running::wait() {
  int status = 0;
  if (waitpid(pid_, &status, 0) != pid_) throw std::runtime_error("no end of " SPHPARAM_PROGRAM);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const std::string out = folder_ / "out";  // not there where it goes elsewhere
  return {code, fs::exists(out) ? bytes_of(out) : "", bytes_of(folder_ / "err")};
}

std::string program_file() { return SPHPARAM_PROGRAM; }

Ended sphparam_program(const std::vector<std::string>& arguments, const std::string& standard_input,
                       const std::string& output) {
  return Running(arguments, standard_input, output).wait();
}

int type_advice(const std::string& message, const std::string& folder) {
  std::string script = "cd '" + folder + "' && sphparam() { '" SPHPARAM_PROGRAM "' -q \"$@\"; }";
  int count = 0;
  for (std::size_t at = 0; (at = message.find('`', at)) != std::string::npos; ++count) {
    const std::size_t end = message.find('`', at + 1);
    if (end == std::string::npos) return -1;
    script += " && " + message.substr(at + 1, end - at - 1);
    at = end + 1;
  }
  return std::system(script.c_str()) == 0 ? count : -1;
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) text.append(" ").append(number(mesh.positions(v, axis)));
    text += '\n';
  }
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (int corner = 0; corner < 3; ++corner) {
      text.append(" ").append(std::to_string(mesh.triangles(f, corner) + 1));
    }
    text += '\n';
  }
  return text;
}

}  // namespace sphparam::tests
