#pragma once

#include <string>

namespace sphparam {

/// A name as a shell takes it: in quotes where it needs them.
std::string shell_word(const std::string& name);

/// The same of a file, which no option is mistaken for: `./-a.obj`.
std::string shell_file(const std::string& path);

}  // namespace sphparam
