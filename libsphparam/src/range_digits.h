#pragma once

#include <cmath>
#include <utility>

#include "number_text.h"
#include "parsed_number.h"

namespace sphparam {

/// How many digits, `least` or more, tell each end of a range to 1 % of what lies between them.
inline int range_digits(const std::pair<double, double>& range, int least) {
  constexpr int most = 17;  // of a double
  const double much = 0.01 * std::abs(range.second - range.first);
  const auto is_rough = [&](double end, int digits) {
    return std::abs(parsed<double>(short_number(end, digits)).value_or(end) - end) > much;
  };
  int digits = least;
  while (digits < most && (is_rough(range.first, digits) || is_rough(range.second, digits)))
    ++digits;
  return digits;
}

}  // namespace sphparam
