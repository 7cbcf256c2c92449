#pragma once

#include <string>
#include <vector>

namespace sphparam::cli {

/// The known word nearest to a mistyped one, or "" when none is near enough to be meant.
std::string nearest_word(const std::string& typed, const std::vector<std::string>& known);

}  // namespace sphparam::cli
