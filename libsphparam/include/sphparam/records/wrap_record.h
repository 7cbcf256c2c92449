#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/wrap/wrap.h"

namespace sphparam {

/// A surface that was wrapped about a soup. References are to values that outlive the record.
struct WrapRecord {
  std::string input;
  const MeshFile& soup;
  const Wrap& wrap;
  std::vector<std::pair<std::string, std::string>> outputs = {};  // what it is, where it is
  double seconds = 0;
};

/// As `sphparam wrap --json` tells it.
std::string to_json(const WrapRecord& record);

/// For people, a line each: what stood in the way of one ball and what became of it, what lies
/// outside, how far the wrap is from the soup, what the soup carried and the wrap does not.
std::vector<std::string> to_lines(const WrapRecord& record);

}  // namespace sphparam
