#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sphparam {

// Numbers and lists as messages have them.

/// "12.3", "0.00123": as many digits as people read.
std::string short_number(double value, int digits = 3);

/// "12.3 %" of 0.123; all of it is "100 %" by any digits.
std::string percent(double share, int digits = 3);

/// All digits that matter, no more: what reads back as the same double.
std::string shortest(double value);

/// "1 skin", "3 skins".
std::string counted(long count, std::string_view thing);

/// "1 face has", "3 faces have".
std::string counted(long count, std::string_view one, std::string_view many);

/// "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

}  // namespace sphparam
