#pragma once

#include <string>

namespace sphparam::tools {

/// ".ply" of "STATUE.PLY": in lower case, with its dot; empty where there is none.
std::string extension_of(const std::string& path);

}  // namespace sphparam::tools
