#include "reports/percent.h"

#include "reports/wording.h"

namespace sphparam::cli {

std::string percent_of(double diagonal, double length) {
  return short_number(100 / diagonal * length) + " %";
}

}  // namespace sphparam::cli
