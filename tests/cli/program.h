#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"
#include "support/bytes_of.h"
#include "support/folder.h"

/// Running the `sphparam` program as its users do.
namespace sphparam::tests {

namespace fs = std::filesystem;

struct Ended {
  int code;         // exit code; 128 + N when signal N killed it
  std::string out;  // standard output
  std::string err;  // standard error
};

/// A running program whose standard streams are files.
class Running {
 public:
  /// output: where standard output goes; empty: into `Ended::out`.
  Running(const std::vector<std::string>& arguments, const std::string& standard_input,
          const std::string& output = "");
  void signal(int number) const;
  std::string err_so_far() const;
  Ended wait();

 private:
  Folder folder_;
  pid_t pid_ = 0;
};

/// The program itself, for scripts.
std::string program_file();

/// `sphparam arguments…` from start to end.
Ended sphparam_program(const std::vector<std::string>& arguments,
                       const std::string& standard_input = "", const std::string& output = "");

/// Types what a message advises, the commands between `…`, one after the other in a folder. Returns
/// how many there were; −1: one of them failed.
int type_advice(const std::string& message, const std::string& folder);

void write_bytes(const std::string& path, const std::string& bytes);

/// The mesh as the text of an OBJ file, with all digits.
std::string obj_text(const TriangleMesh& mesh);

}  // namespace sphparam::tests
