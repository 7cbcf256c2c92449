#pragma once

#include <string>

namespace sphparam::cli {

/// "0.123 %": a length as a share of the diagonal.
std::string percent_of(double diagonal, double length);

}  // namespace sphparam::cli
