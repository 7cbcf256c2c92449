#pragma once

#include <string>

#include "number_text.h"

namespace sphparam {

/// "RMS 0.1 %, at most 0.5 % of the diagonal": of a surface that stands for another.
inline std::string error_words(double rms, double max, double diagonal) {
  return "RMS " + percent(rms / diagonal) + ", at most " + percent(max / diagonal) +
         " of the diagonal";
}

}  // namespace sphparam
