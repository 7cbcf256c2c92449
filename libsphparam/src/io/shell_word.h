#pragma once

#include <string>

namespace sphparam {

/// A name as a shell takes it: in quotes where it needs them.
std::string shell_word(const std::string& name);

}  // namespace sphparam
