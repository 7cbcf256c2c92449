#include "commands/diagonal.h"

#include "reports/wording.h"

namespace sphparam::cli {

double diagonal_of(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

std::string percent_of(double diagonal, double length) {
  return short_number(100 / diagonal * length) + " %";
}

}  // namespace sphparam::cli
