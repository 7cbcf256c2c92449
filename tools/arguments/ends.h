#pragma once

#include <optional>
#include <string>
#include <utility>

namespace sphparam::cli {

/// -0.1 and 0.1 of "-0.1,0.1"; nothing unless these are two finite numbers, the smaller one first.
std::optional<std::pair<double, double>> two_ends(const std::string& text);

/// The complaint about others, after the option's name.
constexpr char wanted_ends[] = "expected two numbers, the smaller one first, as in -0.1,0.1";

}  // namespace sphparam::cli
